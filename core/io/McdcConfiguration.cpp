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

constexpr double gyromagneticRatio = 267.51525e6; ///< rad/(s·T), as in the simulator

void writeBox(std::ostream& out, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper)
{
  for (const Eigen::Vector3d& corner : { lower, upper })
  {
    out << micrometre * corner[0] << ' ' << micrometre * corner[1] << ' ' << micrometre * corner[2] << '\n';
  }
}

} // namespace

double McdcOptions::displacement() const
{
  return 1e6 * std::sqrt(2.0 * diffusivity * echoTime);
}

std::string mcdcConfiguration(const McdcOptions& options, const Domain& domain, const std::string& plyList,
  const std::string& scheme, const std::string& outputPrefix, const std::string& compartment)
{
  const Eigen::Vector3d margin = (0.25 * domain.size()).cwiseMin(options.displacement());
  const Eigen::Vector3d room = Eigen::Vector3d::Constant(10.0 * options.displacement());
  TextStream out;
  out.precision(9);
  out << "N " << options.walkers << '\n'
      << "T " << options.steps << '\n'
      << "duration " << options.echoTime << '\n'
      << "diffusivity " << options.diffusivity << '\n'
      << "exp_prefix " << outputPrefix << '\n'
      << "scheme_file " << scheme << '\n'
      << "scale_from_stu 1\n"
      << "write_txt 1\n"
      << "write_bin 0\n"
      << "write_traj_file 0\n";
  if (options.permeability > 0.0)
  {
    // For all obstacles, too: otherwise the simulator counts crossings as its own errors.
    out << "permeability " << options.permeability << '\n';
  }
  out << "<obstacle>\n"
      << (options.permeability > 0.0 ? "ply_file_list_scale_permeability " : "ply_file_list ") << plyList << '\n'
      << "</obstacle>\n"
      << "<voxels>\n";
  writeBox(out, domain.lower - room, domain.upper + room);
  out << "</voxels>\n"
      << "<spawning_area>\n";
  writeBox(out, domain.lower + margin, domain.upper - margin);
  out << "</spawning_area>\n"
      << "ini_walkers_pos " << compartment << '\n'
      << "num_process 1\n"
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
