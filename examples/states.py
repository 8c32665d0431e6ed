# SPDX-License-Identifier: BSD-3-Clause
"""A ParaView state for each preset: File > Load State makes the substrate and shows it, with all filters at hand.

Run it with ./cactus pvpython examples/states.py [PRESET...]. Without a name it makes all. The states are made here and not kept: each is 0.3 MB
of XML that one version of ParaView has written, and says no more than the few lines below.
"""

import argparse
import os
import re
import sys

from paraview import simple


def file_name(preset):
    """The file of a preset: "Corpus callosum, EM-like" is corpus-callosum-em-like.pvsm."""
    return re.sub(r"[^a-z0-9]+", "-", preset.lower()).strip("-") + ".pvsm"


def known():
    """The names of all presets."""
    bundle = simple.BundleInitializer()
    names = list(bundle.GetProperty("Preset").Available)[1:]  # the first is None
    simple.Delete(bundle)
    return names


def save_state(preset, side, voxel_size, view, path):
    """Writes the state: the chain with the preset's values, and a view of its surfaces."""
    bundle = simple.BundleInitializer(Preset=preset, Side=side)
    optimiser = simple.CapsuleOptimizer(Input=bundle)
    grown = simple.FibreRadialGrowth(Input=simple.OutputPort(optimiser, 0), VoxelSize=voxel_size)
    surfaces = simple.MyelinSurface(Input=grown)
    for port in (0, 1):
        simple.Show(simple.OutputPort(surfaces, port), view)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [2.2, -1.7, 1.6], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    simple.RenameLayout(preset, simple.GetLayout(view))
    count = surfaces.GetDataInformation().GetNumberOfCells()
    if count:
        simple.SetActiveSource(surfaces)
        simple.SaveState(path)
    for proxy in (surfaces, grown, optimiser, bundle):
        simple.Delete(proxy)
    return count


def main():
    names = known()
    parser = argparse.ArgumentParser(prog="./cactus pvpython examples/states.py", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("presets", nargs="*", metavar="PRESET", help="presets by name (default: all)")
    parser.add_argument("--side", type=float, default=12.0, help="side of the domain, µm (default: %(default)s)")
    parser.add_argument("--voxel-size", type=float, default=0.1, help="voxel of the label image, µm (default: %(default)s)")
    parser.add_argument("--output", default="cactus-states", metavar="DIR", help="folder for the states (default: %(default)s)")
    wanted = parser.parse_args()
    for name in wanted.presets:
        if name not in names:
            parser.error(f'there is no preset "{name}": {"; ".join(names)}')
    paths = {name: os.path.join(wanted.output, file_name(name)) for name in wanted.presets or names}
    for path in paths.values():
        if os.path.lexists(path):
            sys.exit(f"states: {path} is there already: move it, or name another folder with --output")
    os.makedirs(wanted.output, exist_ok=True)
    view = simple.CreateRenderView()
    simple.AssignViewToLayout(view=view, layout=simple.CreateLayout("Substrate"))
    failed = [name for name, path in paths.items() if not save_state(name, wanted.side, wanted.voxel_size, view, path)]
    simple.Delete(view)  # a render window that lives until Python ends takes the process down with it
    print("\n".join(f"{name}: {path}" for name, path in paths.items() if name not in failed))
    if failed:
        sys.exit(f"states: could not be made, as the errors above say: {'; '.join(failed)}")


if __name__ == "__main__":
    main()
