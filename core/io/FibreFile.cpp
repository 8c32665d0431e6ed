// SPDX-License-Identifier: BSD-3-Clause
#include "io/FibreFile.h"

#include "base/Error.h"
#include "base/PosixFile.h"
#include "io/EllipsoidFile.h"
#include "io/SphereTable.h"
#include "io/StrandFile.h"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace cactus
{

namespace
{

/// The first character that is neither a blank nor part of a byte order mark; the stream is then back at its beginning.
int firstCharacter(std::istream& stream)
{
  constexpr int none = std::char_traits<char>::eof();
  int c = stream.get();
  while (c != none && (std::isspace(c) != 0 || c >= 0x80))
  {
    c = stream.get();
  }
  stream.clear();
  stream.seekg(0);
  return c;
}

} // namespace

FibresOfFile readFibreFile(const std::string& path)
{
  requireNoPipe("strand file " + path, path);
  std::ifstream file(path);
  if (!file)
  {
    throw FileError("cannot open strand file " + path + ": " + std::strerror(errno));
  }
  const int first = firstCharacter(file);
  if (first == '{')
  {
    return readEllipsoidFile(file, path);
  }
  if (first != std::char_traits<char>::eof() && std::isalpha(first) != 0)
  {
    return readSphereTable(file, path, sideBesideTable(path));
  }
  return { readStrandFile(file, path), {} };
}

} // namespace cactus
