// SPDX-License-Identifier: BSD-3-Clause
#include "io/SurfaceSpool.h"

#include "base/Bytes.h"
#include "base/Error.h"
#include "base/PartialName.h"
#include "base/Sha256.h"
#include "io/NumberedName.h"
#include "surface/SurfaceMaker.h"

#include <algorithm>
#include <set>
#include <utility>

namespace cactus
{

namespace
{

constexpr const char* kinds[] = { "outer", "spaced", "inner" };

std::uint64_t fingerprintOf(const std::string& identity)
{
  return std::stoull(sha256(identity).substr(0, 16), nullptr, 16);
}

void makeFolders(const std::filesystem::path& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
  {
    throw FileError("cannot make the folder " + folder.string() + ": " + error.message());
  }
}

/// Returns the beginning of the names of records of fibres whose outer surfaces are made.
std::string recordsOfOuter()
{
  return std::string(SurfaceMaker::outerMade) + '/';
}

/// The file of one of `count` surfaces.
std::string surfaceName(std::size_t index, std::size_t count)
{
  return numbered(index, count) + ".surface";
}

/// The folder that holds one of `count` surfaces.
std::string folderName(std::size_t index, std::size_t count)
{
  return numbered(index / filesInAFolder, count / filesInAFolder);
}

/// Removes the files of some names, and partial files of these names.
void removeFrom(const std::filesystem::path& folder, const std::set<std::string>& names)
{
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored))
  {
    if (names.count(wholeName(entry->path().filename().string())) > 0)
    {
      found.push_back(entry->path());
    }
  }
  for (const std::filesystem::path& file : found)
  {
    std::filesystem::remove(file, ignored);
  }
}

} // namespace

SurfaceSpool::Files::Files(std::filesystem::path folder, std::string kind, std::uint64_t fingerprint, std::size_t count)
  : Folder(std::move(folder))
  , Kind(std::move(kind))
  , Fingerprint(fingerprint)
  , IsSpaced(count, 0)
{
}

std::string SurfaceSpool::Files::pathOf(std::size_t index) const
{
  const std::string kind = this->IsSpaced[index] != 0 ? "spaced" : this->Kind;
  const std::size_t count = this->IsSpaced.size();
  return (this->Folder / kind / folderName(index, count) / surfaceName(index, count)).string();
}

/// Returns the result of `read(path, owner)` for a surface's file. Throws FileError, which says what to do.
template <typename Read>
auto SurfaceSpool::Files::from(std::size_t index, Read&& read) const
{
  const std::string path = this->pathOf(index);
  try
  {
    return read(path, this->ownerOf(index));
  }
  catch (const Error&)
  {
    throw FileError("the surface " + path + " is damaged, or cannot be read: remove " +
                    (this->IsFinal ? "the folder " + this->Folder.string() + " and make all of it again"
                                   : "it and run again, to make the surfaces of this fibre again"));
  }
}

bool SurfaceSpool::Files::has(std::size_t index) const
{
  std::error_code ignored; // an error is reported when the surface is put
  return std::filesystem::exists(this->pathOf(index), ignored);
}

std::shared_ptr<const TriangleMesh> SurfaceSpool::Files::get(std::size_t index) const
{
  return std::make_shared<const TriangleMesh>(this->from(index, readSurface));
}

SurfacePart SurfaceSpool::Files::part(std::size_t index, double lower, double upper) const
{
  return this->from(index, [lower, upper](const std::string& path, const SurfaceFileOwner& owner)
    { return readSurfacePart(path, owner, lower, upper); });
}

void SurfaceSpool::Files::put(std::size_t index, TriangleMesh surface)
{
  this->IsSpaced[index] = this->IsMoving ? 1 : 0;
  const std::string path = this->pathOf(index);
  makeFolders(std::filesystem::path(path).parent_path());
  writeSurface(path, this->ownerOf(index), surface);
}

void SurfaceSpool::Files::endMoving(const std::vector<std::size_t>& moved)
{
  this->IsMoving = false;
  this->IsFinal = true;
  for (const std::size_t index : moved)
  {
    this->IsSpaced[index] = 1;
  }
}

SurfaceSpool::SurfaceSpool(const std::string& folder, const std::string& identity, std::size_t count, const Sharing& sharing)
  : Folder(folder)
  , Count(count)
  , Outer(folder, "outer", fingerprintOf(identity), count)
  , Inner(folder, "inner", fingerprintOf(identity), count)
{
  if (sharing.isFirst())
  {
    makeFolders(this->Folder);
  }
  this->Log.emplace(this->Folder, identity, sharing);
  const bool isFinal = this->Log->find(SurfaceMaker::keptApart) != nullptr;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string name = recordsOfOuter() + std::to_string(i);
    if (const std::string* known = this->Log->find(name))
    {
      FibreSurfacePair pair;
      getAll(*known, pair);
      const bool isThere = isFinal || (this->Outer.has(i) && (!pair.isInnerMade || this->Inner.has(i)));
      this->Found += isThere ? 1 : 0;
      if (!isThere) // a damaged file was removed
      {
        this->Log->take(name);
      }
    }
  }
}

bool SurfaceSpool::holdsSurfaces() const
{
  return this->Log->holds(recordsOfOuter());
}

void SurfaceSpool::remove()
{
  this->Log->clear();      // so that surfaces left by a kill from here on are made again
  std::error_code ignored; // later readers report leftovers
  for (const char* kind : kinds)
  {
    for (std::size_t first = 0; first < this->Count; first += filesInAFolder)
    {
      const std::filesystem::path folder = this->Folder / kind / folderName(first, this->Count);
      std::set<std::string> own;
      for (std::size_t i = first; i < std::min(this->Count, first + filesInAFolder); ++i)
      {
        own.insert(surfaceName(i, this->Count));
      }
      removeFrom(folder, own);
      std::filesystem::remove(folder, ignored);
    }
    std::filesystem::remove(this->Folder / kind, ignored);
  }
  removeFrom(this->Folder, { stopName });
  this->Log->remove();
  std::filesystem::remove(this->Folder, ignored);
}

} // namespace cactus
