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

/// What ends the work of a process because of another one: the first process throws what happened, and where; nobody else need
/// say it again.
class ReportedElsewhere : public Error
{
public:
  using Error::Error;
};

/// How the processes of a team share work. All of them run the same code on the same input and come to the same exchanges, in
/// the same order; between these, each does a part of what is shared, and all of what is not. So every process ends with the same
/// result, which does not depend on their number.
class Sharing
{
public:
  /// Without a team there is one process, and nothing is exchanged. Processes tell each other by the file `stopFile`, which
  /// nobody else uses, that one has failed, so that the others need not go on to the next exchange.
  explicit Sharing(Team* team = nullptr, std::string stopFile = "");

  int size() const { return this->Members != nullptr ? this->Members->size() : 1; }
  int place() const { return this->Members != nullptr ? this->Members->place() : 0; }
  /// The process that does what only one may do.
  bool isFirst() const { return this->place() == 0; }

  /// Runs what is shared, and ends it alike on all: where it throws on one of them, the first throws that, with the number of the
  /// process, and the others ReportedElsewhere. Of several errors, that of the first process; being stopped comes last.
  void together(const std::function<void()>& work) const;
  /// Whether something that each process knows of itself is so in all of them.
  bool isEverywhere(bool isHere) const;

  // The rest is for such work.

  /// What each process has given. Ends the work where one has failed.
  std::vector<std::string> exchange(const std::string& bytes = "") const;
  /// What each process has given to this one, by their places; toEach is what this one gives to each. Ends the work where one has
  /// failed.
  std::vector<std::string> deal(std::vector<std::string> toEach) const;
  /// What the first process has given.
  std::string fromFirst(const std::string& bytes) const;
  /// Adds up what all processes have counted.
  void addUp(std::vector<std::uint64_t>& counts) const;
  /// Stops, too, once another process has failed.
  Context watching(const Context& context) const;

  /// Runs body(i) for each i in [0, count) in one of the processes, there as parallelFor() does; then take(i, bytes) in the
  /// others, one i after the other, with what bytesOf(i) gave.
  template <typename Body, typename BytesOf, typename Take>
  void loop(std::size_t count, const Context& context, Body&& body, BytesOf&& bytesOf, Take&& take,
    const std::string& message = "", double from = 0.0, double to = 1.0) const
  {
    const auto partOf = [&](int process) { return this->batchesOf(process, count); };
    this->loopInParts(partOf, count, context, body, bytesOf, take, message, from, to);
  }

  /// The same for each i in [0, weights.size()), of which each process has some that follow one another, so many that the sums of
  /// their weights, which are positive, are about the same: for work that needs the same things where it is near in this order.
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
