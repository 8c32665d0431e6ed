# SPDX-License-Identifier: BSD-3-Clause
"""Makes a bundle without and with nodes of Ranvier, prints a table of what nodes take, and draws a picture of one with many.

    ./cactus pvpython examples/nodes.py [--side 30] [PICTURE.png]

All lengths are in µm. The page docs/surfaces.md tells more.
"""

import argparse
import os
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from paraview import simple  # noqa: E402  (folders first)
from picture import AXON, MYELIN, section_view, show, white_view  # noqa: E402

PIXELS = 800


def table_of(proxy, port):
    proxy.UpdatePipeline()
    table = proxy.GetClientSideObject().GetOutputDataObject(port)
    return {table.GetColumnName(i): [table.GetColumn(i).GetTuple1(row) for row in range(table.GetNumberOfRows())] for i in range(table.GetNumberOfColumns())}


def bundle(side):
    return simple.OutputPort(simple.CapsuleOptimizer(Input=simple.BundleInitializer(Side=side, MeanDispersion=5)), 0)


def print_row(name, fibres, surfaces):
    given = {"Outer": simple.OutputPort(surfaces, 0), "Inner": simple.OutputPort(surfaces, 1), "Fibres": fibres}
    rows = table_of(surfaces, 2)
    certified = table_of(simple.SubstrateCertificate(**given), 0)["Certified"][0]
    found = {column: values[0] for column, values in table_of(simple.SubstrateStatistics(**given), 0).items()}
    internodes = [length for length, nodes in zip(rows["InternodeLength_um"], rows["Nodes"]) if nodes > 0]
    mean = f"{sum(internodes) / len(internodes):.1f}" if internodes else ""
    print(
        f"| {name} | {'yes' if certified else 'no'} | {int(sum(rows['Nodes']))} | {mean} | {found['FVF']:.4f} | {found['AVF']:.4f} | {found['MVF']:.4f} | {found['AggregateGRatio']:.4f} |",
        flush=True,
    )
    return found["MVF"]


def thickest(surfaces):
    rows = table_of(surfaces, 2)
    return max((radius, fibre) for radius, fibre, nodes in zip(rows["TargetRadius_um"], rows["FibreId"], rows["Nodes"]) if nodes > 0)[1]


def draw(surfaces, side, picture):
    """Left a cut along the fibres, right the thickest fibre with a node, cut open."""
    outer, inner = (simple.OutputPort(surfaces, port) for port in (0, 1))
    along = section_view([(outer, MYELIN), (inner, AXON)], 1.02 * side, PIXELS, normal=(0.0, -1.0, 0.0), up=(0.0, 0.0, 1.0))
    fibre = thickest(surfaces)
    view = white_view(PIXELS, PIXELS)
    for kind, colour in ((outer, MYELIN), (inner, AXON)):
        one = simple.Threshold(Input=kind, Scalars=["CELLS", "FibreId"], LowerThreshold=fibre, UpperThreshold=fibre)
        one.UpdatePipeline()
        bounds = one.GetDataInformation().GetBounds()
        middle = [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
        if kind is outer:
            one = simple.Clip(Input=one, ClipType="Plane")
            one.ClipType.Origin = middle
            one.ClipType.Normal = [0.0, -1.0, 0.0]
            one.Invert = 1
        show(one, view, colour)
    view.CameraFocalPoint = middle
    view.CameraPosition = [middle[0] + 0.9 * side, middle[1] - 2.0 * side, middle[2] + 0.5 * side]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(1.3)
    layout = simple.CreateLayout("Nodes")
    simple.AssignViewToLayout(view=along, layout=layout, hint=0)
    layout.SplitHorizontal(0, 0.5)
    simple.AssignViewToLayout(view=view, layout=layout, hint=2)
    layout.SetSize(2 * PIXELS, PIXELS)
    simple.SaveScreenshot(picture, layout, ImageResolution=[2 * PIXELS, PIXELS], CompressionLevel="9")
    for each in (along, view):
        simple.Delete(each)  # a render window that lives until Python ends takes the process down with it


def main():
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("picture", nargs="?", default="nodes.png", help="picture to write")
    arguments.add_argument("--side", type=float, default=30, help="of the domain, µm")
    asked = arguments.parse_args()
    fibres = bundle(asked.side)
    grown = simple.FibreRadialGrowth(Input=fibres)
    print("| InternodeFactor | certified | nodes | internode (µm) | FVF | AVF | MVF | AggregateGRatio |")
    print("|---" * 8 + "|")
    print_row("without nodes", fibres, simple.MyelinSurface(Input=grown))
    for factor in (100, 20, 5):
        print_row(factor, fibres, simple.MyelinSurface(Input=grown, NodeLength=1, InternodeFactor=factor))
    few = 12.0
    small = simple.FibreRadialGrowth(Input=bundle(few))
    draw(simple.MyelinSurface(Input=small, NodeLength=1, InternodeFactor=5), few, asked.picture)
    print(f"picture: {asked.picture}")


if __name__ == "__main__":
    main()
