# SPDX-License-Identifier: BSD-3-Clause
"""Data sets for which no filter of ours was made, and good ones spoilt in one respect.

A spoiler is a function that takes a copy of a good data object (fibres, surfaces or a label image) and returns what is fed to the
filter in its place. Each has a name; names do not depend on the order of definition, so that a case can be repeated by it.
"""

import math

import numpy as np
from paraview.modules.vtkRemotingViews import vtkPVView  # noqa: F401  (loads the classes of ParaView's own data objects)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkIdList, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkDataObjectTypes, vtkHyperTreeGrid, vtkImageData, vtkMolecule, vtkMultiBlockDataSet,
    vtkMutableUndirectedGraph, vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPolyData, vtkRectilinearGrid,
    vtkStructuredGrid, vtkTable, vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

NAN, INF = math.nan, math.inf


def copy(data):
    result = data.NewInstance()
    result.DeepCopy(data)
    return result


def attributes(data):
    """(name, vtkFieldData, tuples it should have or None) of what a data set carries."""
    yield "field", data.GetFieldData(), None
    if data.IsA("vtkDataSet"):
        yield "point", data.GetPointData(), data.GetNumberOfPoints()
        yield "cell", data.GetCellData(), data.GetNumberOfCells()


def arrays(data):
    """(where, name) of every array of a data set."""
    return [(where, each.GetArrayName(i)) for where, each, _ in attributes(data) for i in range(each.GetNumberOfArrays())]


def find(data, where, name):
    holder = {kind: each for kind, each, _ in attributes(data)}[where]
    return holder, holder.GetAbstractArray(name)


def replaced(holder, name, values):
    """Puts numbers in place of the array `name`."""
    holder.RemoveArray(name)
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    holder.AddArray(array)


def strings(values):
    array = vtkStringArray()
    for value in values:
        array.InsertNextValue(value)
    return array


# Spoilers of one array -----------------------------------------------------------------------------------------------------------


def removed(holder, array):
    holder.RemoveArray(array.GetName())


def as_text(holder, array):
    other = strings(["?"] * array.GetNumberOfTuples())
    other.SetName(array.GetName())
    holder.RemoveArray(array.GetName())
    holder.AddArray(other)


def shaped(change):
    """Applies `change` to the array's numbers as (tuples, components)."""

    def spoil(holder, array):
        if isinstance(array, vtkDataArray):
            numbers = vtk_to_numpy(array)
            replaced(holder, array.GetName(), change(numbers.reshape(len(numbers), -1) if len(numbers) else numbers.reshape(0, 1)))
        else:
            text = [array.GetValue(i) for i in range(array.GetNumberOfValues())]
            other = strings([str(value) for value in change(np.array(text).reshape(-1, 1)).ravel()])
            other.SetName(array.GetName())
            holder.RemoveArray(array.GetName())
            holder.AddArray(other)

    return spoil


def typed(kind):
    def spoil(holder, array):
        if isinstance(array, vtkDataArray):
            with np.errstate(all="ignore"):
                replaced(holder, array.GetName(), vtk_to_numpy(array).astype(kind))

    return spoil


def valued(value, everywhere=False):
    """One value (in the middle), or all, put in place; as double, so that each value fits."""

    def spoil(holder, array):
        if isinstance(array, vtkDataArray) and array.GetNumberOfTuples():
            numbers = vtk_to_numpy(array).astype(float)
            if everywhere:
                numbers[:] = value
            else:
                numbers.flat[numbers.size // 2] = value
            replaced(holder, array.GetName(), numbers)

    return spoil


ARRAY_SPOILERS = {
    "removed": removed,
    "text": as_text,
    "two-components": shaped(lambda a: np.hstack([a, a])),
    "three-components": shaped(lambda a: np.hstack([a, a, a])),
    "one-too-few": shaped(lambda a: a[:-1]),
    "one-too-many": shaped(lambda a: np.vstack([a, a[-1:]]) if len(a) else a),
    "no-values": shaped(lambda a: a[:0]),
    "reversed": shaped(lambda a: a[::-1]),
    "float": typed(np.float32),
    "double": typed(np.float64),
    "int8": typed(np.int8),
    "uint8": typed(np.uint8),
    "int64": typed(np.int64),
    "uint64": typed(np.uint64),
}
for _name, _value in {
    "nan": NAN, "inf": INF, "-inf": -INF, "0": 0.0, "-1": -1.0, "0.5": 0.5, "1e-300": 1e-300, "1e-6": 1e-6, "1e5": 1e5, "1e40": 1e40,
    "1e300": 1e300, "-1e300": -1e300, "2^31-1": 2.0**31 - 1, "2^31": 2.0**31, "-2^31": -(2.0**31), "2^63": 2.0**63,
}.items():
    ARRAY_SPOILERS["one=" + _name] = valued(_value)
    ARRAY_SPOILERS["all=" + _name] = valued(_value, everywhere=True)


# Spoilers of points and cells ----------------------------------------------------------------------------------------------------


def pointwise(change):
    def spoil(data):
        if data.GetNumberOfPoints():
            numbers = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
            change(numbers)
            points = vtkPoints()
            points.SetData(numpy_to_vtk(numbers, deep=True))
            data.SetPoints(points)
        return data

    return spoil


def put(value, index=None, axis=None):
    def change(points):
        rows = slice(None) if index is None else int(index * (len(points) - 1))
        points[rows, slice(None) if axis is None else axis] = value

    return pointwise(change)


def equal_neighbours(points):
    points[1] = points[0]


def scaled(factor):
    def change(points):
        points *= factor

    return pointwise(change)


def shifted(by):
    def change(points):
        points += by

    return pointwise(change)


def float_points(data):
    points = vtkPoints()
    points.SetDataTypeToFloat()
    points.DeepCopy(data.GetPoints())
    data.SetPoints(points)
    return data


def cells_of(data):
    """[(point ids)] of the polylines, or of the triangles, and the call that sets them."""
    lines = data.GetNumberOfLines() > 0
    cells = data.GetLines() if lines else data.GetPolys()
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    ids = vtk_to_numpy(cells.GetConnectivityArray())
    return [ids[a:b] for a, b in zip(offsets[:-1], offsets[1:])], data.SetLines if lines else data.SetPolys


def with_cells(change):
    """Gives the data set the cells that `change` makes of its own; cell data are cut or repeated to fit."""

    def spoil(data):
        cells, put_in = cells_of(data)
        before = len(cells)
        order, cells = change(cells)
        fresh = vtkCellArray()
        for cell in cells:
            ids = vtkIdList()
            for point in cell:
                ids.InsertNextId(int(point))
            fresh.InsertNextCell(ids)
        put_in(fresh)
        holder = data.GetCellData()
        for i in reversed(range(holder.GetNumberOfArrays())):
            array = holder.GetArray(i)
            if array is not None and array.GetNumberOfTuples() == before:
                replaced(holder, array.GetName(), vtk_to_numpy(array)[np.array(order, dtype=int)])
        return data

    return spoil


def same(cells):
    return list(range(len(cells)))


def only_points(data):
    result = vtkPolyData()
    result.SetPoints(data.GetPoints())
    result.SetFieldData(data.GetFieldData())
    result.GetPointData().ShallowCopy(data.GetPointData())
    return result


def as_vertices(data):
    result = only_points(data)
    cells = vtkCellArray()
    for point in range(data.GetNumberOfPoints()):
        cells.InsertNextCell(1, [point])
    result.SetVerts(cells)
    return result


def one_vertex(data):
    result = vtkPolyData()
    points = vtkPoints()
    points.InsertNextPoint(0, 0, 0)
    cells = vtkCellArray()
    cells.InsertNextCell(1, [0])
    result.SetPoints(points)
    result.SetVerts(cells)
    result.SetFieldData(data.GetFieldData())
    return result


def as_strips(data):
    cells, _ = cells_of(data)
    result = only_points(data)
    strips = vtkCellArray()
    for cell in cells[:10]:
        strips.InsertNextCell(len(cell), [int(point) for point in cell])
    result.SetStrips(strips)
    return result


def and_more(kind):
    """A cell of another kind besides; VTK puts cell data in the order vertices, lines, polygons."""

    def spoil(data):
        extra = vtkCellArray()
        extra.InsertNextCell(3, [0, 1, 2]) if kind == "Polys" else extra.InsertNextCell(2, [0, 1])
        getattr(data, "Set" + kind)(extra)
        holder = data.GetCellData()
        for i in reversed(range(holder.GetNumberOfArrays())):
            numbers = vtk_to_numpy(holder.GetArray(i))
            replaced(holder, holder.GetArrayName(i), np.append(numbers, numbers[-1:], axis=0))
        return data

    return spoil


def bare(data):
    """Without any array, or anything that tells of the domain."""
    data.GetPointData().Initialize()
    data.GetCellData().Initialize()
    data.GetFieldData().Initialize()
    return data


def million_points(closed):
    """One polyline of a million points, as a fibre or as something no surface is."""

    def spoil(data):
        count = 10**6
        along = np.linspace(0, 1, count)
        points = np.column_stack([0.5 * np.sin(200 * along), 0.5 * np.cos(200 * along), 4 * along - 2])
        if closed:
            points[-1] = points[0]
        result = vtkPolyData()
        result.SetPoints(vtkPoints())
        result.GetPoints().SetData(numpy_to_vtk(points, deep=True))
        cells = vtkCellArray()
        cells.InsertNextCell(count, list(range(count)))
        result.SetLines(cells)
        replaced(result.GetPointData(), "Radius", np.full(count, 0.3))
        result.SetFieldData(data.GetFieldData())
        return result

    return spoil


POLYDATA_SPOILERS = {
    "bare": bare,
    "points-only": only_points,
    "vertices": as_vertices,
    "one-vertex": one_vertex,
    "strips": as_strips,
    "and-a-vertex": and_more("Verts"),
    "and-a-line": and_more("Lines"),
    "and-a-triangle": and_more("Polys"),
    "float-points": float_points,
    "no-cells": with_cells(lambda cells: ([], [])),
    "one-cell": with_cells(lambda cells: ([0], cells[:1])),
    "cells-twice": with_cells(lambda cells: (same(cells) * 2, cells + cells)),
    "cells-backwards": with_cells(lambda cells: (same(cells)[::-1], cells[::-1])),
    "cells-turned": with_cells(lambda cells: (same(cells), [cell[::-1] for cell in cells])),
    "one-turned": with_cells(lambda cells: (same(cells), [cells[0][::-1]] + cells[1:])),
    "one-missing": with_cells(lambda cells: (same(cells)[1:], cells[1:])),
    "without-points": with_cells(lambda cells: (same(cells), [[]] + cells[1:])),
    "of-one-point": with_cells(lambda cells: (same(cells), [cells[0][:1]] + cells[1:])),
    "all-of-one-point": with_cells(lambda cells: (same(cells), [cell[:1] for cell in cells])),
    "of-two-points": with_cells(lambda cells: (same(cells), [cells[0][:2]] + cells[1:])),
    "of-four-points": with_cells(lambda cells: (same(cells), [list(cells[0][:3]) + [cells[-1][0]]] + cells[1:])),
    "point-repeated": with_cells(lambda cells: (same(cells), [[cells[0][0]] * len(cells[0])] + cells[1:])),
    "points-shared": with_cells(lambda cells: (same(cells), [cells[-1]] + cells[1:])),
    "index-beyond": with_cells(lambda cells: (same(cells), [np.append(cells[0][:-1], 10**9)] + cells[1:])),
    "index-negative": with_cells(lambda cells: (same(cells), [np.append(cells[0][:-1], -7)] + cells[1:])),
    "million-points": million_points(False),
    "million-points-in-a-ring": million_points(True),
    "zero-length-segment": pointwise(equal_neighbours),
    "all-in-one-place": put(0.25),
    "flat": put(0.0, axis=2),
    "on-a-line": put(0.0, axis=slice(0, 2)),
    "far-away": shifted(9e4),
    "very-far-away": shifted(1e9),
    "tiny": scaled(1e-9),
    "huge": scaled(1e6),
    "turned-inside-out": scaled(-1.0),
}
for _name, _value in {"nan": NAN, "inf": INF, "-inf": -INF, "1e5": 1e5, "1e40": 1e40, "1e300": 1e300, "-1e300": -1e300}.items():
    for _place, _index in {"first": 0, "middle": 0.5, "last": 1}.items():
        POLYDATA_SPOILERS[f"{_place}-point={_name}"] = put(_value, _index)
    POLYDATA_SPOILERS[f"all-points={_name}"] = put(_value)


# Spoilers of images --------------------------------------------------------------------------------------------------------------


def cut(dimensions):
    """A corner of the image, with the voxels that lie in it."""

    def spoil(image):
        whole = image.GetDimensions()
        kept = tuple(min(a, b) for a, b in zip(dimensions, whole))
        result = vtkImageData()
        result.SetDimensions(kept)
        result.SetSpacing(image.GetSpacing())
        result.SetOrigin(image.GetOrigin())
        result.SetFieldData(image.GetFieldData())
        holder = image.GetPointData()
        for i in range(holder.GetNumberOfArrays()):
            numbers = vtk_to_numpy(holder.GetArray(i)).reshape(whole[::-1])[: kept[2], : kept[1], : kept[0]]
            replaced(result.GetPointData(), holder.GetArrayName(i), numbers.ravel())
        return result

    return spoil


def setting(name, *arguments):
    def spoil(image):
        getattr(image, name)(*arguments)
        return image

    return spoil


def numbers(image, name):
    return vtk_to_numpy(image.GetPointData().GetArray(name))


def random_image(image):
    random = np.random.default_rng(1)
    ids = numbers(image, "FibreId")
    ids[:] = random.choice(np.unique(ids), len(ids))
    depth = numbers(image, "Depth")
    depth[:] = np.where(ids > 0, 1, -1) * random.random(len(depth))
    return image


def random_depth(image):
    numbers(image, "Depth")[:] = np.random.default_rng(1).normal(0, 0.5, image.GetNumberOfPoints())
    return image


def one_voxel_in_depth(value):
    def spoil(image):
        ids = numbers(image, "FibreId")
        depth = numbers(image, "Depth")
        depth[np.nonzero(ids)[0][len(np.nonzero(ids)[0]) // 2]] = value
        return image

    return spoil


def cells_instead(image):
    """The arrays on cells, where points should have them."""
    result = vtkImageData()
    result.SetDimensions([count + 1 for count in image.GetDimensions()])
    result.SetSpacing(image.GetSpacing())
    result.SetOrigin(image.GetOrigin())
    result.SetFieldData(image.GetFieldData())
    result.GetCellData().ShallowCopy(image.GetPointData())
    return result


IMAGE_SPOILERS = {
    "one-voxel": cut((1, 1, 1)),
    "two-voxels": cut((2, 1, 1)),
    "eight-voxels": cut((2, 2, 2)),
    "flat-x": cut((1, 99, 99)),
    "flat-z": cut((99, 99, 1)),
    "line": cut((99, 1, 1)),
    "corner": cut((7, 9, 11)),
    "turned": setting("SetDirectionMatrix", 0, 1, 0, -1, 0, 0, 0, 0, 1),
    "direction-nan": setting("SetDirectionMatrix", NAN, 0, 0, 0, 1, 0, 0, 0, 1),
    "direction-zero": setting("SetDirectionMatrix", 0, 0, 0, 0, 0, 0, 0, 0, 0),
    "boxes": setting("SetSpacing", 0.1, 0.2, 0.3),
    "spacing-0": setting("SetSpacing", 0, 0, 0),
    "spacing-negative": setting("SetSpacing", -0.2, -0.2, -0.2),
    "spacing-nan": setting("SetSpacing", NAN, NAN, NAN),
    "spacing-inf": setting("SetSpacing", INF, INF, INF),
    "spacing-1e-300": setting("SetSpacing", 1e-300, 1e-300, 1e-300),
    "spacing-1e300": setting("SetSpacing", 1e300, 1e300, 1e300),
    "origin-nan": setting("SetOrigin", NAN, 0, 0),
    "origin-inf": setting("SetOrigin", 0, INF, 0),
    "origin-1e300": setting("SetOrigin", 1e300, 0, 0),
    "origin-elsewhere": setting("SetOrigin", 50, 50, 50),
    "on-cells": cells_instead,
    "bare": bare,
}
# Of label images.
DEPTH_SPOILERS = {
    "random": random_image,
    "random-depth": random_depth,
    "depth-one-nan": one_voxel_in_depth(NAN),
    "depth-one-inf": one_voxel_in_depth(INF),
    "depth-one-1e30": one_voxel_in_depth(1e30),
    "depth-one--1e30": one_voxel_in_depth(-1e30),
}


# Data sets of other classes ------------------------------------------------------------------------------------------------------


def as_unstructured(data):
    from vtkmodules.vtkFiltersCore import vtkAppendFilter

    append = vtkAppendFilter()
    append.AddInputData(data)
    append.Update()
    return append.GetOutput()


def as_table(data):
    result = vtkTable()
    if data.IsA("vtkDataSet"):
        result.GetRowData().ShallowCopy(data.GetPointData())
    result.SetFieldData(data.GetFieldData())
    return result


def rectilinear(data):
    result = vtkRectilinearGrid()
    result.SetDimensions(3, 3, 3)
    for axis in "XYZ":
        getattr(result, f"Set{axis}Coordinates")(numpy_to_vtk(np.array([-1.0, 0.0, 1.0]), deep=True))
    return dressed(result, data)


def structured(data):
    result = vtkStructuredGrid()
    result.SetDimensions(3, 3, 3)
    points = vtkPoints()
    for i in range(27):
        points.InsertNextPoint(i % 3, i // 3 % 3, i // 9)
    result.SetPoints(points)
    return dressed(result, data)


def dressed(result, data):
    """With arrays of the names that the good data set has."""
    for where, name in arrays(data):
        holder = {kind: (each, count) for kind, each, count in attributes(result)}[where]
        if where != "field":
            replaced(holder[0], name, np.ones(holder[1]))
    result.SetFieldData(data.GetFieldData())
    return result


def graph(data):
    result = vtkMutableUndirectedGraph()
    for _ in range(4):
        result.AddVertex()
    result.AddEdge(0, 1)
    return result


def molecule(data):
    result = vtkMolecule()
    one = result.AppendAtom(6, 0, 0, 0)
    result.AppendBond(one, result.AppendAtom(8, 1, 0, 0), 1)
    return result


def tree_grid(data):
    result = vtkHyperTreeGrid()
    result.SetDimensions(3, 3, 3)
    result.SetBranchFactor(2)
    for axis in "XYZ":
        getattr(result, f"Set{axis}Coordinates")(numpy_to_vtk(np.array([-1.0, 0.0, 1.0]), deep=True))
    return result


OTHER_CLASSES = {
    "as-unstructured-grid": as_unstructured,
    "as-table": as_table,
    "rectilinear-grid": rectilinear,
    "structured-grid": structured,
    "graph": graph,
    "molecule": molecule,
    "hyper-tree-grid": tree_grid,
}


def empty_of(number):
    return lambda data: vtkDataObjectTypes.NewDataObject(number)


def _classes():
    """Every class of data object that VTK can make by itself: an empty one of each."""
    seen = set()
    for number in range(64):
        one = vtkDataObjectTypes.NewDataObject(number)
        # An empty vtkExplicitStructuredGrid does not know its extent: VTK counts its cells by memory that nobody has set.
        if one is not None and one.GetClassName() not in seen | {"vtkExplicitStructuredGrid"}:
            seen.add(one.GetClassName())
            yield "empty-" + one.GetClassName(), empty_of(number)


# Composite data sets -------------------------------------------------------------------------------------------------------------


def split(data, parts=2):
    """Fibres or surfaces of different fibres, in several data sets."""
    cells, _ = cells_of(data)
    ids = data.GetCellData().GetArray("FibreId")
    keys = vtk_to_numpy(ids) if ids is not None else np.arange(len(cells))
    groups = np.array_split(np.unique(keys), parts)
    result = []
    for group in groups:
        chosen = np.nonzero(np.isin(keys, group))[0]
        piece = with_cells(lambda all_cells, chosen=chosen: (list(chosen), [all_cells[i] for i in chosen]))(copy(data))
        append = vtkAppendPolyData()  # (leaves points that are not used, as they come)
        append.AddInputData(piece)
        append.Update()
        tidy = vtkPolyData()
        tidy.ShallowCopy(append.GetOutput())
        tidy.SetFieldData(data.GetFieldData())
        result.append(tidy)
    return result


def multiblock(*blocks):
    result = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        result.SetBlock(i, block)
    return result


def partitioned(*parts):
    result = vtkPartitionedDataSet()
    for i, part in enumerate(parts):
        result.SetPartition(i, part)
    return result


def collection(*sets):
    result = vtkPartitionedDataSetCollection()
    for i, one in enumerate(sets):
        result.SetPartitionedDataSet(i, one)
    return result


def halves(make):
    return lambda data: make(*split(data)) if data.IsA("vtkPolyData") else make(data, copy(data))


def nan_block(data):
    return multiblock(data, put(NAN)(copy(data)) if data.IsA("vtkPolyData") else copy(data))


COMPOSITES = {
    "blocks-none": lambda data: vtkMultiBlockDataSet(),
    "blocks-one": lambda data: multiblock(data),
    "blocks-two-halves": halves(multiblock),
    "blocks-nested": halves(lambda one, other: multiblock(multiblock(one), multiblock(multiblock(other)))),
    "blocks-null": halves(lambda one, other: multiblock(None, one, None, other, None)),
    "blocks-all-null": lambda data: multiblock(None, None),
    "blocks-empty": halves(lambda one, other: multiblock(one, one.NewInstance(), other, vtkMultiBlockDataSet())),
    "blocks-twice": lambda data: multiblock(data, copy(data)),
    "blocks-same-object": lambda data: multiblock(data, data),
    "blocks-mixed": lambda data: multiblock(data, vtkTable(), vtkImageData(), vtkPolyData(), vtkUnstructuredGrid()),
    "blocks-mixed-with-image": lambda data: multiblock(IMAGE_SPOILERS["corner"](data) if data.IsA("vtkImageData") else data, rectilinear(data)),
    "blocks-with-nan": nan_block,
    "blocks-of-tables": lambda data: multiblock(as_table(data), as_table(data)),
    "partitions-none": lambda data: vtkPartitionedDataSet(),
    "partitions-one": lambda data: partitioned(data),
    "partitions-two-halves": halves(partitioned),
    "partitions-null": halves(lambda one, other: partitioned(None, one, None, other)),
    "collection-none": lambda data: vtkPartitionedDataSetCollection(),
    "collection-two-halves": halves(lambda one, other: collection(partitioned(one), partitioned(other))),
    "collection-nested-empty": halves(lambda one, other: collection(partitioned(), partitioned(one, other))),
}
# Whose blocks hold what the whole holds: the result must be that of the whole, for fibres and surfaces.
JOINED = {
    "blocks-one", "blocks-two-halves", "blocks-nested", "blocks-null", "blocks-empty", "partitions-one", "partitions-two-halves",
    "partitions-null", "collection-two-halves", "collection-nested-empty",
}


def spoilers(data):
    """{name: function of a copy of `data`} of all that can be put in the place of a good data object."""
    result = {}
    for where, name in arrays(data):
        for spoiler, function in ARRAY_SPOILERS.items():

            def spoil(copied, where=where, name=name, function=function):
                holder, array = find(copied, where, name)
                function(holder, array)
                return copied

            result[f"{where}.{name}.{spoiler}"] = spoil
    own = POLYDATA_SPOILERS if data.IsA("vtkPolyData") else IMAGE_SPOILERS if data.IsA("vtkImageData") else {}
    if data.IsA("vtkImageData") and data.GetPointData().GetArray("Depth"):
        own = {**own, **DEPTH_SPOILERS}
    return {**result, **own, **OTHER_CLASSES, **dict(_classes()), **COMPOSITES}
