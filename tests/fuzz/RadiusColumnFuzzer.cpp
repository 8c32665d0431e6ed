// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a table with named columns: finite numbers, at least one and no more than lines, or one error of ours.
#include "bundle/RadiusColumn.h"

#include "Fuzzing.h"
#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  writeSeeds(*argc, *argv,
    { "r\n0.4\n0.5\n", "x,\"r\",y\r\n1,0.5,\"a,b\"\r\n\r\n2, 1e-3 ,c", "\xef\xbb\xbfr;s\n0.5;\n", "s\tr\n1\t2\n3\n", "", "r",
      "r\nnan\n", "r,r\n1e400,2\n" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream stream(text);
  try
  {
    const std::vector<double> radii = cactus::readRadiusColumn(stream, "fuzz.csv", "r");
    promise(!radii.empty() && std::ptrdiff_t(radii.size()) <= std::count(text.begin(), text.end(), '\n') + 1,
      "a table has a number a line, and at least one");
    promise(std::all_of(radii.begin(), radii.end(), [](double radius) { return std::isfinite(radius); }), "radii are finite");
  }
  catch (const cactus::FileError&)
  {
    return 0;
  }
  return 0;
}
