// SPDX-License-Identifier: BSD-3-Clause
#include "io/SphereTable.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"
#include "io/StrandFile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace cactus
{

namespace
{

constexpr double closestSpheres = 1e-6; // µm

/// The parts of a line between blanks or commas.
std::vector<std::string_view> partsOf(std::string_view line)
{
  constexpr char separators[] = " \t\r,;";
  std::vector<std::string_view> parts;
  for (std::size_t from = line.find_first_not_of(separators); from != std::string_view::npos;)
  {
    const std::size_t to = std::min(line.find_first_of(separators, from), line.size());
    parts.push_back(line.substr(from, to - from));
    from = line.find_first_not_of(separators, to);
  }
  return parts;
}

/// Where in a line the columns are.
struct SphereColumns
{
  std::size_t type = 0;
  std::size_t axon = 0;
  std::size_t centre[3] = {};
  std::size_t radius = 0;
  std::size_t innerRadius = 0; ///< the same as radius in a table without inner radii
  std::size_t count = 0;
};

/// Nothing where the names are not those of such a table.
std::optional<SphereColumns> columnsOf(const std::string& header)
{
  const std::vector<std::string_view> names = partsOf(header);
  const auto find = [&](std::initializer_list<const char*> candidates, std::size_t& column)
  {
    const auto found = std::find_first_of(names.begin(), names.end(), candidates.begin(), candidates.end());
    column = static_cast<std::size_t>(found - names.begin());
    return found != names.end();
  };
  SphereColumns columns;
  columns.count = names.size();
  const bool isWhole = find({ "cell_type", "Type" }, columns.type) && find({ "cell_id", "id_cell", "id_ax" }, columns.axon) &&
                       find({ "X" }, columns.centre[0]) && find({ "Y" }, columns.centre[1]) && find({ "Z" }, columns.centre[2]) &&
                       find({ "outer_radius", "Rout", "R" }, columns.radius);
  if (!find({ "inner_radius", "Rin" }, columns.innerRadius))
  {
    columns.innerRadius = columns.radius;
  }
  return isWhole ? std::optional<SphereColumns>(columns) : std::nullopt;
}

/// Reads spheres line by line, and makes fibres of them.
class SphereReader
{
public:
  SphereReader(const std::string& name, const SphereColumns& columns, double side)
    : Name(name)
    , Columns(columns)
    , Side(side)
  {
  }

  void take(const std::string& line, std::size_t number)
  {
    const std::vector<std::string_view> parts = partsOf(line);
    if (parts.empty())
    {
      return;
    }
    if (parts.size() != this->Columns.count)
    {
      throw FileError(text(this->Name, ", line ", number, ": expected ", this->Columns.count,
        " columns as in the first line, found ", parts.size(), ": '", excerpt(line), "'"));
    }
    const std::string_view type = parts[this->Columns.type];
    if (type != "axon")
    {
      ++this->LeftOut[std::string(type)];
      return;
    }
    const double axon = this->number(parts[this->Columns.axon], "the axon's number", number);
    if (!limits::id.holds(axon + 1.0) || axon != std::floor(axon))
    {
      throw FileError(
        text(this->Name, ", line ", number, ": the axon's number is ", axon, ": a whole number from 0 on is expected"));
    }
    if (!this->Points.empty() && axon != this->Axon)
    {
      this->finishAxon();
    }
    this->Axon = axon;
    Eigen::Vector3d centre;
    for (int axis = 0; axis < 3; ++axis)
    {
      centre[axis] = this->number(parts[this->Columns.centre[axis]], "a coordinate", number);
    }
    const double radius = this->number(parts[this->Columns.radius], "the radius", number);
    const bool hasInner = this->Columns.innerRadius != this->Columns.radius;
    const double inner = hasInner ? this->number(parts[this->Columns.innerRadius], "the inner radius", number) : 0.0;
    if (!this->Points.empty() && (centre - this->Points.back()).norm() <= closestSpheres)
    {
      this->Radii.back() = std::max(this->Radii.back(), radius);
      this->InnerRadii.back() = std::max(this->InnerRadii.back(), inner);
      return;
    }
    this->Points.push_back(centre);
    this->Radii.push_back(radius);
    this->InnerRadii.push_back(inner);
  }

  FibresOfFile finish()
  {
    if (!this->Points.empty())
    {
      this->finishAxon();
    }
    if (this->Read.fibres.size() == 0)
    {
      throw FileError(this->Name + ": there is no axon of at least two spheres in this table");
    }
    if (this->Side <= 0.0)
    {
      if (this->Largest <= 0.0)
      {
        throw FileError(
          this->Name + ": all axons lie outside of the voxel, which reaches from the origin to positive coordinates");
      }
      this->Side = this->Largest;
      this->Read.remarks.push_back(text("the side of the voxel is not known: Domain is the cube from the origin to ", this->Side,
        " µm, the largest coordinate of the axons' spheres. CATERPillar writes the side to NAME_growth_info.txt: put that file "
        "beside the table"));
    }
    this->Read.fibres.domain.lower.setZero();
    this->Read.fibres.domain.upper.setConstant(this->Side);
    for (const auto& [type, spheres] : this->LeftOut)
    {
      this->Read.remarks.push_back(
        text(spheres, " sphere(s) of type ", excerpt(type), " are left out, since only axons become fibres"));
    }
    if (this->Single > 0)
    {
      this->Read.remarks.push_back(text(this->Single, " axon(s) of a single sphere are left out"));
    }
    return std::move(this->Read);
  }

private:
  double number(std::string_view part, const char* meaning, std::size_t line) const
  {
    double value = 0.0;
    std::string_view rest = part;
    if (!takeNumber(rest, value) || !rest.empty())
    {
      throw FileError(text(this->Name, ", line ", line, ": expected ", meaning, ", found '", excerpt(part), "'"));
    }
    return value;
  }

  void finishAxon()
  {
    if (this->Points.size() == 1)
    {
      ++this->Single;
    }
    else
    {
      this->Read.fibres.addFibre(static_cast<int>(this->Axon) + 1, 1, 1.0);
      for (std::size_t i = 0; i < this->Points.size(); ++i)
      {
        this->Read.fibres.addPoint(this->Points[i], this->Radii[i]);
        this->Largest = std::max(this->Largest, this->Points[i].maxCoeff());
        this->GRatios.add(this->InnerRadii[i], this->Radii[i]);
      }
      this->GRatios.give(this->Read.fibres);
      this->Read.fibres.targetRadii.back() = rootMeanSquareRadius(this->Read.fibres, this->Read.fibres.size() - 1);
    }
    this->Points.clear();
    this->Radii.clear();
    this->InnerRadii.clear();
  }

  std::string Name;
  SphereColumns Columns;
  double Side; ///< of the voxel; 0 where it is not known
  FibresOfFile Read;
  double Axon = 0.0; ///< whose spheres these are
  std::vector<Eigen::Vector3d> Points;
  std::vector<double> Radii;
  std::vector<double> InnerRadii; ///< 0 where the table has none
  GRatiosOfFile GRatios;
  double Largest = 0.0;
  std::size_t Single = 0;
  std::map<std::string, std::size_t> LeftOut; ///< spheres by type
};

} // namespace

FibresOfFile readSphereTable(std::istream& stream, const std::string& name, double side)
{
  std::string line;
  std::getline(stream, line);
  if (line.compare(0, 3, "\xef\xbb\xbf") == 0)
  {
    line.erase(0, 3); // the mark that some editors put before UTF-8
  }
  const auto columns = columnsOf(line);
  if (!columns)
  {
    throw FileError(name + ", line 1: '" + excerpt(line) +
                    "' is neither the side of a cube, as in a strand file, nor the names of columns that CATERPillar writes "
                    "(cell_type cell_id … X Y Z inner_radius outer_radius)");
  }
  SphereReader reader(name, *columns, side);
  for (std::size_t number = 2; std::getline(stream, line); ++number)
  {
    reader.take(line, number);
  }
  FibresOfFile read = reader.finish();
  validateFile(read.fibres, name);
  return read;
}

bool isSphereTable(const std::string& firstLine)
{
  return columnsOf(firstLine).has_value();
}

double sideBesideTable(const std::string& path)
{
  const std::filesystem::path table(path);
  const std::string name = table.stem().string();
  std::vector<std::string> candidates{ name + "_growth_info.txt", name + "_info.txt" };
  if (const std::size_t last = name.rfind('_'); last != std::string::npos)
  {
    candidates.push_back(name.substr(0, last) + "_growth_info" + name.substr(last) + ".txt");
  }
  for (const std::string& candidate : candidates)
  {
    std::ifstream file(table.parent_path() / candidate);
    for (std::string line; std::getline(file, line);)
    {
      constexpr std::string_view title = "Voxel Size ";
      std::string_view rest(line);
      double side = 0.0;
      if (rest.substr(0, title.size()) != title)
      {
        continue;
      }
      rest.remove_prefix(title.size());
      if (takeNumber(rest, side) && side > 0.0)
      {
        return side;
      }
    }
  }
  return 0.0;
}

} // namespace cactus
