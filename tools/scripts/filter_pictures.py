# SPDX-License-Identifier: BSD-3-Clause
"""Draws the picture of each page in docs/filters: what the filter makes of a small substrate.

    ./cactus pvpython tools/scripts/filter_pictures.py [NAME...]

Without a name it draws all, into docs/images/filters.
"""

import argparse
import functools
import io
import os
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path += [os.path.join(ROOT, "examples"), os.path.join(ROOT, "examples", "figures")]
import numpy  # noqa: E402  (folders first)
from paper_figure import columns, image, pyplot  # noqa: E402
from one_view import show_slice, write_image  # noqa: E402
from paraview import servermanager, simple  # noqa: E402
from paraview.vtk.util.numpy_support import vtk_to_numpy  # noqa: E402
from picture import AXON, MYELIN, below, show, white_view  # noqa: E402
from PIL import Image  # noqa: E402
from tract import write_tract  # noqa: E402

SIDE, PIXELS = 12.0, 520
PIXEL = 0.02  # µm, of masks: less than the gap between fibres
SCRATCH = tempfile.TemporaryDirectory(prefix="cactus-pictures-")


@functools.lru_cache(maxsize=None)
def bundle():
    return simple.BundleInitializer(Side=SIDE, MeanDispersion=10, Seed=1)


@functools.lru_cache(maxsize=None)
def fibres():
    return simple.OutputPort(simple.CapsuleOptimizer(Input=bundle()), 0)


@functools.lru_cache(maxsize=None)
def grown():
    return simple.FibreRadialGrowth(Input=fibres())


@functools.lru_cache(maxsize=None)
def surfaces():
    return simple.MyelinSurface(Input=grown())


def outer():
    return simple.OutputPort(surfaces(), 0)


def scratch(name):
    return os.path.join(SCRATCH.name, name)


def look(view, position=(2.2, -1.7, 1.6)):
    """From above, at an angle."""
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = position, [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    return image(view, PIXELS, PIXELS)


def tubes(source, **position):
    view = white_view(PIXELS, PIXELS)
    simple.Show(source, view)
    return look(view, **position)


def coloured(source, array, low, high):
    """Fibres as tubes, from grey to red by an array of their points."""
    view = white_view(PIXELS, PIXELS)
    shown = simple.Show(source, view)
    simple.ColorBy(shown, ("POINTS", array))
    colours = simple.GetColorTransferFunction(array)
    colours.ColorSpace = "RGB"
    colours.RGBPoints = [low, 0.85, 0.85, 0.85, high, 0.75, 0.0, 0.0]
    shown.SetScalarBarVisibility(view, False)
    return look(view)


def pictures_beside(*parts):
    """One figure of several pictures, each with its title."""
    canvas, axes = pyplot.subplots(1, len(parts), figsize=(4.2 * len(parts), 4.2), layout="constrained", squeeze=False)
    for axis, (title, picture) in zip(axes[0], parts):
        axis.imshow(picture)
        axis.set_title(title)
        axis.set_axis_off()
    return canvas


def chart(label, ylabel="fibres"):
    canvas, axis = pyplot.subplots(figsize=(5.5, 3.2), layout="constrained")
    axis.set_xlabel(label)
    axis.set_ylabel(ylabel)
    return canvas, axis


def voxels(source, name):
    """A point array of an image, by z, y and x."""
    source.UpdatePipeline()
    data = servermanager.Fetch(source)
    return vtk_to_numpy(data.GetPointData().GetArray(name)).reshape(data.GetDimensions()[::-1])


def section(values, title, legend="", **how):
    """An image of numbers, with its sides in µm."""
    canvas, axis = pyplot.subplots(figsize=(4.6, 4.0), layout="constrained")
    drawn = axis.imshow(values, origin="lower", extent=[-SIDE / 2, SIDE / 2] * 2, interpolation="nearest", **how)
    axis.set_title(title)
    axis.set_xlabel("x (µm)")
    axis.set_ylabel("y (µm)")
    if legend:
        canvas.colorbar(drawn, ax=axis, label=legend)
    return canvas


def tract():
    path = scratch("tract.tck")
    write_tract(path)
    return path


def bundle_initializer():
    return pictures_beside(("", tubes(bundle())))


def tract_fibres():
    read = simple.TractogramReader(FileName=tract())
    return pictures_beside(("", tubes(simple.TractFibres(Input=read, Side=16, ScaleFactor=0.001, BundleDiameter=11, MinimumRadius=0.4))))


def curved_bundles():
    """A bend, a fan and two bundles that kiss."""
    shapes = (("Bend", {"BendRadius": 16}), ("Fan", {"FanAngle": 60}), ("Kiss", {"BendRadius": 16}))
    return pictures_beside(*[
        (shape.lower(), tubes(simple.CurvedBundles(Shape=shape, Side=15, Margin=0, MinimumRadius=0.4, **values), position=(0.5, -2.0, 0.6)))
        for shape, values in shapes
    ])


def strand_reader():
    path = scratch("bundle.strands")
    simple.SaveData(path, proxy=simple.BundleInitializer(Side=5, MinimumRadius=0.3))
    return pictures_beside(("", tubes(simple.StrandReader(FileName=path))))


def tractogram_reader():
    view = white_view(PIXELS, PIXELS)
    shown = simple.Show(simple.TractogramReader(FileName=tract()), view)
    shown.DiffuseColor = shown.AmbientColor = [0.2, 0.35, 0.7]
    shown.LineWidth = 2.5
    return pictures_beside(("", look(view)))


def nifti_reader():
    """A slice of an image, and the tract beside it."""
    path = scratch("image.nii.gz")
    write_image(path)
    view = white_view(PIXELS, PIXELS)
    show_slice(simple.NiftiReader(FileName=path), view)
    shown = simple.Show(simple.TractogramReader(FileName=tract(), LengthUnit="Millimetre"), view)
    shown.DiffuseColor = shown.AmbientColor = [0.95, 0.75, 0.1]
    shown.LineWidth = 2.5
    return pictures_beside(("", look(view, position=(0.9, -2.0, 0.8))))


def substrate_reader():
    """What a folder gives, one beside the other."""
    path = scratch("small.substrate")
    few = simple.CapsuleOptimizer(Input=simple.BundleInitializer(Side=5, FibreVolumeFraction=0.5, MinimumRadius=0.4))
    simple.SaveData(path, proxy=simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=simple.OutputPort(few, 0))))
    read = simple.SubstrateReader(FileName=path)
    return pictures_beside(*[(name, tubes(simple.OutputPort(read, port))) for port, name in enumerate(("Outer", "Inner", "Fibres"))])


def capsule_optimizer():
    untouched = simple.CapsuleOptimizer(Input=bundle(), MaximumIterations=0)  # which warns that fibres overlap
    deepest = columns(untouched, 1)["MaximumPenetration"][0]
    before, after = (coloured(one, "Overlap", 0.0, deepest) for one in (simple.OutputPort(untouched, 0), fibres()))
    return pictures_beside((f"before: they lie in each other by up to {100 * deepest:.0f} %", before), ("after: no two overlap", after))


def fibre_radial_growth():
    numbers = voxels(grown(), "FibreId")
    middle = numbers[len(numbers) // 2]
    shuffled = numpy.random.default_rng(1).permutation(numbers.max() + 1)
    colours = pyplot.get_cmap("nipy_spectral")(0.1 + 0.8 * shuffled[middle] / numbers.max())
    colours[middle == 0] = 1.0
    return section(colours, "FibreId at z = 0")


def myelin_surface():
    view = white_view(PIXELS, PIXELS)
    show(below(outer(), SIDE / 6), view, MYELIN)
    show(simple.OutputPort(surfaces(), 1), view, AXON)
    return pictures_beside(("", look(view)))


def fibre_field():
    few = simple.CapsuleOptimizer(Input=simple.BundleInitializer(Side=5, FibreVolumeFraction=0.5, MinimumRadius=0.6))
    fields = simple.FibreField(Input=simple.FibreRadialGrowth(Input=simple.OutputPort(few, 0), VoxelSize=0.08), Select="All fibres")
    view = white_view(PIXELS, PIXELS)
    contours = simple.Contour(Input=fields, ContourBy=["POINTS", "Field"], Isosurfaces=[0.0])
    contours.UpdatePipeline()
    blocks = servermanager.Fetch(contours)
    contoured = [blocks.GetBlock(i) for i in range(blocks.GetNumberOfBlocks())]
    for i, block in enumerate(block for block in contoured if block is not None and block.GetNumberOfPoints() > 0):
        producer = simple.TrivialProducer()
        producer.GetClientSideObject().SetOutput(block)
        show(producer, view, list(pyplot.get_cmap("tab10")(i % 10)[:3]))
    return pictures_beside(("", look(view)))


def substrate_production():
    few = simple.CapsuleOptimizer(Input=simple.BundleInitializer(Side=5, FibreVolumeFraction=0.5, MinimumRadius=0.5))
    production = simple.SubstrateProduction(Input=simple.OutputPort(few, 0), FolderName=scratch("production"))
    production.UpdatePipeline()
    table = servermanager.Fetch(production, idx=0)
    view = white_view(PIXELS, PIXELS)
    paths = [table.GetValueByName(row, "Path").ToString() for row in range(table.GetNumberOfRows()) if table.GetValueByName(row, "Surface").ToInt() == 0]
    for i, path in enumerate(paths[:3]):
        show(simple.PLYReader(FileNames=[os.path.join(scratch("production"), path)]), view, list(pyplot.get_cmap("tab10")(i)[:3]))
    return pictures_beside(("", look(view)))


def substrate_statistics():
    counted = columns(simple.SubstrateStatistics(Fibres=outer()), 2)
    canvas, axis = chart("radius (µm)")
    edges = [*counted["RadiusFrom_um"], counted["RadiusTo_um"][-1]]
    for name, label, colour in (("OuterRadiusFibres", "outer", MYELIN), ("InnerRadiusFibres", "inner", AXON)):
        axis.stairs(counted[name], edges, fill=True, alpha=0.6, color=colour, label=label)
    axis.stairs(counted["TargetRadiusFibres"], edges, color="black", label="asked for (outer)")
    axis.legend(frameon=False)
    return canvas


def substrate_certificate():
    gaps = columns(simple.SubstrateCertificate(Outer=outer()), 1)["SmallestGap_um"]
    canvas, axis = chart("distance to the nearest other fibre (µm)")
    axis.hist(gaps, bins=30, color=MYELIN)
    axis.axvline(0.02, color="black", linewidth=1)
    axis.text(0.02, 0.95 * axis.get_ylim()[1], "MinimumGap ", ha="right", va="top")
    axis.set_xlim(left=0)
    return canvas


def substrate_sampler():
    fractions = voxels(simple.SubstrateSampler(Outer=outer(), VoxelSize=1), "AVF")
    return section(fractions[len(fractions) // 2], "AVF, voxels of 1 µm", "fraction of axons", cmap="viridis", vmin=0)


def lesion():
    left = simple.Lesion(Outer=outer(), AxonLoss=0.1, MyelinLoss=0.4)
    cut = simple.HistologyMask(Outer=simple.OutputPort(left, 0), Inner=simple.OutputPort(left, 1), PixelSize=PIXEL)
    return section(voxels(cut, "Mask")[0], "Mask at z = 0", cmap="gray", vmin=0, vmax=255)


def histology_mask():
    return section(voxels(simple.HistologyMask(Outer=outer(), PixelSize=PIXEL), "Mask")[0], "Mask at z = 0", cmap="gray", vmin=0, vmax=255)


def histology_radii():
    measured = columns(simple.HistologyRadii(Input=simple.HistologyMask(Outer=outer(), PixelSize=PIXEL), PixelSize=PIXEL), 0)["FibreRadius_um"]
    known = [radius for radius in columns(simple.SubstrateStatistics(Fibres=outer()), 1)["OuterRadius_um"] if radius == radius]
    canvas, axis = chart("outer radius (µm)", "part of the fibres")
    bins = numpy.linspace(0, 1.1 * max(*measured, *known), 18)
    for values, label, style in ((measured, f"on the mask ({len(measured)} whole fibres)", {"color": [0.6] * 3, "alpha": 0.8}), (known, f"on the surfaces ({len(known)} fibres)", {"histtype": "step", "color": "black"})):
        axis.hist(values, bins=bins, weights=[1 / len(values)] * len(values), label=label, **style)
    axis.legend(frameon=False)
    return canvas


def placement():
    view = white_view(PIXELS, PIXELS)
    show(simple.Placement(Input=outer(), ScaleFactor=1000), view, [0.75] * 3)
    show(simple.Placement(Input=outer(), ScaleFactor=1000, RotationX=60, PositionX=1.6 * SIDE), view, MYELIN)
    return pictures_beside(("", look(view)))


PICTURES = {
    "".join(part.capitalize() for part in function.__name__.split("_")): function
    for function in (
        bundle_initializer, curved_bundles, tract_fibres, strand_reader, tractogram_reader, nifti_reader, substrate_reader, capsule_optimizer, fibre_radial_growth,
        myelin_surface, fibre_field, substrate_production, substrate_statistics, substrate_certificate, substrate_sampler, lesion, histology_mask, histology_radii,
        placement,
    )
}  # fmt: skip


def save(canvas, path):
    """In 128 colours, which a page loads in no time."""
    drawn = io.BytesIO()
    canvas.savefig(drawn, format="png", dpi=110)
    pyplot.close(canvas)
    Image.open(drawn).convert("RGB").quantize(128, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(path, format="png", optimize=True)
    print(f"{os.path.basename(path)}: {os.path.getsize(path) / 1000:.0f} kB", flush=True)


def main():
    parser = argparse.ArgumentParser(prog="./cactus pvpython tools/scripts/filter_pictures.py", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="filters to draw (default: all)")
    parser.add_argument("--output", default=os.path.join(ROOT, "docs", "images", "filters"), metavar="DIR", help="folder for the pictures (default: %(default)s)")
    wanted = parser.parse_args()
    unknown = sorted(set(wanted.names) - set(PICTURES))
    if unknown:
        parser.error(f"there is no picture of {', '.join(unknown)}: {', '.join(PICTURES)}")
    os.makedirs(wanted.output, exist_ok=True)
    for name in wanted.names or PICTURES:
        save(PICTURES[name](), os.path.join(wanted.output, name + ".png"))


if __name__ == "__main__":
    main()
