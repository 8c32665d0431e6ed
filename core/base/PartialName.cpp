// SPDX-License-Identifier: BSD-3-Clause
#include "base/PartialName.h"

#include "base/Error.h"
#include "base/PosixFile.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <sys/file.h>
#include <sys/random.h>

namespace cactus
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t digits = 16;
constexpr std::size_t longestName = 255;
const std::string marker = ".partial-";

/// Returns the beginning of every partial name of `name`.
std::string beginning(const std::string& name)
{
  return name.substr(0, longestName - marker.size() - digits) + marker;
}

} // namespace

std::string partialName(const std::string& name)
{
  std::array<unsigned char, digits / 2> drawn;
  while (::getrandom(drawn.data(), drawn.size(), 0) != static_cast<ssize_t>(drawn.size()))
  {
    if (errno != EINTR)
    {
      throw FileError("cannot draw a random name: " + systemMessage(errno));
    }
  }
  std::string random;
  for (const unsigned char byte : drawn)
  {
    random += "0123456789abcdef"[byte >> 4];
    random += "0123456789abcdef"[byte & 15];
  }
  return beginning(name) + random;
}

bool isPartialName(const std::string& candidate, const std::string& name)
{
  const std::string start = beginning(name);
  return candidate.size() == start.size() + digits && candidate.compare(0, start.size(), start) == 0 &&
         candidate.find_first_not_of("0123456789abcdef", start.size()) == std::string::npos;
}

std::string wholeName(const std::string& candidate)
{
  const std::string name = candidate.substr(0, candidate.rfind(marker));
  return isPartialName(candidate, name) ? name : candidate;
}

bool lockForWriting(int descriptor)
{
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

std::vector<fs::path> partialsOf(const fs::path& folder, const std::string& name)
{
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    if (isPartialName(entry->path().filename().string(), name))
    {
      found.push_back(entry->path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace cactus
