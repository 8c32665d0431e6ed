# SPDX-License-Identifier: BSD-3-Clause
"""NIfTI images in scripts of ParaView, where they lie in the scanner's space (mm).

ParaView's window opens no NIfTI files unless it was built with a plugin for them, and that one leaves their place out. VTK has a reader, which
takes every header at its word and gives the place and the scale of its numbers apart from the image. read_image() looks at the header first and puts all
together; it raises ValueError, which says what is wrong with the file.
"""

import gzip
import math
import struct

from paraview import simple
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkIOImage import vtkNIFTIImageReader

BYTES = {2: 1, 4: 2, 8: 4, 16: 4, 64: 8, 256: 1, 512: 2, 768: 4}  # of a voxel, by the code of its type
MILLIMETRES = {0: 1.0, 1: 1000.0, 2: 1.0, 3: 0.001}  # in the unit of lengths; 0 is one that nobody has named


def content_size(file, wanted):
    """How many bytes there are, counted no further than it matters."""
    size = 0
    while size < wanted:
        read = len(file.read(min(wanted - size, 1 << 20)))
        if read == 0:
            break
        size += read
    return size


def check_header(path):
    """Millimetres in the header's unit of lengths, and slope and intercept of its numbers. Whatever a reader would trip over is found here."""
    with gzip.open(path) if path.endswith(".gz") else open(path, "rb") as file:
        try:
            header = file.read(348)
            if len(header) < 348 or 348 not in (struct.unpack_from(order + "i", header)[0] for order in "<>") or header[344:347] != b"n+1":
                raise ValueError(f"{path} is no NIfTI-1 image in one file")
            order = "<" if struct.unpack_from("<i", header)[0] == 348 else ">"
            rank, *dimensions = struct.unpack_from(order + "8h", header, 40)
            kind, bits = struct.unpack_from(order + "2h", header, 70)
            spacing = struct.unpack_from(order + "3f", header, 80)
            offset, slope, intercept = struct.unpack_from(order + "3f", header, 108)
            if not 1 <= rank <= 7 or min(dimensions[:rank]) < 1:
                raise ValueError(f"{path}: its header gives {rank} dimensions of {dimensions[:max(1, min(rank, 7))]} voxels")
            if BYTES.get(kind, 0) * 8 != bits or not bits:
                raise ValueError(f"{path}: voxels of type {kind} with {bits} bits cannot be read: whole and floating-point numbers can")
            if not all(0 < abs(step) < math.inf for step in spacing[: min(rank, 3)]) or not 352 <= offset < math.inf:
                raise ValueError(f"{path}: its header gives voxels of {spacing} from byte {offset} on")
            if slope == 0:  # not set
                slope, intercept = 1.0, 0.0
            if not math.isfinite(slope) or not math.isfinite(intercept):
                raise ValueError(f"{path}: its header gives numbers scaled by {slope} and moved by {intercept}")
            wanted = int(offset) - 348 + BYTES[kind] * math.prod(dimensions[:rank])
            found = content_size(file, wanted)
        except (EOFError, OSError) as error:
            raise ValueError(f"{path} cannot be read: {error}") from error
    if found < wanted:
        raise ValueError(f"{path} is truncated, or its header wrong: {wanted} bytes are to follow it, and {found} do")
    return MILLIMETRES.get(header[123] & 7, 1.0), slope, intercept


def read_image(path):
    """The image as a source, in mm of the scanner: by its s-form or, where it has none, by its q-form."""
    millimetres, slope, intercept = check_header(path)
    reader = vtkNIFTIImageReader()
    reader.SetFileName(path)
    reader.Update()
    image, place = reader.GetOutput(), reader.GetSFormMatrix() or reader.GetQFormMatrix()
    if place is None:
        raise ValueError(f"{path} does not say where it lies: neither its s-form nor its q-form is set")
    numbers = [[place.GetElement(row, column) for column in range(4)] for row in range(3)]
    if not all(math.isfinite(number) for row in numbers for number in row) or not 1e-6 < abs(place.Determinant()) < 1e6:
        raise ValueError(f"{path}: the affine of its header, {numbers}, leaves the image no volume")
    if (slope, intercept) != (1.0, 0.0):
        scaled = vtkImageShiftScale()
        scaled.SetInputData(image)
        scaled.SetShift(intercept / slope)
        scaled.SetScale(slope)
        scaled.SetOutputScalarTypeToDouble()
        scaled.Update()
        image = scaled.GetOutput()
    image.SetSpacing([millimetres * step for step in image.GetSpacing()])
    image.SetOrigin([millimetres * row[3] for row in numbers])
    image.SetDirectionMatrix([number for row in numbers for number in row[:3]])
    producer = simple.PVTrivialProducer()
    producer.GetClientSideObject().SetOutput(image)
    return producer
