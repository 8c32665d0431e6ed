// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a .trk tractogram: consistent streamlines of finite points, or one error of ours.
#include "io/TrkFile.h"

#include "Fuzzing.h"
#include "TractogramPromises.h"

#include <sstream>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  const std::string one("\0\0\x80\x3f", 4);
  std::string header(1000, '\0');
  header.replace(0, 5, "TRACK");
  header.replace(6, 6, std::string("\2\0\3\0\4\0", 6));
  header.replace(12, 12, one + one + one);
  header.replace(992, 8, std::string("\1\0\0\0\xe8\3\0\0", 8));
  const std::string streamline = std::string("\2\0\0\0", 4) + one + one + one + one + one + one;
  std::string second = header;
  second[992] = '\2';
  for (const std::size_t diagonal : { 440, 460, 480, 500 })
  {
    second.replace(diagonal, 4, one);
  }
  second.replace(948, 3, "LAS");
  second[36] = '\1';
  second[238] = '\1';
  second.replace(38, 2, "FA");
  writeSeeds(*argc, *argv, { header + streamline, second + streamline + one + one + one, header });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  keepsPromises("fuzz.trk", size, [&] { return cactus::readTrk(stream, "fuzz.trk"); });
  return 0;
}
