// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sharing.h"
#include "fibres/Capsules.h"
#include "fibres/Fibres.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cactus
{

/// The assignment of fibres to processes: contiguous ranges of whole fibres, with about as many capsules in each process. It
/// depends only on the fibres and the number of processes, so all processes know the ranges of all.
class FibreShares
{
public:
  /// Assigns all fibres, which are the same in every process; `sharing` has to outlive the object. Throws InvalidInput if there
  /// are more control points than 32 bits can count.
  FibreShares(const Fibres& fibres, const Sharing& sharing);
  /// Assigns the same fibres with fewer control points: each process has those that it has in `alike`.
  FibreShares(const Fibres& coarser, const FibreShares& alike);

  const Sharing& sharing() const { return this->Processes; }
  int place() const { return this->Processes.place(); }
  std::size_t processes() const { return this->FibreBegin.size() - 1; }

  /// Totals over all processes.
  std::size_t fibreCount() const { return this->FibreBegin.back(); }
  std::size_t pointCount() const { return this->PointBegin.back(); }
  std::size_t capsuleCount() const { return this->capsuleBegin(this->processes()); }
  const std::vector<int>& fibreIds() const { return this->FibreIds; }

  /// Return the first fibre, control point and capsule of a process; for processes(), one past the last of all.
  std::size_t fibreBegin(std::size_t process) const { return this->FibreBegin[process]; }
  std::size_t pointBegin(std::size_t process) const { return this->PointBegin[process]; }
  std::size_t capsuleBegin(std::size_t process) const { return this->PointBegin[process] - this->FibreBegin[process]; }

  /// Return those of this process.
  std::size_t ownFibre() const { return this->fibreBegin(this->self()); }
  std::size_t ownCapsule() const { return this->capsuleBegin(this->self()); }

  /// Returns this process's fibres.
  Fibres own(Fibres all) const;

  /// Returns this process's part of an array with one value per fibre.
  template <typename Value>
  std::vector<Value> ownOf(std::vector<Value> perFibre) const
  {
    perFibre.resize(this->fibreBegin(this->self() + 1));
    perFibre.erase(perFibre.begin(), perFibre.begin() + static_cast<std::ptrdiff_t>(this->ownFibre()));
    return perFibre;
  }

private:
  std::size_t self() const { return static_cast<std::size_t>(this->place()); }

  const Sharing& Processes;
  std::vector<std::size_t> FibreBegin;
  std::vector<std::size_t> PointBegin;
  std::vector<int> FibreIds;
};

} // namespace cactus
