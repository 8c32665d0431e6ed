// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateManifest.h"

#include "base/JsonText.h"
#include "base/Sha256.h"
#include "fibres/FibreShape.h"
#include "fibres/SelectFibres.h"
#include "judge/DirectionStatistics.h"
#include "judge/FibreProfile.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace cactus
{

namespace
{

/// The manifest's format name, which identifies a folder as one of ours.
constexpr char format[] = "CACTUS substrate folder";
constexpr char ownChecksum[] = "manifest_sha256";
constexpr std::size_t checksumDigits = 64;

/// Lays JSON out with one line for each property and list item, for readers and `grep`.
std::string laidOut(const Json& manifest)
{
  std::string text = "{";
  for (const auto& [name, value] : manifest.items())
  {
    text += (text.size() > 1 ? ",\n  " : "\n  ") + singleLine(Json(name)) + ": ";
    if (value.empty() || !value.is_structured() || value.front().is_number())
    {
      text += singleLine(value);
      continue;
    }
    const char* before = "";
    text += value.is_array() ? "[" : "{";
    for (const auto& [key, part] : value.items())
    {
      text += before;
      text += "\n    " + (value.is_array() ? "" : singleLine(Json(key)) + ": ") + singleLine(part);
      before = ",";
    }
    text += value.is_array() ? "\n  ]" : "\n  }";
  }
  return text + "\n}\n";
}

Json fileEntry(const SubstrateFile& file)
{
  return { { "path", file.path }, { "surface", file.surface }, { "fibre", file.fibreId }, { "bundle", file.bundleId },
    { "triangles", file.triangles }, { "volume_um3", file.volume }, { "area_um2", file.area }, { "closed", file.closed } };
}

/// Returns the record of each stage as a value; other texts stay as they are.
Json stagesOf(const Provenance& provenance)
{
  Json stages = Json::array();
  for (const std::string& stage : provenance)
  {
    stages.push_back(parsedJson(stage).value_or(Json(stage)));
  }
  return stages;
}

bool isText(const Json& object, const char* name)
{
  const auto found = object.find(name);
  return found != object.end() && found->is_string();
}

/// Returns the manifest's text as it was when its own checksum was computed.
std::string withoutOwnChecksum(std::string text, const std::string& checksum)
{
  const std::size_t place = text.rfind(checksum);
  return place == std::string::npos ? text : text.replace(place, checksum.size(), std::string(checksumDigits, '0'));
}

/// Returns the rows of the affine, or null.
Json placementRows(const std::optional<Placement>& placement)
{
  if (!placement)
  {
    return {};
  }
  const std::array<double, 16> matrix = placement->matrix();
  Json rows = Json::array();
  for (auto row = matrix.begin(); row != matrix.end(); row += 4)
  {
    rows.push_back(std::vector<double>(row, row + 4));
  }
  return rows;
}

/// Six digits, which are the same on every system: its logarithms and angles may differ in the last bits.
Json rounded(double value)
{
  std::array<char, 32> digits{};
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 6).ptr;
  double result = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(digits.data(), end, result);
  return std::isfinite(result) ? Json(result) : Json();
}

/// The directions of the fibres that the surfaces were made of, as SubstrateStatistics measures them; but here an axon's volume
/// along it is that of its mean radius.
Json directionsOf(const Fibres& fibres, const SubstrateCertificateOptions& options, const SubstrateCertificate& certificate)
{
  std::map<int, double> radii;
  for (const FibreCertificate& fibre : certificate.fibres)
  {
    radii[fibre.fibreId] = fibre.innerRadius.mean;
  }
  const std::vector<FibreCut> none;
  std::vector<AxonSections> axons;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const auto radius = radii.find(fibres.fibreIds[f]);
    axons.push_back({ &none, radius != radii.end() ? radius->second : std::numeric_limits<double>::quiet_NaN() });
  }
  const DirectionStatistics measured = measureDirections(fibres, axons, options.cutSpacing);
  Json directions;
  directions["mean_dispersion_deg"] = rounded(meanDispersion(fibres));
  directions["tangent_dispersion_deg"] = rounded(meanTangentDispersion(fibres));
  directions["p2"] = rounded(measured.p2);
  directions["p2_by_axon_volume"] = rounded(measured.p2ByAxonVolume);
  directions["kappa"] = rounded(measured.kappa);
  directions["odi"] = rounded(measured.odi);
  directions["local_spread_deg"] = rounded(measured.localSpread);
  directions["twist"] = rounded(measured.twist);
  if (fibres.orientationHarmonics.size() > 1) // otherwise all directions alike were asked for
  {
    directions["angular_correlation"] = rounded(measured.angularCorrelation);
  }
  directions["sinuosity"] = rounded(meanSinuosity(fibres));
  return directions;
}

Json judgedSurfaces(const SubstrateCertificate& certificate)
{
  Json judged = Json::array();
  if (certificate.outerJudged)
  {
    judged.push_back("outer");
  }
  if (certificate.innerJudged)
  {
    judged.push_back("inner");
  }
  return judged;
}

} // namespace

std::string manifestText(const SubstrateFolderContents& contents, const WrittenSubstrate& substrate, const WrittenFiles& written)
{
  double outerVolume = 0.0;
  double innerVolume = 0.0;
  std::size_t triangles = 0;
  Json files = Json::array();
  for (const SubstrateFile& file : substrate.files)
  {
    (file.surface == "outer" ? outerVolume : innerVolume) += file.volume;
    triangles += file.triangles;
    files.push_back(fileEntry(file));
  }
  Json domain = Json::array();
  for (int axis = 0; axis < 3; ++axis)
  {
    domain.push_back(contents.domain.lower[axis]);
    domain.push_back(contents.domain.upper[axis]);
  }
  Json manifest;
  manifest["format"] = format;
  manifest["version"] = CACTUS_VERSION;
  manifest["certified"] = substrate.certificate.certified();
  manifest["judged"] = judgedSurfaces(substrate.certificate);
  manifest["length_unit"] = "micrometre";
  manifest["simulator"] = formatNames[std::size_t(contents.format)];
  manifest["domain"] = domain;
  if (contents.domain.isPeriodic())
  {
    manifest["periodic"] = contents.domain.periodic;
    manifest["periodic_faces"] = periodicFacesNames[std::size_t(contents.periodicFaces)];
  }
  manifest["placement_um_to_mm"] = placementRows(contents.placement);
  manifest["fibres"] = contents.fibres != nullptr ? Json(contents.fibres->size()) : Json();
  if (hasStrandFile(contents))
  {
    Json& ids = manifest["strand_fibres"] = Json::array();
    Json& bundles = manifest["strand_bundles"] = Json::array();
    for (const std::size_t fibre : orderById(*contents.fibres))
    {
      ids.push_back(contents.fibres->fibreIds[fibre]);
      bundles.push_back(contents.fibres->bundleIds[fibre]);
    }
  }
  if (contents.sample)
  {
    manifest["sample_of_fibres"] = contents.sample->fibres;
  }
  manifest["outer_surfaces"] = contents.outer.size();
  manifest["inner_surfaces"] = contents.inner.size();
  if (substrate.certificate.bare > 0)
  {
    manifest["unmyelinated_fibres"] = substrate.certificate.bare;
  }
  manifest["triangles"] = triangles;
  manifest["outer_volume_um3"] = outerVolume;
  manifest["inner_volume_um3"] = innerVolume;
  if (substrate.leaving)
  {
    manifest["extra_walkers_leaving"] = substrate.leaving->share;
  }
  if (contents.fibres != nullptr && !contents.sample) // neighbours of a sample are not neighbours
  {
    manifest["directions"] = directionsOf(*contents.fibres, contents.certificate, substrate.certificate);
  }
  manifest["faults"] = substrate.certificate.faults;
  manifest["provenance"] = stagesOf(contents.provenance);
  manifest["files"] = std::move(files);
  manifest["folders"] = written.folders;
  manifest["sha256"] = written.checksums;
  const std::string blank(checksumDigits, '0');
  manifest[ownChecksum] = blank;
  std::string text = laidOut(manifest);
  return text.replace(text.rfind(blank), checksumDigits, sha256(text));
}

std::optional<SubstrateManifest> readManifest(const std::string& text)
{
  // Unneeded values are skipped: the list of surfaces, and deeper nesting than ours.
  const Json::parser_callback_t wanted = [](int depth, Json::parse_event_t event, Json&)
  { return depth < 2 || (event != Json::parse_event_t::object_start && event != Json::parse_event_t::array_start); };
  const Json manifest = Json::parse(text, wanted, false);
  if (!manifest.is_object() || !isText(manifest, "format") || manifest["format"] != format)
  {
    return std::nullopt;
  }
  SubstrateManifest found;
  found.version = isText(manifest, "version") ? manifest["version"].get<std::string>() : "";
  const auto checksums = manifest.find("sha256");
  const auto folders = manifest.find("folders");
  found.hasChecksums = checksums != manifest.end() && checksums->is_object() && folders != manifest.end() &&
                       folders->is_array() && isText(manifest, ownChecksum);
  if (!found.hasChecksums)
  {
    return found;
  }
  for (const auto& [path, checksum] : checksums->items())
  {
    if (checksum.is_string())
    {
      found.written.checksums[path] = checksum.get<std::string>();
    }
  }
  for (const Json& folder : *folders)
  {
    if (folder.is_string())
    {
      found.written.folders.insert(folder.get<std::string>());
    }
  }
  const auto checksum = manifest[ownChecksum].get<std::string>();
  found.asWritten = checksum.size() == checksumDigits && sha256(withoutOwnChecksum(text, checksum)) == checksum;
  return found;
}

} // namespace cactus
