# SPDX-License-Identifier: BSD-3-Clause
"""A substrate that bends as a tract does: writes a tract of U-fibres as a .tck, lays fibres along the middle of it, runs the chain, and
draws the tract beside the substrate.

Run it with ./cactus pvpython examples/tract.py [FOLDER]. The tract bends within some 20 mm, the substrate within as many µm.
"""

import math
import struct
import sys

from paraview import servermanager, simple

from output_folder import make_folder
from picture import white_view

SIDE = 24.0  # µm


def write_tract(path):
    """Streamlines (mm) around a sulcus: half circles, one beside the other, with a straight leg at each end."""
    streamlines = []
    for layer in range(4):
        for beside in range(-6, 7):
            radius = 16.0 + 1.5 * layer
            bend = [math.pi * i / 60 for i in range(61)]
            streamline = [(radius, 2.0 * beside, -15.0 + 0.5 * i) for i in range(30)]
            streamline += [(radius * math.cos(angle), 2.0 * beside, radius * math.sin(angle)) for angle in bend]
            streamline += [(-radius, 2.0 * beside, -0.5 - 0.5 * i) for i in range(30)]
            streamlines.append(streamline)
    header = f"mrtrix tracks\ndatatype: Float32LE\ncount: {len(streamlines)}\nfile: . 128\nEND\n".encode()
    with open(path, "wb") as file:
        file.write(header.ljust(128, b"\0"))
        for streamline in streamlines:
            for point in (*streamline, (math.nan,) * 3):
                file.write(struct.pack("<3f", *point))
        file.write(struct.pack("<3f", *(math.inf,) * 3))


def look(view, direction, zoom=1.0):
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraPosition = direction
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(zoom)


def draw(tract, fibres, outer, filename, pixels=800):
    """A PNG of three views side by side: the tract, the fibres that were laid, the surfaces."""
    views = []
    for source, representation in ((tract, "Surface"), (fibres, "Tubes"), (outer, "Surface")):
        view = white_view(pixels, pixels)
        display = simple.Show(source, view)
        display.Representation = representation
        if source is tract:
            display.DiffuseColor = display.AmbientColor = [0.2, 0.35, 0.7]
            display.LineWidth = 3.0
        look(view, [0.6, -2.0, 0.9])
        views.append(view)
    layout = simple.CreateLayout("Tract")
    layout.SplitHorizontal(0, 1 / 3)
    layout.SplitHorizontal(2, 0.5)
    for place, view in zip((1, 5, 6), views):
        layout.AssignView(place, view)
    layout.SetSize(len(views) * pixels, pixels)
    simple.SaveScreenshot(filename, layout, ImageResolution=[len(views) * pixels, pixels])
    for view in views:  # a render window that lives until Python ends takes the process down with it
        simple.Delete(view)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "cactus-tract"
    path, saved, drawn = make_folder("tract", folder, ("tract.tck", "fibres.trx", "tract.png"))
    write_tract(path)
    tract = simple.TractogramReader(FileName=path)
    fibres = simple.TractFibres(Input=tract, Side=SIDE, ScaleFactor=0.001, BundleDiameter=16, MinimumRadius=0.4)
    optimised = simple.CapsuleOptimizer(Input=fibres)
    grown = simple.FibreRadialGrowth(Input=simple.OutputPort(optimised, 0), VoxelSize=0.15)
    surfaces = simple.MyelinSurface(Input=grown)
    outer, inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
    certificate = simple.SubstrateCertificate(Outer=outer, Inner=inner)
    certificate.UpdatePipeline()
    certified = servermanager.Fetch(certificate, idx=0).GetValueByName(0, "Certified").ToInt() == 1
    print(f"{fibres.GetDataInformation().GetNumberOfCells()} fibres, {'certified' if certified else 'NOT certified'}")
    simple.SaveData(saved, proxy=simple.OutputPort(optimised, 0))
    draw(tract, fibres, outer, drawn)
    sys.exit(0 if certified else 1)


if __name__ == "__main__":
    main()
