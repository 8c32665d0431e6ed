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

/// Surfaces on the disk while they are made, and the journal of how far they have come:
///
///   FOLDER/journal            what is known of each fibre, and FOLDER/findings what was solved for before any surface was
///                             made, and found when surfaces were looked at, to keep them apart and to judge them; of
///                             processes of a team beside the first in FOLDER/journal-00001 and so on (see TeamLog)
///   FOLDER/outer/00000/…      outer surfaces as they were contoured, a file each, at most 1,000 in a folder
///   FOLDER/spaced/…, inner/…  those that were moved to keep them apart, and inner surfaces
///   FOLDER/stop.partial-…     while one process of a team tells the others to end (see Sharing)
///
/// Files appear whole or not at all, and what is in a journal is in its file. One that was never put
/// is an error. A file that is gone before surfaces are kept apart is that of a fibre of which nothing is known. Memory is one
/// surface for each that is asked for, or the part of it (see SurfaceFile.h). Any number of processes goes on with what any other
/// has left.
class SurfaceSpool : public SurfaceJournal
{
public:
  static constexpr char stopName[] = "stop";

  /// For so many fibres, in a folder that is made, or goes on where one of the same `identity` ended. Throws InvalidInput for a
  /// folder of another identity, and FileError. Processes that share it make theirs together.
  SurfaceSpool(const std::string& folder, const std::string& identity, std::size_t count, const Sharing& sharing = Sharing());

  SurfaceStore& outer() { return this->Outer; }
  SurfaceStore& inner() { return this->Inner; }
  /// How many fibres' surfaces were there at the beginning: outer or, where these are spaced, inner ones.
  std::size_t found() const { return this->Found; }
  /// Whether an earlier run had left findings.
  bool foundFindings() const { return this->Findings->foundSome(); }
  /// Whether nothing is in any journal, nor among any findings. Only while no other process is at work.
  bool isEmpty() const { return !this->holdsSurfaces() && this->Findings->isEmpty(); }
  /// Whether something of a fibre is in a journal. Only while no other process is at work.
  bool holdsSurfaces() const { return !this->Log->isEmpty(); }

  bool recallOuter(std::size_t index, FibreSurfacePair& pair) const override;
  void noteOuter(std::size_t index, const FibreSurfacePair& pair) override;
  void beginSpacing() override { this->Outer.isSpacing = true; }
  bool recallSpaced(std::vector<FibreSurfacePair>& pairs) const override;
  void noteSpaced(const std::vector<FibreSurfacePair>& pairs) override;
  bool recallInner(std::size_t index, double gRatio, FibreSurfacePair& pair) const override;
  void noteInner(std::size_t index, const FibreSurfacePair& pair) override;
  Recollection findings() override { return Recollection(*this->Findings); }

  /// Removes all that is its own, with what a killed process has left half-written; the folder, too, if nothing else is in it.
  void remove();

private:
  /// Surfaces of one kind.
  class Files : public SurfaceStore
  {
  public:
    Files(std::filesystem::path folder, std::string kind, std::uint64_t fingerprint, std::size_t count);

    std::size_t size() const override { return this->isSpaced.size(); }
    bool has(std::size_t index) const;
    std::shared_ptr<const TriangleMesh> get(std::size_t index) const override;
    SurfacePart part(std::size_t index, double lower, double upper) const override;
    void put(std::size_t index, TriangleMesh surface) override;
    void putElsewhere(std::size_t index) override { this->isSpaced[index] = this->isSpacing ? 1 : 0; }

    bool isSpacing = false;
    bool isFinal = false;       ///< surfaces are kept apart, so that one of them alone is not made again
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
  // Of each fibre, in the order of the journal.
  std::vector<std::vector<std::string>> OuterNotes;
  std::vector<std::vector<std::string>> SpacedNotes;
  std::vector<std::vector<std::string>> InnerNotes;
};

} // namespace cactus
