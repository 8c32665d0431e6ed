// SPDX-License-Identifier: BSD-3-Clause
#include "judge/HistologyMask.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "mesh/SurfaceCheck.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cactus
{

namespace
{

/// Largest number of pixels along a side, a limit of image formats and other programs.
constexpr double mostPixels = 65535.0;
/// Fibres that are cut in parallel before they are drawn in their order.
constexpr std::size_t sectionBatch = 256;

/// A run of pixels of one fibre in a row: from the first column to before the second.
struct PixelRun
{
  int row;
  int begin;
  int end;
};

/// Cuts surfaces by one plane into runs of pixels.
class SectionCutter
{
public:
  SectionCutter(const HistologyMask& mask, const HistologyMaskOptions& options, const Domain& domain)
    : Normal(int(options.normal))
    , IsLowest(options.position <= domain.lower[int(options.normal)])
    , Position(options.position)
    , Pixel(options.pixelSize)
    , Mask(mask)
  {
  }

  std::vector<PixelRun> cut(const TriangleMesh& mesh) const
  {
    requireCorners(mesh);
    std::vector<std::vector<double>> crossings(std::size_t(this->Mask.count[1]));
    for (const auto& triangle : mesh.triangles)
    {
      this->addTriangle(mesh, triangle, crossings);
    }
    std::vector<PixelRun> runs;
    for (std::size_t row = 0; row < crossings.size(); ++row)
    {
      std::sort(crossings[row].begin(), crossings[row].end());
      for (std::size_t i = 0; i + 1 < crossings[row].size(); i += 2)
      {
        const int begin = this->columnFrom(crossings[row][i]);
        const int end = this->columnFrom(crossings[row][i + 1]);
        if (begin < end)
        {
          runs.push_back({ int(row), begin, end });
        }
      }
    }
    return runs;
  }

private:
  using Place = std::array<double, 2>; // along columns and rows, in pixels from the middle of the first

  /// Returns the first pixel whose middle is not before a place.
  int columnFrom(double place) const { return int(std::clamp(std::ceil(place), 0.0, double(this->Mask.count[0]))); }

  /// Returns where an edge with its ends on two sides of the plane crosses it, the same from either end.
  Place crossing(const TriangleMesh& mesh, std::int32_t first, std::int32_t second) const
  {
    const Eigen::Vector3d& p = mesh.points[std::size_t(std::min(first, second))];
    const Eigen::Vector3d& q = mesh.points[std::size_t(std::max(first, second))];
    const double part = (this->Position - p[this->Normal]) / (q[this->Normal] - p[this->Normal]);
    Place place{};
    for (std::size_t i = 0; i < 2; ++i)
    {
      const int axis = this->Mask.axes[i];
      place[i] = (p[axis] + part * (q[axis] - p[axis]) - this->Mask.origin[axis]) / this->Pixel;
    }
    return place;
  }

  void addTriangle(
    const TriangleMesh& mesh, const std::array<std::int32_t, 3>& triangle, std::vector<std::vector<double>>& crossings) const
  {
    std::array<Place, 2> ends{};
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int32_t from = triangle[i];
      const std::int32_t to = triangle[(i + 1) % 3];
      // A corner in the plane counts as beyond it (in the domain's lowest face, as before it), so that a closed surface gives a
      // closed curve.
      if (this->isBeyond(mesh, from) != this->isBeyond(mesh, to))
      {
        ends[found++] = this->crossing(mesh, from, to);
      }
    }
    if (found == 2)
    {
      this->addPiece(ends[0], ends[1], crossings);
    }
  }

  bool isBeyond(const TriangleMesh& mesh, std::int32_t point) const
  {
    const double place = mesh.points[std::size_t(point)][this->Normal];
    return this->IsLowest ? place > this->Position : place >= this->Position;
  }

  /// Adds the crossings of a piece of the outline with the rows.
  void addPiece(const Place& from, const Place& to, std::vector<std::vector<double>>& crossings) const
  {
    const Place& low = from[1] <= to[1] ? from : to;
    const Place& high = from[1] <= to[1] ? to : from;
    const double last = double(crossings.size());
    const auto begin = std::size_t(std::clamp(std::ceil(low[1]), 0.0, last));
    const auto end = std::size_t(std::clamp(std::ceil(high[1]), 0.0, last));
    for (std::size_t row = begin; row < end; ++row)
    {
      crossings[row].push_back(low[0] + (double(row) - low[1]) / (high[1] - low[1]) * (high[0] - low[0]));
    }
  }

  int Normal;
  bool IsLowest;
  double Position;
  double Pixel;
  const HistologyMask& Mask;
};

void drawRuns(const std::vector<PixelRun>& runs, Tissue tissue, int fibreId, HistologyMask& mask)
{
  for (const PixelRun& run : runs)
  {
    const std::size_t row = std::size_t(run.row) * std::size_t(mask.count[0]);
    for (std::size_t pixel = row + std::size_t(run.begin); pixel < row + std::size_t(run.end); ++pixel)
    {
      mask.pixels[pixel] = tissue;
      mask.fibreIds[pixel] = fibreId;
    }
  }
}

} // namespace

const PropertyList<HistologyMaskOptions>& HistologyMaskOptions::properties()
{
  using Options = HistologyMaskOptions;
  static const auto list =
    PropertyList<Options>()
      .add("Normal", &Options::normal, { "X", "Y", "Z" },
        "Axis perpendicular to the cut. Columns and rows of the image follow the two other axes, in their order.")
      .add("Position", &Options::position, limits::coordinate, "Position of the cut along that axis in µm.")
      .add("PixelSize", &Options::pixelSize, maskPixel, "Edge of a pixel in µm.");
  return list;
}

HistologyMask maskGrid(const Domain& domain, const HistologyMaskOptions& options)
{
  validateProperties(options);
  const int normal = int(options.normal);
  if (!(options.position >= domain.lower[normal] && options.position <= domain.upper[normal]))
  {
    throw InvalidInput(text("Position ", options.position, " µm lies beside the domain, which reaches from ",
      domain.lower[normal], " to ", domain.upper[normal], " µm"));
  }
  HistologyMask mask;
  mask.axes = { { normal == 0 ? 1 : 0, normal == 2 ? 1 : 2 } };
  mask.origin = domain.lower + Eigen::Vector3d::Constant(0.5 * options.pixelSize);
  mask.origin[normal] = options.position;
  mask.pixelSize = options.pixelSize;
  for (std::size_t i = 0; i < 2; ++i)
  {
    // Only pixels with their middle within the domain: background beyond it would hide that a fibre reaches the border.
    const double count = std::max(1.0, std::ceil(domain.size()[mask.axes[i]] / options.pixelSize - 0.5 - 1e-6));
    if (count > mostPixels)
    {
      throw InvalidInput(
        text("PixelSize ", options.pixelSize, " µm makes ", count, " pixels of a side of the domain: choose a larger one"));
    }
    mask.count[i] = int(count);
  }
  return mask;
}

HistologyMask cutMask(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const HistologyMaskOptions& options, const Context& context)
{
  require(outer.size() + inner.size() > 0, "there are no surfaces to cut: connect MyelinSurface's Outer and Inner");
  HistologyMask mask = maskGrid(domain, options);
  requireMemory(5.0 * double(mask.size()), text("PixelSize ", options.pixelSize), "choose a larger PixelSize");
  mask.pixels.assign(mask.size(), Tissue::Background);
  mask.fibreIds.assign(mask.size(), 0);
  const SectionCutter cutter(mask, options, domain);
  const auto total = double(outer.size() + inner.size());
  double done = 0.0;
  for (const auto& [surfaces, tissue] : { std::pair(&outer, Tissue::Myelin), std::pair(&inner, Tissue::Axon) })
  {
    for (std::size_t begin = 0; begin < surfaces->size(); begin += sectionBatch)
    {
      const std::size_t count = std::min(sectionBatch, surfaces->size() - begin);
      std::vector<std::vector<PixelRun>> runs(count);
      std::vector<char> isOpen(count, 0);
      parallelFor(
        count, context,
        [&, from = surfaces](std::size_t i)
        {
          const TriangleMesh mesh = from->mesh(begin + i);
          runs[i] = cutter.cut(mesh);
          isOpen[i] = checkSurface(mesh).closed() ? 0 : 1;
        },
        "Cutting fibres", done / total, (done + double(count)) / total);
      done += double(count);
      mask.openSurfaces += std::size_t(std::count(isOpen.begin(), isOpen.end(), 1));
      for (std::size_t i = 0; i < count; ++i)
      {
        drawRuns(runs[i], tissue, surfaces->fibreIds[begin + i], mask);
      }
    }
  }
  return mask;
}

} // namespace cactus
