// SPDX-License-Identifier: BSD-3-Clause
#include "RankTeam.h"

#include <vtkMultiProcessController.h>
#include <vtkType.h>

#include <algorithm>

namespace cactus
{

namespace
{

constexpr int dealTag = 23107;

vtkMultiProcessController* allRanks()
{
  return vtkMultiProcessController::GetGlobalController();
}

/// Largest piece of a message: messages count their bytes with 31 bits.
constexpr vtkIdType mostAtOnce = vtkIdType(1) << 29;

/// Numbers in a rank's announcement before the sizes: whether it sends the same to all. Then follow the bytes for each rank.
constexpr std::size_t announcedBefore = 1;

/// Returns the announcements of all ranks, one after the other. All ranks begin with this, whether they send the same to all or
/// not: only then do they know which exchange the others have called.
std::vector<vtkIdType> announce(bool toAll, std::vector<vtkIdType> sizes)
{
  sizes.insert(sizes.begin(), toAll ? 1 : 0);
  std::vector<vtkIdType> all(sizes.size() * (sizes.size() - announcedBefore));
  allRanks()->AllGather(sizes.data(), all.data(), static_cast<vtkIdType>(sizes.size()));
  return all;
}

std::size_t rankCount()
{
  return static_cast<std::size_t>(allRanks()->GetNumberOfProcesses());
}

bool areAllTheSame(const std::vector<vtkIdType>& announced)
{
  bool same = true;
  for (std::size_t rank = 0; rank < rankCount(); ++rank)
  {
    same = same && announced[rank * (rankCount() + announcedBefore)] != 0;
  }
  return same;
}

/// Returns how many bytes one rank sends to another.
vtkIdType sizeOf(const std::vector<vtkIdType>& announced, std::size_t from, std::size_t to)
{
  return announced[from * (rankCount() + announcedBefore) + announcedBefore + to];
}

/// Returns the bytes that each rank sends to all.
std::vector<std::string> gatherAll(const std::string& bytes, const std::vector<vtkIdType>& announced)
{
  const std::size_t ranks = rankCount();
  const auto own = static_cast<vtkIdType>(bytes.size());
  std::vector<std::string> all(ranks);
  vtkIdType longest = 0;
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    longest = std::max(longest, sizeOf(announced, rank, 0));
  }
  const vtkIdType piece = mostAtOnce / static_cast<vtkIdType>(ranks);
  for (vtkIdType from = 0; from < longest; from += piece)
  {
    std::vector<vtkIdType> lengths;
    std::vector<vtkIdType> offsets;
    vtkIdType total = 0;
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      lengths.push_back(std::clamp<vtkIdType>(sizeOf(announced, rank, 0) - from, 0, piece));
      offsets.push_back(total);
      total += lengths.back();
    }
    std::vector<char> received(static_cast<std::size_t>(total));
    const vtkIdType length = std::clamp<vtkIdType>(own - from, 0, piece);
    allRanks()->AllGatherV(bytes.data() + std::min(from, own), received.data(), length, lengths.data(), offsets.data());
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      all[rank].append(received.data() + offsets[rank], static_cast<std::size_t>(lengths[rank]));
    }
  }
  return all;
}

void send(const std::string& bytes, int to)
{
  for (vtkIdType from = 0; from < static_cast<vtkIdType>(bytes.size()); from += mostAtOnce)
  {
    allRanks()->Send(bytes.data() + from, std::min(static_cast<vtkIdType>(bytes.size()) - from, mostAtOnce), to, dealTag);
  }
}

void receive(std::string& bytes, vtkIdType size, int from)
{
  bytes.resize(static_cast<std::size_t>(size));
  for (vtkIdType at = 0; at < size; at += mostAtOnce)
  {
    allRanks()->Receive(&bytes[static_cast<std::size_t>(at)], std::min(size - at, mostAtOnce), from, dealTag);
  }
}

/// Returns the bytes that each rank sends to this one. Ranks meet in pairs, in an order without circular waiting: in round r
/// those whose sum is r, modulo their number; while one of the two sends, the other receives. Empty messages are not sent.
std::vector<std::string> passOn(const std::vector<std::string>& toEach, const std::vector<vtkIdType>& announced)
{
  const auto ranks = static_cast<int>(rankCount());
  const int self = allRanks()->GetLocalProcessId();
  std::vector<std::string> all(rankCount());
  all[std::size_t(self)] = toEach[std::size_t(self)];
  for (int round = 0; round < ranks; ++round)
  {
    const int other = (round - self + ranks) % ranks;
    for (const bool isSending : { self<other, self> other })
    {
      if (other != self && isSending)
      {
        send(toEach[std::size_t(other)], other);
      }
      else if (other != self)
      {
        receive(all[std::size_t(other)], sizeOf(announced, std::size_t(other), std::size_t(self)), other);
      }
    }
  }
  return all;
}

} // namespace

int RankTeam::size() const
{
  return allRanks() != nullptr ? allRanks()->GetNumberOfProcesses() : 1;
}

int RankTeam::place() const
{
  return allRanks() != nullptr ? allRanks()->GetLocalProcessId() : 0;
}

std::vector<std::string> RankTeam::exchange(const std::string& bytes)
{
  if (this->size() == 1)
  {
    return { bytes };
  }
  const auto ranks = static_cast<std::size_t>(this->size());
  const std::vector<vtkIdType> announced = announce(true, std::vector<vtkIdType>(ranks, static_cast<vtkIdType>(bytes.size())));
  return areAllTheSame(announced) ? gatherAll(bytes, announced) : passOn(std::vector<std::string>(ranks, bytes), announced);
}

std::vector<std::string> RankTeam::deal(const std::vector<std::string>& toEach)
{
  if (this->size() == 1)
  {
    return toEach;
  }
  std::vector<vtkIdType> sizes;
  sizes.reserve(toEach.size());
  for (const std::string& bytes : toEach)
  {
    sizes.push_back(static_cast<vtkIdType>(bytes.size()));
  }
  return passOn(toEach, announce(false, sizes));
}

} // namespace cactus
