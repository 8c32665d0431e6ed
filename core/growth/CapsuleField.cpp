// SPDX-License-Identifier: BSD-3-Clause
#include "growth/CapsuleField.h"

#include "base/Parallel.h"
#include "growth/BlockEvaluation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

namespace cactus
{

namespace
{

int floorDivide(int a, int b)
{
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// The blocks of the index space that hold a grid's samples.
struct Blocks
{
  explicit Blocks(const VoxelGrid& grid)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int lower = grid.lower[std::size_t(axis)];
      this->first[axis] = floorDivide(lower, BlockEvaluation::blockSize);
      this->count[axis] =
        floorDivide(lower + grid.count[std::size_t(axis)] - 1, BlockEvaluation::blockSize) - this->first[axis] + 1;
    }
  }

  std::size_t size() const { return std::size_t(this->count[0] * this->count[1] * this->count[2]); }
  /// Returns the index of the first sample of a block.
  Eigen::Array3i lower(std::size_t block) const
  {
    const auto n = std::int64_t(block);
    return { (this->first[0] + int(n % this->count[0])) * BlockEvaluation::blockSize,
      (this->first[1] + int(n / this->count[0] % this->count[1])) * BlockEvaluation::blockSize,
      (this->first[2] + int(n / (this->count[0] * this->count[1]))) * BlockEvaluation::blockSize };
  }

  int first[3];
  std::int64_t count[3];
};

/// The largest excess of s in single precision, as a fraction of a voxel, with a wide margin.
constexpr double roundingInVoxels = 0.01;

/// Tells whether the field of a cone may be above -`reach` at samples of a block: checks its eighths, in which the field exceeds
/// its value in their middle by no more than the distance to their corners.
bool comesNear(const Cone& cone, const VoxelGrid& grid, const std::array<int, 3>& block, double reach)
{
  constexpr int half = BlockEvaluation::blockSize / 2;
  const double toCorner = 0.5 * (half - 1) * std::sqrt(3.0) * grid.spacing;
  for (int eighth = 0; eighth < 8; ++eighth)
  {
    Eigen::Vector3d middle = grid.origin;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int first = BlockEvaluation::blockSize * block[std::size_t(axis)] + half * ((eighth >> axis) & 1);
      middle[axis] += grid.spacing * (first + 0.5 * (half - 1));
    }
    if (coneValue(cone, middle) + toCorner > -reach)
    {
      return true;
    }
  }
  return false;
}

} // namespace

CapsuleField::CapsuleField(
  const Fibres& fibres, const SeedOptions& options, const Eigen::AlignedBox3d& region, double reach, int threads)
  : Seeds(fibres, options, region, reach, threads)
  , Bins(this->Seeds.pieces, threads)
{
}

double CapsuleField::value(int rank, const Eigen::Vector3d& x) const
{
  double value = -std::numeric_limits<double>::infinity();
  const auto r = std::size_t(rank);
  for (std::size_t p = this->Seeds.pieceOffsets[r]; p < this->Seeds.pieceOffsets[r + 1]; ++p)
  {
    value = std::max(value, coneValue(this->Seeds.pieces[p].cone, x));
  }
  return value;
}

double CapsuleField::length(int rank, Eigen::Vector3d& middle) const
{
  double length = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  const auto r = std::size_t(rank);
  for (std::size_t n = 0; n < this->Seeds.chainPieces[r]; ++n)
  {
    const Cone& cone = this->Seeds.pieces[this->Seeds.pieceOffsets[r] + n].cone;
    length += cone.length;
    moment += cone.length * (cone.start + 0.5 * cone.length * cone.axis);
  }
  if (length > 0.0)
  {
    middle = moment / length;
  }
  return length / this->Seeds.chainsOf(r);
}

std::vector<std::array<int, 3>> CapsuleField::blocksNear(int rank, const VoxelGrid& grid, double reach) const
{
  const double farthest = reach + roundingInVoxels * grid.spacing;
  const double edge = BlockEvaluation::blockSize * grid.spacing;
  const Blocks blocks(grid);
  std::set<std::array<int, 3>> near;
  const auto r = std::size_t(rank);
  for (std::size_t p = this->Seeds.pieceOffsets[r]; p < this->Seeds.pieceOffsets[r + 1]; ++p)
  {
    const Cone& cone = this->Seeds.pieces[p].cone;
    const Eigen::AlignedBox3d box = boundingBox(cone);
    int first[3];
    int last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto blockAt = [&](double x)
      {
        const double block = std::floor((x - grid.origin[axis]) / edge);
        return blocks.first[axis] + int(std::min(std::max(block - blocks.first[axis], -1.0), double(blocks.count[axis])));
      };
      first[axis] = std::max(blockAt(box.min()[axis] - farthest), blocks.first[axis]);
      last[axis] = std::min(blockAt(box.max()[axis] + farthest), blocks.first[axis] + int(blocks.count[axis]) - 1);
    }
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        for (int x = first[0]; x <= last[0]; ++x)
        {
          const std::array<int, 3> block{ { x, y, z } };
          if (near.count(block) == 0 && comesNear(cone, grid, block, farthest))
          {
            near.insert(block);
          }
        }
      }
    }
  }
  return { near.begin(), near.end() };
}

std::unique_ptr<BlockEvaluation> CapsuleField::evaluation(
  const VoxelGrid& grid, const FieldRelevance& relevance, const FieldSink& sink, int thread) const
{
  return std::make_unique<BlockEvaluation>(this->Seeds, this->Bins, grid, relevance, sink, thread);
}

void CapsuleField::sweep(const VoxelGrid& grid, const FieldRelevance& relevance, const Context& context, double progressFrom,
  double progressTo, const std::string& message, const FieldSink& sink) const
{
  if (grid.size() == 0)
  {
    return;
  }
  const Blocks blocks(grid);
  parallelForWithWorkers(
    blocks.size(), context, [&](int thread) { return BlockEvaluation(this->Seeds, this->Bins, grid, relevance, sink, thread); },
    [&](BlockEvaluation& evaluation, std::size_t block) { evaluation.evaluate(blocks.lower(block)); }, message, progressFrom,
    progressTo);
  context.report(progressTo, message);
}

} // namespace cactus
