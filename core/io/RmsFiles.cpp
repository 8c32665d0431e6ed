// SPDX-License-Identifier: BSD-3-Clause
#include "io/RmsFiles.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "judge/LabelPieces.h"
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
constexpr double noRelaxation = 1e9;          ///< ms, of a T2 that has to be positive
constexpr double mostOfAVoxel = 0.5;          ///< that a step leads through; RMS looks for walls one voxel ahead
constexpr double savedMoments = 1000.0;       ///< of which the number of steps has to be a multiple
constexpr double mostLost = 0.1;              ///< of a compartment's volume, or out of its connected part
constexpr double mostNear = 0.1;              ///< of the fibres, that come nearer to another one than a voxel

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

/// A compartment as labels have it, beside its surfaces.
struct Labelled
{
  std::string what; ///< that has walkers
  LabelPieces pieces;
  double fraction = 0.0; ///< of the domain, by the labels
  double exact = 0.0;    ///< by the surfaces; NaN where they do not tell

  /// Whether hardly a voxel is cut off from the others.
  bool isConnected() const { return this->pieces.connectedShare() >= 1.0 - mostLost; }
  /// Whether hardly any of the volume is missing.
  bool isWhole() const { return !(this->fraction < (1.0 - mostLost) * this->exact); }
  std::string sentence() const
  {
    return text(this->what, " fall into ", this->pieces.pieces, " pieces, ", percent(this->pieces.connectedShare()),
      " of them connected, and fill ", this->fraction, " of the domain, where the surfaces have ", this->exact);
  }

private:
  static std::string percent(double share) { return text(0.1 * std::floor(1000.0 * share), " %"); }
};

Labelled labelled(const std::string& what, const SampledSubstrate& sampled, const WalkerVoxels& hasWalkers,
  const std::vector<int>& owner, double exact, const Context& context)
{
  Labelled found;
  found.what = what;
  found.pieces = labelPieces(sampled.voxels, hasWalkers, owner, context);
  found.fraction = double(found.pieces.voxels) / double(sampled.voxels.size());
  found.exact = exact;
  return found;
}

/// What to do where gaps are narrower than a voxel: those as wide as one keep the space between fibres together, see
/// docs/simulators/rms.md.
std::string wayOut(double voxelSize, double smallestGap)
{
  std::string way = text("grow with a MinimumGap of ", voxelSize, " µm or more");
  if (smallestGap > 0.0)
  {
    way += text(", or choose a VoxelSize no larger than the smallest gap, ", smallestGap, " µm");
  }
  return way;
}

/// Fibres that come nearer to another one than a voxel is wide.
std::size_t nearFibres(const SubstrateCertificate& certificate, double voxelSize)
{
  return std::size_t(std::count_if(certificate.fibres.begin(), certificate.fibres.end(),
    [&](const FibreCertificate& fibre) { return fibre.hasOuter && fibre.gap < voxelSize; }));
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

void writeRms(const SubstrateFolderContents& contents, WrittenSubstrate& substrate, FolderWriter& writer, const Context& context)
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
  const SubstrateCertificate& found = substrate.certificate;
  const bool hasInner = contents.inner.size() > 0;
  const WalkerVoxels inside = insideVoxels(sampled, hasInner);
  requireApart(sampled, inside);
  const Labelled intra = labelled(
    text("voxels inside the ", hasInner ? contents.inner.size() : contents.outer.size(), hasInner ? " axons" : " fibres"),
    sampled, inside, sampled.fibreId, hasInner ? found.axonVolumeFraction : found.fibreVolumeFraction, context);
  if (!intra.isConnected())
  {
    throw InvalidInput(text("VoxelSize ", contents.voxelSize, " µm: ", intra.sentence(),
      ", so that RMS would find diffusion along them too slow: choose a smaller one"));
  }
  simulate("intra", inside);
  substrate.notes.push_back("Labels: " + intra.sentence());
  if (!intra.isWhole())
  {
    substrate.remarks.push_back(
      text("VoxelSize ", contents.voxelSize, " µm is too large for thin axons: ", intra.sentence(), "; choose a smaller one"));
  }
  if (contents.outer.size() == 0)
  {
    return;
  }
  const WalkerVoxels outside = outsideVoxels(sampled);
  const Labelled extra = labelled("voxels outside", sampled, outside, {}, 1.0 - found.fibreVolumeFraction, context);
  if (!extra.isConnected() || !extra.isWhole())
  {
    substrate.remarks.push_back(text("extra/ is left out, since RMS would find diffusion there far too slow: with VoxelSize ",
      contents.voxelSize, " µm ", extra.sentence(), ": ", wayOut(contents.voxelSize, found.smallestGap)));
    return;
  }
  simulate("extra", outside);
  substrate.notes.push_back("Labels: " + extra.sentence());
  const std::size_t near = nearFibres(found, contents.voxelSize);
  if (double(near) > mostNear * double(contents.outer.size()))
  {
    substrate.remarks.push_back(text("RMS may find diffusion in extra/ too slow across the fibres: ", near, " of ",
      contents.outer.size(), " fibres come nearer to another one than a voxel, ", contents.voxelSize,
      " µm, where their gap is lost: ", wayOut(contents.voxelSize, found.smallestGap)));
  }
}

} // namespace cactus
