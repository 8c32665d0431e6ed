// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateWriter.h"

#include "FibreData.h"
#include "FilterSupport.h"
#include "SubstrateFolder.h"
#include "SurfaceData.h"
#include "WholeData.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

vtkStandardNewMacro(vtkSubstrateWriter);

namespace
{

template <typename Array, typename Value>
void addColumn(vtkTable* table, const char* name, const std::vector<cactus::SubstrateFile>& files, Value&& value)
{
  vtkNew<Array> column;
  column->SetName(name);
  column->SetNumberOfValues(static_cast<vtkIdType>(files.size()));
  for (std::size_t row = 0; row < files.size(); ++row)
  {
    column->SetValue(static_cast<vtkIdType>(row), value(files[row]));
  }
  table->AddColumn(column);
}

void fill(vtkTable* table, const std::vector<cactus::SubstrateFile>& files)
{
  using File = cactus::SubstrateFile;
  addColumn<vtkStringArray>(table, "Path", files, [](const File& f) { return f.path; });
  addColumn<vtkIntArray>(table, "FibreId", files, [](const File& f) { return f.fibreId; });
  addColumn<vtkIntArray>(table, "BundleId", files, [](const File& f) { return f.bundleId; });
  addColumn<vtkIntArray>(table, "Surface", files, [](const File& f) { return f.surface == "outer" ? 0 : 1; });
  addColumn<vtkIdTypeArray>(table, "Triangles", files, [](const File& f) { return static_cast<vtkIdType>(f.triangles); });
  addColumn<vtkDoubleArray>(table, "Volume_um3", files, [](const File& f) { return f.volume; });
  addColumn<vtkDoubleArray>(table, "Area_um2", files, [](const File& f) { return f.area; });
  addColumn<vtkIntArray>(table, "Closed", files, [](const File& f) { return f.closed ? 1 : 0; });
}

std::vector<std::string> provenanceOf(vtkDataObject* data)
{
  std::vector<std::string> lines;
  if (auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("Provenance")))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      lines.push_back(array->GetValue(i));
    }
  }
  return lines;
}

} // namespace

vtkSubstrateWriter::vtkSubstrateWriter()
{
  this->SetNumberOfInputPorts(3);
}

vtkSubstrateWriter::~vtkSubstrateWriter()
{
  this->SetFolderName(nullptr);
}

int vtkSubstrateWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkSubstrateWriter::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 3);
  return 1;
}

int vtkSubstrateWriter::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      if (!cactus::ownsWholeOutput(request, outputs))
      {
        return;
      }
      vtkPolyData* outer = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* inner = vtkPolyData::GetData(inputs[1]);
      vtkPolyData* lines = vtkPolyData::GetData(inputs[2]);
      cactus::SubstrateFolderContents contents;
      contents.domain = cactus::domainFrom(outer);
      cactus::requireSameDomain(contents.domain, inner, "Inner");
      cactus::requireSameDomain(contents.domain, lines, "Fibres");
      contents.outer = cactus::surfacesFrom(outer, "Outer", 0);
      contents.inner = cactus::surfacesFrom(inner, "Inner", 1);
      cactus::Fibres fibres;
      if (lines != nullptr)
      {
        fibres = cactus::fibresFrom(lines);
        contents.fibres = &fibres;
      }
      contents.provenance = provenanceOf(outer);
      contents.allowOpenSurfaces = this->AllowOpenSurfaces;
      contents.certificate.minimumGap = this->MinimumGap;
      const auto written = cactus::writeSubstrateFolder(
        contents, this->FolderName ? this->FolderName : "", cactus::contextFor(this, this->NumberOfThreads));
      if (!written.certificate.certified())
      {
        vtkWarningMacro(<< "the substrate in " << this->FolderName << " is not certified: " << written.certificate.verdict());
      }
      for (const std::string& leftover : written.leftovers)
      {
        vtkWarningMacro(<< leftover);
      }
      auto* table = vtkTable::GetData(outputs);
      fill(table, written.files);
      cactus::addProvenance(outer, table, "SubstrateWriter",
        std::string("AllowOpenSurfaces=") + (this->AllowOpenSurfaces ? "1" : "0") +
          " MinimumGap=" + std::to_string(this->MinimumGap));
    });
}

void vtkSubstrateWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FolderName: " << (this->FolderName ? this->FolderName : "(none)") << '\n';
  os << indent << "AllowOpenSurfaces: " << this->AllowOpenSurfaces << '\n';
  os << indent << "MinimumGap: " << this->MinimumGap << '\n';
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}
