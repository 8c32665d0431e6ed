// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/PeriodicImages.h"

#include "base/Error.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cactus
{

namespace
{

/// Cells of a grid that capsules come near to.
class TouchedCells
{
public:
  TouchedCells(const Eigen::AlignedBox3d& bounds, double cell)
    : Origin(bounds.min())
    , Cell(cell)
  {
    std::size_t all = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      constexpr double most = 400.0;
      this->Cell = std::max(this->Cell, bounds.sizes()[axis] / most);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Count[std::size_t(axis)] = 1 + static_cast<int>(bounds.sizes()[axis] / this->Cell);
      all *= static_cast<std::size_t>(this->Count[std::size_t(axis)]);
    }
    this->IsTouched.assign(all, 0);
  }

  void touch(const Eigen::AlignedBox3d& box)
  {
    this->anyIn(box,
      [](char& cell)
      {
        cell = 1;
        return false;
      });
  }
  bool isTouched(const Eigen::AlignedBox3d& box)
  {
    return this->anyIn(box, [](const char& cell) { return cell != 0; });
  }

private:
  template <typename Test>
  bool anyIn(const Eigen::AlignedBox3d& box, Test&& test)
  {
    std::array<int, 3> first;
    std::array<int, 3> last;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto a = Eigen::Index(axis);
      const double most = this->Count[axis] - 1;
      const double from = std::floor((box.min()[a] - this->Origin[a]) / this->Cell);
      const double to = std::floor((box.max()[a] - this->Origin[a]) / this->Cell);
      if (to < 0.0 || from > most)
      {
        return false;
      }
      first[axis] = static_cast<int>(std::max(from, 0.0));
      last[axis] = static_cast<int>(std::min(to, most));
    }
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        for (int x = first[0]; x <= last[0]; ++x)
        {
          const std::size_t row = std::size_t(y) + std::size_t(this->Count[1]) * std::size_t(z);
          if (test(this->IsTouched[std::size_t(x) + std::size_t(this->Count[0]) * row]))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  Eigen::Vector3d Origin;
  double Cell;
  std::array<int, 3> Count{ { 1, 1, 1 } };
  std::vector<char> IsTouched;
};

/// Returns the box around a capsule and its reach.
Eigen::AlignedBox3d boxAround(const Capsule& body, double reach)
{
  const Eigen::Vector3d p0 = Eigen::Vector3d::Map(body.p0);
  const Eigen::Vector3d p1 = Eigen::Vector3d::Map(body.p1);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(std::max(body.r0, body.r1) + reach);
  return { p0.cwiseMin(p1) - around, p0.cwiseMax(p1) + around };
}

} // namespace

std::vector<CapsuleImage> imagesWithin(const Domain& domain, const Capsules& capsules, const std::vector<float>& reach)
{
  std::vector<CapsuleImage> images;
  if (!domain.isPeriodic())
  {
    return images;
  }
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(capsules.size());
  Eigen::AlignedBox3d bounds;
  double sizes = 0.0;
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    boxes.push_back(boxAround(capsules.bodies[k], reach[k]));
    bounds.extend(boxes.back());
    sizes += boxes.back().sizes().maxCoeff() / static_cast<double>(capsules.size());
  }
  TouchedCells cells(bounds, sizes);
  std::for_each(boxes.begin(), boxes.end(), [&](const Eigen::AlignedBox3d& box) { cells.touch(box); });
  for (std::size_t k = 0; k < boxes.size(); ++k)
  {
    forEachImage(domain, boxes[k], bounds,
      [&](const Eigen::Vector3d& shift)
      {
        if (!shift.isZero() && cells.isTouched(Eigen::AlignedBox3d(boxes[k]).translate(shift)))
        {
          images.push_back({ static_cast<std::uint32_t>(k), shift });
        }
      });
  }
  // Those of consecutive capsules by the same shift one after the other.
  std::stable_sort(images.begin(), images.end(),
    [](const CapsuleImage& a, const CapsuleImage& b)
    { return std::pair(a.shift.y(), a.shift.x()) < std::pair(b.shift.y(), b.shift.x()); });
  return images;
}

void placeImage(const Capsule& of, const Eigen::Vector3d& shift, Capsule& image)
{
  image = of;
  for (int axis = 0; axis < 3; ++axis)
  {
    image.p0[axis] += shift[axis];
    image.p1[axis] += shift[axis];
  }
}

void addImages(const std::vector<CapsuleImage>& images, Capsules& capsules)
{
  std::uint32_t first = capsules.first.empty() ? 0 : capsules.first.back() + 2;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    // Images of consecutive capsules by the same shift share a control point, so that they are searched together.
    const bool follows = i > 0 && images[i].capsule == images[i - 1].capsule + 1 && images[i].shift == images[i - 1].shift &&
                         capsules.first[images[i].capsule] == capsules.first[images[i - 1].capsule] + 1;
    first += follows || i == 0 ? 0 : 1;
    Capsule image;
    placeImage(capsules.bodies[images[i].capsule], images[i].shift, image);
    capsules.bodies.push_back(image);
    capsules.first.push_back(first++);
    capsules.fibre.push_back(capsules.fibre[images[i].capsule]);
  }
}

} // namespace cactus
