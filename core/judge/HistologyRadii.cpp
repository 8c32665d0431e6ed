// SPDX-License-Identifier: BSD-3-Clause
#include "judge/HistologyRadii.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Memory.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace cactus
{

namespace
{

struct PixelStep
{
  int column;
  int row;
  double length;
};

const double diagonal = std::sqrt(2.0);
const std::array<PixelStep, 8> pixelSteps{ { { -1, 0, 1.0 }, { 1, 0, 1.0 }, { 0, -1, 1.0 }, { 0, 1, 1.0 }, { -1, -1, diagonal },
  { 1, -1, diagonal }, { -1, 1, diagonal }, { 1, 1, diagonal } } };

/// Finds axons and assigns myelin to them.
class MaskMeasurement
{
public:
  MaskMeasurement(const HistologyMask& mask, const Context& context)
    : Mask(mask)
    , Working(context)
  {
    this->Result.labels.assign(mask.pixels.size(), 0);
  }

  MaskAxons run()
  {
    for (std::size_t pixel = 0; pixel < this->Mask.pixels.size(); ++pixel)
    {
      if (this->Mask.pixels[pixel] == Tissue::Axon && this->Result.labels[pixel] == 0)
      {
        this->Result.axons.emplace_back();
        this->fillAxon(pixel, std::int32_t(this->Result.axons.size()));
      }
    }
    require(!this->Result.axons.empty(), "the mask has no axons: they are white (255), myelin is grey (127) and all else black");
    this->spread();
    this->measure();
    return std::move(this->Result);
  }

private:
  /// Calls visit(pixel, length of the step) for the neighbours of a pixel.
  template <typename Visit>
  void forNeighbours(std::size_t pixel, Visit&& visit) const
  {
    const int column = int(pixel % std::size_t(this->Mask.count[0]));
    const int row = int(pixel / std::size_t(this->Mask.count[0]));
    for (const PixelStep& step : pixelSteps)
    {
      const int c = column + step.column;
      const int r = row + step.row;
      if (c >= 0 && c < this->Mask.count[0] && r >= 0 && r < this->Mask.count[1])
      {
        visit(std::size_t(r) * std::size_t(this->Mask.count[0]) + std::size_t(c), step.length);
      }
    }
  }

  void fillAxon(std::size_t first, std::int32_t label)
  {
    this->Working.checkpoint();
    std::vector<std::size_t> open{ first };
    this->Result.labels[first] = label;
    while (!open.empty())
    {
      const std::size_t pixel = open.back();
      open.pop_back();
      this->forNeighbours(pixel,
        [&](std::size_t next, double step)
        {
          if (step == 1.0 && this->Mask.pixels[next] == Tissue::Axon && this->Result.labels[next] == 0)
          {
            this->Result.labels[next] = label;
            open.push_back(next);
          }
        });
    }
  }

  /// Computes shortest paths from all axons at once.
  void spread()
  {
    using Way = std::tuple<double, std::int32_t, std::size_t>; // length, axon, pixel
    std::priority_queue<Way, std::vector<Way>, std::greater<>> ways;
    std::vector<double> lengths(this->Mask.pixels.size(), std::numeric_limits<double>::infinity());
    const auto go = [&](double length, std::int32_t label, std::size_t from)
    {
      this->forNeighbours(from,
        [&](std::size_t next, double step)
        {
          if (this->Mask.pixels[next] == Tissue::Myelin && length + step < lengths[next])
          {
            lengths[next] = length + step;
            ways.emplace(length + step, label, next);
          }
        });
    };
    for (std::size_t pixel = 0; pixel < this->Mask.pixels.size(); ++pixel)
    {
      if (this->Mask.pixels[pixel] == Tissue::Axon)
      {
        go(0.0, this->Result.labels[pixel], pixel);
      }
    }
    while (!ways.empty())
    {
      const auto [length, label, pixel] = ways.top();
      ways.pop();
      if (this->Result.labels[pixel] == 0)
      {
        this->Result.labels[pixel] = label;
        go(length, label, pixel);
      }
    }
  }

  void measure()
  {
    const double area = this->Mask.pixelSize * this->Mask.pixelSize;
    std::vector<double> counts(this->Result.axons.size(), 0.0);
    for (std::size_t pixel = 0; pixel < this->Mask.pixels.size(); ++pixel)
    {
      const Tissue tissue = this->Mask.pixels[pixel];
      const std::int32_t label = this->Result.labels[pixel];
      if (label == 0)
      {
        this->Result.looseMyelin += tissue == Tissue::Myelin ? area : 0.0;
        continue;
      }
      const int column = int(pixel % std::size_t(this->Mask.count[0]));
      const int row = int(pixel / std::size_t(this->Mask.count[0]));
      MaskAxon& axon = this->Result.axons[std::size_t(label) - 1];
      axon.touchesBorder =
        axon.touchesBorder || column == 0 || row == 0 || column + 1 == this->Mask.count[0] || row + 1 == this->Mask.count[1];
      if (tissue == Tissue::Myelin)
      {
        axon.myelinArea += area;
        continue;
      }
      axon.axonArea += area;
      axon.column += column;
      axon.row += row;
      counts[std::size_t(label) - 1] += 1.0;
    }
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      this->Result.axons[i].column /= counts[i];
      this->Result.axons[i].row /= counts[i];
    }
  }

  const HistologyMask& Mask;
  const Context& Working;
  MaskAxons Result;
};

} // namespace

double MaskAxon::axonRadius() const
{
  return std::sqrt(this->axonArea / pi);
}

double MaskAxon::fibreRadius() const
{
  return std::sqrt((this->axonArea + this->myelinArea) / pi);
}

MaskAxons measureMask(const HistologyMask& mask, const Context& context)
{
  requireMemory(40.0 * double(mask.pixels.size()), "a mask of this size", "cut a part out of it");
  return MaskMeasurement(mask, context).run();
}

} // namespace cactus
