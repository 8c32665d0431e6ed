// SPDX-License-Identifier: BSD-3-Clause
#include "growth/BlockEvaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cactus
{

namespace
{

constexpr double blockHalf = 0.5 * (BlockEvaluation::blockSize - 1);
constexpr int cellSize = FieldCell::edge;
/// Samples along each side of the parts of a block whose cells share their narrowed candidates.
constexpr int partSize = 8;
/// The fixed cost of a search, as a number of pieces.
constexpr double piecesPerSearch = 32.0;

/// Single precision has an error of some 1e-7 of a block's neighbourhood; the slack keeps decisions on the safe side of it.
double slackened(double extent)
{
  return extent * (1.0 + 1e-5) + 1e-5;
}

/// Returns a cube with `samples` samples along each edge.
SamplePlace cubeOf(int samples, double spacing)
{
  const double half = 0.5 * spacing * (samples - 1);
  return { {}, float(slackened(half)), float(slackened(half * std::sqrt(3.0))) };
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
  , SearchEdge(this->chooseSearchEdge())
{
  this->Part = cubeOf(partSize, grid.spacing);
  this->Samples.place = cubeOf(cellSize, grid.spacing);
  const int strides[3] = { 1, cellSize, cellSize * cellSize };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int at = 0; at < blockSize; at += cellSize)
    {
      this->Positions[axis].emplace_back();
      for (int n = 0; n < FieldCell::size; ++n)
      {
        const int place = n / strides[axis] % cellSize;
        this->Positions[axis].back()[std::size_t(n)] = float((at + place - blockHalf) * grid.spacing);
      }
    }
  }
}

/// Chooses the edge that costs least: closely spaced samples of a block share their candidates; for widely spaced ones there
/// would be too many.
int BlockEvaluation::chooseSearchEdge() const
{
  int best = blockSize;
  double least = std::numeric_limits<double>::infinity();
  for (int edge = blockSize; edge >= cellSize; edge /= 2)
  {
    const double pieces = this->Search.piecesWithin(cubeOf(edge, this->Grid.spacing).extent);
    const double perSample = (pieces + piecesPerSearch) / (double(edge) * edge * edge);
    if (perSample < least)
    {
      least = perSample;
      best = edge;
    }
  }
  return best;
}

void BlockEvaluation::evaluate(const Eigen::Array3i& lower)
{
  for (int k = 0; k < blockSize; k += this->SearchEdge)
  {
    for (int j = 0; j < blockSize; j += this->SearchEdge)
    {
      for (int i = 0; i < blockSize; i += this->SearchEdge)
      {
        this->evaluateCube(lower, { i, j, k });
      }
    }
  }
}

/// Finds the candidates of the cube that begins `at` a place of the block.
Candidates& BlockEvaluation::findCandidates(const Eigen::Array3i& lower, const Eigen::Array3i& at)
{
  const double h = this->Grid.spacing;
  const double half = 0.5 * (this->SearchEdge - 1);
  const auto place = [&](const Eigen::Array3d& sample) { return Eigen::Vector3d(this->Grid.origin + h * sample.matrix()); };
  const Eigen::Array3d first = lower.cast<double>();
  return this->Search.find(
    place(first + at.cast<double>() + half), slackened(h * half * std::sqrt(3.0)), this->Relevance, place(first + blockHalf));
}

/// Evaluates samples that share their candidates.
void BlockEvaluation::evaluateCube(const Eigen::Array3i& lower, const Eigen::Array3i& at)
{
  int begin[3];
  int end[3];
  if (!this->findHeld(lower + at, this->SearchEdge, begin, end))
  {
    return;
  }
  Candidates& candidates = this->findCandidates(lower, at);
  if (this->SearchEdge == cellSize)
  {
    this->evaluateCell(lower, at, candidates.all());
    return;
  }
  this->Near.makeRoomFor(candidates);
  for (int k = 0; k < this->SearchEdge; k += partSize)
  {
    for (int j = 0; j < this->SearchEdge; j += partSize)
    {
      for (int i = 0; i < this->SearchEdge; i += partSize)
      {
        this->evaluatePart(lower, at + Eigen::Array3i(i, j, k), candidates.all());
      }
    }
  }
}

/// Evaluates a part of a block. part: where in the block it begins.
void BlockEvaluation::evaluatePart(const Eigen::Array3i& lower, const Eigen::Array3i& part, const ConeGroups& candidates)
{
  int begin[3];
  int end[3];
  if (!this->findHeld(lower + part, partSize, begin, end))
  {
    return;
  }
  this->moveTo(part, partSize, this->Part);
  ConeGroups near = this->Near.all();
  this->Kernels.narrow(candidates, this->RelevanceInCells, this->Part, near);
  for (int k = part[2]; k < part[2] + partSize; k += cellSize)
  {
    for (int j = part[1]; j < part[1] + partSize; j += cellSize)
    {
      for (int i = part[0]; i < part[0] + partSize; i += cellSize)
      {
        this->evaluateCell(lower, { i, j, k }, near);
      }
    }
  }
}

/// Evaluates a cell. at: where in the block it begins.
void BlockEvaluation::evaluateCell(const Eigen::Array3i& lower, const Eigen::Array3i& at, const ConeGroups& candidates)
{
  FieldCell cell;
  if (!this->findHeld(lower + at, cellSize, cell.begin, cell.end))
  {
    return;
  }
  this->moveTo(at, cellSize, this->Samples.place);
  for (int axis = 0; axis < 3; ++axis)
  {
    cell.lower[axis] = lower[axis] + at[axis];
    const auto& positions = this->Positions[axis][std::size_t(at[axis] / cellSize)];
    std::copy(positions.begin(), positions.end(), this->Samples.position[axis]);
  }
  this->Kernels.evaluateCell(candidates, this->RelevanceInCells, this->Samples);
  cell.best = this->Samples.best;
  cell.second = this->Samples.second;
  cell.rank = this->Samples.rank;
  this->HandOver(cell, this->Thread);
}

/// Finds the samples of a cube that the grid contains, relative to its first one, `lower`; false if there are none.
bool BlockEvaluation::findHeld(const Eigen::Array3i& lower, int edge, int (&begin)[3], int (&end)[3]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int first = this->Grid.lower[std::size_t(axis)];
    begin[axis] = std::max(0, first - lower[axis]);
    end[axis] = std::min(edge, first + this->Grid.count[std::size_t(axis)] - lower[axis]);
    if (begin[axis] >= end[axis])
    {
      return false;
    }
  }
  return true;
}

/// Moves a place to the middle of a cube of samples that begins `at` a place of the block.
void BlockEvaluation::moveTo(const Eigen::Array3i& at, int edge, SamplePlace& place) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    place.centre[axis] = float((at[axis] + 0.5 * (edge - 1) - blockHalf) * this->Grid.spacing);
  }
}

} // namespace cactus
