// SPDX-License-Identifier: BSD-3-Clause
#include "io/RmsFiles.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "judge/SubstrateSampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace cactus
{

namespace
{

constexpr double squareMetrePerSecond = 1e9;  ///< µm²/ms
constexpr double secondPerSquareMetre = 1e-9; ///< ms/µm²
constexpr double second = 1e3;                ///< ms
constexpr double noRelaxation = 1e9;          ///< ms, since T2 has to be positive
constexpr double mostOfAVoxel = 0.5;          ///< largest step; RMS looks for walls one voxel ahead
constexpr double savedMoments = 1000.0;       ///< the number of steps has to be a multiple of this

/// The voxels with walkers.
using WalkerVoxels = std::vector<bool>;

SubstrateSamplerOptions voxelsOf(double voxelSize)
{
  SubstrateSamplerOptions options;
  options.voxelSize = voxelSize;
  return options;
}

/// Returns the voxels inside the axons, or inside the fibres if there are no inner surfaces at all.
WalkerVoxels insideVoxels(const SampledSubstrate& sampled, bool hasInner)
{
  WalkerVoxels inside(sampled.voxels.size());
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    inside[i] = hasInner ? sampled.compartment[i] == Compartment::Axon : sampled.compartment[i] != Compartment::ExtraAxonal;
  }
  return inside;
}

WalkerVoxels outsideVoxels(const SampledSubstrate& sampled)
{
  WalkerVoxels outside(sampled.voxels.size());
  for (std::size_t i = 0; i < outside.size(); ++i)
  {
    outside[i] = sampled.compartment[i] == Compartment::ExtraAxonal;
  }
  return outside;
}

/// Throws if two fibres' voxels share a face.
void requireApart(const SampledSubstrate& sampled, const WalkerVoxels& inside)
{
  const std::array<int, 3>& count = sampled.voxels.count;
  const std::array<std::size_t, 3> step{ { 1, std::size_t(count[0]), std::size_t(count[0]) * std::size_t(count[1]) } };
  for (std::size_t voxel = 0; voxel < inside.size(); ++voxel)
  {
    for (std::size_t axis = 0; inside[voxel] && axis < 3; ++axis)
    {
      const bool isLast = voxel / step[axis] % std::size_t(count[axis]) + 1 == std::size_t(count[axis]);
      const std::size_t next = isLast ? voxel : voxel + step[axis];
      if (inside[next] && sampled.fibreId[voxel] != sampled.fibreId[next])
      {
        throw InvalidInput(text("VoxelSize ", sampled.voxels.spacing, " µm: voxels inside fibres ", sampled.fibreId[voxel],
          " and ", sampled.fibreId[next], " share a face, and walkers would go from one into the other: choose a smaller one"));
      }
    }
  }
}

void writeLabels(
  const WalkerVoxels& hasWalkers, const VoxelBoxes& voxels, const std::string& path, FolderWriter& writer, const Context& context)
{
  if (std::find(hasWalkers.begin(), hasWalkers.end(), true) == hasWalkers.end())
  {
    throw InvalidInput(
      text("VoxelSize ", voxels.spacing, " µm leaves no voxel to the walkers of ", path, ": choose a smaller one"));
  }
  writer.writeBy(path,
    [&](const std::string& place)
    {
      AtomicFile file(place);
      std::string line;
      for (int i = 0; i < voxels.count[0]; ++i)
      {
        context.checkpoint();
        for (int j = 0; j < voxels.count[1]; ++j)
        {
          line.clear();
          for (int k = 0; k < voxels.count[2]; ++k)
          {
            line += hasWalkers[voxels.index(i, j, k)] ? "1 " : "0 ";
          }
          file.stream() << line;
        }
      }
      file.commit();
    });
}

/// Returns the parameters, with enough time steps to keep a step below mostOfAVoxel.
std::string parameterText(const McdcOptions& options, const VoxelBoxes& voxels)
{
  const double reach = mostOfAVoxel * voxels.spacing;
  const double longest = reach * reach / (6.0 * squareMetrePerSecond * options.diffusivity);
  const double duration = second * options.echoTime;
  const double steps = savedMoments * std::ceil(duration / longest / savedMoments);
  TextStream out;
  out.precision(9);
  out << duration / steps << '\n'
      << static_cast<long long>(steps) << '\n'
      << options.walkers << '\n'
      << options.bValues.size() * std::size_t(options.directions) << '\n'
      << "2\n"
      << voxels.spacing << '\n';
  for (const int count : voxels.count)
  {
    out << count << '\n';
  }
  return out.str();
}

std::string bValueText(const McdcOptions& options)
{
  TextStream out;
  out.precision(9);
  for (const double b : options.bValues)
  {
    for (int i = 0; i < options.directions; ++i)
    {
      out << secondPerSquareMetre * b << '\n';
    }
  }
  return out.str();
}

std::string directionText(const McdcOptions& options)
{
  TextStream out;
  out.precision(9);
  const auto directions = mcdcDirections(options.directions);
  for (std::size_t i = 0; i < options.bValues.size(); ++i)
  {
    for (const Eigen::Vector3d& direction : directions)
    {
      out << direction[0] << '\n' << direction[1] << '\n' << direction[2] << '\n';
    }
  }
  return out.str();
}

} // namespace

void requireRmsVoxels(const Domain& domain, double voxelSize)
{
  const VoxelBoxes voxels = samplerGrid(domain, voxelsOf(voxelSize));
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = domain.size()[axis];
    const int count = voxels.count[std::size_t(axis)];
    if (std::fabs(count * voxels.spacing - side) > 1e-6 * side)
    {
      std::string fitting;
      appendNumber(fitting, side / count, 9);
      throw InvalidInput(text("VoxelSize ", voxels.spacing, " µm does not divide the domain's side of ", side,
        " µm, at whose end RMS mirrors the voxels: choose one that does, such as ", fitting));
    }
  }
}

void writeRms(const SubstrateFolderContents& contents, FolderWriter& writer, const Context& context)
{
  requireRmsVoxels(contents.domain, contents.voxelSize);
  const SampledSubstrate sampled =
    sampleSubstrate(contents.domain, contents.outer, contents.inner, nullptr, voxelsOf(contents.voxelSize), context);
  const auto simulate = [&](const std::string& folder, const WalkerVoxels& hasWalkers)
  {
    TextStream diffusivity;
    diffusivity << "0\n" << squareMetrePerSecond * contents.mcdc.diffusivity << '\n';
    TextStream relaxation;
    relaxation << noRelaxation << '\n' << noRelaxation << '\n';
    writer.makeFolder(folder);
    writeLabels(hasWalkers, sampled.voxels, folder + "/fiber.txt", writer, context);
    writer.write(folder + "/simParamInput.txt", parameterText(contents.mcdc, sampled.voxels));
    writer.write(folder + "/diffusivity.txt", diffusivity.str());
    writer.write(folder + "/T2.txt", relaxation.str());
    writer.write(folder + "/bval.txt", bValueText(contents.mcdc));
    writer.write(folder + "/bvec.txt", directionText(contents.mcdc));
  };
  const WalkerVoxels inside = insideVoxels(sampled, contents.inner.size() > 0);
  requireApart(sampled, inside);
  simulate("intra", inside);
  if (contents.outer.size() > 0)
  {
    simulate("extra", outsideVoxels(sampled));
  }
}

} // namespace cactus
