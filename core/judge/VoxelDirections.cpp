// SPDX-License-Identifier: BSD-3-Clause
#include "judge/VoxelDirections.h"

#include "base/Domain.h"
#include "base/SphericalHarmonics.h"
#include "fibres/PeriodicImages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cactus
{

namespace
{

/// A block of voxels, and a fibre's directions in them.
class BlockDirections
{
public:
  BlockDirections(const Fibres& fibres, std::size_t fibre, const VoxelBoxes& voxels, const VoxelVolumes& block, int order)
    : Lines(fibres)
    , First(fibres.offsets[fibre])
    , Last(fibres.offsets[fibre + 1] - 1)
    , Voxels(voxels)
    , Block(block)
    , Order(order)
  {
    this->Result.tensors.assign(block.volumes.size(), Eigen::Matrix3d::Zero());
    this->Result.harmonics.resize(order >= 0 ? block.volumes.size() : 0);
  }

  VoxelDirections run()
  {
    Eigen::AlignedBox3d around(this->box(0, 0, 0).lower);
    around.extend(this->box(this->Block.count[0] - 1, this->Block.count[1] - 1, this->Block.count[2] - 1).upper);
    for (std::size_t segment = this->First; segment < this->Last; ++segment)
    {
      Eigen::AlignedBox3d ends(this->Lines.points[segment]);
      ends.extend(this->Lines.points[segment + 1]);
      forEachImage(this->Lines.domain, ends, around, [&](const Eigen::Vector3d& shift) { this->addSegment(segment, shift); });
    }
    std::size_t place = 0;
    for (int k = 0; k < this->Block.count[2]; ++k)
    {
      for (int j = 0; j < this->Block.count[1]; ++j)
      {
        for (int i = 0; i < this->Block.count[0]; ++i, ++place)
        {
          this->finish(place, this->box(i, j, k));
        }
      }
    }
    return std::move(this->Result);
  }

private:
  Domain box(int i, int j, int k) const
  {
    const Eigen::Vector3d number(this->Block.lower[0] + i, this->Block.lower[1] + j, this->Block.lower[2] + k);
    Domain box;
    box.lower = this->Voxels.origin + this->Voxels.spacing * number;
    box.upper = box.lower + Eigen::Vector3d::Constant(this->Voxels.spacing);
    return box;
  }

  Eigen::Vector3d along(std::size_t segment) const { return this->Lines.points[segment + 1] - this->Lines.points[segment]; }

  /// Adds the image of a segment to the voxels of the block that meet its box.
  void addSegment(std::size_t segment, const Eigen::Vector3d& shift)
  {
    const Eigen::Vector3d p = this->Lines.points[segment] + shift;
    const Eigen::Vector3d q = this->Lines.points[segment + 1] + shift;
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto a = std::size_t(axis);
      const double first = std::floor((std::min(p[axis], q[axis]) - this->Voxels.origin[axis]) / this->Voxels.spacing);
      const double last = std::floor((std::max(p[axis], q[axis]) - this->Voxels.origin[axis]) / this->Voxels.spacing);
      low[a] = int(std::max(first - this->Block.lower[a], 0.0));
      high[a] = int(std::min(last - this->Block.lower[a], this->Block.count[a] - 1.0));
    }
    const Eigen::Vector3d direction = this->along(segment);
    const std::vector<double> harmonics = this->harmonicsOf(direction);
    for (int k = low[2]; k <= high[2]; ++k)
    {
      for (int j = low[1]; j <= high[1]; ++j)
      {
        for (int i = low[0]; i <= high[0]; ++i)
        {
          const auto [from, to] = this->box(i, j, k).clip(p, q);
          if (to > from)
          {
            const std::size_t place =
              (std::size_t(k) * std::size_t(this->Block.count[1]) + std::size_t(j)) * std::size_t(this->Block.count[0]) +
              std::size_t(i);
            // Weighted with the length in the voxel.
            this->Result.tensors[place] += (to - from) / direction.norm() * direction * direction.transpose();
            this->addHarmonics(place, (to - from) * direction.norm(), harmonics);
          }
        }
      }
    }
  }

  std::vector<double> harmonicsOf(const Eigen::Vector3d& direction) const
  {
    return this->Order >= 0 ? harmonicsAt(direction.normalized(), this->Order) : std::vector<double>();
  }

  void addHarmonics(std::size_t place, double weight, const std::vector<double>& harmonics)
  {
    if (harmonics.empty())
    {
      return;
    }
    std::vector<double>& sums = this->Result.harmonics[place];
    sums.resize(harmonics.size(), 0.0);
    for (std::size_t i = 0; i < sums.size(); ++i)
    {
      sums[i] += weight * harmonics[i];
    }
  }

  void finish(std::size_t place, const Domain& box)
  {
    Eigen::Matrix3d& tensor = this->Result.tensors[place];
    if (this->Block.volumes[place] <= 0.0)
    {
      tensor.setZero();
      return;
    }
    if (tensor.trace() <= 0.0)
    {
      const Eigen::Vector3d direction = this->along(this->closest(0.5 * (box.lower + box.upper)));
      tensor = direction * direction.transpose();
      this->addHarmonics(place, tensor.trace(), this->harmonicsOf(direction));
    }
    for (std::size_t i = 0; this->Order >= 0 && i < this->Result.harmonics[place].size(); ++i)
    {
      this->Result.harmonics[place][i] /= tensor.trace();
    }
    tensor /= tensor.trace();
  }

  std::size_t closest(const Eigen::Vector3d& point) const
  {
    std::size_t best = this->First;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t segment = this->First; segment < this->Last; ++segment)
    {
      const Eigen::Vector3d direction = this->along(segment);
      const Eigen::Vector3d offset = this->Lines.domain.nearest(point - this->Lines.points[segment]);
      const double t = std::clamp(offset.dot(direction) / direction.squaredNorm(), 0.0, 1.0);
      const double distance = (offset - t * direction).squaredNorm();
      if (distance < least)
      {
        least = distance;
        best = segment;
      }
    }
    return best;
  }

  const Fibres& Lines;
  std::size_t First;
  std::size_t Last;
  const VoxelBoxes& Voxels;
  const VoxelVolumes& Block;
  int Order;
  VoxelDirections Result;
};

} // namespace

VoxelDirections voxelDirections(
  const Fibres& fibres, std::size_t fibre, const VoxelBoxes& voxels, const VoxelVolumes& block, int order)
{
  return BlockDirections(fibres, fibre, voxels, block, order).run();
}

} // namespace cactus
