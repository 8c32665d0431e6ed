// SPDX-License-Identifier: BSD-3-Clause
#include "io/StrandFile.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"
#include "base/PosixFile.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>

namespace cactus
{

namespace
{

/// Reads numbers line by line, and counts the lines.
class LineReader
{
public:
  LineReader(std::istream& stream, const std::string& name)
    : Buffer(*stream.rdbuf())
    , Name(name)
  {
  }

  /// Reads the only number of the next line.
  double only(const std::string& meaning)
  {
    this->begin(meaning);
    const double value = this->number(meaning);
    this->end(meaning + " and nothing else");
    return value;
  }

  std::size_t count(const std::string& meaning)
  {
    const double value = this->only(meaning);
    if (value < 0.0 || value != std::floor(value) || value > std::numeric_limits<int>::max())
    {
      this->expected(meaning + " (a whole number)");
    }
    return static_cast<std::size_t>(value);
  }

  /// Reads the only number of the next line, or three numbers.
  Eigen::Vector3d oneOrThree(const std::string& meaning)
  {
    this->begin(meaning);
    Eigen::Vector3d values = Eigen::Vector3d::Constant(this->number(meaning));
    if (!this->Rest.empty())
    {
      values[1] = this->number(meaning);
      values[2] = this->number(meaning);
    }
    this->end(meaning + " and nothing else");
    return values;
  }

  /// Reads the four numbers of the next line.
  void four(const std::string& meaning, double (&values)[4])
  {
    this->begin(meaning);
    for (double& value : values)
    {
      value = this->number(meaning);
    }
    this->end(meaning + " and nothing else");
  }

  /// Throws unless only blank lines are left.
  void finish(const std::string& after)
  {
    if (this->next())
    {
      this->fail("expected the end of the file after " + after + ", found '" + excerpt(this->Rest) + "': correct the number");
    }
  }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw FileError(this->Name + ", line " + std::to_string(this->Line) + ": " + what);
  }

private:
  /// Goes to the next line that is not blank; false if there is none.
  bool next()
  {
    do
    {
      if (!this->readLine())
      {
        return false;
      }
      this->Rest = this->Text;
      skipBlanks(this->Rest);
    } while (this->Rest.empty());
    return true;
  }

  /// Reads the next line, with a line end of Unix, Windows or the old Mac; false at the end of the file.
  bool readLine()
  {
    constexpr std::size_t longest = 4096;
    constexpr int none = std::char_traits<char>::eof();
    this->Text.clear();
    try
    {
      int c = this->Buffer.sbumpc();
      if (c == none)
      {
        return false;
      }
      ++this->Line;
      for (; c != none && c != '\n' && c != '\r'; c = this->Buffer.sbumpc())
      {
        if (this->Text.size() == longest)
        {
          this->fail("the line is longer than " + std::to_string(longest) + " characters: this is no strand file");
        }
        this->Text += static_cast<char>(c);
      }
      if (c == '\r' && this->Buffer.sgetc() == '\n')
      {
        this->Buffer.sbumpc();
      }
    }
    catch (const std::ios_base::failure& error) // a folder, or a disk error
    {
      throw FileError("cannot read " + this->Name + " after line " + std::to_string(this->Line) + ": " + error.code().message());
    }
    if (this->Line == 1 && this->Text.compare(0, 3, "\xef\xbb\xbf") == 0)
    {
      this->Text.erase(0, 3); // byte-order mark of UTF-8
    }
    return true;
  }

  void begin(const std::string& meaning)
  {
    if (!this->next())
    {
      throw FileError(this->Name + ": the file ends after line " + std::to_string(this->Line) + ", where " + meaning +
                      " was expected: it is truncated, or the numbers of strands and control points in it are wrong");
    }
  }

  double number(const std::string& meaning)
  {
    double value = 0.0;
    if (!takeNumber(this->Rest, value))
    {
      this->expected(meaning);
    }
    const std::size_t before = this->Rest.size();
    skipBlanks(this->Rest);
    if (!this->Rest.empty() && this->Rest.size() == before)
    {
      this->expected(meaning);
    }
    return value;
  }

  void end(const std::string& meaning)
  {
    if (!this->Rest.empty())
    {
      this->expected(meaning);
    }
  }

  [[noreturn]] void expected(const std::string& meaning) const
  {
    this->fail("expected " + meaning + ", found '" + excerpt(this->Text) + "'");
  }

  std::streambuf& Buffer;
  std::string Name;
  std::string Text;
  std::string_view Rest; ///< of Text
  std::size_t Line = 0;
};

void readStrand(LineReader& reader, std::size_t number, std::size_t strands, Fibres& fibres)
{
  const std::string strand = "strand " + std::to_string(number) + " of " + std::to_string(strands);
  const std::size_t points = reader.count("the number of control points of " + strand);
  if (points < 2)
  {
    reader.fail("fibre " + std::to_string(number) + " (" + strand + ") has " + std::to_string(points) +
                " control point(s): a fibre needs at least two");
  }
  fibres.addFibre(static_cast<int>(number), 1, 1.0);
  for (std::size_t i = 0; i < points; ++i)
  {
    double values[4];
    reader.four("x y z r of control point " + std::to_string(i + 1) + " of " + strand, values);
    fibres.addPoint({ values[0], values[1], values[2] }, values[3]);
  }
  double& target = fibres.targetRadii.back();
  target = rootMeanSquareRadius(fibres, fibres.size() - 1);
  for (const double limit : { limits::radius.lowest, limits::radius.highest })
  {
    // That of radii at a limit counts as within it, however their sum was rounded.
    target = std::abs(target - limit) <= 1e-9 * limit ? limit : target;
  }
}

} // namespace

Fibres readStrandFile(std::istream& stream, const std::string& name)
{
  LineReader reader(stream, name);
  Fibres fibres;
  const Eigen::Vector3d size = reader.oneOrThree("the side of the cube, or the size of the domain along x, y and z");
  if (size.minCoeff() <= 0.0)
  {
    reader.fail(text("the side of the domain is ", size.minCoeff(), ", not a positive length"));
  }
  fibres.domain.upper = 0.5 * size;
  fibres.domain.lower = -fibres.domain.upper;
  const std::size_t strands = reader.count("the number of strands");
  if (strands == 0)
  {
    reader.fail("the number of strands is 0: there are no fibres to read");
  }
  for (std::size_t s = 0; s < strands; ++s)
  {
    readStrand(reader, s + 1, strands, fibres);
  }
  reader.finish("the last of " + std::to_string(strands) + " strand(s)");
  validateFile(fibres, name);
  return fibres;
}

void validateFile(const Fibres& fibres, const std::string& name)
{
  try
  {
    validate(fibres);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput(name + ": " + error.what());
  }
}

Fibres readStrandFile(const std::string& path)
{
  requireNoPipe("strand file " + path, path);
  std::ifstream file(path);
  if (!file)
  {
    throw FileError("cannot open strand file " + path + ": " + std::strerror(errno));
  }
  return readStrandFile(file, path);
}

bool beginsAsStrandFile(std::istream& stream)
{
  try
  {
    LineReader reader(stream, "");
    reader.oneOrThree("");
    reader.count("");
    reader.count("");
    double values[4];
    reader.four("", values);
    return true;
  }
  catch (const FileError&)
  {
    return false;
  }
}

bool fitsStrandFile(const Domain& domain)
{
  return (domain.lower + domain.upper).cwiseAbs().maxCoeff() <= 1e-9 * domain.size().maxCoeff();
}

bool isCube(const Domain& domain)
{
  return domain.size().maxCoeff() - domain.size().minCoeff() <= 1e-9 * domain.size().maxCoeff();
}

void writeStrandFile(const Fibres& fibres, const std::string& path)
{
  validate(fibres);
  require(fitsStrandFile(fibres.domain), "a strand file can only hold a Domain centred on the origin: write .vtp instead");
  constexpr int digits = 9;
  AtomicFile file(path);
  std::string part;
  for (int axis = 0; axis < (isCube(fibres.domain) ? 1 : 3); ++axis)
  {
    part += axis > 0 ? " " : "";
    appendNumber(part, fibres.domain.size()[axis], digits);
  }
  part += '\n' + std::to_string(fibres.size()) + '\n';
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    part += std::to_string(fibres.pointCount(f)) + '\n';
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        appendNumber(part, fibres.points[i][axis], digits);
        part += ' ';
      }
      appendNumber(part, fibres.radii[i], digits);
      part += '\n';
    }
    file.stream().write(part.data(), static_cast<std::streamsize>(part.size()));
    part.clear();
  }
  file.commit();
}

} // namespace cactus
