// SPDX-License-Identifier: BSD-3-Clause
#include "judge/SubstrateSampler.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "base/SphericalHarmonics.h"
#include "judge/VoxelDirections.h"
#include "mesh/SurfaceCheck.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace cactus
{

namespace
{

/// Fibres that are sampled in parallel before their results are added in their order.
constexpr std::size_t batch = 64;
/// Fraction of the largest voxel in the domain below which a fibre is not in a voxel: the rounding of exact sums.
constexpr double nothing = 1e-9;

/// One fibre in the voxels around it.
struct SampledFibre
{
  int fibreId = 0;
  int bundleId = 0;
  VoxelVolumes outer; ///< of the inner surface if there is no outer one
  VoxelVolumes inner;
  VoxelDirections directions; ///< for the voxels of `outer`
  int openSurfaces = 0;
};

template <typename Visit>
void visitVoxels(const VoxelVolumes& block, const VoxelBoxes& voxels, Visit&& visit)
{
  std::size_t place = 0;
  for (int k = 0; k < block.count[2]; ++k)
  {
    for (int j = 0; j < block.count[1]; ++j)
    {
      for (int i = 0; i < block.count[0]; ++i, ++place)
      {
        visit(place, voxels.index(block.lower[0] + i, block.lower[1] + j, block.lower[2] + k));
      }
    }
  }
}

/// Adds fibres to the grid, in their order.
class Collector
{
public:
  /// largestPart: of a voxel in the domain, µm³.
  Collector(SampledSubstrate& sampled, double largestPart, bool withDirections, bool withPeaks)
    : Sampled(sampled)
    , LargestPart(largestPart)
    , WithPeaks(withPeaks)
    , Largest(sampled.voxels.size(), 0.0)
    , Tensors(withDirections ? sampled.voxels.size() : 0, Eigen::Matrix3d::Zero())
  {
    if (sampled.harmonicsOrder > 0)
    {
      sampled.harmonics.assign(sampled.voxels.size() * harmonicCount(sampled.harmonicsOrder), 0.0);
    }
    const std::size_t size = sampled.voxels.size();
    sampled.axonFraction.assign(size, 0.0);
    sampled.myelinFraction.assign(size, 0.0);
    sampled.compartment.assign(size, Compartment::ExtraAxonal);
    sampled.fibreId.assign(size, 0);
    sampled.fibreCount.assign(size, 0);
  }

  void add(const SampledFibre& fibre)
  {
    const VoxelBoxes& voxels = this->Sampled.voxels;
    const double least = nothing * this->LargestPart;
    std::vector<double>& bundle = this->Sampled.bundleFraction[fibre.bundleId];
    bundle.resize(voxels.size(), 0.0);
    visitVoxels(fibre.outer, voxels,
      [&](std::size_t place, std::size_t voxel)
      {
        const double volume = fibre.outer.volumes[place];
        if (volume <= least)
        {
          return;
        }
        this->Sampled.myelinFraction[voxel] += volume;
        bundle[voxel] += volume;
        ++this->Sampled.fibreCount[voxel];
        if (volume > this->Largest[voxel])
        {
          this->Largest[voxel] = volume;
          this->Sampled.fibreId[voxel] = fibre.fibreId;
        }
        if (!this->Tensors.empty())
        {
          this->Tensors[voxel] += volume * fibre.directions.tensors[place];
          this->addDirections(fibre, place, voxel, volume);
        }
      });
    visitVoxels(fibre.inner, voxels,
      [&](std::size_t place, std::size_t voxel)
      {
        this->Sampled.axonFraction[voxel] += fibre.inner.volumes[place];
        this->Sampled.myelinFraction[voxel] -= fibre.inner.volumes[place];
      });
  }

  /// Converts volumes to fractions, and derives the other results. `volume` is that of a voxel's part in the domain.
  void finish(const std::vector<double>& volume)
  {
    for (auto& [id, fractions] : this->Sampled.bundleFraction)
    {
      divide(fractions, volume);
    }
    divide(this->Sampled.axonFraction, volume);
    divide(this->Sampled.myelinFraction, volume);
    for (std::size_t voxel = 0; voxel < volume.size(); ++voxel)
    {
      const double axon = this->Sampled.axonFraction[voxel];
      const double myelin = this->Sampled.myelinFraction[voxel];
      const double outside = 1.0 - axon - myelin;
      Compartment& most = this->Sampled.compartment[voxel];
      most = outside >= std::max(axon, myelin) ? Compartment::ExtraAxonal
             : axon >= myelin                  ? Compartment::Axon
                                               : Compartment::Myelin;
      this->Sampled.fibreId[voxel] = most == Compartment::ExtraAxonal ? 0 : this->Sampled.fibreId[voxel];
    }
    this->finishDirections();
    const std::size_t count = volume.empty() ? 0 : this->Sampled.harmonics.size() / volume.size();
    for (std::size_t i = 0; i < this->Sampled.harmonics.size(); ++i)
    {
      this->Sampled.harmonics[i] /= volume[i / count];
    }
    if (this->WithPeaks)
    {
      this->finishPeaks();
    }
  }

private:
  void addDirections(const SampledFibre& fibre, std::size_t place, std::size_t voxel, double volume)
  {
    if (this->Sampled.harmonicsOrder > 0)
    {
      const std::vector<double>& harmonics = fibre.directions.harmonics[place];
      for (std::size_t i = 0; i < harmonics.size(); ++i)
      {
        this->Sampled.harmonics[voxel * harmonicCount(this->Sampled.harmonicsOrder) + i] += volume * harmonics[i];
      }
    }
    if (this->WithPeaks)
    {
      std::vector<Eigen::Matrix3d>& tensors = this->BundleTensors[fibre.bundleId];
      tensors.resize(this->Tensors.size(), Eigen::Matrix3d::Zero());
      tensors[voxel] += volume * fibre.directions.tensors[place];
    }
  }

  void finishPeaks()
  {
    std::array<Eigen::Vector3d, SampledSubstrate::peakCount> none;
    none.fill(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    this->Sampled.peaks.assign(this->Tensors.size(), none);
    for (std::size_t voxel = 0; voxel < this->Tensors.size(); ++voxel)
    {
      std::vector<std::pair<double, int>> bundles;
      for (const auto& [id, tensors] : this->BundleTensors)
      {
        if (tensors[voxel].trace() > 0.0)
        {
          bundles.emplace_back(-this->Sampled.bundleFraction[id][voxel], id);
        }
      }
      std::sort(bundles.begin(), bundles.end());
      for (std::size_t i = 0; i < std::min(bundles.size(), none.size()); ++i)
      {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(this->BundleTensors[bundles[i].second][voxel]);
        this->Sampled.peaks[voxel][i] = -bundles[i].first * upward(parts.eigenvectors().col(2));
      }
    }
  }

  /// Returns an axis with its sign chosen so that z is not negative.
  static Eigen::Vector3d upward(const Eigen::Vector3d& axis) { return axis[2] < 0.0 ? Eigen::Vector3d(-axis) : axis; }

  static void divide(std::vector<double>& volumes, const std::vector<double>& by)
  {
    for (std::size_t i = 0; i < volumes.size(); ++i)
    {
      volumes[i] = std::clamp(volumes[i] / by[i], 0.0, 1.0);
    }
  }

  void finishDirections()
  {
    this->Sampled.direction.assign(this->Tensors.size(), Eigen::Vector3d::Zero());
    this->Sampled.dispersion.assign(this->Tensors.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t voxel = 0; voxel < this->Tensors.size(); ++voxel)
    {
      const double weight = this->Tensors[voxel].trace();
      if (weight > 0.0)
      {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(this->Tensors[voxel]);
        this->Sampled.direction[voxel] = upward(parts.eigenvectors().col(2));
        const double squaredCosine = std::clamp(parts.eigenvalues()[2] / weight, 0.0, 1.0);
        this->Sampled.dispersion[voxel] = radian * std::acos(std::sqrt(squaredCosine));
      }
    }
  }

  SampledSubstrate& Sampled;
  double LargestPart;
  bool WithPeaks;
  std::vector<double> Largest; ///< volume of the largest fibre
  std::vector<Eigen::Matrix3d> Tensors;
  std::map<int, std::vector<Eigen::Matrix3d>> BundleTensors;
};

/// Returns the volume (µm³) of each voxel's part in the domain.
std::vector<double> volumesInDomain(const Domain& domain, const VoxelBoxes& voxels)
{
  std::array<std::vector<double>, 3> lengths;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < voxels.count[std::size_t(axis)]; ++i)
    {
      const double left = domain.size()[axis] - i * voxels.spacing;
      // If the voxel size divides the domain, the last voxel may be off by rounding.
      lengths[std::size_t(axis)].push_back(left > (1.0 - 1e-6) * voxels.spacing ? voxels.spacing : left);
    }
  }
  std::vector<double> volumes;
  volumes.reserve(voxels.size());
  for (const double z : lengths[2])
  {
    for (const double y : lengths[1])
    {
      for (const double x : lengths[0])
      {
        volumes.push_back(x * y * z);
      }
    }
  }
  return volumes;
}

/// Samples fibres one by one, independently.
class FibreSampler
{
public:
  FibreSampler(const VoxelBoxes& voxels, const FibreSurfaces& outer, const FibreSurfaces& inner, const Fibres* fibres, int order)
    : Voxels(voxels)
    , Outer(outer)
    , Inner(inner)
    , Lines(fibres)
    , Order(order)
  {
    this->Ids = outer.fibreIds;
    this->Ids.insert(this->Ids.end(), inner.fibreIds.begin(), inner.fibreIds.end());
    std::sort(this->Ids.begin(), this->Ids.end());
    this->Ids.erase(std::unique(this->Ids.begin(), this->Ids.end()), this->Ids.end());
    for (std::size_t f = 0; fibres != nullptr && f < fibres->size(); ++f)
    {
      this->LineOf[fibres->fibreIds[f]] = f;
    }
  }

  std::size_t size() const { return this->Ids.size(); }

  SampledFibre sample(std::size_t i) const
  {
    SampledFibre fibre;
    fibre.fibreId = this->Ids[i];
    const auto outerPlace = this->Outer.placeOf(fibre.fibreId);
    const auto innerPlace = this->Inner.placeOf(fibre.fibreId);
    if (innerPlace)
    {
      fibre.bundleId = this->Inner.bundleIds[*innerPlace];
      fibre.inner = this->volumesOf(this->Inner.mesh(*innerPlace), fibre);
    }
    if (outerPlace)
    {
      fibre.bundleId = this->Outer.bundleIds[*outerPlace];
      fibre.outer = this->volumesOf(this->Outer.mesh(*outerPlace), fibre);
    }
    else
    {
      fibre.outer = fibre.inner;
    }
    const auto line = this->LineOf.find(fibre.fibreId);
    if (this->Lines != nullptr)
    {
      const std::size_t size = fibre.outer.volumes.size();
      fibre.directions = line != this->LineOf.end()
                           ? voxelDirections(*this->Lines, line->second, this->Voxels, fibre.outer, this->Order)
                           : VoxelDirections{ std::vector<Eigen::Matrix3d>(size, Eigen::Matrix3d::Zero()),
                               std::vector<std::vector<double>>(size) };
    }
    return fibre;
  }

private:
  VoxelVolumes volumesOf(const TriangleMesh& mesh, SampledFibre& fibre) const
  {
    fibre.openSurfaces += checkSurface(mesh).sound() ? 0 : 1;
    return voxelVolumes(mesh, this->Voxels);
  }

  const VoxelBoxes& Voxels;
  const FibreSurfaces& Outer;
  const FibreSurfaces& Inner;
  const Fibres* Lines;
  int Order; ///< of spherical harmonics; below 0 for none
  std::vector<int> Ids;
  std::map<int, std::size_t> LineOf;
};

} // namespace

const PropertyList<SubstrateSamplerOptions>& SubstrateSamplerOptions::properties()
{
  static const auto list =
    PropertyList<SubstrateSamplerOptions>()
      .add("VoxelSize", &SubstrateSamplerOptions::voxelSize, sampledVoxel, "Edge of a voxel in µm.")
      .add("HarmonicsOrder", &SubstrateSamplerOptions::harmonics, { "None", "2", "4", "6", "8", "10", "12" },
        "Maximum order (lmax) of the spherical harmonics of the fibre orientation distribution, in MRtrix's basis and order: "
        "array FOD. Its integral over the sphere is the fibre volume fraction.")
      .add("Peaks", &SubstrateSamplerOptions::peaks,
        "Add the array Peaks: the axes of the three bundles that fill most of each voxel, in MRtrix's format. The length of an "
        "axis is the fraction that its bundle fills.");
  return list;
}

VoxelBoxes samplerGrid(const Domain& domain, const SubstrateSamplerOptions& options)
{
  validateProperties(options);
  VoxelBoxes voxels;
  voxels.origin = domain.lower;
  voxels.spacing = options.voxelSize;
  double size = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    // If the voxel size divides the domain up to rounding, no further voxel is needed.
    const double count = std::max(1.0, std::ceil(domain.size()[axis] / options.voxelSize - 1e-6));
    size *= count;
    if (size > double(std::numeric_limits<int>::max()))
    {
      throw InvalidInput(
        text("VoxelSize ", options.voxelSize, " makes more voxels of the domain than can be counted: choose a larger one"));
    }
    voxels.count[std::size_t(axis)] = int(count);
  }
  return voxels;
}

SampledSubstrate sampleSubstrate(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const Fibres* fibres, const SubstrateSamplerOptions& options, const Context& context)
{
  SampledSubstrate sampled;
  sampled.voxels = samplerGrid(domain, options);
  sampled.harmonicsOrder = 2 * int(options.harmonics);
  const int order = sampled.harmonicsOrder > 0 ? sampled.harmonicsOrder : -1;
  if (fibres == nullptr && (order > 0 || options.peaks))
  {
    throw InvalidInput(
      text(order > 0 ? "HarmonicsOrder" : "Peaks", " asks for directions, which only centre lines have: connect Fibres"));
  }
  const FibreSampler sampler(sampled.voxels, outer, inner, fibres, order);
  require(sampler.size() > 0, "there are no surfaces to sample: connect MyelinSurface's Outer and Inner");
  std::set<int> bundles(outer.bundleIds.begin(), outer.bundleIds.end());
  bundles.insert(inner.bundleIds.begin(), inner.bundleIds.end());
  const double each = (fibres != nullptr ? 160.0 : 56.0) + (order > 0 ? 12.0 * double(harmonicCount(order)) : 0.0) +
                      (options.peaks ? 108.0 : 0.0) + (options.peaks ? 84.0 : 12.0) * double(bundles.size());
  const double bytes = each * double(sampled.voxels.size());
  requireMemory(bytes, text("VoxelSize ", options.voxelSize), "choose a larger VoxelSize");
  const std::vector<double> volumes = volumesInDomain(domain, sampled.voxels);
  Collector collector(sampled, *std::max_element(volumes.begin(), volumes.end()), fibres != nullptr, options.peaks);
  for (std::size_t begin = 0; begin < sampler.size(); begin += batch)
  {
    std::vector<SampledFibre> some(std::min(batch, sampler.size() - begin));
    const auto share = [&](std::size_t done) { return double(done) / double(sampler.size()); };
    parallelFor(
      some.size(), context, [&](std::size_t i) { some[i] = sampler.sample(begin + i); }, "Sampling fibres", share(begin),
      share(begin + some.size()));
    for (const SampledFibre& fibre : some)
    {
      sampled.openSurfaces += fibre.openSurfaces;
      collector.add(fibre);
    }
  }
  collector.finish(volumes);
  return sampled;
}

} // namespace cactus
