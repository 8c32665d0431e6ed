// SPDX-License-Identifier: BSD-3-Clause
#include "base/Memory.h"

#include "base/Error.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <iomanip>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace cactus
{

namespace
{

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::atomic<int> processesSharingMemory{ 1 };

std::uint64_t minus(std::uint64_t limit, std::uint64_t used)
{
  return used < limit ? limit - used : 0;
}

/// The number in a file that holds one; unlimited where there is no such file, or another word in it ("max").
std::uint64_t numberIn(const std::string& path)
{
  std::ifstream file(path);
  file.imbue(std::locale::classic());
  std::uint64_t number = 0;
  return file >> number ? number : unlimited;
}

/// Empty ones stand for none.
using Keys = std::array<std::string_view, 3>;

/// The numbers that follow some keys in a file of "key number …" lines, added up; nothing where the file has none of them.
std::optional<std::uint64_t> sumOf(const std::string& path, const Keys& keys)
{
  std::ifstream file(path);
  file.imbue(std::locale::classic());
  std::optional<std::uint64_t> sum;
  std::string word;
  std::uint64_t number = 0;
  std::string rest;
  while (file >> word >> number && std::getline(file, rest))
  {
    if (std::find(keys.begin(), keys.end(), word) != keys.end())
    {
      sum = sum.value_or(0) + number;
    }
  }
  return sum;
}

/// The names of a control group's files in its two versions.
struct GroupFiles
{
  const char* limit;
  const char* used;
  /// In memory.stat: what the kernel takes back before it refuses memory. These are its lists of pages that a file on a disk
  /// backs, which do not have the pages of tmpfs: `file` and `cache` do, and those can only be swapped.
  Keys reclaimable;
};

constexpr GroupFiles version2{ "memory.max", "memory.current", { "active_file", "inactive_file", "slab_reclaimable" } };
constexpr GroupFiles version1{ "memory.limit_in_bytes", "memory.usage_in_bytes", { "total_active_file", "total_inactive_file" } };

/// What a group and those that it lies in leave, up to the mount point. In a container the path of /proc/self/cgroup may be that
/// outside, which is not there: the group itself is then what is mounted.
std::uint64_t leftByGroups(const std::string& mount, std::string path, const GroupFiles& files)
{
  std::uint64_t left = unlimited;
  for (;;)
  {
    const std::string folder = mount + path + "/";
    const std::uint64_t limit = numberIn(folder + files.limit);
    const std::uint64_t used = numberIn(folder + files.used);
    if (limit != unlimited && used != unlimited)
    {
      const std::uint64_t reclaimable = sumOf(folder + "memory.stat", files.reclaimable).value_or(0);
      left = std::min(left, minus(limit, minus(used, reclaimable)));
    }
    const std::size_t slash = path.rfind('/');
    if (path.empty() || slash == std::string::npos)
    {
      return left;
    }
    path.resize(slash);
  }
}

/// Lines "number:controllers:path": version 2 has no controllers.
std::uint64_t leftByControlGroups(const std::string& root)
{
  std::uint64_t left = unlimited;
  std::ifstream file(root + "/proc/self/cgroup");
  std::string line;
  while (std::getline(file, line))
  {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos)
    {
      continue;
    }
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    std::string path = line.substr(second + 1);
    while (!path.empty() && path.back() == '/')
    {
      path.pop_back();
    }
    if (controllers == ",,")
    {
      // Beside version 1, version 2 is mounted one lower.
      left = std::min({ left, leftByGroups(root + "/sys/fs/cgroup", path, version2),
        leftByGroups(root + "/sys/fs/cgroup/unified", path, version2) });
    }
    else if (controllers.find(",memory,") != std::string::npos)
    {
      left = std::min(left, leftByGroups(root + "/sys/fs/cgroup/memory", path, version1));
    }
  }
  return left;
}

} // namespace

void keepFreedMemory()
{
#ifdef __GLIBC__
  // What glibc itself comes to once it has freed a block of the largest size for which it does.
  constexpr int largestBlock = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, largestBlock);
  mallopt(M_TRIM_THRESHOLD, 2 * largestBlock);
  // A thread's memory comes in heaps of 64 MB, each of which would be given back as soon as nothing is in it. But so much is
  // asked for each time, too, which is refused where addresses are short.
  constexpr int usualPad = 128 << 10;
  mallopt(M_TOP_PAD, availableAddressSpace() == unlimited ? 2 * largestBlock : usualPad);
#endif
}

std::uint64_t availableAddressSpace()
{
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
  {
    return unlimited;
  }
  const std::uint64_t pages = numberIn("/proc/self/statm");
  const long pageSize = sysconf(_SC_PAGESIZE);
  return pages == unlimited || pageSize <= 0 ? limit.rlim_cur
                                             : minus(limit.rlim_cur, pages * static_cast<std::uint64_t>(pageSize));
}

std::uint64_t sharedMemoryLeft(const std::string& root)
{
  const std::uint64_t kilobytes = sumOf(root + "/proc/meminfo", { { "MemAvailable:" } }).value_or(unlimited / 1024);
  return std::min(kilobytes * 1024, leftByControlGroups(root));
}

std::uint64_t availableMemory()
{
  return std::min(sharedMemoryLeft("") / static_cast<std::uint64_t>(processesSharingMemory), availableAddressSpace());
}

namespace
{

/// With three digits, or all before the point where there are more: "8000 GB" is read, "8e+03 GB" is not.
std::string gigabytes(double bytes)
{
  const double value = bytes / 1e9;
  TextStream text;
  if (value >= 1e3 && value < 1e9)
  {
    text << std::fixed << std::setprecision(0);
  }
  else
  {
    text << std::setprecision(3);
  }
  text << value << " GB";
  return text.str();
}

} // namespace

void setProcessesSharingMemory(int processes)
{
  processesSharingMemory = std::max(1, processes);
}

void requireMemory(double bytes, const std::string& what, const std::string& advice)
{
  const auto available = static_cast<double>(availableMemory());
  if (bytes < available)
  {
    return;
  }
  TextStream message;
  message << what << " needs " << gigabytes(bytes) << " of memory, and " << gigabytes(available) << " are available: " << advice;
  throw OutOfMemory(message.str());
}

} // namespace cactus
