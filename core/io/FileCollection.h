// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace cactus
{

/// The readable files in a folder or an archive, by their relative names with slashes.
class FileCollection
{
public:
  FileCollection() = default;
  virtual ~FileCollection() = default;
  FileCollection(const FileCollection&) = delete;
  FileCollection& operator=(const FileCollection&) = delete;

  virtual std::vector<std::string> names() const = 0;
  /// Returns the bytes of a file, as listed by the collection.
  virtual std::uint64_t size(const std::string& name) const = 0;
  /// Reads a whole file; memory grows only with the bytes read. Throws FileError if it cannot be read or its length differs from
  /// size().
  virtual std::vector<char> read(const std::string& name) const = 0;
};

/// A zip archive, compressed or not (libzip). Throws FileError if it is none.
class ZipArchive : public FileCollection
{
public:
  explicit ZipArchive(const std::string& path);
  /// Uses the bytes of an archive, which have to outlive this object; `name` is its name in messages.
  ZipArchive(const std::string& bytes, const std::string& name);

  std::vector<std::string> names() const override;
  std::uint64_t size(const std::string& name) const override;
  std::vector<char> read(const std::string& name) const override;

private:
  [[noreturn]] void fail(const std::string& name, const std::string& why) const;

  std::string Name;
  std::unique_ptr<struct zip, void (*)(struct zip*)> Archive;
};

/// A folder with all its subfolders. Throws FileError if it does not exist.
class Folder : public FileCollection
{
public:
  explicit Folder(const std::string& path);

  std::vector<std::string> names() const override;
  std::uint64_t size(const std::string& name) const override;
  std::vector<char> read(const std::string& name) const override;

private:
  std::string Path;
};

/// Returns the bytes of a zip archive of these files, in their order and not compressed, so that readers can map them into
/// memory. Throws FileError.
std::string zipText(const std::vector<std::pair<std::string, std::string>>& files);

} // namespace cactus
