# SPDX-License-Identifier: BSD-3-Clause
"""A slice of an image, a tract and a substrate in one view, each where it lies in the scanner's space (mm).

Run it with ./cactus pvpython examples/one_view.py [FOLDER]. It writes an image (NIfTI) of a tract that bends around a sulcus and the tract
(.tck), lays fibres along the middle of it, runs the chain, places the substrate there, magnified to be seen, and draws all three.
The fibres and an image of the substrate's fractions go into files that lie in the same place.
"""

import gzip
import math
import struct
import sys

from paraview import simple
from output_folder import make_folder
from picture import white_view
from tract import SIDE, look, write_tract

SCALE = 0.001  # 1 mm of the tract is 1 µm of the substrate
VOXEL = 1.0  # mm
LOWER, COUNT = (-30.0, -18.0, -22.0), (61, 37, 56)


def write_image(path):
    """An image in which the tract is bright in a dark sulcus's bank: 255 along its half circle and legs, less around it."""
    values = bytearray()
    for k in range(COUNT[2]):
        for j in range(COUNT[1]):
            for i in range(COUNT[0]):
                x, y, z = (low + VOXEL * index for low, index in zip(LOWER, (i, j, k)))
                depth = abs((math.hypot(x, z) if z > 0 else abs(x)) - 18.25)
                white = 1 / (1 + math.exp(2 * (depth - 4))) / (1 + math.exp(2 * (abs(y) - 14)))
                values.append(int(60 + 150 * white + i % 2 + k % 3))
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *COUNT, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)  # unsigned bytes
    struct.pack_into("<8f", header, 76, 1, VOXEL, VOXEL, VOXEL, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    header[123] = 2  # mm
    struct.pack_into("<2h", header, 252, 0, 1)
    for axis in range(3):
        struct.pack_into("<4f", header, 280 + 16 * axis, *(VOXEL if axis == column else 0 for column in range(3)), LOWER[axis])
    header[344:348] = b"n+1\0"
    with gzip.open(path, "wb") as file:
        file.write(bytes(header) + bytes(values))


def make_substrate(tract):
    """Fibres along the tract, and their outer surfaces."""
    fibres = simple.TractFibres(Input=tract, Side=SIDE, ScaleFactor=SCALE, BundleDiameter=16, MinimumRadius=0.4)
    optimised = simple.OutputPort(simple.CapsuleOptimizer(Input=fibres), 0)
    surfaces = simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=optimised, VoxelSize=0.15))
    return optimised, simple.OutputPort(surfaces, 0)


def show_slice(image, view):
    cut = simple.Slice(Input=image, SliceType="Plane")
    cut.SliceType.Origin, cut.SliceType.Normal = [0.0, 9.0, 0.0], [0.0, 1.0, 0.0]
    shown = simple.Show(cut, view)
    shown.Ambient, shown.Diffuse = 1.0, 0.0
    simple.ColorBy(shown, ("POINTS", "image"))
    greys = simple.GetColorTransferFunction("image")
    greys.ApplyPreset("Grayscale", True)
    greys.RescaleTransferFunction(0.0, 255.0)
    shown.LookupTable = greys
    shown.SetScalarBarVisibility(view, False)


def draw(image, tract, fibres, outer, filename, pixels=900):
    """Left: the fibres in the tract; right: closer, their surfaces."""
    layout = simple.CreateLayout("One view")
    layout.SplitHorizontal(0, 0.5)
    views = []
    for place, source, representation, width in ((1, fibres, "FibreRepresentation", 1.5), (2, outer, "MyelinRepresentation", 3.0)):
        view = white_view(pixels, pixels)
        shown = simple.Show(source, view, representation)
        if place == 2:
            shown.DiffuseColor = shown.AmbientColor = [0.8, 0.35, 0.3]
            look(view, [0.9, -2.0, 0.8])
        show_slice(image, view)
        lines = simple.Show(tract, view)
        lines.DiffuseColor = lines.AmbientColor = [0.95, 0.75, 0.1]
        lines.LineWidth = width
        if place == 1:
            look(view, [0.9, -2.0, 0.8], 1.2)
        layout.AssignView(place, view)
        views.append(view)
    layout.SetSize(2 * pixels, pixels)
    simple.SaveScreenshot(filename, layout, ImageResolution=[2 * pixels, pixels])
    for view in views:  # a render window that lives until Python ends takes the process down with it
        simple.Delete(view)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "cactus-one-view"
    names = ("image.nii.gz", "tract.tck", "fibres.tck", "avf.nii.gz", "one-view.png")
    files = dict(zip(names, make_folder("one_view", folder, names)))
    write_image(files["image.nii.gz"])
    write_tract(files["tract.tck"])
    tract = simple.TractogramReader(FileName=files["tract.tck"], LengthUnit="Millimetre")
    fibres, outer = make_substrate(tract)
    placed = simple.Placement(Input=fibres, Place="On its tract")
    simple.SaveData(files["fibres.tck"], proxy=placed)
    sampled = simple.Placement(Input=simple.SubstrateSampler(Outer=outer, VoxelSize=1), Place="On its tract")
    simple.SaveData(files["avf.nii.gz"], proxy=sampled, Array="AVF")
    draw(simple.NiftiReader(FileName=files["image.nii.gz"]), tract, placed, simple.Placement(Input=outer, Place="On its tract"), files["one-view.png"])


if __name__ == "__main__":
    main()
