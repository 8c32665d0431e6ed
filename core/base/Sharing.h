// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Bytes.h"
#include "base/Context.h"
#include "base/Error.h"
#include "base/Parallel.h"
#include "base/Team.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// Ends the work of a process because another one failed: the first process throws the error and names the process; nobody else
/// needs to report it.
class ReportedElsewhere : public Error
{
public:
  using Error::Error;
};

/// Shares work among the processes of a team. All of them run the same code on the same input and make the same exchanges in the
/// same order. Between two exchanges, each does its part of the shared work and all of the rest. So every process ends with the
/// same result, which does not depend on their number.
class Sharing
{
public:
  /// Without a team there is one process and nothing is exchanged. A process that fails creates `stopFile`, which nothing else
  /// may use, so that the others stop before the next exchange.
  explicit Sharing(Team* team = nullptr, std::string stopFile = "");

  int size() const { return this->Members != nullptr ? this->Members->size() : 1; }
  int place() const { return this->Members != nullptr ? this->Members->place() : 0; }
  /// Tells whether this is the process that does what only one may do.
  bool isFirst() const { return this->place() == 0; }

  /// Runs collective work and ends it alike in all processes: if it throws in one of them, the first process throws that error
  /// with the number of the failed process, and the others ReportedElsewhere. Of several errors, that of the lowest rank wins;
  /// being stopped comes last.
  void together(const std::function<void()>& work) const;
  /// Tells whether `isHere` is true in all processes.
  bool isEverywhere(bool isHere) const;
  /// Tells whether all processes have given the same.
  bool areAlike(const std::string& given) const;

  // The functions below are called within together().

  /// Returns the bytes of each process (all-gather). Ends the work if one has failed.
  std::vector<std::string> exchange(const std::string& bytes = "") const;
  /// Returns the bytes that each process has sent to this one, by rank; toEach holds those that this one sends to each
  /// (all-to-all). Ends the work if one has failed.
  std::vector<std::string> deal(std::vector<std::string> toEach) const;
  /// Returns the bytes of the first process (broadcast).
  std::string fromFirst(const std::string& bytes) const;
  /// Sums the counts of all processes.
  void addUp(std::vector<std::uint64_t>& counts) const;
  /// Returns a context that also stops once another process has failed.
  Context watching(const Context& context) const;

  /// Runs body(i) for each i in [0, count) in one of the processes, as parallelFor() does; then calls take(i, bytes) in the
  /// others, one i after the other, with the result of bytesOf(i).
  template <typename Body, typename BytesOf, typename Take>
  void loop(std::size_t count, const Context& context, Body&& body, BytesOf&& bytesOf, Take&& take,
    const std::string& message = "", double from = 0.0, double to = 1.0) const
  {
    const auto partOf = [&](int process) { return this->batchesOf(process, count); };
    this->loopInParts(partOf, count, context, body, bytesOf, take, message, from, to);
  }

  /// Does the same for each i in [0, weights.size()). Each process gets a contiguous range, with about the same sum of the
  /// positive weights: for work whose neighbours in this order need the same data.
  template <typename Body, typename BytesOf, typename Take>
  void loopAlong(const std::vector<double>& weights, const Context& context, Body&& body, BytesOf&& bytesOf, Take&& take,
    const std::string& message = "", double from = 0.0, double to = 1.0) const
  {
    const auto partOf = [&](int process) { return this->stretchOf(process, weights); };
    this->loopInParts(partOf, weights.size(), context, body, bytesOf, take, message, from, to);
  }

private:
  struct Ended;

  std::vector<std::size_t> batchesOf(int process, std::size_t count) const;
  std::vector<std::size_t> stretchOf(int process, const std::vector<double>& weights) const;
  template <typename PartOf, typename Body, typename BytesOf, typename Take>
  void loopInParts(const PartOf& partOf, std::size_t count, const Context& context, Body&& body, BytesOf&& bytesOf, Take&& take,
    const std::string& message, double from, double to) const;
  static std::vector<std::string> whereWell(std::vector<std::string> all);
  void tell(const std::string& failure) const;
  [[noreturn]] void rethrow(const Ended& ended) const;

  Team* Members;
  std::string StopFile;
};

template <typename PartOf, typename Body, typename BytesOf, typename Take>
void Sharing::loopInParts(const PartOf& partOf, std::size_t count, const Context& context, Body&& body, BytesOf&& bytesOf,
  Take&& take, const std::string& message, double from, double to) const
{
  if (this->size() == 1)
  {
    parallelFor(count, context, body, message, from, to);
    return;
  }
  const std::vector<std::size_t> own = partOf(this->place());
  parallelFor(
    own.size(), context, [&](std::size_t i) { body(own[i]); }, message, from, to);
  ByteWriter made;
  for (const std::size_t i : own)
  {
    made(std::string(bytesOf(i)));
  }
  const std::vector<std::string> all = this->exchange(made.bytes());
  for (int process = 0; process < this->size(); ++process)
  {
    ByteReader found(all[std::size_t(process)]);
    for (const std::size_t i : process == this->place() ? std::vector<std::size_t>() : partOf(process))
    {
      take(i, found.get<std::string>());
    }
  }
}

} // namespace cactus
