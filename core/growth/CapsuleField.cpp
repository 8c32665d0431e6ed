// SPDX-License-Identifier: BSD-3-Clause
#include "growth/CapsuleField.h"

#include "base/Parallel.h"
#include "growth/CandidateSearch.h"
#include "growth/FieldKernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cactus
{

namespace
{

/// Samples along each side of a block, in which single-precision arithmetic is relative to the block's centre.
constexpr int blockSize = 16;
constexpr double blockHalf = 0.5 * (blockSize - 1);
constexpr int cellSize[3] = { FieldCell::sizeX, FieldCell::sizeY, FieldCell::sizeZ };

int floorDivide(int a, int b)
{
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// Single precision is good to some 1e-7 of a block's neighbourhood; the slack keeps decisions on the safe side of it.
double slackened(double extent)
{
  return extent * (1.0 + 1e-5) + 1e-5;
}

CellRelevance inSinglePrecision(const FieldRelevance& relevance)
{
  const auto bounded = [](double value) { return float(std::min(value, 1e20)); };
  return { bounded(relevance.bestReach), bounded(relevance.secondReach), bounded(relevance.sumReach),
    bounded(relevance.contrast) };
}

/// The blocks of the index space that hold a grid's samples.
struct Blocks
{
  explicit Blocks(const VoxelGrid& grid)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int lower = grid.lower[std::size_t(axis)];
      this->first[axis] = floorDivide(lower, blockSize);
      this->count[axis] = floorDivide(lower + grid.count[std::size_t(axis)] - 1, blockSize) - this->first[axis] + 1;
    }
  }

  std::size_t size() const { return std::size_t(this->count[0] * this->count[1] * this->count[2]); }
  /// Index of the first sample of a block.
  Eigen::Array3i lower(std::size_t block) const
  {
    const auto n = std::int64_t(block);
    return { (this->first[0] + int(n % this->count[0])) * blockSize,
      (this->first[1] + int(n / this->count[0] % this->count[1])) * blockSize,
      (this->first[2] + int(n / (this->count[0] * this->count[1]))) * blockSize };
  }

  int first[3];
  std::int64_t count[3];
};

/// Evaluates one block after the other, cell by cell; each thread has one of its own.
class BlockEvaluation
{
public:
  using Sink = std::function<void(const FieldCell&, int)>;

  BlockEvaluation(const CapsuleSeeds& seeds, const SeedBins& bins, const VoxelGrid& grid, const FieldRelevance& relevance,
    const Sink& sink, int thread)
    : Search(seeds, bins)
    , Grid(grid)
    , Relevance(relevance)
    , RelevanceInCells(inSinglePrecision(relevance))
    , HandOver(sink)
    , Thread(thread)
  {
    this->Samples.extent =
      float(slackened(0.5 * grid.spacing * Eigen::Vector3d(cellSize[0] - 1, cellSize[1] - 1, cellSize[2] - 1).norm()));
  }

  /// lower: index of the block's first sample.
  void evaluate(const Eigen::Array3i& lower)
  {
    const double h = this->Grid.spacing;
    const Eigen::Vector3d centre =
      this->Grid.origin + h * Eigen::Vector3d(lower[0] + blockHalf, lower[1] + blockHalf, lower[2] + blockHalf);
    const double extent = slackened(0.5 * h * (blockSize - 1) * std::sqrt(3.0));
    Candidates& candidates = this->Search.find(centre, extent, this->Relevance);
    for (int k = 0; k < blockSize; k += cellSize[2])
    {
      for (int j = 0; j < blockSize; j += cellSize[1])
      {
        for (int i = 0; i < blockSize; i += cellSize[0])
        {
          this->evaluateCell(lower, { i, j, k }, candidates);
        }
      }
    }
  }

private:
  /// at: where in the block the cell begins.
  void evaluateCell(const Eigen::Array3i& lower, const Eigen::Array3i& at, Candidates& candidates)
  {
    FieldCell cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int first = this->Grid.lower[std::size_t(axis)];
      cell.lower[axis] = lower[axis] + at[axis];
      cell.begin[axis] = std::max(0, first - cell.lower[axis]);
      cell.end[axis] = std::min(cellSize[axis], first + this->Grid.count[std::size_t(axis)] - cell.lower[axis]);
      if (cell.begin[axis] >= cell.end[axis])
      {
        return;
      }
    }
    this->placeSamples(at);
    std::vector<ConeGroup>& groups = candidates.groups();
    this->Kernels.evaluateCell(candidates.columns(), groups.data(), groups.size(), this->RelevanceInCells, this->Samples);
    cell.best = this->Samples.best;
    cell.second = this->Samples.second;
    cell.rank = this->Samples.rank;
    this->HandOver(cell, this->Thread);
  }

  void placeSamples(const Eigen::Array3i& at)
  {
    const double h = this->Grid.spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Samples.centre[axis] = float((at[axis] + 0.5 * (cellSize[axis] - 1) - blockHalf) * h);
    }
    for (int n = 0; n < FieldCell::size; ++n)
    {
      const int inRow = n % FieldCell::sizeX;
      const int row = n / FieldCell::sizeX % FieldCell::sizeY;
      const int plane = n / (FieldCell::sizeX * FieldCell::sizeY);
      this->Samples.position[0][n] = float((at[0] + inRow - blockHalf) * h);
      this->Samples.position[1][n] = float((at[1] + row - blockHalf) * h);
      this->Samples.position[2][n] = float((at[2] + plane - blockHalf) * h);
    }
  }

  CandidateSearch Search;
  const VoxelGrid& Grid;
  const FieldRelevance& Relevance;
  CellRelevance RelevanceInCells;
  const FieldKernels& Kernels = bestKernels<FieldKernels>();
  const Sink& HandOver;
  int Thread;
  CellSamples Samples;
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

void CapsuleField::sweep(const VoxelGrid& grid, const FieldRelevance& relevance, const Context& context, double progressFrom,
  double progressTo, const std::string& message, const std::function<void(const FieldCell&, int)>& sink) const
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
