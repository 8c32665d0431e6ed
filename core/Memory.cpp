// SPDX-License-Identifier: BSD-3-Clause
#include "Memory.h"

#include "Error.h"

#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace cactus
{

std::uint64_t availableMemory()
{
  std::ifstream info("/proc/meminfo");
  std::string key;
  std::uint64_t kilobytes = 0;
  std::string rest;
  while (info >> key >> kilobytes && std::getline(info, rest))
  {
    if (key == "MemAvailable:")
    {
      return kilobytes * 1024;
    }
  }
  return std::numeric_limits<std::uint64_t>::max();
}

void requireMemory(double bytes, const std::string& what, const std::string& advice)
{
  const auto available = static_cast<double>(availableMemory());
  if (bytes < available)
  {
    return;
  }
  std::ostringstream message;
  message << std::setprecision(3) << what << " needs " << bytes / 1e9 << " GB of memory, and " << available / 1e9
          << " GB are available: " << advice;
  throw OutOfMemory(message.str());
}

} // namespace cactus
