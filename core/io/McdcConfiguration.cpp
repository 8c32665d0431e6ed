// SPDX-License-Identifier: BSD-3-Clause
#include "io/McdcConfiguration.h"

#include "base/Constants.h"
#include "base/Numbers.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

constexpr double gyromagneticRatio = 267.51525e6; ///< rad/(s·T), as the simulator has it
/// Steps outside fibres (µm). Longer ones do not see the pores: 0.29 µm made diffusion across fibres 7 % too slow.
constexpr double extraStep = 0.05;
/// Steps inside (µm), however wide the axons are.
constexpr double longestIntraStep = 0.3;
/// How far the simulator looks for triangles, over the free displacement √(6 D t) in three dimensions.
constexpr double sphereSize = 0.12;

Domain startBox(const Domain& domain, const Eigen::Vector3d& margin)
{
  return { domain.lower + margin, domain.upper - margin };
}

/// Returns a distance from the faces, 0 for periodic ones.
Eigen::Vector3d alongWalls(const Domain& domain, Eigen::Vector3d distance)
{
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    distance[axis] = domain.periodic[static_cast<std::size_t>(axis)] ? 0.0 : distance[axis];
  }
  return distance;
}

void writeBox(std::ostream& out, const Domain& box)
{
  for (const Eigen::Vector3d& corner : { box.lower, box.upper })
  {
    out << micrometre * corner[0] << ' ' << micrometre * corner[1] << ' ' << micrometre * corner[2] << '\n';
  }
}

} // namespace

double McdcOptions::displacement() const
{
  return 1e6 * std::sqrt(2.0 * diffusivity * echoTime);
}

McdcSimulation intraSimulation(const McdcOptions& options, const Domain& domain, bool goOn, double smallestRadius)
{
  const Eigen::Vector3d margin = (0.25 * domain.size()).cwiseMin(options.displacement());
  return { "intra", std::clamp(smallestRadius, extraStep, longestIntraStep),
    startBox(domain, goOn ? alongWalls(domain, margin) : margin) };
}

McdcSimulation extraSimulation(const McdcOptions& options, const Domain& domain)
{
  const Eigen::Vector3d margin = (0.375 * domain.size()).cwiseMin(4.0 * options.displacement());
  return { "extra", extraStep, startBox(domain, alongWalls(domain, margin)) };
}

int mcdcSteps(const McdcOptions& options, double longestStep)
{
  const double squared = 3.0 * std::pow(options.displacement() / longestStep, 2);
  const double unit = std::max(1.0, std::pow(10.0, std::floor(std::log10(squared)) - 1.0));
  return static_cast<int>(unit * (std::floor(squared / unit) + 1.0));
}

std::string mcdcConfiguration(const McdcOptions& options, const Domain& domain, const McdcSimulation& simulation)
{
  // The simulator repeats this box: around a periodic domain, it is the period.
  const Eigen::Vector3d room = alongWalls(domain, Eigen::Vector3d::Constant(10.0 * options.displacement()));
  const std::string& compartment = simulation.compartment;
  const bool hasStarts = simulation.startPositions > 0;
  TextStream out;
  out.precision(9);
  out << "N " << (hasStarts ? simulation.startPositions : options.walkers) << '\n'
      << "T " << mcdcSteps(options, simulation.longestStep) << '\n'
      << "duration " << options.echoTime << '\n'
      << "diffusivity " << options.diffusivity << '\n'
      << "exp_prefix mcdc/output/" << compartment << '\n'
      << "scheme_file mcdc/pgse.scheme\n"
      << "scale_from_stu 1\n"
      << "write_txt 1\n"
      << "write_bin 0\n"
      << "write_traj_file 0\n"
      << "sphere_size " << sphereSize << '\n';
  if (options.permeability > 0.0)
  {
    // Else the simulator takes walkers that have crossed for its own errors. A line permeability would do that, too, but
    // overrules what the list says of each file.
    out << "deportation 0\n";
  }
  out << "<obstacle>\n"
      << (options.permeability > 0.0 ? "ply_file_list_scale_permeability " : "ply_file_list ") << "mcdc/" << compartment
      << "_ply_list.txt\n"
      << "</obstacle>\n"
      << "<voxels>\n";
  writeBox(out, { domain.lower - room, domain.upper + room });
  out << "</voxels>\n";
  if (hasStarts)
  {
    out << "ini_walkers_file start/" << compartment << ".txt\n";
  }
  else
  {
    out << "<spawning_area>\n";
    writeBox(out, simulation.start);
    out << "</spawning_area>\n"
        << "ini_walkers_pos " << compartment << '\n';
  }
  out << "num_process 1\n"
      << "<END>\n";
  return out.str();
}

std::string mcdcScheme(const McdcOptions& options)
{
  TextStream out;
  out.precision(9);
  const auto line = [&](const Eigen::Vector3d& direction, double gradient)
  {
    out << direction[0] << ' ' << direction[1] << ' ' << direction[2] << ' ' << gradient << ' ' << options.gradientSeparation
        << ' ' << options.gradientDuration << ' ' << options.echoTime << '\n';
  };
  out << "VERSION: STEJSKALTANNER\n";
  line({ 0.0, 0.0, 1.0 }, 0.0);
  const auto directions = mcdcDirections(options.directions);
  for (const double b : options.bValues)
  {
    // Stejskal & Tanner 1965: b = (γ G δ)² (Δ - δ / 3)
    const double gradient = std::sqrt(b / (options.gradientSeparation - options.gradientDuration / 3.0)) /
                            (gyromagneticRatio * options.gradientDuration);
    for (const Eigen::Vector3d& direction : directions)
    {
      line(direction, gradient);
    }
  }
  return out.str();
}

std::vector<Eigen::Vector3d> mcdcDirections(int count)
{
  const double golden = pi * (3.0 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (i + 0.5) / count;
    const double radius = std::sqrt(1.0 - z * z);
    directions.emplace_back(radius * std::cos(golden * i), radius * std::sin(golden * i), z);
  }
  return directions;
}

std::string mcdcPlyList(const std::vector<std::string>& paths, double permeability)
{
  TextStream out;
  out.precision(9);
  out << (permeability > 0.0 ? "" : "1e-3\n");
  for (const std::string& path : paths)
  {
    out << path;
    if (permeability > 0.0)
    {
      out << " 1e-3 " << permeability;
    }
    out << '\n';
  }
  return out.str();
}

} // namespace cactus
