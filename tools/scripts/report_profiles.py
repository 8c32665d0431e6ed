# SPDX-License-Identifier: BSD-3-Clause
"""How thick some fibres of a substrate folder are along themselves: the cuts of Substrate Statistics across their surfaces, which alone are read."""

import math

from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

from preview import read_surface, surface_files, with_numbers

CUTS = 80  # along the side of the domain


def candidates(fibres, parts=(0.1, 0.5, 0.9), count=5):
    """[ids of some thin fibres], of middle ones and of thick ones, by rows of the certificate's table, those at their place first; of as many as there
    are."""
    measured = sorted((row["OuterRadius_um"], int(row["FibreId"])) for row in fibres if math.isfinite(row["OuterRadius_um"]) and row.get("OuterCuts", 1) > 0)
    places = sorted({round(part * (len(measured) - 1)) for part in parts}) if measured else []

    def around(place):
        nearest = sorted(range(len(measured)), key=lambda index: abs(index - place))[:count]
        return [index for index in nearest if min(places, key=lambda other: abs(other - index)) == place]

    return [[measured[index][1] for index in around(place)] for place in places]


def chosen(groups, cuts):
    """Of each group the fibre with the most cuts across its outer surface: of one that leaves the domain at its side little is to be seen."""
    return [max(group, key=lambda fibre: sum(math.isfinite(outer) for _, outer, _ in cuts[fibre])) for group in groups]


def _source(data):
    """Data as an input for ParaView's filters."""
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    return producer


def _lines(everything, places):
    """Those centre lines out of all that are at `places` = {id: place}, with these ids."""
    some = vtkPolyData()
    some.SetPoints(everything.GetPoints())
    some.GetPointData().AddArray(everything.GetPointData().GetArray("Radius"))
    cells = vtkCellArray()
    for place in places.values():
        cells.InsertNextCell(everything.GetCell(place))
    some.SetLines(cells)
    with_numbers(some, FibreId=0, BundleId=1)
    for cell, fibre in enumerate(places):
        some.GetCellData().GetArray("FibreId").SetValue(cell, fibre)
    some.GetFieldData().AddArray(everything.GetFieldData().GetArray("Domain"))
    return some


def _surfaces(folder, manifest, kind, wanted):
    """The surfaces of a kind of these fibres, or None where there are none."""
    together = vtkAppendPolyData()
    for entry, path in surface_files(folder, manifest):
        if entry["surface"] == kind and entry["fibre"] in wanted:
            surface = read_surface(manifest, entry, path)
            together.AddInputData(with_numbers(surface, FibreId=entry["fibre"], BundleId=entry["bundle"]))
    if together.GetNumberOfInputConnections(0) == 0:
        return None
    together.Update()
    return together.GetOutput()


def profiles(folder, manifest, fibres, lines):
    """[(id, [(arc length, outer diameter, inner diameter)])] of some fibres, in µm, inner ones NaN where there is no axon. `fibres` = rows of
    the certificate's table, `lines` = a source of all centre lines. None of a folder whose lines are not those of its surfaces."""
    everything = servermanager.Fetch(lines)
    ids = sorted(int(row["FibreId"]) for row in fibres)
    if everything.GetNumberOfCells() != len(ids):
        return []
    groups = candidates(fibres)
    wanted = [fibre for group in groups for fibre in group]
    outer, inner = (_surfaces(folder, manifest, kind, wanted) for kind in ("outer", "inner"))
    if outer is None:
        return []
    side = max(manifest["domain"][2 * axis + 1] - manifest["domain"][2 * axis] for axis in range(3))
    inputs = {"Inner": _source(inner)} if inner is not None else {}
    statistics = simple.SubstrateStatistics(
        Fibres=_source(_lines(everything, {fibre: ids.index(fibre) for fibre in wanted})), Outer=_source(outer), CutSpacing=max(0.01, side / CUTS), **inputs)
    statistics.UpdatePipeline()
    table = servermanager.Fetch(statistics, idx=3)
    columns = [vtk_to_numpy(table.GetColumnByName(name)) for name in ("FibreId", "ArcLength_um", "OuterDiameter_um", "InnerDiameter_um")]
    found = {fibre: [] for fibre in wanted}
    for fibre, *cut in zip(*columns):
        found[int(fibre)].append(tuple(float(value) for value in cut))
    return [(fibre, found[fibre]) for fibre in chosen(groups, found) if len(found[fibre]) > 1]
