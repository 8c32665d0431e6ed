// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubstrateReader.h"

#include "DataProvenance.h"
#include "FibreData.h"
#include "FilterSupport.h"
#include "StageProperties.h"
#include "SurfaceData.h"
#include "SurfaceFacts.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/SinglePrecision.h"
#include "io/SubstrateReading.h"
#include "stages/Stages.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDelimitedTextReader.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkSubstrateReader);

namespace
{

using cactus::notANumber;

/// Gives this thread the C locale, in which VTK reads numbers of files, until the end of its life.
class PlainNumbers
{
public:
  PlainNumbers()
    : Plain(::newlocale(LC_ALL_MASK, "C", nullptr))
    , Before(::uselocale(this->Plain))
  {
  }
  ~PlainNumbers()
  {
    ::uselocale(this->Before);
    ::freelocale(this->Plain);
  }
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

private:
  locale_t Plain;
  locale_t Before;
};

/// Reads a table of the folder. Cells without a number are NaN.
void readTable(const std::string& path, vtkTable* table)
{
  const PlainNumbers numbers;
  vtkNew<vtkDelimitedTextReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetHaveHeaders(true);
  reader->SetDetectNumericColumns(true);
  reader->SetForceDouble(true);
  reader->SetDefaultDoubleValue(notANumber);
  reader->Update();
  table->ShallowCopy(reader->GetOutput());
}

/// Returns the fibres of `certificate_fibres.csv` and their lengths (µm), NaN where it does not tell, as in versions before
/// 0.3.0.
std::map<int, double> lengthsOf(vtkTable* table, const std::string& path)
{
  const auto column = [&](const char* name) { return vtkDataArray::SafeDownCast(table->GetColumnByName(name)); };
  vtkDataArray* ids = column("FibreId");
  vtkDataArray* lengths = column("Length_um");
  if (ids == nullptr)
  {
    throw cactus::FileError(path + " has no column FibreId");
  }
  std::map<int, double> known;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    known[cactus::idFrom(ids, row)] = lengths != nullptr ? lengths->GetComponent(row, 0) : notANumber;
  }
  return known;
}

/// Returns the least distance (µm) that the folder's certificate required; 0 if it does not tell.
double minimumGapOf(vtkTable* table)
{
  auto* quantities = vtkStringArray::SafeDownCast(table->GetColumnByName("quantity"));
  auto* values = vtkDataArray::SafeDownCast(table->GetColumnByName("value"));
  const vtkIdType row = quantities != nullptr ? quantities->LookupValue("MinimumGap_um") : -1;
  return values != nullptr && row >= 0 && values->GetComponent(row, 0) > 0.0 ? values->GetComponent(row, 0) : 0.0;
}

/// Returns a coordinate (µm) that a file's unit and single precision have moved off a face of the domain, back on that.
double onFace(double place, double lower, double upper)
{
  constexpr double loss = std::numeric_limits<float>::epsilon();
  for (const double face : { lower, upper })
  {
    if (std::abs(place - face) <= loss * std::abs(face))
    {
      return face;
    }
  }
  return place;
}

/// The surfaces of a PLY file, one after the other, each with points of its own.
class SurfacesOfFile
{
public:
  SurfacesOfFile(vtkPolyData* file, const std::string& path)
    : File(file)
    , Path(path)
  {
  }

  /// Takes the next surface.
  cactus::TriangleMesh take(std::size_t triangles, double unit, const cactus::Domain& domain)
  {
    cactus::TriangleMesh mesh;
    vtkIdType end = this->Point;
    mesh.triangles.resize(triangles);
    for (auto& triangle : mesh.triangles)
    {
      this->File->GetPolys()->GetCellAtId(this->Cell++, this->Corners);
      for (std::size_t c = 0; c < 3; ++c)
      {
        const vtkIdType corner = this->Corners->GetId(static_cast<vtkIdType>(c));
        if (corner < this->Point || corner >= this->File->GetNumberOfPoints())
        {
          throw cactus::FileError(this->Path + " has surfaces that share points, or points that do not exist");
        }
        triangle[c] = static_cast<std::int32_t>(corner - this->Point);
        end = std::max(end, corner + 1);
      }
    }
    for (; this->Point < end; ++this->Point)
    {
      Eigen::Vector3d place;
      this->File->GetPoint(this->Point, place.data());
      for (int axis = 0; axis < 3; ++axis)
      {
        place[axis] = onFace(cactus::inSinglePrecision(unit * place[axis]), domain.lower[axis], domain.upper[axis]);
      }
      mesh.points.push_back(place);
    }
    return mesh;
  }

private:
  vtkPolyData* File;
  const std::string& Path;
  vtkNew<vtkIdList> Corners;
  vtkIdType Cell = 0;
  vtkIdType Point = 0; ///< first one of the next surface
};

/// Reads the surfaces of one file into the meshes at these places.
void readSurfaces(const cactus::SubstrateDescription& substrate, const std::vector<std::size_t>& places,
  std::vector<cactus::TriangleMesh>& meshes)
{
  const PlainNumbers numbers;
  const std::string path = cactus::fileAsWritten(substrate, substrate.files[places.front()].path);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkCellArray* triangles = reader->GetOutput()->GetPolys();
  const std::size_t listed = std::accumulate(places.begin(), places.end(), std::size_t(0),
    [&](std::size_t sum, std::size_t place) { return sum + substrate.files[place].triangles; });
  if (std::size_t(triangles->GetNumberOfCells()) != listed || triangles->IsHomogeneous() != 3)
  {
    throw cactus::FileError(path + " does not hold the triangles that the manifest lists");
  }
  SurfacesOfFile surfaces(reader->GetOutput(), path);
  for (const std::size_t place : places)
  {
    meshes[place] = surfaces.take(substrate.files[place].triangles, substrate.unit, substrate.domain);
  }
}

/// Returns the surfaces in the order of the manifest.
std::vector<cactus::TriangleMesh> surfacesOf(const cactus::SubstrateDescription& substrate, const cactus::Context& context)
{
  std::map<std::string, std::vector<std::size_t>> placesIn;
  for (std::size_t i = 0; i < substrate.files.size(); ++i)
  {
    placesIn[substrate.files[i].path].push_back(i);
  }
  const std::vector<std::pair<std::string, std::vector<std::size_t>>> files(placesIn.begin(), placesIn.end());
  std::vector<cactus::TriangleMesh> meshes(substrate.files.size());
  // One after the other, since VTK's pipelines are not made for several threads.
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    context.checkpoint();
    context.report(double(i) / double(files.size()), "Reading surfaces");
    readSurfaces(substrate, files[i].second, meshes);
  }
  return meshes;
}

/// Returns what cell data say of each fibre.
std::map<int, cactus::FibreValues> valuesOf(const cactus::SubstrateDescription& substrate,
  const std::vector<cactus::TriangleMesh>& meshes, const std::map<int, double>& lengths)
{
  std::map<int, double> outerVolumes;
  std::map<int, double> innerVolumes;
  std::map<int, const cactus::TriangleMesh*> surfaces;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const cactus::SubstrateFile& file = substrate.files[i];
    const bool isOuter = file.surface == "outer";
    (isOuter ? outerVolumes : innerVolumes)[file.fibreId] = file.volume;
    if (isOuter || surfaces.count(file.fibreId) == 0)
    {
      surfaces[file.fibreId] = &meshes[i];
    }
  }
  const auto valueOf = [](const std::map<int, double>& values, int fibreId)
  {
    const auto found = values.find(fibreId);
    return found != values.end() ? found->second : notANumber;
  };
  std::map<int, cactus::FibreValues> values;
  for (const auto& [fibreId, mesh] : surfaces)
  {
    const double volume = valueOf(outerVolumes, fibreId);
    values[fibreId] = cactus::fibreValues(
      *mesh, volume, valueOf(lengths, fibreId), std::sqrt(valueOf(innerVolumes, fibreId) / volume), substrate.domain);
  }
  return values;
}

/// Moves the surfaces of one kind to an output.
void giveOut(
  const cactus::SubstrateDescription& substrate, std::vector<cactus::TriangleMesh>& meshes, int kind, vtkPolyData* output)
{
  std::vector<cactus::NamedSurface> surfaces;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const cactus::SubstrateFile& file = substrate.files[i];
    if (file.surface == (kind == 0 ? "outer" : "inner"))
    {
      surfaces.push_back({ file.fibreId, file.bundleId, std::move(meshes[i]) });
    }
  }
  cactus::toPolyData(std::move(surfaces), kind, output);
}

/// Returns the stages of the folder, and after them the reader, which names the folder's manifest and its checksum instead of
/// inputs: who makes the substrate again reads the folder, and does not make it.
cactus::Provenance provenanceOf(const cactus::SubstrateReaderStage& stage, const cactus::SubstrateDescription& substrate)
{
  cactus::StageRecord record;
  record.filter = "SubstrateReader";
  record.properties = cactus::SubstrateReaderStage::properties().states(stage);
  record.files.push_back({ "FileName", cactus::manifestOf(stage.fileName) });
  cactus::Provenance provenance = substrate.provenance;
  provenance.push_back(cactus::provenanceOf(record).back());
  return provenance;
}

/// Returns what the user has to know of the folder, in sentences.
std::vector<std::string> remarksOn(const cactus::SubstrateDescription& substrate)
{
  std::vector<std::string> remarks;
  if (substrate.isOpen)
  {
    remarks.emplace_back(
      "the surfaces lack their caps in periodic faces (PeriodicFaces Open), so that they are not closed: stages that "
      "need closed ones take the substrate from a folder written with PeriodicFaces Caps");
  }
  if (substrate.sampledFibres > 0)
  {
    remarks.push_back(cactus::text(
      "the surfaces are those of a sample: the substrate has ", substrate.sampledFibres, " fibres, and fractions are too small"));
  }
  if (substrate.strandFibres.empty() && !substrate.strands.empty())
  {
    remarks.push_back(
      "Fibres is empty: the folder is of an older CACTUS, which did not tell whose the lines in " + substrate.strands + " are");
  }
  return remarks;
}

} // namespace

vtkSubstrateReader::vtkSubstrateReader()
  : Properties(cactus::makeProperties<cactus::SubstrateReaderStage>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(5);
}

int vtkSubstrateReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port > 2 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkSubstrateReader::CanReadFile(const char* name)
{
  return name != nullptr && cactus::isSubstrate(name) ? 1 : 0;
}

int vtkSubstrateReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return cactus::guarded(this,
    [&]
    {
      const auto& stage = cactus::stageOf<cactus::SubstrateReaderStage>(this->Properties);
      cactus::validateProperties(stage);
      if (stage.fileName.empty())
      {
        throw cactus::InvalidInput("FileName is empty: name the substrate folder to read, or its manifest.json");
      }
      const cactus::SubstrateDescription substrate = cactus::describeSubstrate(stage.fileName);
      auto* certificate = vtkTable::GetData(outputs, 3);
      auto* fibreTable = vtkTable::GetData(outputs, 4);
      const std::string fibrePath = cactus::fileAsWritten(substrate, "certificate_fibres.csv");
      readTable(cactus::fileAsWritten(substrate, "certificate.csv"), certificate);
      readTable(fibrePath, fibreTable);
      const std::map<int, double> lengths = lengthsOf(fibreTable, fibrePath);
      const std::optional<cactus::Fibres> fibres = cactus::centreLines(substrate);
      std::vector<cactus::TriangleMesh> meshes = surfacesOf(substrate, cactus::contextFor(this));
      const std::map<int, cactus::FibreValues> values = valuesOf(substrate, meshes, lengths);

      std::vector<int> wanted;
      std::transform(lengths.begin(), lengths.end(), std::back_inserter(wanted), [](const auto& fibre) { return fibre.first; });
      const double minimumGap = minimumGapOf(certificate);
      for (int port = 0; port < 2; ++port)
      {
        auto* output = vtkPolyData::GetData(outputs, port);
        giveOut(substrate, meshes, port, output);
        cactus::addFibreValues(output, values);
        cactus::setSurfaceFacts(output, port == 0 ? wanted : std::vector<int>(), minimumGap);
        cactus::setDomain(output, substrate.domain);
      }
      if (fibres)
      {
        cactus::toPolyData(*fibres, vtkPolyData::GetData(outputs, 2));
      }
      const cactus::Provenance provenance = provenanceOf(stage, substrate);
      for (int port = 0; port < 5; ++port)
      {
        cactus::setProvenance(vtkDataObject::GetData(outputs, port), provenance, port);
      }
      for (const std::string& remark : remarksOn(substrate))
      {
        vtkWarningMacro(<< stage.fileName << ": " << remark);
      }
    });
}
