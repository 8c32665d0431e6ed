// SPDX-License-Identifier: BSD-3-Clause
#include "growth/GrownTiles.h"

#include "base/Error.h"
#include "growth/BlockEvaluation.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrownField.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

namespace cactus
{

static_assert(GrownTiles::edge == BlockEvaluation::blockSize, "a tile is what is evaluated at once");

namespace
{

/// Largest number of tiles along an axis: 33 million samples.
constexpr int mostTiles = 1 << 21;

const Fibres& checked(const Fibres& fibres, double growth)
{
  validate(fibres);
  require(std::isfinite(growth), "the growth must be a finite number of µm");
  return fibres;
}

/// Per-thread data for computing tiles.
class TileWorker
{
public:
  explicit TileWorker(const GrownField& field)
    : Enter([this, &field](const FieldCell& cell, int) { field.enter(cell, *this->Grid, this->FibreId, this->Depth); })
    , Evaluation(field.seeds().evaluation(field.grid(), field.relevance(), this->Enter, 0))
  {
  }
  TileWorker(const TileWorker&) = delete;
  TileWorker& operator=(const TileWorker&) = delete;

  void compute(const Eigen::Array3i& lower, const VoxelGrid& held, std::int32_t* fibreId, float* depth)
  {
    this->Grid = &held;
    this->FibreId = fibreId;
    this->Depth = depth;
    this->Evaluation->evaluate(lower);
  }

private:
  const VoxelGrid* Grid = nullptr;
  std::int32_t* FibreId = nullptr;
  float* Depth = nullptr;
  FieldSink Enter;
  std::unique_ptr<BlockEvaluation> Evaluation;
};

} // namespace

/// The field, and a worker for each thread that has been active at the same time.
class GrownTiles::Growing : public KnownFibres
{
public:
  Growing(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, std::size_t kept, int threads)
    : gap(options.gap())
    , field(checked(fibres, growth), options, growth, growthGrid(fibres.domain, options), threads)
    , kept(kept)
  {
  }

  void compute(const Eigen::Array3i& lower, Tile& tile)
  {
    std::unique_ptr<TileWorker> worker = this->takeWorker();
    worker->compute(lower, tile.grid, tile.fibreId.data(), tile.depth.data());
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Idle.push_back(std::move(worker));
  }

  std::vector<FibreOutline> outlines() const override
  {
    std::vector<FibreOutline> outlines;
    for (std::size_t rank = 0; rank < this->field.seeds().size(); ++rank)
    {
      outlines.push_back(this->field.outline(static_cast<int>(rank)));
    }
    return outlines;
  }

  std::vector<std::array<int, 3>> tilesOf(std::int32_t fibreId) const override
  {
    const int rank = this->field.rankOf(fibreId);
    return rank < 0 ? std::vector<std::array<int, 3>>() : this->field.blocksOf(rank);
  }

  const double gap;
  const GrownField field;
  TileStore kept;

private:
  std::unique_ptr<TileWorker> takeWorker()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      if (!this->Idle.empty())
      {
        std::unique_ptr<TileWorker> worker = std::move(this->Idle.back());
        this->Idle.pop_back();
        return worker;
      }
    }
    return std::make_unique<TileWorker>(this->field);
  }

  std::mutex Mutex;
  std::vector<std::unique_ptr<TileWorker>> Idle;
};

GrownTiles::GrownTiles(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, std::size_t kept, int threads)
  : Source(std::make_unique<Growing>(fibres, options, growth, kept, threads))
{
  for (const int count : this->grid().count)
  {
    require(count / edge < mostTiles, "the image has too many voxels along an axis: choose a larger VoxelSize");
  }
}

GrownTiles::~GrownTiles() = default;

const VoxelGrid& GrownTiles::grid() const
{
  return this->Source->field.grid();
}

double GrownTiles::gap() const
{
  return this->Source->gap;
}

const KnownFibres* GrownTiles::knownFibres() const
{
  return this->Source.get();
}

std::shared_ptr<const Tile> GrownTiles::tile(const std::array<int, 3>& at) const
{
  const VoxelGrid& whole = this->grid();
  std::uint64_t number = 0;
  for (std::size_t axis = 3; axis-- > 0;)
  {
    number = number * std::uint64_t(whole.count[axis] / edge + 1) + std::uint64_t(at[axis]); // see mostTiles
  }
  if (auto kept = this->Source->kept.find(number))
  {
    return kept;
  }
  const std::shared_ptr<Tile> tile = this->Source->kept.make();
  tile->grid = whole;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    tile->grid.lower[axis] = edge * at[axis];
    tile->grid.count[axis] = std::min(edge, whole.count[axis] - edge * at[axis]);
  }
  this->Source->compute({ edge * at[0], edge * at[1], edge * at[2] }, *tile);
  ++this->Computed;
  this->Source->kept.keep(number, tile);
  return tile;
}

/// Copies the part of a tile that `held` contains.
void GrownTiles::copyTile(const Tile& tile, const VoxelGrid& held, LabelBuffer& buffer)
{
  std::array<int, 3> begin{};
  std::array<int, 3> end{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    begin[axis] = std::max(held.lower[axis], tile.grid.lower[axis]);
    end[axis] = std::min(held.lower[axis] + held.count[axis], tile.grid.lower[axis] + tile.grid.count[axis]);
  }
  for (int k = begin[2]; k < end[2]; ++k)
  {
    for (int j = begin[1]; j < end[1]; ++j)
    {
      const std::size_t from = tile.grid.index(begin[0], j, k);
      const std::size_t to = held.index(begin[0], j, k);
      const auto count = std::ptrdiff_t(end[0] - begin[0]);
      std::copy_n(tile.fibreId.data() + from, count, buffer.fibreId.data() + to);
      std::copy_n(tile.depth.data() + from, count, buffer.depth.data() + to);
    }
  }
}

LabelImageView GrownTiles::samples(const SampleRange& range, LabelBuffer& buffer) const
{
  LabelImageView view;
  view.gap = this->gap();
  view.grid = this->grid();
  view.grid.lower = range.first;
  view.grid.count = range.count;
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    first[axis] = range.first[axis] / edge;
    last[axis] = (range.first[axis] + range.count[axis] - 1) / edge;
  }
  if (first == last)
  {
    const std::shared_ptr<const Tile> tile = this->tile(first);
    buffer.held = tile;
    view.grid = tile->grid;
    view.fibreId = tile->fibreId.data();
    view.depth = tile->depth.data();
    return view;
  }
  buffer.fibreId.resize(view.grid.size());
  buffer.depth.resize(view.grid.size());
  for (int z = first[2]; z <= last[2]; ++z)
  {
    for (int y = first[1]; y <= last[1]; ++y)
    {
      for (int x = first[0]; x <= last[0]; ++x)
      {
        copyTile(*this->tile({ { x, y, z } }), view.grid, buffer);
      }
    }
  }
  view.fibreId = buffer.fibreId.data();
  view.depth = buffer.depth.data();
  return view;
}

} // namespace cactus
