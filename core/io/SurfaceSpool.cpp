// SPDX-License-Identifier: BSD-3-Clause
#include "io/SurfaceSpool.h"

#include "base/Error.h"
#include "base/PartialName.h"
#include "base/Sha256.h"
#include "io/NumberedName.h"
#include "surface/SurfaceNumbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

namespace cactus
{

namespace
{

// First bytes of a journal's records.
constexpr char outerMade = 'o';
constexpr char spaced = 's';
constexpr char spacingDone = 'S';
constexpr char innerMade = 'i';

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
  : isSpaced(count, 0)
  , Folder(std::move(folder))
  , Kind(std::move(kind))
  , Fingerprint(fingerprint)
{
}

std::string SurfaceSpool::Files::pathOf(std::size_t index) const
{
  const std::string kind = this->isSpaced[index] != 0 ? "spaced" : this->Kind;
  const std::size_t count = this->isSpaced.size();
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
                    (this->isFinal ? "the folder " + this->Folder.string() + " and make all of it again"
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
  this->isSpaced[index] = this->isSpacing ? 1 : 0;
  const std::string path = this->pathOf(index);
  makeFolders(std::filesystem::path(path).parent_path());
  writeSurface(path, this->ownerOf(index), surface);
}

SurfaceSpool::SurfaceSpool(const std::string& folder, const std::string& identity, std::size_t count, const Sharing& sharing)
  : Folder(folder)
  , Count(count)
  , IsFirst(sharing.isFirst())
  , Outer(folder, "outer", fingerprintOf(identity), count)
  , Inner(folder, "inner", fingerprintOf(identity), count)
  , OuterNotes(count)
  , SpacedNotes(count)
  , InnerNotes(count)
{
  if (this->IsFirst)
  {
    makeFolders(this->Folder);
  }
  this->Log.emplace(this->Folder, "journal", identity, sharing);
  this->Findings.emplace(this->Folder, identity, sharing);
  this->read(this->Log->takeRecords());
  this->Outer.isFinal = this->Inner.isFinal = this->IsSpacingDone;
  if (!this->IsSpacingDone)
  {
    // Moved surfaces are moved again, from their contours.
    std::fill(this->Outer.isSpaced.begin(), this->Outer.isSpaced.end(), 0);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (this->IsSpacingDone && this->SpacedNotes[i].empty())
    {
      throw FileError("a part of the journal in " + this->Folder.string() + " is missing: remove this folder");
    }
    const bool isFound = this->IsSpacingDone ? !this->InnerNotes[i].empty() || pairFrom(this->SpacedNotes[i].back()).isInnerMade
                                             : !this->OuterNotes[i].empty();
    this->Found += isFound ? 1 : 0;
  }
}

void SurfaceSpool::read(const std::vector<std::string>& records)
{
  for (const std::string& record : records)
  {
    std::uint64_t index = 0;
    constexpr std::size_t head = 2 + sizeof(index);
    if (record.size() < head)
    {
      throw FileError("the journal in " + this->Folder.string() + " is damaged: remove this folder");
    }
    std::memcpy(&index, record.data() + 2, sizeof(index));
    this->IsSpacingDone = this->IsSpacingDone || record[0] == spacingDone;
    if (record[0] == spacingDone || index >= this->Count)
    {
      continue;
    }
    auto& notes = record[0] == outerMade ? this->OuterNotes : record[0] == spaced ? this->SpacedNotes : this->InnerNotes;
    notes[index].push_back(record.substr(head));
    if (record[0] == spaced)
    {
      this->Outer.isSpaced[index] = record[1];
    }
  }
}

void SurfaceSpool::note(char step, std::size_t index, const FibreSurfacePair& pair, bool isMoved)
{
  const std::uint64_t number = index;
  std::string record{ step, static_cast<char>(isMoved ? 1 : 0) };
  record.append(reinterpret_cast<const char*>(&number), sizeof(number));
  this->Log->add(record + bytesOf(pair));
}

bool SurfaceSpool::recallOuter(std::size_t index, FibreSurfacePair& pair) const
{
  if (this->OuterNotes[index].empty())
  {
    return false;
  }
  FibreSurfacePair found = pairFrom(this->OuterNotes[index].back());
  if (!this->Outer.has(index) || (found.isInnerMade && !this->Inner.has(index)))
  {
    return false; // a damaged file was removed
  }
  pair = std::move(found);
  return true;
}

void SurfaceSpool::noteOuter(std::size_t index, const FibreSurfacePair& pair)
{
  this->note(outerMade, index, pair, false);
}

bool SurfaceSpool::recallSpaced(std::vector<FibreSurfacePair>& pairs) const
{
  for (std::size_t i = 0; this->IsSpacingDone && i < pairs.size(); ++i)
  {
    pairs[i] = pairFrom(this->SpacedNotes[i].back());
  }
  return this->IsSpacingDone;
}

void SurfaceSpool::noteSpaced(const std::vector<FibreSurfacePair>& pairs)
{
  this->Outer.isFinal = this->Inner.isFinal = true;
  if (!this->IsFirst)
  {
    return; // each process knows all of them
  }
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    this->note(spaced, i, pairs[i], this->Outer.isSpaced[i] != 0);
  }
  this->note(spacingDone, 0, {}, false);
}

bool SurfaceSpool::recallInner(std::size_t index, double gRatio, FibreSurfacePair& pair) const
{
  // The latest first, since its surface is the stored one.
  const auto& notes = this->InnerNotes[index];
  for (auto note = notes.rbegin(); note != notes.rend(); ++note)
  {
    FibreSurfacePair found = pairFrom(*note);
    if (std::isnan(gRatio) || found.targetGRatio == gRatio)
    {
      pair = std::move(found);
      return true;
    }
  }
  return false;
}

void SurfaceSpool::noteInner(std::size_t index, const FibreSurfacePair& pair)
{
  this->note(innerMade, index, pair, false);
}

void SurfaceSpool::remove()
{
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
  this->Findings->remove();
  this->Log->remove();
  std::filesystem::remove(this->Folder, ignored);
}

} // namespace cactus
