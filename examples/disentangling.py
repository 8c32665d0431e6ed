# SPDX-License-Identifier: BSD-3-Clause
"""How the optimiser disentangles a bundle: an animation of its states, and a film strip of some of them.

Run it with ./cactus pvpython examples/disentangling.py. Fibres are the redder the deeper they lie in each other. KeepHistory makes the optimiser
offer its states as time steps, which ParaView plays as it plays any data that change with time.
"""

import argparse
import os
import sys
import tempfile

from paraview import servermanager, simple
from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

from output_folder import make_folder
from picture import white_view

PIXELS = 200


def arguments():
    parser = argparse.ArgumentParser(prog="./cactus pvpython examples/disentangling.py", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--side", type=float, default=10.0, help="side of the domain, µm (default: %(default)s)")
    parser.add_argument("--dispersion", type=float, default=15.0, help="mean dispersion, degrees (default: %(default)s)")
    parser.add_argument("--interval", type=int, default=2, help="iterations from one state to the next (default: %(default)s)")
    parser.add_argument("--pictures", type=int, default=5, help="pictures of the film strip (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, another bundle (default: %(default)s)")
    parser.add_argument("--output", default="cactus-disentangling", metavar="DIR", help="folder for animation and film strip (default: %(default)s)")
    return parser.parse_args()


def disentangled(wanted):
    """The optimiser, done, with its history. Directions that do not depend on each other entangle fibres the most."""
    bundle = simple.BundleInitializer(Side=wanted.side, MeanDispersion=wanted.dispersion, DispersionModel="Watson", Seed=wanted.seed)
    optimiser = simple.CapsuleOptimizer(Input=bundle, KeepHistory=1, HistoryInterval=wanted.interval)
    optimiser.UpdatePipeline(0)
    if not optimiser.TimestepValues:
        sys.exit("disentangling: the bundle could not be made, as the error above says")
    return optimiser


def show(optimiser, side):
    """The view that is played."""
    view = white_view(PIXELS, PIXELS)
    fibres = simple.OutputPort(optimiser, 0)
    shown = simple.Show(fibres, view)
    simple.ColorBy(shown, ("POINTS", "Overlap"))
    deepest = servermanager.Fetch(optimiser, idx=1).GetValueByName(0, "MaximumPenetration").ToDouble()
    colours = simple.GetColorTransferFunction("Overlap")
    colours.ColorSpace = "RGB"
    colours.RGBPoints = [0.0, 0.85, 0.85, 0.85, deepest, 0.75, 0.0, 0.0]
    shown.SetScalarBarVisibility(view, False)
    iteration = simple.Show(simple.AnnotateTimeFilter(Input=fibres, Format="iteration {time:.0f}"), view)
    iteration.Color, iteration.FontSize, iteration.WindowLocation = [0.0, 0.0, 0.0], 10, "Lower Center"
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [2.2, -1.7, 1.6], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    view.CameraFocalPoint = [0.0, 0.0, -0.06 * side]  # room for the number below
    return view


def chosen(times, count):
    """Times for a film strip: most of them early, when most is moving."""
    last = len(times) - 1
    places = sorted({round(last * (i / max(1, count - 1)) ** 2) for i in range(count)})
    return [times[place] for place in places]


def film_strip(view, times, path):
    """The view at these times, side by side."""
    strip = vtkImageAppend()
    with tempfile.TemporaryDirectory(prefix="cactus-film-") as folder:
        for time in times:
            view.ViewTime = time
            picture = os.path.join(folder, f"{time:.0f}.png")
            simple.SaveScreenshot(picture, view, ImageResolution=[PIXELS, PIXELS])
            reader = vtkPNGReader()
            reader.SetFileName(picture)
            reader.Update()
            strip.AddInputData(reader.GetOutput())
        writer = vtkPNGWriter()
        writer.SetInputConnection(strip.GetOutputPort())
        writer.SetCompressionLevel(9)
        writer.SetFileName(path)
        writer.Write()


def main():
    wanted = arguments()
    files = make_folder("disentangling", wanted.output, ("disentangling.ogv", "film-strip.png"))
    optimiser = disentangled(wanted)
    table = servermanager.Fetch(optimiser, idx=1)
    pairs = [table.GetValueByName(row, "OverlappingPairs").ToInt() for row in (0, table.GetNumberOfRows() - 1)]
    print(f"{pairs[0]} overlapping pairs at first, {pairs[1]} after {table.GetNumberOfRows() - 1} iterations")
    view = show(optimiser, wanted.side)
    film_strip(view, chosen(list(optimiser.TimestepValues), wanted.pictures), files[1])
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.SaveAnimation(files[0], view, ImageResolution=[2 * PIXELS, 2 * PIXELS], FrameRate=12)
    simple.Delete(view)  # a render window that lives until Python ends takes the process down with it
    print("Wrote " + " and ".join(files))


if __name__ == "__main__":
    main()
