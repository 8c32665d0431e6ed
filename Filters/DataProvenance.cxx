// SPDX-License-Identifier: BSD-3-Clause
#include "DataProvenance.h"

#include "FibreData.h"
#include "InputBlocks.h"
#include "LegacyText.h"
#include "base/Hash64.h"
#include "fibres/ColumnTable.h"

#include <vtkAlgorithm.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <cstdint>

namespace cactus
{

namespace
{

constexpr const char* arrayName = "Provenance";
/// Largest number of filters searched between two stages: pipelines may branch and join again.
constexpr int mostFilters = 100;

void add(Hash64& checksum, vtkDataArray* array)
{
  if (array == nullptr)
  {
    checksum.add(std::uint64_t(0));
    return;
  }
  checksum.add(static_cast<std::uint64_t>(array->GetDataType()));
  const std::size_t bytes =
    static_cast<std::size_t>(array->GetNumberOfValues()) * static_cast<std::size_t>(array->GetDataTypeSize());
  checksum.add(bytes);
  checksum.add(array->GetVoidPointer(0), bytes);
}

/// Returns the checksum that identifies our data: their points, and the arrays that later stages use. Empty for data of another
/// type.
std::string checksumOfData(vtkDataObject* data)
{
  Hash64 checksum;
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    checksum.add(static_cast<std::uint64_t>(surface->GetNumberOfCells()));
    add(checksum, surface->GetPoints() != nullptr ? surface->GetPoints()->GetData() : nullptr);
    add(checksum, surface->GetPointData()->GetArray("Radius"));
    if (vtkDataArray* myelin = surface->GetPointData()->GetArray(myelinFractionName))
    {
      add(checksum, myelin);
    }
    for (const char* name : { "FibreId", "BundleId", "TargetRadius", "Surface" })
    {
      add(checksum, surface->GetCellData()->GetArray(name));
    }
    for (const ColumnFacts& column : fibreColumns())
    {
      if (vtkDataArray* array = surface->GetCellData()->GetArray(column.name))
      {
        add(checksum, array);
      }
    }
    return checksum.text();
  }
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    checksum.add(image->GetExtent(), 6 * sizeof(int));
    checksum.add(image->GetOrigin(), 3 * sizeof(double));
    checksum.add(image->GetSpacing(), 3 * sizeof(double));
    for (const char* name : { "FibreId", "Depth", "Field" })
    {
      add(checksum, image->GetPointData()->GetArray(name));
    }
    return checksum.text();
  }
  return "";
}

Provenance recordsIn(vtkDataObject* data)
{
  Provenance records;
  auto* array = vtkStringArray::SafeDownCast(
    data != nullptr && data->GetFieldData() != nullptr ? data->GetFieldData()->GetAbstractArray(arrayName) : nullptr);
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfValues(); ++i)
  {
    records.push_back(array->GetValue(i));
  }
  return records;
}

/// Returns the origin known from the data alone.
DataOrigin originOf(vtkDataObject* data)
{
  DataOrigin origin;
  const std::vector<vtkDataObject*> leaves = leavesOf(data);
  if (leaves.size() == 1 && leaves.front() == data)
  {
    origin.records = recordsIn(data);
    const std::string recorded = checksumOf(origin.records);
    // Version 0.2.0 computed another checksum, of 16 digits without a prefix, with which nothing can be compared.
    const bool isOld = recorded.size() == 16 && recorded.rfind(Hash64::prefix, 0) != 0;
    origin.isChanged = origin.isKnown() && !isOld && recorded != checksumOfData(data);
    return origin;
  }
  for (vtkDataObject* leaf : leaves)
  {
    origin.parts.push_back(originOf(leaf));
  }
  return origin;
}

bool isAsMade(const DataOrigin& origin)
{
  if (origin.parts.empty())
  {
    return origin.isKnown() && !origin.isChanged;
  }
  for (const DataOrigin& part : origin.parts)
  {
    if (!isAsMade(part))
    {
      return false;
    }
  }
  return true;
}

DataOrigin originAt(vtkAlgorithm* consumer, int port, int connection, int& filtersLeft);

/// Returns the inputs of a filter whose data have no record.
DataOrigin originBefore(vtkAlgorithm* filter, int& filtersLeft)
{
  DataOrigin origin;
  origin.filter = filter->GetClassName();
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int connection = 0; connection < filter->GetNumberOfInputConnections(port); ++connection)
    {
      origin.parts.push_back(originAt(filter, port, connection, filtersLeft));
    }
  }
  return origin;
}

DataOrigin originAt(vtkAlgorithm* consumer, int port, int connection, int& filtersLeft)
{
  DataOrigin origin = originOf(consumer->GetInputDataObject(port, connection));
  int producerPort = 0;
  vtkAlgorithm* producer = consumer->GetInputAlgorithm(port, connection, producerPort);
  if (isAsMade(origin) || producer == nullptr || producer->GetTotalNumberOfInputConnections() == 0 || filtersLeft-- <= 0)
  {
    return origin;
  }
  DataOrigin before = originBefore(producer, filtersLeft);
  // ParaView puts its own filters behind every other, which pass data on.
  const bool isPassage = before.filter == "vtkPVPostFilter" && before.parts.size() == 1;
  if (isPassage)
  {
    return before.parts.front();
  }
  return before.isKnown() ? before : origin;
}

} // namespace

std::vector<std::pair<std::string, std::vector<DataOrigin>>> originsOf(vtkAlgorithm* self, const std::vector<std::string>& ports)
{
  std::vector<std::pair<std::string, std::vector<DataOrigin>>> origins;
  for (int port = 0; port < self->GetNumberOfInputPorts(); ++port)
  {
    std::vector<DataOrigin> data;
    for (int connection = 0; connection < self->GetNumberOfInputConnections(port); ++connection)
    {
      int filtersLeft = mostFilters;
      data.push_back(originAt(self, port, connection, filtersLeft));
    }
    if (!data.empty())
    {
      origins.emplace_back(ports.at(static_cast<std::size_t>(port)), std::move(data));
    }
  }
  return origins;
}

std::string checksumsOf(vtkDataObject* data)
{
  std::string checksums;
  for (vtkDataObject* leaf : leavesOf(data))
  {
    checksums += checksumOfData(leaf) + ' ';
  }
  return checksums;
}

bool areAsMade(vtkDataObject* data)
{
  return isAsMade(originOf(data));
}

void setProvenance(vtkDataObject* data, const Provenance& records, int port)
{
  vtkNew<vtkStringArray> array;
  array->SetName(arrayName);
  for (const std::string& record : provenanceOfOutput(records, port, checksumOfData(data)))
  {
    array->InsertNextValue(withoutKeywords(record));
  }
  data->GetFieldData()->AddArray(array);
}

} // namespace cactus
