// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a strand file: fibres that use every line, or one error of ours.
#include "io/StrandFile.h"

#include "Fuzzing.h"
#include "base/Error.h"

#include <sstream>

namespace
{

std::size_t linesWithText(const std::string& text)
{
  std::size_t lines = 0;
  bool blank = true;
  std::size_t i = text.compare(0, 3, "\xef\xbb\xbf") == 0 ? 3 : 0;
  for (; i < text.size(); ++i)
  {
    const char c = text[i];
    if (c == '\n' || c == '\r')
    {
      blank = true;
    }
    else if (blank && c != ' ' && c != '\t' && c != '\v' && c != '\f')
    {
      blank = false;
      ++lines;
    }
  }
  return lines;
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  writeSeeds(*argc, *argv,
    { "30\n2\n2\n0 0 0 1\n0 0 1.5 1\n3\n1 0 0 .5\n1 0 1 0.5\n1 1e-3 2 +0.5\n",
      "\xef\xbb\xbf+30.\r\n1.0\r\n2\r\n0x1p0\t0 0\t1\r\n0 0 1E0 1\r\n\r\n", "10\r1\r2\r-0 0 1e-400 1\r4.9e-324 nan inf 1e400\r",
      "5\n1000000000\n1\n0 0 0 0\n", "1e5\n1\n2\n100000 0 0 1000\n0 0 0 0.001\n\f\v\n1 2 3\n" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream stream(text);
  try
  {
    const cactus::Fibres fibres = cactus::readStrandFile(stream, "fuzz.strands");
    cactus::validate(fibres);
    promise(linesWithText(text) == 2 + fibres.size() + fibres.points.size(), "every line of a strand file is used");
  }
  catch (const cactus::Error& error)
  {
    promise(std::string(error.what()).find("fuzz.strands") != std::string::npos, "a message names the file");
  }
  return 0;
}
