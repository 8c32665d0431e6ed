// SPDX-License-Identifier: BSD-3-Clause
#include "RankTeam.h"

#include <vtkMultiProcessController.h>
#include <vtkType.h>

#include <algorithm>

namespace cactus
{

namespace
{

vtkMultiProcessController* allRanks()
{
  return vtkMultiProcessController::GetGlobalController();
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
  // In pieces: messages count their bytes with 31 bits.
  constexpr vtkIdType mostAtOnce = vtkIdType(1) << 29;
  const auto ranks = static_cast<std::size_t>(this->size());
  const auto own = static_cast<vtkIdType>(bytes.size());
  std::vector<vtkIdType> sizes(ranks, own);
  std::vector<std::string> all(ranks);
  if (ranks == 1)
  {
    return { bytes };
  }
  allRanks()->AllGather(&own, sizes.data(), 1);
  const vtkIdType piece = mostAtOnce / static_cast<vtkIdType>(ranks);
  const vtkIdType longest = *std::max_element(sizes.begin(), sizes.end());
  for (vtkIdType from = 0; from < longest; from += piece)
  {
    std::vector<vtkIdType> lengths;
    std::vector<vtkIdType> offsets;
    vtkIdType total = 0;
    for (const vtkIdType size : sizes)
    {
      lengths.push_back(std::clamp<vtkIdType>(size - from, 0, piece));
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

} // namespace cactus
