# SPDX-License-Identifier: BSD-3-Clause
"""Prints the shape of fibres, their triangles, and how far coarsening moved the surfaces, as rows of a Markdown table.

    ./cactus pvpython tools/benchmarks/surfaces.py --roughness 0 0.1 0.2 0.4 -- coherent-10 dispersion-10
    ./cactus pvpython tools/benchmarks/surfaces.py --error 0.005 0.0075 0.01 -- coherent-10
    ./cactus pvpython tools/benchmarks/surfaces.py --meshoptimizer -- coherent-10 dispersion-10

Substrates have the names of substrates.py. Each cell with two figures has that of the outer surfaces first. Shapes are columns of
SubstrateStatistics: deviation of the equivalent radius along a fibre over its mean, and 4π · area / perimeter² of the cross-sections,
both means over fibres. Distances are those of random points on the surfaces, farther than 0.15 µm from the domain's faces, to the
surfaces that have not been coarsened (DecimationError 0), as VTK finds them. For comparison --meshoptimizer adds what
meshopt_simplify() of that library (Debian: libmeshoptimizer2d) makes of the latter at the same error.
"""

import ctypes
import ctypes.util

import numpy as np
from paraview import servermanager
from paraview.simple import *
from substrates import columns_of, parser_for, properties
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator


def triangles_of(surface):
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def corners_of(surface):
    """Corners and areas of all triangles."""
    corners = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)[triangles_of(surface)]
    return corners, 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)


def simplified(surface, error):
    """What meshoptimizer makes of a surface."""
    name = ctypes.util.find_library("meshoptimizer")
    if name is None:
        raise SystemExit("--meshoptimizer needs that library: install libmeshoptimizer2d")
    library = ctypes.CDLL(name)
    size, pointer, real = ctypes.c_size_t, ctypes.c_void_p, ctypes.c_float
    library.meshopt_simplifyScale.restype = real
    library.meshopt_simplifyScale.argtypes = [pointer, size, size]
    library.meshopt_simplify.restype = size
    library.meshopt_simplify.argtypes = [pointer, pointer, size, pointer, size, size, size, real, ctypes.c_uint, pointer]
    points = np.ascontiguousarray(vtk_to_numpy(surface.GetPoints().GetData()), dtype=np.float32)
    indices = np.ascontiguousarray(triangles_of(surface), dtype=np.uint32)
    made = np.empty_like(indices)
    relative = error / library.meshopt_simplifyScale(points.ctypes.data, len(points), 12)
    count = library.meshopt_simplify(
        made.ctypes.data, indices.ctypes.data, indices.size, points.ctypes.data, len(points), 12, 0, relative, 0, None
    )
    result = vtkPolyData()
    result.SetPoints(surface.GetPoints())
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(made.ravel()[:count].astype(np.int64), deep=True))
    result.SetPolys(cells)
    return result


def distances(surface, original, side, count=40000):
    """From points spread evenly over one surface to another, at none of the domain's faces."""
    corners, areas = corners_of(surface)
    random = np.random.default_rng(1)
    picked = corners[random.choice(len(corners), count, p=areas / areas.sum())]
    places = np.einsum("ij,ijk->ik", random.dirichlet((1, 1, 1), count), picked)
    places = places[np.abs(places).max(axis=1) < 0.5 * side - 0.15]
    locator = vtkStaticCellLocator()
    locator.SetDataSet(original)
    locator.BuildLocator()
    squares = np.empty(len(places))
    cell, part, square = reference(0), reference(0), reference(0.0)
    for i, place in enumerate(places):
        locator.FindClosestPoint(place, [0.0, 0.0, 0.0], cell, part, square)
        squares[i] = square.get()
    return np.sqrt(squares)


sides = ("Outer", "Inner")


def both(form, figure):
    return ", ".join(form.format(figure(of)) for of in sides)


def print_row(first, coarse, fine, error, side):
    """Prints the cells that come first, and what there is to say of triangles and distances."""
    areas = {of: corners_of(coarse[of])[1] for of in sides}
    apart = {of: distances(coarse[of], fine[of], side) for of in sides}
    cells = [
        both("{:.1f}", lambda of: len(areas[of]) / areas[of].sum()),
        both("{:.4f}", lambda of: np.sqrt((apart[of] ** 2).mean())),
        both("{:.1f} %", lambda of: 100 * (apart[of] <= error).mean()),
        both("{:.4f}", lambda of: np.percentile(apart[of], 99)),
        both("{:.3f}", lambda of: apart[of].max()),
    ]
    print("| " + " | ".join(first + cells) + " |", flush=True)


def substrate(name, arguments):
    bundle, growth, myelin = properties(name, arguments)
    initial = BundleInitializer(**bundle)
    fibres = OutputPort(CapsuleOptimizer(Input=initial), 0)
    for roughness in arguments.roughness:
        for error in arguments.error:
            growth.update(SurfaceRoughness=roughness, SurfaceTolerance=max(error, arguments.tolerance))
            grown = FibreRadialGrowth(Input=fibres, VoxelSize=arguments.voxel, **growth)
            surfaces = MyelinSurface(Input=grown, DecimationError=error, **myelin)
            outer, inner = OutputPort(surfaces, 0), OutputPort(surfaces, 1)
            statistics = SubstrateStatistics(Fibres=fibres, Outer=outer, Inner=inner)
            UpdatePipeline(proxy=statistics)
            found = columns_of(statistics, 1)
            coarse = {of: servermanager.Fetch(surfaces, idx=port) for port, of in enumerate(sides)}
            surfaces.DecimationError = 0
            UpdatePipeline(proxy=surfaces)
            fine = {of: servermanager.Fetch(surfaces, idx=port) for port, of in enumerate(sides)}
            print_row(
                [
                    name,
                    f"{roughness:g}",
                    f"{error:g}",
                    f"{columns_of(statistics, 0)['FVF'][0]:.4f}",
                    both("{:.3f}", lambda of: np.nanmean(found[f"{of}RadiusDeviation_um"] / found[f"{of}Radius_um"])),
                    both("{:.3f}", lambda of: np.nanmean(found[f"{of}Circularity"])),
                ],
                coarse, fine, error, arguments.side,
            )
            if arguments.meshoptimizer:
                theirs = {of: simplified(fine[of], error) for of in sides}
                print_row([f"{name}, meshoptimizer", f"{roughness:g}", f"{error:g}", "", "", ""], theirs, fine, error, arguments.side)
            for proxy in (statistics, surfaces, grown):
                Delete(proxy)


def main():
    parser = parser_for(__doc__, side=15, fraction=0.9, tolerance=0.0075)
    parser.add_argument("--roughness", type=float, nargs="+", default=[0.1], help="SurfaceRoughness (%(default)s)")
    parser.add_argument("--error", type=float, nargs="+", default=[0.005], help="DecimationError, µm; SurfaceTolerance is no less (%(default)s)")
    parser.add_argument("--meshoptimizer", action="store_true", help="a row for meshopt_simplify() too")
    arguments = parser.parse_args()
    columns = "substrate, SurfaceRoughness, DecimationError (µm), FVF, deviation over radius, circularity, triangles/µm²".split(", ")
    columns += ["root mean square distance (µm)", "within DecimationError", "99 % within (µm)", "largest (µm)"]
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns), flush=True)
    for name in arguments.names:
        substrate(name, arguments)


if __name__ == "__main__":
    main()
