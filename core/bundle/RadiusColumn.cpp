// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/RadiusColumn.h"

#include "base/Error.h"
#include "base/Numbers.h"
#include "base/PosixFile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string_view>

namespace cactus
{

namespace
{

constexpr std::size_t longestLine = 1 << 20;
constexpr std::size_t mostRadii = 1 << 24;

/// Reads a line without its end; limited to the length of plausible lines.
bool takeLine(std::istream& stream, const std::string& name, std::string& line)
{
  line.clear();
  for (int c = stream.get(); c != std::istream::traits_type::eof(); c = stream.get())
  {
    if (c == '\n')
    {
      return true;
    }
    if (c != '\r')
    {
      line.push_back(static_cast<char>(c));
    }
    if (line.size() > longestLine)
    {
      throw FileError("RadiusTableFile " + name + " has a line of more than 1 MB: this is no table");
    }
  }
  if (stream.bad())
  {
    throw FileError("RadiusTableFile " + name + " cannot be read");
  }
  return !line.empty();
}

std::string trimmed(std::string_view cell)
{
  constexpr std::string_view blanks = " \t";
  cell.remove_prefix(std::min(cell.find_first_not_of(blanks), cell.size()));
  cell = cell.substr(0, cell.find_last_not_of(blanks) + 1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
  {
    cell = cell.substr(1, cell.size() - 2);
  }
  return std::string(cell);
}

/// Returns the cells of a line; separators in quotation marks do not count.
std::vector<std::string> cellsOf(const std::string& line, char separator)
{
  std::vector<std::string> cells;
  std::size_t begin = 0;
  bool isQuoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i)
  {
    if (i == line.size() || (line[i] == separator && !isQuoted))
    {
      cells.push_back(trimmed(std::string_view(line).substr(begin, i - begin)));
      begin = i + 1;
    }
    else if (line[i] == '"')
    {
      isQuoted = !isQuoted;
    }
  }
  return cells;
}

char separatorOf(const std::string& header)
{
  const std::size_t place = header.find_first_of(",;\t");
  return place == std::string::npos ? ',' : header[place];
}

/// Returns a column's name with "u" for each way to write a micro sign: those of Latin-1 and UTF-8, and the Greek letter.
std::string withoutMicro(std::string name)
{
  for (const char* sign : { "\xc2\xb5", "\xce\xbc", "\xb5" })
  {
    const std::string text(sign);
    for (std::size_t at = name.find(text); at != std::string::npos; at = name.find(text, at))
    {
      name.replace(at, text.size(), "u");
    }
  }
  return name;
}

/// Returns the column of this name, or of one that differs in its micro sign alone; their number if there is none.
std::size_t placeOf(const std::string& column, const std::vector<std::string>& names)
{
  auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end())
  {
    found = std::find_if(
      names.begin(), names.end(), [&](const std::string& name) { return withoutMicro(name) == withoutMicro(column); });
  }
  return static_cast<std::size_t>(found - names.begin());
}

/// Takes the finite number that a cell is, with a point or a comma before its decimals.
bool takeCell(std::string cell, double& value)
{
  if (const std::size_t comma = cell.find(','); comma != std::string::npos && cell.find('.') == std::string::npos)
  {
    cell[comma] = '.';
  }
  std::string_view rest(cell);
  return takeNumber(rest, value) && rest.empty() && std::isfinite(value);
}

} // namespace

std::vector<double> readRadiusColumn(std::istream& stream, const std::string& name, const std::string& column)
{
  std::string line;
  takeLine(stream, name, line);
  if (line.rfind("\xef\xbb\xbf", 0) == 0)
  {
    line.erase(0, 3); // byte-order mark of UTF-8
  }
  const char separator = separatorOf(line);
  const std::vector<std::string> names = cellsOf(line, separator);
  const std::size_t place = placeOf(column, names);
  if (place == names.size())
  {
    throw FileError("RadiusTableFile " + name + " has no column \"" + column + "\" (RadiusTableColumn); its first line is \"" +
                    excerpt(line) + "\"");
  }
  std::vector<double> radii;
  for (std::size_t number = 2; takeLine(stream, name, line) || stream.good(); ++number)
  {
    if (line.find_first_not_of(" \t") == std::string::npos)
    {
      continue;
    }
    const std::vector<std::string> cells = cellsOf(line, separator);
    const auto isFilled = [](const std::string& cell) { return !cell.empty(); };
    if (separator == ',' && cells.size() > names.size() &&
        std::any_of(cells.begin() + std::ptrdiff_t(names.size()), cells.end(), isFilled))
    {
      throw FileError("RadiusTableFile " + name + ", line " + std::to_string(number) +
                      ", has more cells than the first line has names: numbers with a decimal comma, or names left out?");
    }
    const std::string cell = place < cells.size() ? cells[place] : std::string();
    double value = 0.0;
    if (!takeCell(cell, value))
    {
      throw FileError("RadiusTableFile " + name + ", line " + std::to_string(number) + ", has no number in column \"" + column +
                      "\", but \"" + excerpt(cell) + "\": leave such lines out");
    }
    radii.push_back(value);
    if (radii.size() > mostRadii)
    {
      throw FileError("RadiusTableFile " + name + " has more than " + std::to_string(mostRadii) + " lines: take a part of it");
    }
  }
  if (radii.empty())
  {
    throw FileError("RadiusTableFile " + name + " has no numbers below its column \"" + column + "\"");
  }
  return radii;
}

std::vector<double> readRadiusColumn(const std::string& path, const std::string& column)
{
  requireNoPipe("RadiusTableFile " + path, path);
  std::ifstream file(path);
  if (!file)
  {
    throw FileError("RadiusTableFile " + path + " cannot be read: name a table with a column of radii");
  }
  return readRadiusColumn(file, path, column);
}

} // namespace cactus
