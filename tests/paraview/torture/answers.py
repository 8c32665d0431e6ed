# SPDX-License-Identifier: BSD-3-Clause
"""What a case is answered: messages, and what outputs hold."""

import hashlib
import re

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkDataArray, vtkLogger, vtkOutputWindow

from torture import inputs

PREFIX = re.compile(r"^(ERROR|Warning|Generic Warning): In [^\n]*, line \d+\n(?:[\w:<> ]+ \((?:0x)?[0-9a-fA-F]+\): )?")
DUMP = re.compile(r": vtkInformation \(.*", re.S)  # what the pipeline adds to its own remarks
CPLUSPLUS = re.compile(
    r"std::|St\d|\bstd_|bad_alloc|basic_string|basic_filebuf|vector::|_M_|length_error|what\(\)|Eigen|_ZN|filesystem error|cannot create std|Assertion|terminate"
)
PIPELINE = re.compile(r"returned failure for request|Failed to execute|Could not create")
CLASS_MISMATCH = re.compile(r"^Input for connection index \d+ on input port index \d+ for algorithm .* is of type \w+, but an? .* is required\.$", re.S)
# Measures that need not exist: of cuts where none lies wholly inside the domain, of axons without any, over an edge of no length, of
# bends where all is straight, directions of which a voxel has fewer (NaN, as MRtrix writes them).
MAY_BE_MISSING = re.compile(
    r"row\..*(Radius|Circularity|SmallestMyelin|GRatio|EdgeRatio|Aspect|Sinuosity|Undulation|AxisRatio|CalibreVariation|AxonArea|DiffusivityRatio|SurfaceToVolume|Diameter|MyelinThickness)"
    r"|field\.Smallest(Bend|Curvature)Radius|point\.Peaks$")
THINGS = re.compile(
    r"fibre|point|cell|array|tractogram|header|truncated|field data|Domain|voxel|surface|triangle|input|block|image|extent|polyline|segment|file|line|folder|link|memory|grey value|axons|Radius|Side|Id\b",
    re.I,
)


class Reports:
    """VTK's errors and warnings while it is watched."""

    def __init__(self):
        self.errors, self.warnings = [], []

        def listen(window, event, text):
            if PREFIX.match(text):
                text = DUMP.sub("", PREFIX.sub("", text)).strip()
                (self.errors if event == "ErrorEvent" else self.warnings).append(text)

        listen.CallDataType = VTK_STRING
        for event in ("ErrorEvent", "WarningEvent"):
            vtkOutputWindow.GetInstance().AddObserver(event, listen)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)

    def take(self):
        result = (self.errors, self.warnings)
        self.errors, self.warnings = [], []
        return result


def leaves(data):
    """The data sets of a composite, or the data object itself; None for nothing."""
    if data is None:
        return []
    if data.IsA("vtkCompositeDataSet"):
        iterator = data.NewIterator()
        iterator.InitTraversal()
        result = []
        while not iterator.IsDoneWithTraversal():
            result.append(iterator.GetCurrentDataObject())
            iterator.GoToNextItem()
        return result
    return [data]


def holders(data):
    """(name, vtkFieldData) of the attributes of a data object, and of a table its columns."""
    yield from ((where, holder) for where, holder, _ in inputs.attributes(data))
    if data.IsA("vtkTable"):
        yield "row", data.GetRowData()


def is_empty(data):
    return all(
        (each.GetNumberOfPoints() == 0 and each.GetNumberOfCells() == 0) if each.IsA("vtkDataSet") else each.GetNumberOfElements(6) == 0
        for each in leaves(data)
    )


def contents(data):
    """(name, numbers or text) of all that a data object holds, but for times."""
    for number, each in enumerate(leaves(data)):
        if each.IsA("vtkPointSet") and each.GetNumberOfPoints():
            yield f"{number}.points", vtk_to_numpy(each.GetPoints().GetData())
        if each.IsA("vtkPolyData"):
            for kind in ("Verts", "Lines", "Polys", "Strips"):
                yield f"{number}.{kind}", vtk_to_numpy(getattr(each, "Get" + kind)().GetConnectivityArray())
        if each.IsA("vtkImageData"):
            yield f"{number}.grid", np.array(each.GetExtent() + each.GetOrigin() + each.GetSpacing())
        for where, holder in holders(each):
            for i in range(holder.GetNumberOfArrays()):
                array = holder.GetAbstractArray(i)
                name = f"{number}.{where}.{array.GetName()}"
                if "Seconds" in name:
                    continue
                if isinstance(array, vtkDataArray):
                    yield name, vtk_to_numpy(array)
                else:
                    yield name, "\n".join(str(array.GetVariantValue(j).ToString()) for j in range(array.GetNumberOfValues()))


def fingerprint(outputs):
    """A hash of all that the outputs hold."""
    digest = hashlib.sha256()
    for data in outputs:
        for name, value in sorted(contents(data), key=lambda item: item[0]):  # (in which order VTK keeps arrays is its own affair)
            digest.update(name.encode())
            digest.update(value.encode() if isinstance(value, str) else np.ascontiguousarray(value).tobytes())
    return digest.hexdigest()


def not_finite(outputs):
    """Names of arrays with a number that is not finite, or beyond all reason."""
    result = set()
    for port, data in enumerate(outputs):
        for name, value in contents(data):
            if not isinstance(value, str) and value.dtype.kind == "f" and value.size:
                may_be_missing = MAY_BE_MISSING.search(name)
                flat = value.ravel()
                for first in range(0, flat.size, 10**6):  # in parts: this process has a limit of memory, too
                    part = flat[first : first + 10**6]
                    with np.errstate(all="ignore"):
                        fine = np.abs(part) < 1e15
                        if may_be_missing:
                            fine |= ~np.isfinite(part)
                        if not np.all(fine):
                            result.add(f"{port}.{name.split('.', 1)[1]}")
                            break
    return result


def marks(data):
    """The texts of field data `Error`, in the data object or its blocks."""
    found = []
    for each in leaves(data) + ([data] if data is not None else []):
        array = each.GetFieldData().GetAbstractArray("Error")
        if array is not None and array.GetNumberOfValues():
            found.append(str(array.GetVariantValue(0).ToString()))
    return found
