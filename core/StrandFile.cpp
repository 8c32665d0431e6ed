// SPDX-License-Identifier: BSD-3-Clause
#include "StrandFile.h"

#include "AtomicFile.h"
#include "Error.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace cactus
{

namespace
{

/// Reads numbers and remembers the line it is on.
class NumberReader
{
public:
  NumberReader(const std::string& path)
    : Path(path)
    , File(path)
  {
    if (!this->File)
    {
      throw FileError("cannot open strand file " + path);
    }
  }

  double number(const std::string& meaning)
  {
    while (this->Cursor == nullptr || this->skipBlanks())
    {
      if (!std::getline(this->File, this->Text))
      {
        throw FileError(this->Path + ": the file ends after line " + std::to_string(this->Line) + ", where " + meaning +
                        " was expected: it is truncated");
      }
      ++this->Line;
      this->Cursor = this->Text.c_str();
    }
    char* end = nullptr;
    const double value = std::strtod(this->Cursor, &end);
    if (end == this->Cursor || !std::isfinite(value))
    {
      this->fail(meaning);
    }
    this->Cursor = end;
    return value;
  }

  std::size_t count(const std::string& meaning)
  {
    const double value = this->number(meaning);
    if (value < 0.0 || value != std::floor(value) || value > 1e12)
    {
      this->fail(meaning);
    }
    return static_cast<std::size_t>(value);
  }

private:
  bool skipBlanks()
  {
    while (*this->Cursor == ' ' || *this->Cursor == '\t' || *this->Cursor == '\r')
    {
      ++this->Cursor;
    }
    return *this->Cursor == '\0';
  }

  [[noreturn]] void fail(const std::string& meaning) const
  {
    throw FileError(this->Path + ", line " + std::to_string(this->Line) + ": expected " + meaning + ", found '" +
                    this->Text.substr(0, 60) + "'");
  }

  std::string Path;
  std::ifstream File;
  std::string Text;
  const char* Cursor = nullptr;
  std::size_t Line = 0;
};

} // namespace

Fibres readStrandFile(const std::string& path)
{
  NumberReader reader(path);
  Fibres fibres;
  const double side = reader.number("the side of the cube");
  if (side <= 0.0)
  {
    throw FileError(path + ", line 1: the side of the cube is " + std::to_string(side) + ", not a positive length");
  }
  fibres.domain = Domain::cube(side);
  const std::size_t strands = reader.count("the number of strands");
  for (std::size_t s = 0; s < strands; ++s)
  {
    const std::string strand = "strand " + std::to_string(s + 1);
    const std::size_t points = reader.count("the number of control points of " + strand);
    fibres.addFibre(static_cast<int>(s + 1), 1, 1.0);
    double radiusSum = 0.0;
    for (std::size_t i = 0; i < points; ++i)
    {
      const std::string meaning = "x y z r of control point " + std::to_string(i + 1) + " of " + strand;
      const double x = reader.number(meaning);
      const double y = reader.number(meaning);
      const double z = reader.number(meaning);
      const double r = reader.number(meaning);
      fibres.addPoint({ x, y, z }, r);
      radiusSum += r;
    }
    if (points > 0)
    {
      fibres.targetRadii.back() = radiusSum / static_cast<double>(points);
    }
  }
  validate(fibres);
  return fibres;
}

void writeStrandFile(const Fibres& fibres, const std::string& path)
{
  validate(fibres);
  const double side = fibres.domain.size()[0];
  const Domain cube = Domain::cube(side);
  if ((fibres.domain.lower - cube.lower).cwiseAbs().maxCoeff() > 1e-9 * side ||
      (fibres.domain.upper - cube.upper).cwiseAbs().maxCoeff() > 1e-9 * side)
  {
    throw InvalidInput(
      "a strand file can only hold a cube centred on the origin, and the Domain is something else: write .vtp instead");
  }
  AtomicFile file(path);
  file.stream().precision(9);
  file.stream() << side << '\n' << fibres.size() << '\n';
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    file.stream() << fibres.pointCount(f) << '\n';
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d& p = fibres.points[i];
      file.stream() << p[0] << ' ' << p[1] << ' ' << p[2] << ' ' << fibres.radii[i] << '\n';
    }
  }
  file.commit();
}

} // namespace cactus
