// SPDX-License-Identifier: BSD-3-Clause
#include "SubstrateFileTable.h"

#include "Columns.h"

#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

namespace cactus
{

void fillFileTable(vtkTable* table, const std::vector<SubstrateFile>& files)
{
  using File = SubstrateFile;
  const std::size_t rows = files.size();
  const auto from = [&](auto value) { return [&files, value](std::size_t row) { return value(files[row]); }; };
  addColumn<vtkStringArray>(table, "Path", rows, from([](const File& f) { return f.path; }));
  addColumn<vtkIntArray>(table, "FibreId", rows, from([](const File& f) { return f.fibreId; }));
  addColumn<vtkIntArray>(table, "BundleId", rows, from([](const File& f) { return f.bundleId; }));
  addColumn<vtkIntArray>(table, "Surface", rows, from([](const File& f) { return f.surface == "outer" ? 0 : 1; }));
  addColumn<vtkIdTypeArray>(table, "Triangles", rows, from([](const File& f) { return f.triangles; }));
  addColumn<vtkDoubleArray>(table, "Volume_um3", rows, from([](const File& f) { return f.volume; }));
  addColumn<vtkDoubleArray>(table, "Area_um2", rows, from([](const File& f) { return f.area; }));
  addColumn<vtkIntArray>(table, "Closed", rows, from([](const File& f) { return f.closed ? 1 : 0; }));
}

} // namespace cactus
