// SPDX-License-Identifier: BSD-3-Clause
#include "io/McmrGeometry.h"

#include "base/AtomicFile.h"
#include "base/Numbers.h"
#include "io/PlyFile.h"

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

constexpr double wallInset = 1e-3; ///< µm
/// µm by which a period is longer than the domain: between caps in one plane, those of the domain and of its repeat, walkers in
/// myelin would be thrown back and forth without end.
constexpr double periodExcess = 2e-4;
constexpr int jsonDigits = 9;

/// Writes a JSON list of what `rows` makes of each surface, which has so many points before it: rows that end with a comma.
void writeRows(std::ostream& out, const FibreSurfaces& surfaces, PlyEncoding encoding, const Context& context,
  const std::function<std::string(const TriangleMesh&, std::int64_t)>& rows)
{
  std::int64_t before = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    context.checkpoint();
    const TriangleMesh mesh = asWritten(surfaces.mesh(i), encoding);
    std::string text = rows(mesh, before);
    if (i + 1 == surfaces.size())
    {
      text.erase(text.rfind(',')); // JSON has none after the last
    }
    out << text;
    before += std::int64_t(mesh.points.size());
  }
}

std::string vertexRows(const TriangleMesh& mesh)
{
  std::string text;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      text += axis == 0 ? '[' : ',';
      appendNumber(text, point[axis], jsonDigits);
    }
    text += "],\n";
  }
  return text;
}

std::string triangleRows(const TriangleMesh& mesh, std::int64_t before)
{
  std::string text;
  for (const auto& triangle : mesh.triangles)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      text += corner == 0 ? '[' : ',';
      text += std::to_string(before + triangle[corner] + 1);
    }
    text += "],\n";
  }
  return text;
}

/// Returns what a group says of the distance after which it is repeated, if the domain is periodic: along an axis on which that
/// is not, a distance that nobody walks, as there are walls.
std::string repeatsText(const Domain& domain)
{
  if (!domain.isPeriodic())
  {
    return "";
  }
  std::string text = "\"repeats\": ";
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    text += axis == 0 ? "[" : ", ";
    const double side = domain.size()[Eigen::Index(axis)];
    appendNumber(text, domain.periodic[axis] ? side + periodExcess : 2.0 * side, jsonDigits);
  }
  return text + "], ";
}

/// Writes a group behind `before`, which becomes what is put between two.
void writeMesh(std::ostream& out, const FibreSurfaces& surfaces, const Domain& domain, PlyEncoding encoding, std::string& before,
  const Context& context)
{
  if (surfaces.size() == 0)
  {
    return;
  }
  out << std::exchange(before, ",\n") << "{\"type\": \"Mesh\", " << repeatsText(domain) << "\"vertices\": [\n";
  writeRows(out, surfaces, encoding, context, [](const TriangleMesh& mesh, std::int64_t) { return vertexRows(mesh); });
  out << "], \"triangles\": [\n";
  writeRows(out, surfaces, encoding, context, triangleRows);
  out << "]}";
}

std::string wallText(const Domain& box, std::string& before)
{
  constexpr const char* axes[] = { "[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]" };
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!box.periodic[std::size_t(axis)])
    {
      text += std::exchange(before, ",\n") + R"({"type": "Walls", "rotation": )" + axes[axis] + ", \"position\": [";
      appendNumber(text, box.lower[axis], jsonDigits);
      text += ", ";
      appendNumber(text, box.upper[axis], jsonDigits);
      text += "]}";
    }
  }
  return text;
}

/// Returns the outer surfaces of fibres with myelin; that of an axon without it is its inner one, too, and stands there.
FibreSurfaces withMyelin(const SubstrateFolderContents& contents)
{
  const FibreSurfaces& outer = contents.outer;
  const FibreSurfaces& inner = contents.inner;
  FibreSurfaces found = outer;
  found.fibreIds.clear();
  found.bundleIds.clear();
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    const auto axon = inner.placeOf(outer.fibreIds[i]);
    if (!axon || !areSame(outer.mesh(i), inner.mesh(*axon)))
    {
      found.fibreIds.push_back(outer.fibreIds[i]);
      found.bundleIds.push_back(outer.bundleIds[i]);
      places.push_back(i);
    }
  }
  found.mesh = [&outer, places = std::move(places)](std::size_t i) { return outer.mesh(places[i]); };
  return found;
}

} // namespace

Domain mcmrBox(const Domain& domain)
{
  Domain box = domain;
  box.lower.array() += wallInset;
  box.upper.array() -= wallInset;
  return box;
}

void writeMcmrGeometry(const SubstrateFolderContents& contents, FolderWriter& writer, const Context& context)
{
  writer.writeBy("geometry.json",
    [&](const std::string& place)
    {
      AtomicFile file(place);
      std::string before = "[\n";
      writeMesh(file.stream(), withMyelin(contents), contents.domain, contents.encoding, before, context);
      writeMesh(file.stream(), contents.inner, contents.domain, contents.encoding, before, context);
      file.stream() << wallText(mcmrBox(contents.domain), before) << "\n]\n";
      file.commit();
    });
}

} // namespace cactus
