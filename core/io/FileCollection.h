// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace cactus
{

/// What is in a folder or an archive: names, relative and with slashes, of files that can be read.
class FileCollection
{
public:
  FileCollection() = default;
  virtual ~FileCollection() = default;
  FileCollection(const FileCollection&) = delete;
  FileCollection& operator=(const FileCollection&) = delete;

  virtual std::vector<std::string> names() const = 0;
  /// Bytes, as the collection says.
  virtual std::uint64_t size(const std::string& name) const = 0;
  /// A whole file; no more is kept than comes. Throws FileError where it cannot be read or is not of size().
  virtual std::vector<char> read(const std::string& name) const = 0;
};

/// A zip archive, packed or not (libzip). Throws FileError for what is none.
class ZipArchive : public FileCollection
{
public:
  explicit ZipArchive(const std::string& path);
  /// The bytes of an archive, which have to outlive this object; `name` is what messages call it.
  ZipArchive(const std::string& bytes, const std::string& name);

  std::vector<std::string> names() const override;
  std::uint64_t size(const std::string& name) const override;
  std::vector<char> read(const std::string& name) const override;

private:
  [[noreturn]] void fail(const std::string& name, const std::string& why) const;

  std::string Name;
  std::unique_ptr<struct zip, void (*)(struct zip*)> Archive;
};

/// A folder, with the folders in it as deep as they go. Throws FileError where there is none.
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

/// The bytes of a zip archive of these files, in their order and not packed, so that readers can map them into memory. Throws
/// FileError.
std::string zipText(const std::vector<std::pair<std::string, std::string>>& files);

} // namespace cactus
