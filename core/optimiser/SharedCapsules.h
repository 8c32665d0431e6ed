// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Bytes.h"
#include "fibres/Capsules.h"
#include "fibres/Fibres.h"
#include "fibres/PeriodicImages.h"
#include "optimiser/FibreShares.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cactus
{

/// The capsules of this process's fibres, and those of other processes' fibres that may touch them, as found in the last search
/// for neighbours. All are in the order of a single process, so that lists of neighbours and their sums are the same. A single
/// process has all and sends nothing. In a periodic domain, which processes do not share, the images of capsules that may touch
/// others follow behind all.
class SharedCapsules
{
public:
  /// Makes the capsules of `fibres`, this process's own; `shares` has to outlive the object.
  SharedCapsules(const Fibres& fibres, const FibreShares& shares);

  const Capsules& all() const { return this->All; }
  /// Returns the range of this process's own capsules in all().
  const CapsuleRange& own() const { return this->Own; }
  /// Returns the first control point, among those of the process's own fibres, of the k-th of its own capsules.
  std::size_t pointOf(std::size_t k) const { return this->All.first[this->Own.begin + k] - this->PointsBefore; }

  /// Updates the positions and radii of a fibre's control points.
  void take(const Fibres& fibres, std::size_t f);
  /// Does the same for all fibres; the capsules of other processes must then be found or updated anew.
  void takeAll(const Fibres& fibres);

  // The functions below are collective.

  /// Finds the neighbours of the own capsules, including those of other processes. reach: per own capsule (see findNeighbours).
  void findNeighbours(const Fibres& fibres, const std::vector<float>& reach, int threads, NeighbourList& list);

  /// Updates the positions of the capsules of other processes. Returns whether the flag is set in any process.
  bool update(const Fibres& fibres, bool withRadii, bool flag);

  /// Evaluates the own capsules. The caller combines the parts of all processes.
  OverlapParts evaluate(
    const NeighbourList& neighbours, double margin, double tolerance, int threads, std::vector<CapsuleOverlap>& result);

private:
  /// Consecutive capsules of a fibre.
  struct Stretch
  {
    std::size_t begin; ///< of sent ones, among the process's own; of received ones, in all()
    std::size_t count;
  };

  /// The capsules received from other processes, without their control points.
  struct Others
  {
    std::vector<std::uint32_t> first; ///< per capsule, as in Capsules
    std::vector<std::uint32_t> fibre;
    std::vector<float> reaches;
    std::size_t points = 0; ///< number of control points
    bool isTapered = false;
  };

  bool isShared() const { return this->Shares.processes() > 1; }
  void dropOthers();
  std::vector<std::vector<Stretch>> stretchesNearOthers(const std::vector<float>& reach, int threads) const;
  std::vector<float> giveAway(const Fibres& fibres, std::vector<std::vector<Stretch>> stretches, const std::vector<float>& reach);
  std::vector<float> takeIn(const std::vector<std::string>& found, std::size_t ownPoints, const std::vector<float>& reach);
  void readStretches(
    const CapsuleRange& processes, std::vector<ByteReader>& given, Others& others, std::size_t place, std::uint32_t point);
  void putPoints(const Fibres& fibres, const std::vector<Stretch>& stretches, bool withRadii, ByteWriter& put) const;
  void getPoints(const std::vector<Stretch>& stretches, bool withRadii, ByteReader& get);

  const FibreShares& Shares;
  const Domain Periods;
  std::vector<CapsuleImage> Images; ///< of own capsules, behind these in All
  Capsules All;
  std::vector<RoughCapsule> Rough; ///< work space of evaluate()
  CapsuleRange Own;
  std::size_t PointsBefore = 0; ///< control points received from lower ranks
  /// Whether any capsule of all processes is tapered: if none is here, the gradients without it have the same value, but zeros
  /// may have another sign.
  bool IsTapered = false;
  std::vector<std::vector<Stretch>> Given; ///< to each process
  std::vector<std::vector<Stretch>> Taken; ///< from each process
};

} // namespace cactus
