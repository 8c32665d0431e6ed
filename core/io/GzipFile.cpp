// SPDX-License-Identifier: BSD-3-Clause
#include "io/GzipFile.h"

#include "base/Error.h"
#include "base/Memory.h"

#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

namespace cactus
{

GzipReader::GzipReader(std::string path)
  : Path(std::move(path))
  , File(gzopen(this->Path.c_str(), "rb"), gzclose)
{
  if (!this->File)
  {
    throw FileError("cannot open " + this->Path);
  }
}

std::size_t GzipReader::read(char* to, std::size_t count)
{
  constexpr std::size_t most = std::size_t(1) << 30; // at once
  std::size_t done = 0;
  while (done < count)
  {
    const int came = gzread(this->File.get(), to + done, static_cast<unsigned>(std::min(count - done, most)));
    int state = Z_OK;
    const char* message = gzerror(this->File.get(), &state);
    if (came < 0 || (state != Z_OK && state != Z_STREAM_END))
    {
      throw FileError("cannot unpack " + this->Path + ": it is truncated or damaged (" + message + ")");
    }
    if (came == 0)
    {
      break;
    }
    done += static_cast<std::size_t>(came);
  }
  return done;
}

bool GzipReader::skip(std::uint64_t count)
{
  std::vector<char> bytes(std::min<std::uint64_t>(count, std::uint64_t(1) << 20));
  while (count > 0)
  {
    const std::size_t came = this->read(bytes.data(), std::min<std::uint64_t>(count, bytes.size()));
    if (came == 0)
    {
      return false;
    }
    count -= came;
  }
  return true;
}

bool isGzip(const std::string& path)
{
  char first[2] = {};
  std::ifstream(path, std::ios::binary).read(first, 2);
  return first[0] == '\x1f' && first[1] == '\x8b';
}

std::string beginningOfFile(const std::string& path, std::size_t count)
{
  std::string bytes;
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) // a pipe would wait for its writer
  {
    const std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file(gzopen(path.c_str(), "rb"), gzclose);
    if (file)
    {
      bytes.resize(count);
      const int came = gzread(file.get(), bytes.data(), static_cast<unsigned>(count));
      bytes.resize(came > 0 ? static_cast<std::size_t>(came) : 0);
    }
  }
  return bytes;
}

void unpackGzip(const std::string& path, std::ostream& to, const Context& context)
{
  GzipReader file(path);
  std::vector<char> bytes(std::size_t(1) << 20);
  double size = 0.0;
  double checked = 0.0;
  while (const std::size_t came = file.read(bytes.data(), bytes.size()))
  {
    size += static_cast<double>(came);
    if (size > checked)
    {
      requireMemory(3.0 * size, path, "choose streamlines from it first"); // a stream in memory may double, and is then copied
      checked = 2.0 * size;
    }
    to.write(bytes.data(), static_cast<std::streamsize>(came));
    context.checkpoint();
  }
}

} // namespace cactus
