// SPDX-License-Identifier: BSD-3-Clause
#include "io/GzipFile.h"

#include "base/Error.h"
#include "base/Memory.h"

#include <zlib.h>

#include <filesystem>
#include <memory>
#include <type_traits>
#include <vector>

namespace cactus
{

namespace
{

using GzipHandle = std::unique_ptr<std::remove_pointer_t<gzFile>, int (*)(gzFile)>;

GzipHandle openGzip(const std::string& path)
{
  return { gzopen(path.c_str(), "rb"), gzclose };
}

} // namespace

std::string beginningOfFile(const std::string& path, std::size_t count)
{
  std::string bytes;
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) // a pipe would wait for its writer
  {
    if (const GzipHandle file = openGzip(path))
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
  const GzipHandle file = openGzip(path);
  if (!file)
  {
    throw FileError("cannot open " + path);
  }
  std::vector<char> bytes(std::size_t(1) << 20);
  double size = 0.0;
  double checked = 0.0;
  while (true)
  {
    const int came = gzread(file.get(), bytes.data(), static_cast<unsigned>(bytes.size()));
    int state = Z_OK;
    const char* message = gzerror(file.get(), &state);
    if (came < 0 || (state != Z_OK && state != Z_STREAM_END))
    {
      throw FileError("cannot unpack " + path + ": it is truncated or damaged (" + message + ")");
    }
    if (came == 0)
    {
      return;
    }
    size += came;
    if (size > checked)
    {
      requireMemory(3.0 * size, path, "choose streamlines from it first"); // a stream in memory may double, and is then copied
      checked = 2.0 * size;
    }
    to.write(bytes.data(), came);
    context.checkpoint();
  }
}

} // namespace cactus
