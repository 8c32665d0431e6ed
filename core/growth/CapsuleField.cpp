// SPDX-License-Identifier: BSD-3-Clause
#include "growth/CapsuleField.h"

#include "base/Parallel.h"
#include "growth/BlockEvaluation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

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
  /// Index of the first sample of a block.
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

} // namespace

CapsuleField::CapsuleField(const Fibres& fibres, const CalibreOptions& options, const Eigen::AlignedBox3d& region, double reach)
  : Seeds(fibres, Calibre(options), region, reach)
  , Bins(this->Seeds.pieces)
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
