// SPDX-License-Identifier: BSD-3-Clause
#include "io/FileCollection.h"

#include "base/Error.h"
#include "base/Numbers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <zip.h>

namespace cactus
{

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t chunk = std::size_t(1) << 20;

/// An error object of libzip that is freed.
class ZipError
{
public:
  ZipError() { zip_error_init(&this->Error); }
  ZipError(const ZipError&) = delete;
  ZipError& operator=(const ZipError&) = delete;
  ~ZipError() { zip_error_fini(&this->Error); }

  zip_error_t* get() { return &this->Error; }
  std::string text() { return zip_error_strerror(&this->Error); }

private:
  zip_error_t Error{};
};

/// Opens an archive and takes ownership of the source, which may be null.
zip_t* openArchive(zip_source_t* source, const std::string& name, ZipError& error)
{
  zip_t* archive = source != nullptr ? zip_open_from_source(source, ZIP_RDONLY, error.get()) : nullptr;
  if (archive == nullptr)
  {
    zip_source_free(source);
    throw FileError("cannot read " + name + " as a zip archive: " + error.text());
  }
  return archive;
}

zip_t* openFile(const std::string& path)
{
  ZipError error;
  return openArchive(zip_source_file_create(path.c_str(), 0, -1, error.get()), path, error);
}

zip_t* openBytes(const std::string& bytes, const std::string& name)
{
  ZipError error;
  return openArchive(zip_source_buffer_create(bytes.data(), bytes.size(), 0, error.get()), name, error);
}

/// Reads until the end, or until more than `size`: read(to, count) returns the number of bytes, negative for an error.
template <typename Read>
bool readAll(std::uint64_t size, std::vector<char>& bytes, Read&& read)
{
  std::int64_t came = 1;
  while (came > 0 && bytes.size() <= size)
  {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min<std::uint64_t>(chunk, size - before + 1));
    came = read(bytes.data() + before, bytes.size() - before);
    bytes.resize(before + static_cast<std::size_t>(std::max<std::int64_t>(came, 0)));
  }
  return came == 0 && bytes.size() == size;
}

} // namespace

ZipArchive::ZipArchive(const std::string& path)
  : Name(path)
  , Archive(openFile(path), zip_discard)
{
}

ZipArchive::ZipArchive(const std::string& bytes, const std::string& name)
  : Name(name)
  , Archive(openBytes(bytes, name), zip_discard)
{
}

void ZipArchive::fail(const std::string& name, const std::string& why) const
{
  throw FileError("cannot read " + excerpt(name) + " in " + this->Name + ": " + why);
}

std::vector<std::string> ZipArchive::names() const
{
  std::vector<std::string> all;
  const zip_int64_t count = zip_get_num_entries(this->Archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i)
  {
    const char* name = zip_get_name(this->Archive.get(), static_cast<zip_uint64_t>(i), ZIP_FL_ENC_RAW);
    if (name != nullptr && *name != '\0' && std::string(name).back() != '/')
    {
      all.emplace_back(name);
    }
  }
  return all;
}

std::uint64_t ZipArchive::size(const std::string& name) const
{
  zip_stat_t found;
  zip_stat_init(&found);
  if (zip_stat(this->Archive.get(), name.c_str(), ZIP_FL_ENC_RAW, &found) != 0 || (found.valid & ZIP_STAT_SIZE) == 0)
  {
    this->fail(name, zip_strerror(this->Archive.get()));
  }
  return found.size;
}

std::vector<char> ZipArchive::read(const std::string& name) const
{
  const std::uint64_t size = this->size(name);
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
    zip_fopen(this->Archive.get(), name.c_str(), ZIP_FL_ENC_RAW), zip_fclose);
  if (!file)
  {
    this->fail(name, zip_strerror(this->Archive.get()));
  }
  std::vector<char> bytes;
  if (!readAll(size, bytes, [&](char* to, std::size_t count) { return zip_fread(file.get(), to, count); }))
  {
    const std::string why = zip_file_strerror(file.get());
    this->fail(name, "it is damaged, or not as long as the archive says (" + why + ")");
  }
  return bytes;
}

Folder::Folder(const std::string& path)
  : Path(path)
{
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    throw FileError("cannot read " + path + ": it is no folder");
  }
}

std::vector<std::string> Folder::names() const
{
  std::vector<std::string> all;
  try
  {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(this->Path))
    {
      if (entry.is_regular_file())
      {
        all.push_back(entry.path().lexically_relative(this->Path).generic_string());
      }
    }
  }
  catch (const fs::filesystem_error& error)
  {
    throw FileError("cannot read folder " + this->Path + ": " + error.code().message());
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::uint64_t Folder::size(const std::string& name) const
{
  std::error_code error;
  const std::uintmax_t size = fs::file_size(fs::path(this->Path) / name, error);
  if (error)
  {
    throw FileError("cannot read " + name + " in " + this->Path + ": " + error.message());
  }
  return size;
}

std::vector<char> Folder::read(const std::string& name) const
{
  std::ifstream file(fs::path(this->Path) / name, std::ios::binary);
  std::vector<char> bytes;
  const bool isWhole = file && readAll(this->size(name), bytes,
                                 [&](char* to, std::size_t count)
                                 {
                                   file.read(to, static_cast<std::streamsize>(count));
                                   return file.gcount();
                                 });
  if (!isWhole)
  {
    throw FileError("cannot read " + name + " in " + this->Path);
  }
  return bytes;
}

std::string zipText(const std::vector<std::pair<std::string, std::string>>& files)
{
  ZipError error;
  const auto failed = [&] { return FileError("cannot make a zip archive: " + error.text()); };
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, error.get());
  zip_t* archive = target != nullptr ? zip_open_from_source(target, ZIP_TRUNCATE, error.get()) : nullptr;
  if (archive == nullptr)
  {
    zip_source_free(target);
    throw failed();
  }
  // Closing the archive frees its target, too, unless that is kept.
  zip_source_keep(target);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(target, zip_source_free);
  std::unique_ptr<zip_t, void (*)(zip_t*)> open(archive, zip_discard);
  for (const auto& [name, bytes] : files)
  {
    zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t place = source != nullptr ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (place < 0)
    {
      zip_source_free(source);
      throw FileError("cannot add " + name + " to a zip archive: " + zip_strerror(archive));
    }
    // All files get the same time, so that the same files give the same archive.
    zip_file_set_dostime(archive, static_cast<zip_uint64_t>(place), 0, (1 << 5) | 1, 0);
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(place), ZIP_CM_STORE, 0);
  }
  if (zip_close(archive) != 0)
  {
    throw FileError(std::string("cannot make a zip archive: ") + zip_strerror(archive));
  }
  static_cast<void>(open.release()); // closed above
  std::string text;
  zip_stat_t found;
  zip_stat_init(&found);
  if (zip_source_stat(target, &found) != 0 || zip_source_open(target) != 0)
  {
    throw failed();
  }
  text.resize(found.size);
  const zip_int64_t came = zip_source_read(target, text.data(), text.size());
  zip_source_close(target);
  if (came != static_cast<zip_int64_t>(text.size()))
  {
    throw failed();
  }
  return text;
}

} // namespace cactus
