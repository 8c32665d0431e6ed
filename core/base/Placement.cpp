// SPDX-License-Identifier: BSD-3-Clause
#include "base/Placement.h"

#include "base/Error.h"
#include "base/Limits.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace cactus
{

namespace
{

/// Ten metres to either side of the scanner.
constexpr Range placedPosition{ -1e4, 1e4, " mm" };
constexpr Range rotation{ -360.0, 360.0, "°" };
constexpr Range placedScale{ 1e-3, 1e6 };

} // namespace

Eigen::Vector3d Placement::toSubstrate(const Eigen::Vector3d& point) const
{
  constexpr double parts = double(1 << 26);
  const Eigen::Vector3d exact = this->axes.transpose() * (point - this->position) / this->scale;
  return (exact * parts).array().round() / parts;
}

Placement Placement::in(LengthUnit unit) const
{
  const double units = micrometresIn(LengthUnit::Millimetre) / micrometresIn(unit);
  Placement placement = *this;
  placement.scale *= units;
  placement.position *= units;
  return placement;
}

std::array<double, 16> Placement::matrix() const
{
  std::array<double, 16> rows{};
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      rows[4 * row + column] = this->scale * this->axes(Eigen::Index(row), Eigen::Index(column));
    }
    rows[4 * row + 3] = this->position[Eigen::Index(row)];
  }
  rows[15] = 1.0;
  return rows;
}

Placement Placement::of(const std::array<double, 16>& matrix)
{
  using Rows = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Map<const Rows> rows(matrix.data());
  const Eigen::Matrix3d linear = rows.topLeftCorner<3, 3>();
  Placement placement;
  placement.scale = std::cbrt(linear.determinant());
  placement.axes = linear / placement.scale;
  placement.position = rows.topRightCorner<3, 1>();
  constexpr double rounding = 1e-6;
  if (!rows.allFinite() || !(placement.scale > 0.0) || !placement.axes.isUnitary(rounding) ||
      rows.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
  {
    throw InvalidInput("the field data Placement is no rotation with one scale and a position: apply Placement to what it was "
                       "made of, or remove it");
  }
  return placement;
}

const PropertyList<PlacementOptions>& PlacementOptions::properties()
{
  using Options = PlacementOptions;
  static const auto list =
    PropertyList<Options>()
      .add("Place", &Options::by, { "By position", "On its tract" },
        "Where the substrate goes: to a position that is given here, or to the place on the tract that TractFibres has laid its "
        "fibres along, as large as that tract is.")
      .add("PositionX", &Options::positionX, placedPosition,
        "Position of the substrate's origin (the middle of its domain) along x, in mm.")
      .where("Place", { 0 })
      .add("PositionY", &Options::positionY, placedPosition,
        "Position of the substrate's origin (the middle of its domain) along y, in mm.")
      .where("Place", { 0 })
      .add("PositionZ", &Options::positionZ, placedPosition,
        "Position of the substrate's origin (the middle of its domain) along z, in mm.")
      .where("Place", { 0 })
      .add("RotationX", &Options::rotationX, rotation,
        "Rotation in degrees about x. It follows that about y, as in ParaView's own Transform.")
      .where("Place", { 0 })
      .add("RotationY", &Options::rotationY, rotation,
        "Rotation in degrees about y. It comes first, as in ParaView's own Transform.")
      .where("Place", { 0 })
      .add(
        "RotationZ", &Options::rotationZ, rotation, "Rotation in degrees about z. It comes last, as in ParaView's own Transform.")
      .where("Place", { 0 })
      .add("ScaleFactor", &Options::scaleFactor, placedScale,
        "Length in the image's space over the same length in the substrate. 1: true size; 1000 shows 1 µm as 1 mm.")
      .where("Place", { 0 });
  return list;
}

Placement PlacementOptions::placement() const
{
  validateProperties(*this);
  const auto turn = [](double angle, const Eigen::Vector3d& axis) { return Eigen::AngleAxisd(angle * degree, axis); };
  Placement placement;
  placement.axes = (turn(rotationZ, Eigen::Vector3d::UnitZ()) * turn(rotationX, Eigen::Vector3d::UnitX()) *
                    turn(rotationY, Eigen::Vector3d::UnitY()))
                     .toRotationMatrix();
  placement.scale = micrometre * scaleFactor;
  placement.position = { positionX, positionY, positionZ };
  return placement;
}

} // namespace cactus
