// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sharing.h"
#include "io/Journal.h"
#include "io/SurfaceFile.h"
#include "mesh/SurfaceStore.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// Surfaces on the disk while they are made, and the journal of all that is known of them:
///
///   FOLDER/journal            the record of each fibre, the growth, which is solved for first, and the results of keeping
///                             surfaces apart and of judging them, by name; each other process of a team has a file of its own,
///                             FOLDER/journal-00001 and so on (see Journal)
///   FOLDER/outer/00000/…      outer surfaces as contoured, a file each, at most 1,000 in a folder
///   FOLDER/spaced/…, inner/…  surfaces that were moved to keep them apart, and inner surfaces
///   FOLDER/stop.partial-…     while one process of a team tells the others to end (see Sharing)
///
/// Files appear whole or not at all, and a surface in a journal is in its file. Reading one that was never put is an error. A
/// file that is missing before surfaces are kept apart counts as a fibre without a record. Each request holds one surface in
/// memory, or a part of it (see SurfaceFile.h). Any number of processes continues the work that any others have left.
class SurfaceSpool
{
public:
  static constexpr char stopName[] = "stop";

  /// Makes the folder for `count` fibres, or continues in one of the same `identity`. Throws InvalidInput for a folder of another
  /// identity, and FileError. Collective: processes that share it make theirs together.
  SurfaceSpool(const std::string& folder, const std::string& identity, std::size_t count, const Sharing& sharing = Sharing());

  SurfaceStore& outer() { return this->Outer; }
  SurfaceStore& inner() { return this->Inner; }
  /// Returns the cache of all that is known of the fibres.
  Recollection findings() { return Recollection(*this->Log); }
  /// Returns how many fibres' outer surfaces existed at the beginning.
  std::size_t found() const { return this->Found; }
  /// Tells whether an earlier run had left findings.
  bool foundSome() const { return this->Log->foundSome(); }
  /// Tells whether all journals are empty. Call it only while no other process runs.
  bool isEmpty() const { return !this->Log->holds(""); }
  /// Tells whether a journal has a record of a fibre. Call it only while no other process runs.
  bool holdsSurfaces() const;

  /// Removes all its own files, including half-written ones of a killed process; also the folder, if nothing else is in it.
  void remove();

private:
  /// The surfaces of one kind.
  class Files : public SurfaceStore
  {
  public:
    Files(std::filesystem::path folder, std::string kind, std::uint64_t fingerprint, std::size_t count);

    std::size_t size() const override { return this->IsSpaced.size(); }
    bool has(std::size_t index) const;
    std::shared_ptr<const TriangleMesh> get(std::size_t index) const override;
    SurfacePart part(std::size_t index, double lower, double upper) const override;
    void put(std::size_t index, TriangleMesh surface) override;
    void putElsewhere(std::size_t index, const std::string&) override { this->IsSpaced[index] = this->IsMoving ? 1 : 0; }
    void beginMoving() override { this->IsMoving = true; }
    void endMoving(const std::vector<std::size_t>& moved) override;

  private:
    std::string pathOf(std::size_t index) const;
    SurfaceFileOwner ownerOf(std::size_t index) const { return { this->Fingerprint, index }; }
    template <typename Read>
    auto from(std::size_t index, Read&& read) const;

    std::filesystem::path Folder;
    std::string Kind;
    std::uint64_t Fingerprint;
    std::vector<char> IsSpaced; ///< whether it was put while IsMoving
    bool IsMoving = false;
    bool IsFinal = false; ///< surfaces are kept apart, so that a single one is not made again
  };

  std::filesystem::path Folder;
  std::size_t Count;
  std::size_t Found = 0;
  std::optional<Journal> Log;
  Files Outer;
  Files Inner;
};

} // namespace cactus
