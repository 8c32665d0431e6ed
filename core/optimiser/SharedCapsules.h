// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Bytes.h"
#include "fibres/Capsules.h"
#include "fibres/Fibres.h"
#include "optimiser/FibreShares.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cactus
{

/// The capsules of this process's fibres, and beside them those of other processes' fibres that may touch them, as far as the
/// last search for neighbours reached. All are in the order that they have in one process, so that lists of neighbours and the
/// sums over them are the same there. One process has all, and tells nobody.
class SharedCapsules
{
public:
  /// fibres: this process's own; `shares` has to outlive the object.
  SharedCapsules(const Fibres& fibres, const FibreShares& shares);

  const Capsules& all() const { return this->All; }
  /// Where this process's own ones are in all().
  const CapsuleRange& own() const { return this->Own; }
  /// The first control point, among those of the process's own fibres, of the k-th of its own capsules.
  std::size_t pointOf(std::size_t k) const { return this->All.first[this->Own.begin + k] - this->PointsBefore; }

  /// Takes over where a fibre's control points are now, and their radii.
  void take(const Fibres& fibres, std::size_t f);
  /// The same for all of them, after which what is known of other processes has to be found, or asked for, anew.
  void takeAll(const Fibres& fibres);

  // Every process has to come to the rest.

  /// Finds the neighbours of the own capsules, and the capsules of other processes among them. reach: of each own capsule (see
  /// findNeighbours).
  void findNeighbours(const Fibres& fibres, const std::vector<float>& reach, int threads, NeighbourList& list);

  /// Takes over where the capsules of other processes are now. Returns whether the flag is set in any process.
  bool update(const Fibres& fibres, bool withRadii, bool flag);

  /// Sums over the capsules of all processes are the caller's to make of those over the own ones.
  OverlapParts evaluate(
    const NeighbourList& neighbours, double margin, double tolerance, int threads, std::vector<CapsuleOverlap>& result);

private:
  /// Capsules that follow each other in a fibre.
  struct Stretch
  {
    std::size_t begin; ///< of those given away, among the process's own; of others, in all()
    std::size_t count;
  };

  /// What other processes have given, but for its control points.
  struct Others
  {
    std::vector<std::uint32_t> first; ///< of each capsule, as in Capsules
    std::vector<std::uint32_t> fibre;
    std::vector<float> reaches;
    std::size_t points = 0; ///< their number
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
  Capsules All;
  std::vector<RoughCapsule> Rough; ///< room for evaluate()
  CapsuleRange Own;
  std::size_t PointsBefore = 0; ///< control points of others in front of the process's own
  /// Whether any capsule of all processes is tapered: where none is here, gradients are the same in value without, but zeros may
  /// have another sign.
  bool IsTapered = false;
  std::vector<std::vector<Stretch>> Given; ///< to each process
  std::vector<std::vector<Stretch>> Taken; ///< from each process
};

} // namespace cactus
