// SPDX-License-Identifier: BSD-3-Clause
#include "io/RunningPrograms.h"

#include <fstream>
#include <system_error>
#include <unistd.h>

namespace cactus
{

namespace fs = std::filesystem;

std::string programIn(const fs::path& folder)
{
  const std::string within = folder.string() + "/";
  const std::string own = std::to_string(::getpid());
  std::error_code error;
  for (fs::directory_iterator process("/proc", error), end; !error && process != end; process.increment(error))
  {
    const std::string id = process->path().filename().string();
    if (id.find_first_not_of("0123456789") != std::string::npos || id == own)
    {
      continue;
    }
    std::error_code unknown; // of another user, or ended meanwhile
    const fs::path current = fs::read_symlink(process->path() / "cwd", unknown);
    if (!unknown && (current.string() + "/").compare(0, within.size(), within) == 0)
    {
      std::ifstream file(process->path() / "comm");
      std::string name;
      std::getline(file, name);
      return name + " (process " + id + ")";
    }
  }
  return "";
}

} // namespace cactus
