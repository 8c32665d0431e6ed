// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFibreTubesRepresentation.h"

#include "DomainBox.h"
#include "ImageSections.h"
#include "ObliqueCamera.h"

#include <vtkAlgorithmOutput.h>
#include <vtkCellData.h>
#include <vtkColorSeries.h>
#include <vtkDataArray.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkMapper.h>
#include <vtkObjectFactory.h>
#include <vtkPVGeometryFilter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <numeric>

vtkStandardNewMacro(vtkFibreTubesRepresentation);

namespace
{

/// Returns the sides of a tube, so that a bundle of any size rotates smoothly; 0: lines.
int sidesFor(vtkIdType points)
{
  return points <= 100000 ? 12 : points <= 400000 ? 6 : points <= 2000000 ? 4 : 0;
}

constexpr const char* cellIds = "vtkOriginalCellIds";
constexpr const char* pointIds = "vtkOriginalPointIds";

void addIds(vtkDataSetAttributes* data, const char* name, vtkIdType count)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(name);
  ids->SetNumberOfValues(count);
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + count, vtkIdType(0));
  data->AddArray(ids);
}

constexpr const char* drawnColours = "cactusColours";
/// How far directions' colours are mixed with white: blue, of fibres along z, is too dark otherwise, above all at their ends.
constexpr double whiteness = 0.35;

/// Adds the colours in which fibres are drawn, per point: those of the bundles where there are several, else of their directions.
void addColours(vtkPolyData* fibres)
{
  auto* directions = vtkUnsignedCharArray::SafeDownCast(fibres->GetPointData()->GetArray("Direction"));
  if (directions == nullptr || directions->GetNumberOfComponents() != 3)
  {
    return;
  }
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName(drawnColours);
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(fibres->GetNumberOfPoints());
  for (vtkIdType i = 0; i < directions->GetNumberOfValues(); ++i)
  {
    const double colour = directions->GetValue(i) + whiteness * (255.0 - directions->GetValue(i));
    colours->SetValue(i, static_cast<unsigned char>(std::lround(colour)));
  }
  vtkDataArray* bundles = fibres->GetCellData()->GetArray("BundleId");
  double ids[2] = { 0.0, 0.0 };
  if (bundles != nullptr)
  {
    bundles->GetRange(ids);
  }
  if (ids[0] < ids[1])
  {
    vtkNew<vtkColorSeries> series;
    series->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_SET2);
    vtkNew<vtkIdList> points;
    for (vtkIdType fibre = 0; fibre < fibres->GetNumberOfCells(); ++fibre)
    {
      const int place = (static_cast<int>(bundles->GetTuple1(fibre)) - 1) % series->GetNumberOfColors();
      const vtkColor3ub colour = series->GetColor(place < 0 ? place + series->GetNumberOfColors() : place);
      fibres->GetCellPoints(fibre, points);
      for (const vtkIdType point : *points)
      {
        colours->SetTypedTuple(point, colour.GetData());
      }
    }
  }
  fibres->GetPointData()->AddArray(colours);
}

/// Returns lines without radii, and blocks of lines, with their colours; nullptr for other data.
vtkSmartPointer<vtkDataObject> withColours(vtkDataObject* data)
{
  if (auto* lines = vtkPolyData::SafeDownCast(data))
  {
    auto coloured = vtkSmartPointer<vtkPolyData>::New();
    coloured->ShallowCopy(lines);
    addColours(coloured);
    return coloured;
  }
  auto* blocks = vtkDataObjectTree::SafeDownCast(data);
  if (blocks == nullptr)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkDataObjectTree> coloured = vtk::TakeSmartPointer(blocks->NewInstance());
  coloured->CopyStructure(blocks);
  vtkSmartPointer<vtkDataObjectTreeIterator> one = vtk::TakeSmartPointer(blocks->NewTreeIterator());
  for (one->InitTraversal(); !one->IsDoneWithTraversal(); one->GoToNextItem())
  {
    vtkDataObject* block = one->GetCurrentDataObject();
    const vtkSmartPointer<vtkDataObject> lines = vtkPolyData::SafeDownCast(block) != nullptr ? withColours(block) : nullptr;
    coloured->SetDataSetFrom(one, lines != nullptr ? lines.Get() : block);
  }
  return coloured;
}

/// Adds the original numbers of cells and points, for selections: those of the drawn data differ.
vtkSmartPointer<vtkPolyData> withIds(vtkPolyData* fibres)
{
  auto numbered = vtkSmartPointer<vtkPolyData>::New();
  numbered->ShallowCopy(fibres);
  addIds(numbered->GetCellData(), cellIds, fibres->GetNumberOfCells());
  addIds(numbered->GetPointData(), pointIds, fibres->GetNumberOfPoints());
  return numbered;
}

/// Removes ids, so that what is drawn around the fibres cannot be selected as one of them.
void forgetIds(vtkDataSetAttributes* data, const char* name, vtkIdType first, vtkIdType count)
{
  auto* ids = vtkIdTypeArray::SafeDownCast(data->GetArray(name));
  for (vtkIdType i = 0; ids != nullptr && i < count; ++i)
  {
    ids->SetValue(first + i, -1);
  }
}

vtkSmartPointer<vtkPolyData> tubes(vtkPolyData* fibres, int sides)
{
  vtkNew<vtkTubeFilter> filter;
  filter->SetInputData(fibres);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Radius");
  filter->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  filter->SetNumberOfSides(sides);
  filter->CappingOn();
  filter->Update();
  return filter->GetOutput();
}

} // namespace

vtkFibreTubesRepresentation::vtkFibreTubesRepresentation() = default;
vtkFibreTubesRepresentation::~vtkFibreTubesRepresentation() = default;

vtkAlgorithmOutput* vtkFibreTubesRepresentation::GetInternalOutputPort(int port, int connection)
{
  vtkAlgorithmOutput* input = this->Superclass::GetInternalOutputPort(port, connection);
  vtkDataObject* data = input->GetProducer()->GetOutputDataObject(input->GetIndex());
  auto* fibres = vtkPolyData::SafeDownCast(data);
  const bool isFibres =
    fibres != nullptr && fibres->GetNumberOfLines() > 0 && fibres->GetPointData()->GetArray("Radius") != nullptr;
  const vtkSmartPointer<vtkDataObject> sections = isFibres ? nullptr : cactus::imageSections(data);
  if (auto* geometry = vtkPVGeometryFilter::SafeDownCast(this->GeometryFilter))
  {
    const bool hasOwnIds = isFibres || sections != nullptr; // otherwise the filter numbers the drawn data
    geometry->SetPassThroughCellIds(hasOwnIds ? 0 : 1);
    geometry->SetPassThroughPointIds(hasOwnIds ? 0 : 1);
  }
  if (!isFibres)
  {
    const vtkSmartPointer<vtkDataObject> shown = sections != nullptr ? sections : withColours(data);
    this->Shape->SetOutput(shown);
    return shown != nullptr ? this->Shape->GetOutputPort() : input;
  }
  const vtkSmartPointer<vtkPolyData> numbered = withIds(fibres);
  addColours(numbered);
  const int sides = sidesFor(fibres->GetNumberOfPoints());
  const vtkSmartPointer<vtkPolyData> shape = sides > 0 ? tubes(numbered, sides) : numbered;
  const vtkSmartPointer<vtkPolyData> boxed = cactus::withDomainBox(shape, fibres->GetFieldData());
  forgetIds(boxed->GetCellData(), cellIds, 0, boxed->GetNumberOfCells() - shape->GetNumberOfCells());
  const vtkIdType drawn = shape->GetNumberOfPoints();
  forgetIds(boxed->GetPointData(), pointIds, drawn, boxed->GetNumberOfPoints() - drawn);
  this->Shape->SetOutput(boxed);
  return this->Shape->GetOutputPort();
}

bool vtkFibreTubesRepresentation::AddToView(vtkView* view)
{
  cactus::lookObliquely(view);
  return this->Superclass::AddToView(view);
}

void vtkFibreTubesRepresentation::UpdateColoringParameters()
{
  this->Superclass::UpdateColoringParameters();
  // Other arrays are mapped as usual.
  for (vtkMapper* mapper : { this->Mapper, this->LODMapper })
  {
    mapper->SetColorModeToDefault();
    if (this->DirectionColors && !mapper->GetScalarVisibility())
    {
      mapper->ScalarVisibilityOn();
      mapper->SetScalarModeToUsePointFieldData();
      mapper->SelectColorArray(drawnColours);
    }
  }
}

void vtkFibreTubesRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DirectionColors: " << this->DirectionColors << '\n';
}
