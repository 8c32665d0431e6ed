// SPDX-License-Identifier: BSD-3-Clause
#include "io/EllipsoidFile.h"

#include "base/Error.h"
#include "base/JsonText.h"
#include "base/Numbers.h"
#include "io/StrandFile.h"

#include <algorithm>
#include <iterator>

namespace cactus
{

namespace
{

constexpr double closestEllipsoids = 1e-6; // µm

/// A member that is a list of three numbers; throws FileError otherwise.
Eigen::Vector3d threeNumbers(const Json& object, const char* member, const std::string& where)
{
  const auto found = object.find(member);
  if (found == object.end() || !found->is_array() || found->size() != 3 ||
      !std::all_of(found->begin(), found->end(), [](const Json& value) { return value.is_number(); }))
  {
    throw FileError(text(where, " has no ", member, " of three numbers"));
  }
  return { (*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>() };
}

void readAxon(const Json& axon, const std::string& name, Fibres& fibres, GRatiosOfFile& gRatios)
{
  const std::string where = text(name, ": axon ", fibres.size() + 1);
  const auto ellipsoids = axon.is_object() ? axon.find("ellipsoids") : axon.end();
  if (ellipsoids == axon.end() || !ellipsoids->is_array() || ellipsoids->size() < 2)
  {
    throw FileError(where + " has fewer than two ellipsoids: give a file that the White Matter Generator has written "
                            "(config_output_N.json), not one that it starts from");
  }
  fibres.addFibre(static_cast<int>(fibres.size()) + 1, 1, 1.0);
  for (const Json& ellipsoid : *ellipsoids)
  {
    const Eigen::Vector3d point = threeNumbers(ellipsoid, "position", where + ", an ellipsoid");
    const auto diameter = ellipsoid.find("myelinDiameter");
    if (diameter == ellipsoid.end() || !diameter->is_number())
    {
      throw FileError(where + ", an ellipsoid, has no myelinDiameter");
    }
    const double radius = 0.5 * diameter->get<double>();
    const auto inner = ellipsoid.find("axonDiameter");
    if (fibres.pointCount(fibres.size() - 1) > 0 && (point - fibres.points.back()).norm() <= closestEllipsoids)
    {
      continue;
    }
    fibres.addPoint(point, radius);
    gRatios.add(inner != ellipsoid.end() && inner->is_number() ? 0.5 * inner->get<double>() : 0.0, radius);
  }
  fibres.targetRadii.back() = rootMeanSquareRadius(fibres, fibres.size() - 1);
  gRatios.give(fibres);
}

} // namespace

FibresOfFile readEllipsoidFile(std::istream& stream, const std::string& name)
{
  const std::string content((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const auto json = parsedJson(content);
  if (!json || !json->is_object() || json->count("axons") == 0 || json->count("voxelSize") == 0 || !(*json)["axons"].is_array())
  {
    throw FileError(name +
                    " is no strand file: it begins as JSON does, and is not what the White Matter Generator writes (an object "
                    "with voxelSize and axons)");
  }
  FibresOfFile read;
  const Json& voxel = (*json)["voxelSize"];
  const Eigen::Vector3d size =
    voxel.is_number() ? Eigen::Vector3d::Constant(voxel.get<double>()).eval() : threeNumbers(*json, "voxelSize", name);
  read.fibres.domain.lower = -0.5 * size;
  read.fibres.domain.upper = 0.5 * size;
  GRatiosOfFile gRatios;
  for (const Json& axon : (*json)["axons"])
  {
    readAxon(axon, name, read.fibres, gRatios);
  }
  if (const auto cells = json->find("cells"); cells != json->end() && cells->is_array() && !cells->empty())
  {
    read.remarks.push_back(text(cells->size(), " cell(s) are left out, since only axons become fibres"));
  }
  validateFile(read.fibres, name);
  return read;
}

} // namespace cactus
