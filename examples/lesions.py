# SPDX-License-Identifier: BSD-3-Clause
"""Makes a healthy bundle with nodes of Ranvier and six states of disease of it, and prints a table of all and a strip of their cross-sections.

    ./cactus pvpython examples/lesions.py [--side 12] [STRIP.png]

All lengths are in µm. The page docs/lesions.md tells more.
"""

import argparse

import matplotlib

matplotlib.use("Agg")  # without a window
from matplotlib import pyplot  # noqa: E402
from paraview import simple  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

COLUMNS = ("FVF", "AVF", "MVF", "AxonalWaterFraction", "MeanAxonDiffusivityRatio", "ExtraAxonalDiffusivityRatioX")


def row_of(proxy):
    proxy.UpdatePipeline()
    table = proxy.GetClientSideObject().GetOutputDataObject(0)
    return {table.GetColumnName(i): table.GetColumn(i).GetTuple1(0) for i in range(table.GetNumberOfColumns())}


def bundle(side):
    return simple.OutputPort(simple.CapsuleOptimizer(Input=simple.BundleInitializer(Side=side, FibreVolumeFraction=0.5, GrownFibreVolumeFraction=0.8)), 0)


def state(fibres, fraction=-1, myelin=None, **loss):
    """(fibres, outer and inner surfaces) grown to a fraction, with a lesion of internodes or axons (properties of MyelinSurface) or of fibres."""
    surfaces = simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=fibres, TargetFibreVolumeFraction=fraction), NodeLength=1, **(myelin or {}))
    if not loss:
        return fibres, simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
    left = simple.Lesion(Outer=simple.OutputPort(surfaces, 0), Inner=simple.OutputPort(surfaces, 1), Fibres=fibres, **loss)
    return simple.OutputPort(left, 2), simple.OutputPort(left, 0), simple.OutputPort(left, 1)


def section(outer, inner):
    """A cut through the middle, as rows of grey values."""
    cut = simple.HistologyMask(Outer=outer, Inner=inner, PixelSize=0.04)
    cut.UpdatePipeline()
    image = cut.GetClientSideObject().GetOutputDataObject(0)
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetArray("Mask")).reshape(rows, columns)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("strip", nargs="?", default="lesions.png", help="picture to write")
    arguments.add_argument("--side", type=float, default=12, help="of the domain, µm")
    asked = arguments.parse_args()
    healthy = bundle(asked.side)
    states = {
        "healthy": state(healthy),
        "oedema": state(healthy, fraction=0.65),
        "demyelinated": state(healthy, MyelinLoss=0.5),
        "internodes lost": state(healthy, myelin={"InternodeLoss": 0.5}),
        "remyelinated": state(healthy, myelin={"InternodeLoss": 0.5, "RemyelinatedFraction": 1}),
        "with axonal loss": state(healthy, AxonLoss=0.25, MyelinLoss=0.5),
        "swollen": state(healthy, myelin={"SwellingAmplitude": 0.3}),
    }
    strip, places = pyplot.subplots(1, len(states), figsize=(3 * len(states), 3.3))
    print("| state | certified | " + " | ".join(COLUMNS) + " |")
    print("|---" * (len(COLUMNS) + 2) + "|")
    for place, (name, (fibres, outer, inner)) in zip(places, states.items()):
        given = {"Outer": outer, "Inner": inner, "Fibres": fibres}
        certified = row_of(simple.SubstrateCertificate(**given))["Certified"]
        found = row_of(simple.SubstrateStatistics(ExtraAxonalWalkers=1000, CutSpacing=0.25, **given))
        print(f"| {name} | {'yes' if certified else 'no'} | " + " | ".join(f"{found[column]:.3f}" for column in COLUMNS) + " |", flush=True)
        place.imshow(section(outer, inner), cmap="gray", vmin=0, vmax=255, origin="lower")
        place.set_title(name)
        place.set_axis_off()
    strip.tight_layout()
    strip.savefig(asked.strip, dpi=100)
    print(f"strip: {asked.strip}")


if __name__ == "__main__":
    main()
