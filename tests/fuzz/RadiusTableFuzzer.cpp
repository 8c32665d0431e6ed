// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a table of radii, as text and as a file: the same numbers from both, or one error of ours from each.
#include "bundle/RadiusDistribution.h"

#include "Fuzzing.h"
#include "base/Error.h"

#include <cmath>
#include <sstream>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  writeSeeds(*argc, *argv,
    { "0.4 0.5 0.7", "0.4,0.5;.7\r\n1e-3\t+2. 0x1p-3",
      "\xef\xbb\xbf"
      "0.5\n",
      "", ",;", "1e400 1e-400 nan inf 1.5mm" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<double> typed;
  bool good = true;
  try
  {
    typed = cactus::parseRadiusTable(text);
  }
  catch (const cactus::InvalidInput&)
  {
    good = false;
  }
  try
  {
    std::istringstream stream(text);
    const std::vector<double> read = cactus::readRadiusTable(stream, "fuzz.txt");
    const bool marked = text.compare(0, 3, "\xef\xbb\xbf") == 0;
    promise(marked || (good && read == typed), "a file holds the numbers of its text");
    for (const double radius : read)
    {
      promise(std::isfinite(radius), "radii are finite");
    }
  }
  catch (const cactus::FileError&)
  {
    promise(!good || typed.empty(), "a file with the text of a table is read");
  }
  return 0;
}
