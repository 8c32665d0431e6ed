# SPDX-License-Identifier: BSD-3-Clause
"""Gives the fibres of one bundle nodes of Ranvier, at several distances, and prints a table of what that takes of the myelin. Draws a cut along
the fibres of the last of them, and of the same fibres without nodes.

    ./cactus pvpython examples/nodes.py [--side 10] [--length 24] [NODES.png]

All lengths are in µm. The page docs/surfaces.md tells more of nodes.
"""

import argparse

from paraview import simple
from picture import AXON, MYELIN, section_view
from vtkmodules.util.numpy_support import vtk_to_numpy

WIDTH = 1000  # of the picture, in pixels
FACTORS = (100, 50, 20, 10)  # internodes of tissue are 100 to 200 outer diameters long


def table_of(proxy, port=0):
    proxy.UpdatePipeline()
    rows = proxy.GetClientSideObject().GetOutputDataObject(port)
    return {rows.GetColumnName(i): vtk_to_numpy(rows.GetColumn(i)) for i in range(rows.GetNumberOfColumns())}


def row_of(name, fibres, surfaces):
    given = {"Outer": simple.OutputPort(surfaces, 0), "Inner": simple.OutputPort(surfaces, 1), "Fibres": fibres}
    certificate = table_of(simple.SubstrateCertificate(**given))
    each = table_of(surfaces, 2)
    nodes = each["Nodes"]
    internodes = f"{each['InternodeLength_um'][nodes > 0].mean():.1f}" if nodes.any() else ""
    myelin = each["OuterVolume_um3"] - each["InnerVolume_um3"]
    lost = (each["LostMyelin"] * myelin / (1 - each["LostMyelin"]))[nodes > 0].sum() / myelin.sum()
    fractions = " | ".join(f"{certificate[fraction][0]:.4f}" for fraction in ("FVF", "AVF", "MVF"))
    return f"| {name} | {'yes' if certificate['Certified'][0] else 'no'} | {int(nodes.sum())} | {internodes} | {100 * lost:.1f} | {fractions} |"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("picture", nargs="?", default="nodes.png", help="picture to write")
    arguments.add_argument("--side", type=float, default=10, help="of the domain, µm")
    arguments.add_argument("--length", type=float, default=24, help="of the domain along the bundle, µm")
    asked = arguments.parse_args()
    bundle = simple.BundleInitializer(Side=asked.side, Length=asked.length, MeanDispersion=2, Sinuosity=1.01, FibreVolumeFraction=0.55, GrownFibreVolumeFraction=0.8)
    fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0)
    grown = simple.FibreRadialGrowth(Input=fibres)
    without = simple.MyelinSurface(Input=grown)
    print("| internodes in outer diameters | certified | nodes | mean internode (µm) | myelin lost (%) | FVF | AVF | MVF |")
    print("|---|---|---|---|---|---|---|---|")
    print(row_of("no nodes", fibres, without), flush=True)
    for factor in FACTORS:
        surfaces = simple.MyelinSurface(Input=grown, NodeLength=1, InternodeFactor=factor)
        print(row_of(factor, fibres, surfaces), flush=True)
    layout = simple.CreateLayout("Nodes")
    views = []
    for made in (without, surfaces):
        layers = [(simple.OutputPort(made, 0), MYELIN), (simple.OutputPort(made, 1), AXON)]
        views.append(section_view(layers, 1.04 * asked.side, WIDTH, normal=(0.0, -1.0, 0.0), up=(1.0, 0.0, 0.0)))
    simple.AssignViewToLayout(view=views[0], layout=layout, hint=0)
    simple.AssignViewToLayout(view=views[1], layout=layout, hint=layout.SplitVertical(0, 0.5) + 1)
    height = round(2 * WIDTH * asked.side / asked.length)
    layout.SetSize(WIDTH, height)
    simple.SaveScreenshot(asked.picture, layout, ImageResolution=[WIDTH, height])
    print(f"picture: {asked.picture}")


if __name__ == "__main__":
    main()
