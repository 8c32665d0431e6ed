// SPDX-License-Identifier: BSD-3-Clause
#include "growth/BlockEvaluation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cactus
{

namespace
{

constexpr double blockHalf = 0.5 * (BlockEvaluation::blockSize - 1);
constexpr int cellSize[3] = { FieldCell::sizeX, FieldCell::sizeY, FieldCell::sizeZ };

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

} // namespace

BlockEvaluation::BlockEvaluation(const CapsuleSeeds& seeds, const SeedBins& bins, const VoxelGrid& grid,
  const FieldRelevance& relevance, const FieldSink& sink, int thread)
  : Search(seeds, bins)
  , Grid(grid)
  , Relevance(relevance)
  , RelevanceInCells(inSinglePrecision(relevance))
  , HandOver(sink)
  , Thread(thread)
{
  this->Samples.extent =
    float(slackened(0.5 * grid.spacing * Eigen::Vector3d(cellSize[0] - 1, cellSize[1] - 1, cellSize[2] - 1).norm()));
  const int strides[3] = { 1, FieldCell::sizeX, FieldCell::sizeX * FieldCell::sizeY };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int at = 0; at < blockSize; at += cellSize[axis])
    {
      this->Positions[axis].emplace_back();
      for (int n = 0; n < FieldCell::size; ++n)
      {
        const int place = n / strides[axis] % cellSize[axis];
        this->Positions[axis].back()[std::size_t(n)] = float((at + place - blockHalf) * grid.spacing);
      }
    }
  }
}

void BlockEvaluation::evaluate(const Eigen::Array3i& lower)
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

/// at: where in the block the cell begins.
void BlockEvaluation::evaluateCell(const Eigen::Array3i& lower, const Eigen::Array3i& at, Candidates& candidates)
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

void BlockEvaluation::placeSamples(const Eigen::Array3i& at)
{
  const double h = this->Grid.spacing;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Samples.centre[axis] = float((at[axis] + 0.5 * (cellSize[axis] - 1) - blockHalf) * h);
    const auto& positions = this->Positions[axis][std::size_t(at[axis] / cellSize[axis])];
    std::copy(positions.begin(), positions.end(), this->Samples.position[axis]);
  }
}

} // namespace cactus
