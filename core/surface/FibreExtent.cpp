// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreExtent.h"

#include "base/Constants.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Tells whether a node is a sample of the image: the outermost nodes lie on the faces of the box.
bool isSample(const NodeLattice& lattice, const std::array<int, 3>& node)
{
  return node[0] > 0 && node[1] > 0 && node[2] > 0 && node[0] < lattice.cells(0) && node[1] < lattice.cells(1) &&
         node[2] < lattice.cells(2);
}

/// Calls visit(node, depth) for each sample inside a fibre.
template <typename Visit>
void forEachSample(const SmoothedField& field, Visit&& visit)
{
  std::vector<float> values;
  for (const std::uint32_t block : field.blocks())
  {
    const NodeRange range = nodesOfBlock(field.lattice(), block).widened(1);
    values.resize(range.size());
    field.values(0.0, 0.0, range, values.data());
    const float* row = values.data();
    for (int k = 0; k < range.count[2]; ++k)
    {
      for (int j = 0; j < range.count[1]; ++j, row += range.count[0])
      {
        int found = 0; // most rows are outside the fibre
        for (int i = 0; i < range.count[0]; ++i)
        {
          found |= int(row[i] > 0.0f);
        }
        for (int i = 0; found != 0 && i < range.count[0]; ++i)
        {
          const std::array<int, 3> at{ { range.first[0] + i, range.first[1] + j, range.first[2] + k } };
          // Blocks share their nodes: each counts for one block only.
          constexpr int size = NodeLattice::blockCells;
          const bool isOwn = i > 0 && j > 0 && k > 0 && i <= size && j <= size && k <= size;
          if (isOwn && row[i] > 0.0f && isSample(field.lattice(), at))
          {
            visit(at, row[i]);
          }
        }
      }
    }
  }
}

/// The moments of a fibre's samples, in nodes.
struct SampleMoments
{
  double count = 0.0;
  Vector3d mean = Vector3d::Zero();
  Vector3d axis = Vector3d::UnitZ(); ///< direction of the largest variance
  double middleVariance = 0.0;       ///< second largest variance
};

SampleMoments momentsOf(const SmoothedField& field)
{
  SampleMoments moments;
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  forEachSample(field,
    [&](const std::array<int, 3>& at, float)
    {
      const Vector3d p(at[0], at[1], at[2]);
      moments.count += 1.0;
      moments.mean += p;
      square += p * p.transpose();
    });
  if (moments.count > 0.0)
  {
    moments.mean /= moments.count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(square / moments.count - moments.mean * moments.mean.transpose());
    moments.axis = solver.eigenvectors().col(2);
    moments.middleVariance = std::max(0.0, solver.eigenvalues()[1]);
  }
  return moments;
}

/// Returns the length, in nodes, of a fibre along z whose pieces go on beyond periodic faces across x and y.
double lengthOfRepeated(const SmoothedField& field)
{
  const Eigen::Vector2d period(field.lattice().cells(0) - 1, field.lattice().cells(1) - 1);
  const auto nearest = [&](const Eigen::Vector2d& apart) -> Eigen::Vector2d { return apart.binaryExpr(period, &nearestImage); };
  struct Layer
  {
    double count = 0.0;
    Eigen::Vector2d first = Eigen::Vector2d::Zero();
    Eigen::Vector2d sum = Eigen::Vector2d::Zero(); ///< of the ways from the first sample
  };
  std::map<int, Layer> layers;
  double count = 0.0;
  forEachSample(field,
    [&](const std::array<int, 3>& at, float)
    {
      const Eigen::Vector2d p(at[0], at[1]);
      Layer& layer = layers[at[2]];
      layer.first = layer.count == 0.0 ? p : layer.first;
      layer.count += 1.0;
      layer.sum += nearest(p - layer.first);
      count += 1.0;
    });
  if (layers.empty())
  {
    return 1.0;
  }
  // From centroid to centroid of layers as far apart as the fibre is wide, so that they follow the fibre and not the voxels.
  const auto height = static_cast<double>(layers.size());
  const int thickness = std::max(4, static_cast<int>(std::lround(2.0 * std::sqrt(count / height / pi))));
  double length = height;
  const Layer* before = nullptr;
  int last = 0;
  for (const auto& [z, layer] : layers)
  {
    if (before == nullptr || z >= last + thickness)
    {
      if (before != nullptr)
      {
        const auto centroid = [](const Layer& of) -> Eigen::Vector2d { return of.first + of.sum / of.count; };
        length += std::hypot(nearest(centroid(layer) - centroid(*before)).norm(), z - last) - (z - last);
      }
      before = &layer;
      last = z;
    }
  }
  return length;
}

} // namespace

double lengthOf(const SmoothedField& field, double spacing)
{
  if (field.repeats(0))
  {
    return lengthOfRepeated(field) * spacing;
  }
  const SampleMoments moments = momentsOf(field);
  if (!(moments.count > 0.0))
  {
    return spacing;
  }
  // Slices are as thick as the fibre is wide, so that centroids follow the fibre and not the voxels.
  const double thickness = std::max(4.0, 4.0 * std::sqrt(moments.middleVariance));
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  std::map<int, std::pair<double, Vector3d>> slices; // number of samples and sum of their places
  auto now = slices.end();
  forEachSample(field,
    [&](const std::array<int, 3>& at, float)
    {
      const Vector3d p = Vector3d(at[0], at[1], at[2]) - moments.mean;
      const double along = moments.axis.dot(p);
      lowest = std::min(lowest, along);
      highest = std::max(highest, along);
      const int number = static_cast<int>(std::floor(along / thickness));
      if (now == slices.end() || now->first != number) // neighbouring samples usually share a slice
      {
        now = slices.emplace(number, std::make_pair(0.0, Vector3d::Zero())).first;
      }
      now->second.first += 1.0;
      now->second.second += p;
    });
  // The ends beyond the first and the last centroid continue along the axis.
  double length = 1.0 + highest - lowest;
  Vector3d before = slices.begin()->second.second / slices.begin()->second.first;
  for (auto slice = std::next(slices.begin()); slice != slices.end(); ++slice)
  {
    const Vector3d centroid = slice->second.second / slice->second.first;
    const Vector3d step = centroid - before;
    length += step.norm() - std::abs(moments.axis.dot(step));
    before = centroid;
  }
  return length * spacing;
}

} // namespace cactus
