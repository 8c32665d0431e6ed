// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace cactus
{

/// Processes that work on one thing together, and see the same disk. This is all that core knows of them; see Sharing.
class Team
{
public:
  virtual ~Team() = default;

  virtual int size() const = 0;
  /// Of this process, counted from 0.
  virtual int place() const = 0;
  /// What each process has given, by their places. Waits until all have come here.
  virtual std::vector<std::string> exchange(const std::string& bytes) = 0;
  /// What each process has given to this one, by their places; toEach is what this one gives, its own part included. Waits until
  /// all have come here. Some may come to an exchange instead, and so give the same to all.
  virtual std::vector<std::string> deal(const std::vector<std::string>& toEach) = 0;
};

} // namespace cactus
