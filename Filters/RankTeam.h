// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Team.h"

#include <string>
#include <vector>

namespace cactus
{

/// The ranks of a parallel run as core's Team. Every rank has to run the shared work.
class RankTeam : public Team
{
public:
  int size() const override;
  int place() const override;
  std::vector<std::string> exchange(const std::string& bytes) override;
  std::vector<std::string> deal(const std::vector<std::string>& toEach) override;
};

} // namespace cactus
