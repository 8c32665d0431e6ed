// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a .tck tractogram: consistent streamlines of finite points, or one error of ours.
#include "io/TckFile.h"

#include "Fuzzing.h"
#include "TractogramPromises.h"

#include <sstream>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  const std::string point("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12);
  const std::string nan("\0\0\xc0\x7f\0\0\xc0\x7f\0\0\xc0\x7f", 12);
  const std::string end("\0\0\x80\x7f\0\0\x80\x7f\0\0\x80\x7f", 12);
  const std::string body = point + point + nan + point + nan + end;
  writeSeeds(*argc, *argv,
    { "mrtrix tracks\ndatatype: Float32LE\ncount: 2\nfile: . 58\nEND\n" + body,
      "mrtrix tracks\ndatatype: Float32BE\nEND\n" + body, "mrtrix tracks\r\ndatatype: Float64LE\r\nEND\r\n" + body + body,
      "mrtrix tracks\nEND\n" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  keepsPromises("fuzz.tck", size, [&] { return cactus::readTck(stream, "fuzz.tck"); });
  return 0;
}
