// SPDX-License-Identifier: BSD-3-Clause
// Support for all fuzzers: seeds, and reporting broken promises.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

/// The functions that libFuzzer calls: once at the start, and for each input.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Ends the program, so that the input is kept, unless the promise holds.
inline void promise(bool kept, const char* what)
{
  if (!kept)
  {
    std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
  }
}

/// Writes seeds into the first folder on the command line, in which a fuzzer keeps its findings.
inline void writeSeeds(int argc, char** argv, const std::vector<std::string>& seeds)
{
  for (int i = 1; i < argc; ++i)
  {
    if (argv[i][0] != '-')
    {
      for (std::size_t s = 0; s < seeds.size(); ++s)
      {
        std::ofstream(std::string(argv[i]) + "/seed-" + std::to_string(s), std::ios::binary)
          .write(seeds[s].data(), static_cast<std::streamsize>(seeds[s].size()));
      }
      return;
    }
  }
}

/// Returns a folder of this process alone, which is gone when the program ends: writing a file lists its folder, and others may
/// hold thousands of files.
inline const std::string& scratchFolder()
{
  static const std::string name = []
  {
    std::error_code error;
    std::filesystem::path made =
      std::filesystem::is_directory("/dev/shm", error) ? "/dev/shm" : std::filesystem::temp_directory_path();
    made /= "cactus-fuzz-" + std::to_string(::getpid());
    std::filesystem::create_directory(made);
    return made.string();
  }();
  static const int willBeRemoved = std::atexit([] { std::filesystem::remove_all(scratchFolder()); });
  static_cast<void>(willBeRemoved);
  return name;
}
