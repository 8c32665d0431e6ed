// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/CandidateSearch.h"
#include "growth/CapsuleSeeds.h"
#include "growth/FieldCell.h"
#include "growth/FieldKernels.h"
#include "growth/FieldRelevance.h"
#include "growth/LabelImage.h"
#include "growth/SeedBins.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace cactus
{

/// Evaluates blocks of the index space, cell by cell; each thread has its own.
class BlockEvaluation
{
public:
  /// Samples along each side of a block. Single-precision arithmetic is relative to the block's centre.
  static constexpr int blockSize = 16;

  BlockEvaluation(const CapsuleSeeds& seeds, const SeedBins& bins, const VoxelGrid& grid, const FieldRelevance& relevance,
    const FieldSink& sink, int thread);

  /// Passes those of a block's cells that contain samples of the grid to the sink. lower: index of the block's first sample.
  void evaluate(const Eigen::Array3i& lower);

private:
  int chooseSearchEdge() const;
  Candidates& findCandidates(const Eigen::Array3i& lower, const Eigen::Array3i& at);
  void evaluateCube(const Eigen::Array3i& lower, const Eigen::Array3i& at);
  void evaluatePart(const Eigen::Array3i& lower, const Eigen::Array3i& part, const ConeGroups& candidates);
  void evaluateCell(const Eigen::Array3i& lower, const Eigen::Array3i& at, const ConeGroups& candidates);
  bool findHeld(const Eigen::Array3i& lower, int edge, int (&begin)[3], int (&end)[3]) const;
  void moveTo(const Eigen::Array3i& at, int edge, SamplePlace& place) const;

  CandidateSearch Search;
  const VoxelGrid& Grid;
  const FieldRelevance& Relevance;
  CellRelevance RelevanceInCells;
  const FieldKernels& Kernels = bestKernels<FieldKernels>();
  const FieldSink& HandOver;
  int Thread;
  int SearchEdge;  ///< edge of the cubes of samples that share a search for candidates
  Candidates Near; ///< those of a block's candidates that matter in a part of it
  SamplePlace Part;
  CellSamples Samples;
  /// Per axis, the sample positions relative to a block's centre, for each place where a cell may begin.
  std::vector<std::array<float, FieldCell::size>> Positions[3];
};

} // namespace cactus
