// SPDX-License-Identifier: BSD-3-Clause
// Support for all fuzzers: seeds, and reporting broken promises.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
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
