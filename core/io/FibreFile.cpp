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
#include <filesystem>
#include <fstream>
#include <sstream>

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

/// Returns the beginning of a file without its byte order mark; empty if there is none to read.
std::string firstText(const std::string& path)
{
  constexpr std::size_t most = 1 << 16;
  std::error_code error;
  std::string text;
  if (std::filesystem::is_regular_file(path, error)) // a pipe would wait for its writer
  {
    std::ifstream file(path, std::ios::binary);
    text.resize(most);
    file.read(text.data(), most);
    text.resize(static_cast<std::size_t>(file.gcount()));
  }
  return text.compare(0, 3, "\xef\xbb\xbf") == 0 ? text.substr(3) : text;
}

} // namespace

bool isFibreFile(const std::string& path)
{
  const std::filesystem::path name(path);
  std::error_code error;
  if (name.extension() == ".strands" && !name.stem().has_extension() && std::filesystem::is_regular_file(name, error))
  {
    return true;
  }
  const std::string text = firstText(path);
  std::istringstream stream(text);
  const int first = firstCharacter(stream);
  if (first == '{')
  {
    return text.find("\"axons\"") != std::string::npos || text.find("\"voxelSize\"") != std::string::npos;
  }
  if (first != std::char_traits<char>::eof() && std::isalpha(first) != 0)
  {
    return isSphereTable(text.substr(0, text.find('\n')));
  }
  return beginsAsStrandFile(stream);
}

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
