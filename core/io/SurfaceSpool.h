// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Sharing.h"
#include "io/FindingsFile.h"
#include "io/SurfaceFile.h"
#include "io/TeamLog.h"
#include "mesh/SurfaceStore.h"
#include "surface/SurfaceJournal.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cactus
{

/// Surfaces on the disk while they are made, and the journal of their progress:
///
///   FOLDER/journal            the record of each fibre; FOLDER/findings has the growth, which is solved for first, and the
///                             results of keeping surfaces apart and of judging them; the other processes of a team have
///                             FOLDER/journal-00001 and so on (see TeamLog)
///   FOLDER/outer/00000/…      outer surfaces as contoured, a file each, at most 1,000 in a folder
///   FOLDER/spaced/…, inner/…  surfaces that were moved to keep them apart, and inner surfaces
///   FOLDER/stop.partial-…     while one process of a team tells the others to end (see Sharing)
///
/// Files appear whole or not at all, and a surface in a journal is in its file. Reading one that was never put is an error. A
/// file that is missing before surfaces are kept apart counts as a fibre without a record. Each request holds one surface in
/// memory, or a part of it (see SurfaceFile.h). Any number of processes continues the work that any others have left.
class SurfaceSpool : public SurfaceJournal
{
public:
  static constexpr char stopName[] = "stop";

  /// Makes the folder for `count` fibres, or continues in one of the same `identity`. Throws InvalidInput for a folder of another
  /// identity, and FileError. Collective: processes that share it make theirs together.
  SurfaceSpool(const std::string& folder, const std::string& identity, std::size_t count, const Sharing& sharing = Sharing());

  SurfaceStore& outer() { return this->Outer; }
  SurfaceStore& inner() { return this->Inner; }
  /// Returns how many fibres' surfaces existed at the beginning: outer or, if these are spaced, inner ones.
  std::size_t found() const { return this->Found; }
  /// Tells whether an earlier run had left findings.
  bool foundFindings() const { return this->Findings->foundSome(); }
  /// Tells whether all journals and findings are empty. Call it only while no other process runs.
  bool isEmpty() const { return !this->holdsSurfaces() && this->Findings->isEmpty(); }
  /// Tells whether a journal has a record of a fibre. Call it only while no other process runs.
  bool holdsSurfaces() const { return !this->Log->isEmpty(); }

  bool recallOuter(std::size_t index, FibreSurfacePair& pair) const override;
  void noteOuter(std::size_t index, const FibreSurfacePair& pair) override;
  void beginSpacing() override { this->Outer.isSpacing = true; }
  bool recallSpaced(std::vector<FibreSurfacePair>& pairs) const override;
  void noteSpaced(const std::vector<FibreSurfacePair>& pairs) override;
  bool recallInner(std::size_t index, double gRatio, FibreSurfacePair& pair) const override;
  void noteInner(std::size_t index, const FibreSurfacePair& pair) override;
  Recollection findings() override { return Recollection(*this->Findings); }

  /// Removes all its own files, including half-written ones of a killed process; also the folder, if nothing else is in it.
  void remove();

private:
  /// The surfaces of one kind.
  class Files : public SurfaceStore
  {
  public:
    Files(std::filesystem::path folder, std::string kind, std::uint64_t fingerprint, std::size_t count);

    std::size_t size() const override { return this->isSpaced.size(); }
    bool has(std::size_t index) const;
    std::shared_ptr<const TriangleMesh> get(std::size_t index) const override;
    SurfacePart part(std::size_t index, double lower, double upper) const override;
    void put(std::size_t index, TriangleMesh surface) override;
    void putElsewhere(std::size_t index, const std::string&) override { this->isSpaced[index] = this->isSpacing ? 1 : 0; }

    bool isSpacing = false;
    bool isFinal = false;       ///< surfaces are kept apart, so that a single one is not made again
    std::vector<char> isSpaced; ///< whether it was put while isSpacing

  private:
    std::string pathOf(std::size_t index) const;
    SurfaceFileOwner ownerOf(std::size_t index) const { return { this->Fingerprint, index }; }
    template <typename Read>
    auto from(std::size_t index, Read&& read) const;

    std::filesystem::path Folder;
    std::string Kind;
    std::uint64_t Fingerprint;
  };

  void read(const std::vector<std::string>& records);
  void note(char step, std::size_t index, const FibreSurfacePair& pair, bool isMoved);

  std::filesystem::path Folder;
  std::size_t Count;
  std::size_t Found = 0;
  bool IsFirst;
  std::optional<TeamLog> Log;
  std::optional<FindingsFile> Findings;
  Files Outer;
  Files Inner;
  bool IsSpacingDone = false;
  // Records of each fibre, in the order of the journal.
  std::vector<std::vector<std::string>> OuterNotes;
  std::vector<std::vector<std::string>> SpacedNotes;
  std::vector<std::vector<std::string>> InnerNotes;
};

} // namespace cactus
