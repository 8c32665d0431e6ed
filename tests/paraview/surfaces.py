# SPDX-License-Identifier: BSD-3-Clause
"""Fibres and surfaces whose measures are known by formula, made with VTK alone."""

import math

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

SIDES = 48
# Area of the regular polygon with a circumscribed circle of radius 1.
POLYGON = 0.5 * SIDES * math.sin(2 * math.pi / SIDES)
EQUIVALENT = math.sqrt(POLYGON / math.pi)


def set_domain(data, side):
    domain = vtkDoubleArray()
    domain.SetName("Domain")
    for axis in range(3):
        domain.InsertNextValue(-side / 2)
        domain.InsertNextValue(side / 2)
    data.GetFieldData().AddArray(domain)


def cell_array(data, name, value):
    array = vtkIntArray()
    array.SetName(name)
    array.SetNumberOfValues(data.GetNumberOfCells())
    array.Fill(value)
    data.GetCellData().AddArray(array)


def tube(x, y, radius, length, rings=10):
    """A closed prism along z, centred on (x, y, 0), of outward triangles that share their points."""
    surface, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for ring in range(rings + 1):
        for side in range(SIDES):
            angle = 2 * math.pi * side / SIDES
            z = length * (ring / rings - 0.5)
            sine = 0.0 if 2 * side % SIDES == 0 else math.sin(angle)  # two columns lie exactly at y
            points.InsertNextPoint(x + radius * math.cos(angle), y + radius * sine, z)
    bottom = points.InsertNextPoint(x, y, -length / 2)
    top = points.InsertNextPoint(x, y, length / 2)
    for side in range(SIDES):
        after = (side + 1) % SIDES
        for low in range(0, rings * SIDES, SIDES):
            high = low + SIDES
            cells.InsertNextCell(3, (low + side, low + after, high + after))
            cells.InsertNextCell(3, (low + side, high + after, high + side))
        cells.InsertNextCell(3, (bottom, after, side))
        cells.InsertNextCell(3, (top, rings * SIDES + side, rings * SIDES + after))
    surface.SetPoints(points)
    surface.SetPolys(cells)
    return surface


def without(part, triangles):
    """A copy with some triangles taken out."""
    result = vtkPolyData()
    result.DeepCopy(part)
    result.BuildCells()
    for triangle in triangles:
        result.DeleteCell(triangle)
    result.RemoveDeletedCells()
    return result


def surfaces(parts, kind, side):
    """One vtkPolyData of the surfaces {fibre id: vtkPolyData}, in the product's data model."""
    append = vtkAppendPolyData()
    for fibre, part in parts.items():
        cell_array(part, "FibreId", fibre)
        cell_array(part, "BundleId", 1 + fibre % 2)
        cell_array(part, "Surface", kind)
        append.AddInputData(part)
    append.Update()
    result = append.GetOutput()
    set_domain(result, side)
    return result


def fibres(lines, side):
    """Polylines {fibre id: (radius, [points])} in the product's data model."""
    result, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    radius = vtkDoubleArray()
    radius.SetName("Radius")
    target = vtkDoubleArray()
    target.SetName("TargetRadius")
    fibre_id = vtkIntArray()
    fibre_id.SetName("FibreId")
    bundle_id = vtkIntArray()
    bundle_id.SetName("BundleId")
    for fibre, (r, line) in lines.items():
        cells.InsertNextCell(len(line), [points.InsertNextPoint(point) for point in line])
        for _ in line:
            radius.InsertNextValue(r)
        target.InsertNextValue(r)
        fibre_id.InsertNextValue(fibre)
        bundle_id.InsertNextValue(1 + fibre % 2)
    result.SetPoints(points)
    result.SetLines(cells)
    result.GetPointData().AddArray(radius)
    for array in (target, fibre_id, bundle_id):
        result.GetCellData().AddArray(array)
    set_domain(result, side)
    return result


def two_tubes(side=10.0, inset=0.0):
    """Fibres, outer and inner surfaces of fibres 3 (radius 1, inner 0.7) and 5 (radius 1.5, inner 0.9), 4 µm apart along z.

    The inner surfaces end `inset` below the outer ones' caps.
    """
    along = [k * side / 10 for k in range(-6, 7)]
    lines = fibres({3: (1.0, [(-2, 0, z) for z in along]), 5: (1.5, [(2, 0, z) for z in along])}, side)
    outer = surfaces({3: tube(-2, 0, 1.0, side), 5: tube(2, 0, 1.5, side)}, 0, side)
    inner = surfaces({3: tube(-2, 0, 0.7, side - 2 * inset), 5: tube(2, 0, 0.9, side - 2 * inset)}, 1, side)
    return lines, outer, inner
