// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace cactus
{

/// A communicator: processes that work together and see the same disk. Core knows no more of them; see Sharing.
class Team
{
public:
  virtual ~Team() = default;

  virtual int size() const = 0;
  /// Returns the rank of this process, from 0.
  virtual int place() const = 0;
  /// Returns the bytes of each process, by rank (all-gather). Waits for all processes.
  virtual std::vector<std::string> exchange(const std::string& bytes) = 0;
  /// Returns the bytes that each process has sent to this one, by rank; toEach holds those that this one sends to each, itself
  /// included (all-to-all). Waits for all processes. Some may call exchange() instead, and so send the same to all.
  virtual std::vector<std::string> deal(const std::vector<std::string>& toEach) = 0;
};

} // namespace cactus
