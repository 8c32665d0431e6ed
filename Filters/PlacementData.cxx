// SPDX-License-Identifier: BSD-3-Clause
#include "PlacementData.h"

#include "Columns.h"
#include "FibreData.h"
#include "InputBlocks.h"
#include "base/Error.h"
#include "base/SphericalHarmonics.h"
#include "mesh/SurfaceDirection.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Core>

#include <array>
#include <map>
#include <vector>

namespace cactus
{

namespace
{

constexpr const char* placementName = "Placement";

void placePoints(vtkPointSet* data, const Placement& placement)
{
  if (data->GetPoints() == nullptr)
  {
    return;
  }
  const vtkIdType count = data->GetNumberOfPoints();
  auto coordinates = makeArray<vtkDoubleArray>("Points", std::size_t(count), 3);
  for (vtkIdType i = 0; i < count; ++i)
  {
    Eigen::Vector3d point;
    data->GetPoint(i, point.data());
    coordinates->SetTypedTuple(i, placement.toImage(point).data());
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  data->SetPoints(points);
}

/// The array with `change` done to each of its tuples.
template <typename Change>
void changeArray(vtkDataSetAttributes* data, vtkDataArray* array, Change&& change)
{
  auto changed = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  changed->DeepCopy(array);
  std::vector<double> tuple(std::size_t(array->GetNumberOfComponents()));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->GetTuple(i, tuple.data());
    change(tuple);
    changed->SetTuple(i, tuple.data());
  }
  // In the same place, since it may be the active scalars or normals.
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    if (data->GetAbstractArray(i) == array)
    {
      const int attribute = data->IsArrayAnAttribute(i);
      data->AddArray(changed);
      if (attribute >= 0)
      {
        data->SetActiveAttribute(i, attribute);
      }
      return;
    }
  }
}

/// Tells whether an array has directions: ours by their names, others where they are the data's vectors, normals or tangents.
bool hasDirections(vtkDataSetAttributes* data, vtkDataArray* array)
{
  if (array == nullptr || array->GetNumberOfComponents() != 3 ||
      (array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE))
  {
    return false;
  }
  const std::string name = array->GetName() != nullptr ? array->GetName() : "";
  return array == data->GetVectors() || array == data->GetNormals() || array == data->GetTangents() || name == "MeanDirection" ||
         name == "Direction";
}

void turnDirections(vtkDataSetAttributes* data, const Placement& placement)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (hasDirections(data, array))
    {
      changeArray(data, array,
        [&](std::vector<double>& tuple)
        {
          Eigen::Map<Eigen::Vector3d> direction(tuple.data());
          direction = (placement.axes * direction).eval();
        });
    }
  }
}

/// Rotates the coefficients of the distribution of directions that fibres were made for.
void turnAskedDirections(vtkFieldData* data, const Placement& placement)
{
  std::vector<double> coefficients = orientationHarmonicsOf(data);
  if (!coefficients.empty())
  {
    HarmonicRotation(placement.axes, orderOfHarmonics(coefficients.size())).turn(coefficients);
    setOrientationHarmonics(coefficients, data); // a new array, since the input may have the other one, too
  }
}

/// Rotates the coefficients of spherical harmonics and axes of bundles of SubstrateSampler.
void turnOrientations(vtkDataSetAttributes* data, const Placement& placement)
{
  auto* fod = vtkFloatArray::SafeDownCast(data->GetArray("FOD"));
  const int order = fod != nullptr ? orderOfHarmonics(std::size_t(fod->GetNumberOfComponents())) : -1;
  if (order >= 0)
  {
    const HarmonicRotation rotation(placement.axes, order);
    changeArray(data, fod, [&](std::vector<double>& tuple) { rotation.turn(tuple); });
  }
  auto* peaks = vtkFloatArray::SafeDownCast(data->GetArray("Peaks"));
  if (peaks != nullptr && peaks->GetNumberOfComponents() % 3 == 0)
  {
    changeArray(data, peaks,
      [&](std::vector<double>& tuple)
      {
        Eigen::Map<Eigen::Matrix3Xd> axes(tuple.data(), 3, Eigen::Index(tuple.size() / 3));
        axes = (placement.axes * axes).eval();
      });
  }
}

/// The directions of fibres by their ids, as their surfaces have them.
using Directions = std::map<int, SurfaceDirection>;

/// Returns those of surfaces that have colours of them, not yet placed.
Directions surfaceDirections(vtkPolyData* surfaces)
{
  Directions directions;
  auto* ids = vtkIntArray::SafeDownCast(surfaces->GetCellData()->GetArray("FibreId"));
  auto* colours = vtkUnsignedCharArray::SafeDownCast(surfaces->GetCellData()->GetArray("Direction"));
  if (ids == nullptr || colours == nullptr || surfaces->GetNumberOfPolys() != surfaces->GetNumberOfCells() ||
      !hasDomain(surfaces))
  {
    return directions;
  }
  const Domain domain = domainFrom(surfaces);
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surfaces->GetNumberOfCells(); ++cell)
  {
    surfaces->GetPolys()->GetCellAtId(cell, corners);
    const auto corner = [&](vtkIdType i) { return Eigen::Vector3d(surfaces->GetPoint(corners->GetId(i))); };
    if (corners->GetNumberOfIds() == 3)
    {
      directions[ids->GetValue(cell)].add(domain, corner(0), corner(1), corner(2));
    }
  }
  return directions;
}

void setSurfaceColours(vtkPolyData* surfaces, const Directions& directions, const Placement& placement)
{
  std::map<int, std::array<unsigned char, 3>> colours;
  for (const auto& fibre : directions)
  {
    colours[fibre.first] = directionColour(placement.axes * fibre.second.direction());
  }
  auto* ids = vtkIntArray::SafeDownCast(surfaces->GetCellData()->GetArray("FibreId"));
  const auto count = static_cast<std::size_t>(surfaces->GetNumberOfCells());
  const auto placed = makeArray<vtkUnsignedCharArray>("Direction", count, 3);
  for (vtkIdType cell = 0; cell < surfaces->GetNumberOfCells(); ++cell)
  {
    placed->SetTypedTuple(cell, colours[ids->GetValue(cell)].data());
  }
  surfaces->GetCellData()->AddArray(placed);
}

void scaleLengths(vtkDataSetAttributes* data, const char* name, double scale)
{
  vtkDataArray* array = data->GetArray(name);
  if (array != nullptr && array->GetNumberOfComponents() == 1)
  {
    changeArray(data, array, [&](std::vector<double>& tuple) { tuple[0] *= scale; });
  }
}

} // namespace

std::optional<Placement> placementOf(vtkDataObject* data)
{
  vtkAbstractArray* array = data != nullptr ? fieldArray(data, placementName) : nullptr;
  if (array == nullptr)
  {
    return std::nullopt;
  }
  std::array<double, 16> matrix{};
  auto* numbers = vtkDataArray::SafeDownCast(array);
  for (std::size_t i = 0; numbers != nullptr && numbers->GetNumberOfValues() == 16 && i < matrix.size(); ++i)
  {
    matrix[i] = numbers->GetVariantValue(vtkIdType(i)).ToDouble();
  }
  return Placement::of(matrix);
}

void forgetPlacement(vtkDataObject* data)
{
  data->GetFieldData()->RemoveArray(placementName);
}

void setPlacement(vtkDataObject* data, const Placement& placement)
{
  const std::array<double, 16> matrix = placement.matrix();
  addColumn<vtkDoubleArray>(data->GetFieldData(), placementName, matrix.size(), [&](std::size_t i) { return matrix[i]; });
}

void requireNotPlaced(vtkDataObject* data)
{
  if (placementOf(data))
  {
    throw InvalidInput("the data are placed in an image's space: connect what Placement was given");
  }
}

void requireFileUnit(LengthUnit unit, bool isPlaced)
{
  if (isPlaced && unit != LengthUnit::Millimetre)
  {
    throw InvalidInput("LengthUnit is Micrometre, and the data are placed in an image's space, which is in millimetres: choose "
                       "Millimetre, or connect what Placement was given");
  }
}

void placeGrid(vtkImageData* image, const Placement& placement)
{
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Rows direction = placement.axes * Eigen::Map<const Rows>(image->GetDirectionMatrix()->GetData());
  const Eigen::Vector3d origin = placement.toImage(Eigen::Vector3d(image->GetOrigin()));
  const Eigen::Vector3d spacing = placement.scale * Eigen::Vector3d(image->GetSpacing());
  image->SetDirectionMatrix(direction.data());
  image->SetOrigin(origin.data());
  image->SetSpacing(spacing.data());
}

bool isPlaceable(vtkDataObject* data)
{
  return vtkPointSet::SafeDownCast(data) != nullptr || vtkImageData::SafeDownCast(data) != nullptr ||
         vtkTable::SafeDownCast(data) != nullptr;
}

void requirePlaceable(vtkDataObject* data)
{
  if (!isPlaceable(data))
  {
    throw InvalidInput(std::string("the input is a ") + data->GetClassName() +
                       ": what has points, images and tables can be placed; apply Resample To Image or Clean To Grid first");
  }
}

void place(vtkDataObject* output, const Placement& placement)
{
  requirePlaceable(output);
  auto* data = vtkDataSet::SafeDownCast(output);
  if (data == nullptr)
  {
    return; // a table
  }
  requireNotPlaced(output);
  auto* surfaces = vtkPolyData::SafeDownCast(output);
  const Directions directions = surfaces != nullptr ? surfaceDirections(surfaces) : Directions();
  if (auto* image = vtkImageData::SafeDownCast(output))
  {
    placeGrid(image, placement);
  }
  else
  {
    placePoints(vtkPointSet::SafeDownCast(output), placement);
  }
  turnDirections(data->GetPointData(), placement);
  turnDirections(data->GetCellData(), placement);
  turnOrientations(data->GetPointData(), placement);
  turnAskedDirections(output->GetFieldData(), placement);
  scaleLengths(data->GetPointData(), "Radius", placement.scale);
  scaleLengths(data->GetCellData(), "Radius", placement.scale);
  scaleLengths(data->GetCellData(), "TargetRadius", placement.scale);
  if (auto* lines = vtkPolyData::SafeDownCast(output))
  {
    if (lines->GetNumberOfLines() > 0 &&
        vtkUnsignedCharArray::SafeDownCast(lines->GetPointData()->GetArray("Direction")) != nullptr)
    {
      addDirectionColours(lines);
    }
  }
  if (!directions.empty())
  {
    setSurfaceColours(surfaces, directions, placement);
  }
  setPlacement(output, placement);
}

} // namespace cactus
