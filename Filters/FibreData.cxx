// SPDX-License-Identifier: BSD-3-Clause
#include "FibreData.h"

#include "Columns.h"
#include "InputBlocks.h"
#include "PlacementData.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/SphericalHarmonics.h"
#include "fibres/JoinFibres.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace cactus
{

namespace
{

constexpr const char* grownName = "GrownFibreVolumeFraction";
constexpr const char* grownVolumeName = "GrownTargetVolume";
constexpr const char* harmonicsName = "OrientationHarmonics";
constexpr const char* convergedName = "Converged";

/// Returns a one-component array with `expected` tuples, or null if there is none of that name.
vtkDataArray* scalars(vtkFieldData* data, const char* name, vtkIdType expected)
{
  vtkDataArray* array = data->GetArray(name);
  if (array == nullptr && data->HasArray(name) != 0)
  {
    throw InvalidInput(std::string("array ") + name + " must hold numbers");
  }
  if (array != nullptr && (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != expected))
  {
    throw InvalidInput(std::string("array ") + name + " must have one component and " + std::to_string(expected) + " values");
  }
  return array;
}

/// Returns an array of `data` as scalars() does. Refuses one of that name among `others`, the data of the points in place of the
/// cells or the reverse, where it would have no effect.
vtkDataArray* scalarsNotAmong(
  vtkFieldData* others, vtkFieldData* data, const char* name, vtkIdType expected, const char* kindOfData)
{
  vtkDataArray* array = scalars(data, name, expected);
  if (array == nullptr && others->HasArray(name) != 0)
  {
    throw InvalidInput(std::string("array ") + name + " must be " + kindOfData);
  }
  return array;
}

/// Returns a number of a block's field data that is not negative; 0 if unknown.
double numberFrom(vtkPolyData* input, const char* name)
{
  vtkDataArray* array = input->GetFieldData()->GetArray(name);
  if (array == nullptr || array->GetNumberOfValues() != 1)
  {
    return 0.0;
  }
  const double number = array->GetComponent(0, 0);
  return std::isfinite(number) ? std::max(number, 0.0) : 0.0;
}

/// Takes the fraction that fibres were made for in proportion if some of those that it was given for were picked, or others put
/// to them. `volume` (µm³) is that for which it was given, 0 if unknown.
void correctGrownFraction(double volume, Fibres& fibres)
{
  constexpr double unlike = 0.01; // more than resampling and rounding change
  if (fibres.grownFraction <= 0.0 || volume <= 0.0)
  {
    return;
  }
  const double ratio = targetVolumeInDomain(fibres) / volume;
  if (ratio > 0.0 && std::abs(ratio - 1.0) > unlike)
  {
    fibres.grownFraction *= ratio;
  }
}

/// Adds the fibres of one block. Their radii are NaN where the block has none and they are not needed.
void addFibres(vtkPolyData* input, bool areRadiiNeeded, Fibres& fibres)
{
  if (input->GetNumberOfLines() != input->GetNumberOfCells())
  {
    throw InvalidInput(std::string("the input holds cells that are not polylines: one polyline per fibre is expected") +
                       (input->GetNumberOfPolys() > 0 ? ", and not the surfaces that are made of it" : ""));
  }
  vtkDataArray* radius = scalars(input->GetPointData(), "Radius", input->GetNumberOfPoints());
  if (radius == nullptr && areRadiiNeeded)
  {
    throw InvalidInput("the input has no point data array Radius (µm), so its fibres have no calibre");
  }
  vtkDataArray* myelin =
    scalarsNotAmong(input->GetCellData(), input->GetPointData(), myelinFractionName, input->GetNumberOfPoints(), "point data");
  const auto ofCells = [input](const char* name)
  {
    return scalarsNotAmong(
      input->GetPointData(), input->GetCellData(), name, input->GetNumberOfCells(), "cell data, a value per fibre");
  };
  vtkDataArray* fibreId = ofCells("FibreId");
  vtkDataArray* bundleId = ofCells("BundleId");
  vtkDataArray* targetRadius = ofCells("TargetRadius");

  std::vector<std::pair<const char*, vtkDataArray*>> columns;
  for (const ColumnFacts& column : fibreColumns())
  {
    if (vtkDataArray* array = ofCells(column.name))
    {
      columns.emplace_back(column.name, array);
    }
  }

  fibres.grownFraction = numberFrom(input, grownName);
  fibres.orientationHarmonics = orientationHarmonicsOf(input->GetFieldData());
  auto cells = vtk::TakeSmartPointer(input->GetLines()->NewIterator());
  vtkIdType cell = 0;
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell(), ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(count, ids);
    fibres.addFibre(fibreId ? idFrom(fibreId, cell) : static_cast<int>(cell) + 1, bundleId ? idFrom(bundleId, cell) : 1, 1.0);
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (ids[i] < 0 || ids[i] >= input->GetNumberOfPoints())
      {
        throw InvalidInput("cell " + std::to_string(cell) + " names point " + std::to_string(ids[i]) + ", and there are " +
                           std::to_string(input->GetNumberOfPoints()) + " points: the polylines are damaged");
      }
      Eigen::Vector3d point;
      input->GetPoint(ids[i], point.data());
      fibres.addPoint(point, radius != nullptr ? radius->GetComponent(ids[i], 0) : std::numeric_limits<double>::quiet_NaN());
      if (myelin != nullptr)
      {
        fibres.setMyelinFraction(myelin->GetComponent(ids[i], 0));
      }
    }
    if (count > 0)
    {
      fibres.targetRadii.back() =
        targetRadius ? targetRadius->GetComponent(cell, 0) : rootMeanSquareRadius(fibres, fibres.size() - 1);
    }
    for (const auto& [name, array] : columns)
    {
      fibres.columns.set(name, static_cast<std::size_t>(cell), array->GetComponent(cell, 0));
    }
  }
}

Domain boundingBox(const Fibres& fibres)
{
  Domain box;
  box.lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  box.upper = -box.lower;
  for (const Eigen::Vector3d& point : fibres.points)
  {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  return box;
}

/// `periodic` is the array of that name, or null.
Domain readDomain(vtkAbstractArray* array, vtkAbstractArray* periodic)
{
  auto* numbers = vtkDataArray::SafeDownCast(array);
  if (numbers == nullptr || numbers->GetNumberOfValues() != 6)
  {
    throw InvalidInput("the input has no field data Domain with six numbers (xmin xmax ymin ymax zmin zmax, µm)");
  }
  Domain domain;
  for (int axis = 0; axis < 3; ++axis)
  {
    domain.lower[axis] = numbers->GetVariantValue(2 * axis).ToDouble();
    domain.upper[axis] = numbers->GetVariantValue(2 * axis + 1).ToDouble();
  }
  if (periodic != nullptr)
  {
    auto* flags = vtkDataArray::SafeDownCast(periodic);
    if (flags == nullptr || flags->GetNumberOfValues() != 3)
    {
      throw InvalidInput("the field data Periodic must have three numbers, 0 or 1, for x, y and z");
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      domain.periodic[static_cast<std::size_t>(axis)] = flags->GetVariantValue(axis).ToInt() != 0;
    }
  }
  validate(domain);
  return domain;
}

/// Moves fibres from an image's space into the substrate's.
void takeBack(const Placement& placement, Fibres& fibres)
{
  for (Eigen::Vector3d& point : fibres.points)
  {
    point = placement.toSubstrate(point);
  }
  for (std::vector<double>* radii : { &fibres.radii, &fibres.targetRadii })
  {
    for (double& radius : *radii)
    {
      radius /= placement.scale;
    }
  }
  if (!fibres.orientationHarmonics.empty())
  {
    const int order = orderOfHarmonics(fibres.orientationHarmonics.size());
    HarmonicRotation(placement.axes.transpose(), order).turn(fibres.orientationHarmonics);
  }
}

/// Does what tractFrom() does.
Fibres readFibres(vtkDataObject* input, const std::optional<Placement>& unlessPlaced, bool areRadiiNeeded)
{
  const auto blocks = polyDataBlocks(
    input, "fibres are polylines (vtkPolyData) with point data Radius; AppendGeometry, not AppendDatasets, joins them as such");
  Fibres fibres;
  double grownVolume = 0.0;
  for (const InputBlock& block : blocks)
  {
    Fibres part;
    try
    {
      addFibres(block.data, areRadiiNeeded, part);
      const auto placement = placementOf(block.data);
      if (placement || unlessPlaced)
      {
        takeBack(placement ? *placement : *unlessPlaced, part);
      }
    }
    catch (const InvalidInput& error)
    {
      throw InvalidInput((block.name.empty() ? "" : block.name + ": ") + error.what());
    }
    const double volume = numberFrom(block.data, grownVolumeName);
    if (fibres.size() == 0)
    {
      fibres = std::move(part);
      grownVolume = volume;
    }
    else if (!appendFibres(part, fibres))
    {
      grownVolume = grownVolume > 0.0 && volume > 0.0 ? grownVolume + volume : 0.0;
    }
  }
  if (fibres.size() == 0)
  {
    throw InvalidInput("the input holds no fibres: connect a BundleInitializer, a reader or polylines with a Radius array");
  }
  fibres.domain = hasDomain(input) ? domainFrom(input) : boundingBox(fibres);
  correctGrownFraction(grownVolume, fibres);
  return fibres;
}

} // namespace

Fibres tractFrom(vtkDataObject* input, const std::optional<Placement>& unlessPlaced)
{
  return readFibres(input, unlessPlaced, false);
}

bool hasMyelinFractions(vtkDataObject* input)
{
  const std::vector<vtkDataObject*> leaves = leavesOf(input);
  return std::any_of(leaves.begin(), leaves.end(),
    [](vtkDataObject* leaf)
    {
      auto* lines = vtkPolyData::SafeDownCast(leaf);
      return lines != nullptr && lines->GetPointData()->HasArray(myelinFractionName) != 0;
    });
}

Fibres fibresFrom(vtkDataObject* input)
{
  Fibres fibres = readFibres(input, std::nullopt, true);
  validate(fibres);
  return fibres;
}

Fibres joinedFibres(const std::vector<vtkDataObject*>& inputs)
{
  std::vector<Fibres> fibres;
  fibres.reserve(inputs.size());
  for (vtkDataObject* input : inputs)
  {
    fibres.push_back(fibresFrom(input));
  }
  Fibres all = joinFibres(std::move(fibres));
  validate(all);
  return all;
}

int idFrom(vtkDataArray* array, vtkIdType cell)
{
  const double value = array->GetComponent(cell, 0);
  if (!limits::id.holds(value) || value != std::floor(value))
  {
    throw InvalidInput(text(array->GetName(), " of cell ", cell, " is ", value, ": ids count from 1, in whole numbers up to ",
      std::numeric_limits<int>::max()));
  }
  return static_cast<int>(value);
}

void toPolyData(const Fibres& fibres, vtkPolyData* output)
{
  const std::size_t pointCount = fibres.points.size();
  auto coordinates = makeArray<vtkDoubleArray>("Points", pointCount, 3);
  for (std::size_t i = 0; i < pointCount; ++i)
  {
    coordinates->SetTypedTuple(static_cast<vtkIdType>(i), fibres.points[i].data());
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  auto offsets = makeArray<vtkTypeInt64Array>("", fibres.size() + 1);
  for (std::size_t f = 0; f <= fibres.size(); ++f)
  {
    offsets->SetValue(static_cast<vtkIdType>(f), static_cast<vtkTypeInt64>(fibres.offsets[f]));
  }
  auto corners = makeArray<vtkTypeInt64Array>("", pointCount);
  std::iota(corners->GetPointer(0), corners->GetPointer(0) + pointCount, vtkTypeInt64(0));
  vtkNew<vtkCellArray> lines;
  lines->SetData(offsets, corners);

  vtkNew<vtkPolyData> fresh;
  fresh->SetPoints(points);
  fresh->SetLines(lines);
  addColumn<vtkDoubleArray>(fresh->GetPointData(), "Radius", pointCount, [&](std::size_t i) { return fibres.radii[i]; });
  if (!fibres.myelinFractions.empty())
  {
    addColumn<vtkDoubleArray>(
      fresh->GetPointData(), myelinFractionName, pointCount, [&](std::size_t i) { return fibres.myelinFractions[i]; });
  }
  addDirectionColours(fresh);
  vtkCellData* cells = fresh->GetCellData();
  addColumn<vtkIntArray>(cells, "FibreId", fibres.size(), [&](std::size_t f) { return fibres.fibreIds[f]; });
  addColumn<vtkIntArray>(cells, "BundleId", fibres.size(), [&](std::size_t f) { return fibres.bundleIds[f]; });
  addColumn<vtkDoubleArray>(cells, "TargetRadius", fibres.size(), [&](std::size_t f) { return fibres.targetRadii[f]; });
  addColumns(fibres, "", cells);
  vtkNew<vtkFieldData> kept; // field data cannot be copied to themselves
  kept->ShallowCopy(output->GetFieldData());
  fresh->SetFieldData(kept);
  output->ShallowCopy(fresh);
  setDomain(output, fibres.domain);
  for (const char* name : { grownName, grownVolumeName, harmonicsName, convergedName }) // those of the first of several inputs
  {
    output->GetFieldData()->RemoveArray(name);
  }
  if (fibres.grownFraction > 0.0)
  {
    addNumber(output->GetFieldData(), grownName, fibres.grownFraction);
    addNumber(output->GetFieldData(), grownVolumeName, targetVolumeInDomain(fibres));
  }
  if (!fibres.orientationHarmonics.empty())
  {
    setOrientationHarmonics(fibres.orientationHarmonics, output->GetFieldData());
  }
}

std::vector<double> orientationHarmonicsOf(vtkFieldData* data)
{
  vtkDataArray* array = data->GetArray(harmonicsName);
  std::vector<double> coefficients;
  for (vtkIdType i = 0; array != nullptr && array->GetNumberOfComponents() == 1 && i < array->GetNumberOfTuples(); ++i)
  {
    coefficients.push_back(array->GetTuple1(i));
  }
  const bool isFinite =
    std::all_of(coefficients.begin(), coefficients.end(), [](double coefficient) { return std::isfinite(coefficient); });
  return isFinite && orderOfHarmonics(coefficients.size()) >= 0 ? coefficients : std::vector<double>();
}

void setOrientationHarmonics(const std::vector<double>& coefficients, vtkFieldData* data)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(harmonicsName);
  for (const double coefficient : coefficients)
  {
    array->InsertNextValue(coefficient);
  }
  data->AddArray(array);
}

void addColumns(const Fibres& fibres, const std::string& prefix, vtkFieldData* data)
{
  for (const auto& column : fibres.columns.all())
  {
    addColumn<vtkDoubleArray>(
      data, (prefix + column.first).c_str(), fibres.size(), [&](std::size_t f) { return fibres.columns.value(column.first, f); });
  }
}

std::array<unsigned char, 3> directionColour(const Eigen::Vector3d& direction)
{
  std::array<unsigned char, 3> colour{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    colour[axis] = static_cast<unsigned char>(std::lround(255.0 * std::abs(direction[Eigen::Index(axis)])));
  }
  return colour;
}

void addDirectionColours(vtkPolyData* fibres)
{
  auto colours = makeArray<vtkUnsignedCharArray>("Direction", static_cast<std::size_t>(fibres->GetNumberOfPoints()), 3);
  colours->Fill(0.0);
  auto cells = vtk::TakeSmartPointer(fibres->GetLines()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(count, ids);
    for (vtkIdType i = 0; i < count; ++i)
    {
      Eigen::Vector3d before;
      Eigen::Vector3d after;
      fibres->GetPoint(ids[std::max<vtkIdType>(i, 1) - 1], before.data());
      fibres->GetPoint(ids[std::min(i + 1, count - 1)], after.data());
      const Eigen::Vector3d along = after - before;
      const double length = along.norm();
      const Eigen::Vector3d direction = length > 0.0 ? Eigen::Vector3d(along / length) : Eigen::Vector3d(Eigen::Vector3d::Zero());
      colours->SetTypedTuple(ids[i], directionColour(direction).data());
    }
  }
  fibres->GetPointData()->AddArray(colours);
}

bool hasDomain(vtkDataObject* data)
{
  return fieldArray(data, "Domain") != nullptr;
}

Domain domainFrom(vtkDataObject* data)
{
  Domain domain = readDomain(fieldArray(data, "Domain"), fieldArray(data, "Periodic"));
  for (vtkDataObject* leaf : leavesOf(data))
  {
    vtkFieldData* facts = leaf->GetFieldData();
    vtkAbstractArray* array = facts != nullptr ? facts->GetAbstractArray("Domain") : nullptr;
    if (array != nullptr && !isSame(readDomain(array, facts->GetAbstractArray("Periodic")), domain))
    {
      throw InvalidInput("the blocks of the input have different Domains: group what belongs to one substrate");
    }
  }
  return domain;
}

void setDomain(vtkDataObject* data, const Domain& domain)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Domain");
  array->SetNumberOfValues(6);
  vtkNew<vtkUnsignedCharArray> periodic;
  periodic->SetName("Periodic");
  for (int axis = 0; axis < 3; ++axis)
  {
    array->SetValue(2 * axis, domain.lower[axis]);
    array->SetValue(2 * axis + 1, domain.upper[axis]);
    periodic->InsertNextValue(domain.periodic[static_cast<std::size_t>(axis)] ? 1 : 0);
  }
  data->GetFieldData()->AddArray(array);
  data->GetFieldData()->RemoveArray("Periodic");
  if (domain.isPeriodic())
  {
    data->GetFieldData()->AddArray(periodic);
  }
  forgetPlacement(data);
}

} // namespace cactus
