// SPDX-License-Identifier: BSD-3-Clause
// cactus_random_walk [--walkers N] [--steps N] [--step LENGTH] [--seed N] [--repeats N] FOLDER: tests whether walkers leak.
//
// Shares no code with the product. Reads every PLY file below FOLDER/outer and FOLDER/inner (µm, ASCII or binary), starts walkers
// at random inside the inner surfaces, in the myelin (inside an outer surface and no inner one) and outside, and moves them by
// steps of a fixed length in random directions, which every triangle and the box around all surfaces reflect. Every thousand
// steps, and at the end, it determines anew which surfaces a walker is inside of, by the number of their crossings with a line to
// the outside; these must be those that it started in. Prints one JSON object: for each compartment its walkers, those that
// leaked, how often one was reflected, mean squared displacements along x, y and z, and by how much these grow over the second
// half of the walk, with standard errors.
//
// With --repeats 2 (x and y) or 3 (z, too) the folder is an open tile (PeriodicFaces Open): the box repeats along these axes, and
// a walker that leaves it enters through the opposite face. Surfaces then have no outside; a walker is inside of those whose back
// is what it sees first, of all inner ones and of all outer ones, along a line that goes on in the next copies of the box.
//
// The result is 0 whatever is found, 1 if a file cannot be read or there is no room to start, 2 for wrong arguments.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

struct Vector
{
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
};

Vector operator+(const Vector& a, const Vector& b)
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}

Vector operator-(const Vector& a, const Vector& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

Vector operator*(double s, const Vector& a)
{
  return { s * a.x, s * a.y, s * a.z };
}

double dot(const Vector& a, const Vector& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector cross(const Vector& a, const Vector& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

Vector randomDirection(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double z = uniform(random);
  const double angle = 3.14159265358979323846 * uniform(random);
  const double across = std::sqrt(1.0 - z * z);
  return { across * std::cos(angle), across * std::sin(angle), z };
}

/// The squares of the components.
Vector squared(const Vector& a)
{
  return { a.x * a.x, a.y * a.y, a.z * a.z };
}

struct Triangle
{
  Vector a;
  Vector ab;
  Vector ac;
  Vector normal; ///< of length 1
  int surface = 0;
};

struct Surface
{
  std::string file;
  bool inner = false;
};

/// A barrier keeps a walker this far off (µm), so that rounding cannot put it on the other side.
constexpr double skin = 1e-7;
/// µm. The box's walls stand a little inside it, so that they do not coincide with caps.
constexpr double boxInset = 1e-3;

/// Reads four bytes, little-endian.
std::uint32_t fourBytes(std::istream& file)
{
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i)
  {
    bits |= static_cast<std::uint32_t>(file.get() & 0xff) << (8 * i);
  }
  return bits;
}

double coordinate(std::istream& file, bool isBinary)
{
  if (isBinary)
  {
    const std::uint32_t bits = fourBytes(file);
    float number = 0.0F;
    std::memcpy(&number, &bits, sizeof(number));
    return number;
  }
  double number = 0.0;
  file >> number;
  return number;
}

std::size_t place(std::istream& file, bool isBinary)
{
  if (isBinary)
  {
    return fourBytes(file);
  }
  std::size_t number = 0;
  file >> number;
  return number;
}

/// What a walker meets first.
struct Hit
{
  double fraction = 1.0; ///< of the way
  Vector normal;         ///< of a triangle, or of a face of the box
  int axis = -1;         ///< across which a face of the box lies; −1 for a triangle
  int surface = -1;      ///< of a triangle
};

class Walls
{
public:
  Walls(const std::filesystem::path& folder, int repeats)
    : Repeats(repeats)
  {
    for (const char* kind : { "outer", "inner" })
    {
      if (!std::filesystem::is_directory(folder / kind))
      {
        continue;
      }
      std::vector<std::filesystem::path> files;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / kind))
      {
        if (entry.is_regular_file())
        {
          files.push_back(entry.path());
        }
      }
      std::sort(files.begin(), files.end());
      for (const auto& file : files)
      {
        this->Surfaces.push_back({ file.string(), kind == std::string("inner") });
        this->read(file);
      }
    }
    if (this->Triangles.empty())
    {
      throw std::runtime_error("there are no surfaces in " + folder.string());
    }
    this->sort();
  }

  const std::vector<Surface>& surfaces() const { return this->Surfaces; }
  std::size_t triangles() const { return this->Triangles.size(); }
  const Vector& lower() const { return this->Lower; }
  const Vector& upper() const { return this->Upper; }

  /// Tells whether the box repeats along an axis.
  bool repeats(int axis) const { return axis < this->Repeats; }

  /// How far the walls of the box stand inside it along an axis.
  double inset(int axis) const { return this->repeats(axis) ? 0.0 : boxInset; }

  /// Finds the first wall, a triangle that `counts` or a face of the box, on the segment from `from` along `by`.
  template <typename Counts>
  std::optional<Hit> firstHit(const Vector& from, const Vector& by, Counts&& counts) const
  {
    std::optional<Hit> hit;
    double fraction = 1.0;
    this->alongSegment(from, by,
      [&](int t)
      {
        const Triangle& triangle = this->Triangles[std::size_t(t)];
        double where = 0.0;
        if (counts(triangle) && this->crosses(t, from, by, where) && where <= fraction)
        {
          fraction = where;
          hit = Hit{ where, triangle.normal, -1, triangle.surface };
        }
      });
    for (int axis = 0; axis < 3; ++axis)
    {
      const double wall = by[axis] < 0.0 ? this->Lower[axis] + this->inset(axis) : this->Upper[axis] - this->inset(axis);
      const double where = by[axis] == 0.0 ? 2.0 : (wall - from[axis]) / by[axis];
      if (where >= 0.0 && where < fraction)
      {
        fraction = where;
        hit = Hit{ where, { axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0 }, axis, -1 };
      }
    }
    return hit;
  }

  /// Puts a point on a face that repeats, in the sense of `by`, on the opposite one.
  void goThrough(Vector& point, const Vector& by, int axis) const
  {
    point[axis] = by[axis] > 0.0 ? this->Lower[axis] : this->Upper[axis];
  }

  /// Returns the surfaces that a point is inside of, by the parity of crossings on lines to beyond the box. The first answer that
  /// two lines give counts; returns nothing if there is none, as near a hole.
  std::optional<std::vector<int>> around(const Vector& point, std::mt19937_64& random) const
  {
    std::map<std::vector<int>, int> votes;
    for (int line = 0; line < 9; ++line)
    {
      const auto inside = this->Repeats > 0 ? this->facingAlong(point, random) : this->aroundAlong(point, random);
      if (inside && ++votes[*inside] == 2)
      {
        return inside;
      }
    }
    return std::nullopt;
  }

private:
  void read(const std::filesystem::path& path)
  {
    std::ifstream file(path, std::ios::binary);
    std::string word;
    std::size_t points = 0;
    std::size_t faces = 0;
    bool isBinary = false;
    while (file >> word && word != "end_header")
    {
      if (word == "binary_little_endian")
      {
        isBinary = true;
      }
      else if (word == "vertex")
      {
        file >> points;
      }
      else if (word == "face")
      {
        file >> faces;
      }
    }
    file.get();
    std::vector<Vector> p(points);
    for (Vector& v : p)
    {
      v = { coordinate(file, isBinary), coordinate(file, isBinary), coordinate(file, isBinary) };
      this->Lower = { std::min(this->Lower.x, v.x), std::min(this->Lower.y, v.y), std::min(this->Lower.z, v.z) };
      this->Upper = { std::max(this->Upper.x, v.x), std::max(this->Upper.y, v.y), std::max(this->Upper.z, v.z) };
    }
    for (std::size_t i = 0; i < faces; ++i)
    {
      std::size_t corners = 0;
      std::array<std::size_t, 3> t{};
      if (isBinary)
      {
        corners = static_cast<std::size_t>(file.get());
      }
      else
      {
        file >> corners;
      }
      for (std::size_t& corner : t)
      {
        corner = place(file, isBinary);
      }
      if (!file || corners != 3 || std::max({ t[0], t[1], t[2] }) >= points)
      {
        throw std::runtime_error(path.string() + " cannot be read");
      }
      const Vector ab = p[t[1]] - p[t[0]];
      const Vector ac = p[t[2]] - p[t[0]];
      const Vector normal = cross(ab, ac);
      const double area = std::sqrt(dot(normal, normal));
      if (area > 0.0)
      {
        this->Triangles.push_back({ p[t[0]], ab, ac, (1.0 / area) * normal, static_cast<int>(this->Surfaces.size()) - 1 });
      }
    }
  }

  /// Sorts triangles into cubic cells, each with a list.
  void sort()
  {
    const Vector size = this->Upper - this->Lower;
    this->Cell = std::max(0.1, std::cbrt(size.x * size.y * size.z / (0.5 * double(this->Triangles.size()) + 1.0)));
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Cells[std::size_t(axis)] = static_cast<int>(size[axis] / this->Cell) + 1;
    }
    std::vector<std::vector<int>> lists(std::size_t(this->Cells[0]) * std::size_t(this->Cells[1]) * std::size_t(this->Cells[2]));
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      const Triangle& triangle = this->Triangles[t];
      const Vector b = triangle.a + triangle.ab;
      const Vector c = triangle.a + triangle.ac;
      std::array<int, 3> first{};
      std::array<int, 3> last{};
      for (int axis = 0; axis < 3; ++axis)
      {
        first[std::size_t(axis)] = this->cellOf(std::min({ triangle.a[axis], b[axis], c[axis] }) - skin, axis);
        last[std::size_t(axis)] = this->cellOf(std::max({ triangle.a[axis], b[axis], c[axis] }) + skin, axis);
      }
      for (int k = first[2]; k <= last[2]; ++k)
      {
        for (int j = first[1]; j <= last[1]; ++j)
        {
          for (int i = first[0]; i <= last[0]; ++i)
          {
            lists[this->index(i, j, k)].push_back(static_cast<int>(t));
          }
        }
      }
    }
    this->Begin.assign(lists.size() + 1, 0);
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      this->Entries.insert(this->Entries.end(), lists[i].begin(), lists[i].end());
      this->Begin[i + 1] = this->Entries.size();
    }
  }

  int cellOf(double coordinate, int axis) const
  {
    const int cell = static_cast<int>(std::floor((coordinate - this->Lower[axis]) / this->Cell));
    return std::clamp(cell, 0, this->Cells[std::size_t(axis)] - 1);
  }

  std::size_t index(int i, int j, int k) const
  {
    return (std::size_t(k) * std::size_t(this->Cells[1]) + std::size_t(j)) * std::size_t(this->Cells[0]) + std::size_t(i);
  }

  /// Calls visit(triangle) for those in all cells of the box around the segment, cut into pieces no longer than a cell; some come
  /// more than once.
  template <typename Visit>
  void alongSegment(const Vector& from, const Vector& by, Visit&& visit) const
  {
    const int pieces = static_cast<int>(std::sqrt(dot(by, by)) / this->Cell) + 1;
    for (int piece = 0; piece < pieces; ++piece)
    {
      const Vector p = from + (double(piece) / pieces) * by;
      const Vector q = from + (double(piece + 1) / pieces) * by;
      std::array<int, 3> first{};
      std::array<int, 3> last{};
      for (int axis = 0; axis < 3; ++axis)
      {
        first[std::size_t(axis)] = this->cellOf(std::min(p[axis], q[axis]) - skin, axis);
        last[std::size_t(axis)] = this->cellOf(std::max(p[axis], q[axis]) + skin, axis);
      }
      for (int k = first[2]; k <= last[2]; ++k)
      {
        for (int j = first[1]; j <= last[1]; ++j)
        {
          for (int i = first[0]; i <= last[0]; ++i)
          {
            const std::size_t cell = this->index(i, j, k);
            for (std::size_t entry = this->Begin[cell]; entry < this->Begin[cell + 1]; ++entry)
            {
              visit(this->Entries[entry]);
            }
          }
        }
      }
    }
  }

  /// Tests a crossing (Möller–Trumbore), with slightly widened edges: a crossing through an edge may be seen twice, but never
  /// missed.
  bool crosses(int index, const Vector& from, const Vector& by, double& where) const
  {
    constexpr double hair = 1e-9;
    constexpr double tiny = 1e-11;
    const Triangle& t = this->Triangles[std::size_t(index)];
    const Vector s = from - t.a;
    const double before = dot(s, t.normal);
    const double behind = before + dot(by, t.normal);
    if ((before > tiny && behind > tiny) || (before < -tiny && behind < -tiny))
    {
      return false; // on one side, the usual case
    }
    const Vector h = cross(by, t.ac);
    const double determinant = dot(t.ab, h);
    if (determinant == 0.0)
    {
      return false;
    }
    const double u = dot(s, h) / determinant;
    if (u < -hair || u > 1.0 + hair)
    {
      return false;
    }
    const Vector q = cross(s, t.ab);
    const double v = dot(by, q) / determinant;
    if (v < -hair || u + v > 1.0 + hair)
    {
      return false;
    }
    where = dot(t.ac, q) / determinant;
    return where >= 0.0 && where <= 1.0;
  }

  /// Returns the surfaces whose backs are first, of the inner and of the outer ones, along a line through the copies of the box.
  std::optional<std::vector<int>> facingAlong(const Vector& point, std::mt19937_64& random) const
  {
    constexpr int mostFaces = 100;
    const Vector size = this->Upper - this->Lower;
    const Vector by = std::max({ size.x, size.y, size.z }) * randomDirection(random);
    std::vector<int> inside;
    for (const bool inner : { false, true })
    {
      const auto isKind = [this, inner](const Triangle& t) { return this->Surfaces[std::size_t(t.surface)].inner == inner; };
      const bool hasKind = std::any_of(
        this->Surfaces.begin(), this->Surfaces.end(), [inner](const Surface& surface) { return surface.inner == inner; });
      Vector from = point;
      std::optional<Hit> hit = hasKind ? this->firstHit(from, by, isKind) : std::nullopt;
      for (int face = 0; hit && hit->axis >= 0 && this->repeats(hit->axis) && face < mostFaces; ++face)
      {
        from = from + hit->fraction * by;
        this->goThrough(from, by, hit->axis);
        hit = this->firstHit(from, by, isKind);
      }
      if (hasKind && (!hit || hit->axis >= 0))
      {
        return std::nullopt; // out of the box, or along the fibres
      }
      if (hit && dot(by, hit->normal) > 0.0)
      {
        inside.push_back(hit->surface);
      }
    }
    return inside;
  }

  std::optional<std::vector<int>> aroundAlong(const Vector& point, std::mt19937_64& random) const
  {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Vector size = this->Upper - this->Lower;
    // To the nearer end of x, slanted.
    const double far = point.x - this->Lower.x < this->Upper.x - point.x ? this->Lower.x - 1.0 : this->Upper.x + 1.0;
    const Vector by{ far - point.x, 0.1 * size.y * uniform(random), 0.1 * size.z * uniform(random) };
    std::vector<int> hits;
    this->alongSegment(point, by,
      [&](int t)
      {
        double where = 0.0;
        if (this->crosses(t, point, by, where))
        {
          hits.push_back(t);
        }
      });
    std::sort(hits.begin(), hits.end());
    hits.erase(std::unique(hits.begin(), hits.end()), hits.end());
    std::map<int, int> crossings;
    for (const int t : hits)
    {
      ++crossings[this->Triangles[std::size_t(t)].surface];
    }
    std::vector<int> inside;
    for (const auto& entry : crossings)
    {
      if (entry.second % 2 == 1)
      {
        inside.push_back(entry.first);
      }
    }
    return inside;
  }

  int Repeats; ///< number of axes along which the box repeats
  std::vector<Surface> Surfaces;
  std::vector<Triangle> Triangles;
  Vector Lower{ 1e30, 1e30, 1e30 };
  Vector Upper{ -1e30, -1e30, -1e30 };
  double Cell = 1.0;
  std::array<int, 3> Cells{};
  std::vector<std::size_t> Begin;
  std::vector<int> Entries;
};

enum Compartment
{
  Inner,
  Myelin,
  Outside
};

constexpr std::array<const char*, 3> compartmentNames{ "inner", "myelin", "outside" };

Compartment compartmentOf(const Walls& walls, const std::vector<int>& inside)
{
  const bool isInner =
    std::any_of(inside.begin(), inside.end(), [&walls](int s) { return walls.surfaces()[std::size_t(s)].inner; });
  return isInner ? Inner : inside.empty() ? Outside : Myelin;
}

struct Walker
{
  Vector start;
  std::vector<int> inside; ///< the surfaces that it started inside of
  Vector position;
  Vector moved;  ///< from its start, in the copies of the box
  Vector middle; ///< how far it had moved after half of its steps
  bool leaked = false;
  std::size_t reflections = 0;
};

struct Options
{
  std::size_t walkers = 100; ///< in each compartment
  std::size_t steps = 100000;
  double step = 0.2; ///< µm
  std::uint64_t seed = 1;
  int repeats = 0; ///< number of axes
  std::string folder;
};

/// Moves a walker by one step, reflected at walls.
void move(const Walls& walls, Walker& walker, Vector by)
{
  for (int reflection = 0; reflection < 1000; ++reflection)
  {
    const std::optional<Hit> hit = walls.firstHit(walker.position, by, [](const Triangle&) { return true; });
    const double length = std::sqrt(dot(by, by));
    const bool goesThrough = hit && hit->axis >= 0 && walls.repeats(hit->axis);
    const double part = !hit ? 1.0 : goesThrough ? hit->fraction : std::max(0.0, hit->fraction * length - skin) / length;
    walker.position = walker.position + part * by;
    walker.moved = walker.moved + part * by;
    if (!hit)
    {
      return;
    }
    if (goesThrough)
    {
      walls.goThrough(walker.position, by, hit->axis);
      by = (1.0 - hit->fraction) * by;
    }
    else
    {
      by = (1.0 - hit->fraction) * (by - 2.0 * dot(by, hit->normal) * hit->normal);
      ++walker.reflections;
    }
    if (dot(by, by) == 0.0)
    {
      return;
    }
  }
}

/// Returns the requested number of walkers in each compartment (inner: if there are inner surfaces); throws if one has no room.
std::vector<std::vector<Walker>> start(const Walls& walls, const Options& options)
{
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Vector size = walls.upper() - walls.lower();
  const Vector margin{ 2.0 * walls.inset(0), 2.0 * walls.inset(1), 2.0 * walls.inset(2) };
  std::vector<std::vector<Walker>> walkers(3);
  const auto wanted = [&]
  { return std::any_of(walkers.begin(), walkers.end(), [&options](const auto& here) { return here.size() < options.walkers; }); };
  for (std::size_t attempt = 0; attempt < 200 * options.walkers + 10000 && wanted(); ++attempt)
  {
    Walker walker;
    walker.start = { walls.lower().x + margin.x + (size.x - 2.0 * margin.x) * uniform(random),
      walls.lower().y + margin.y + (size.y - 2.0 * margin.y) * uniform(random),
      walls.lower().z + margin.z + (size.z - 2.0 * margin.z) * uniform(random) };
    const auto inside = walls.around(walker.start, random);
    if (!inside)
    {
      continue;
    }
    walker.inside = *inside;
    walker.position = walker.start;
    auto& here = walkers[compartmentOf(walls, walker.inside)];
    if (here.size() < options.walkers)
    {
      here.push_back(walker);
    }
  }
  const bool hasInner =
    std::any_of(walls.surfaces().begin(), walls.surfaces().end(), [](const Surface& surface) { return surface.inner; });
  for (std::size_t c = hasInner ? Inner : Myelin; c < walkers.size(); ++c)
  {
    if (walkers[c].size() < options.walkers)
    {
      throw std::runtime_error("only " + std::to_string(walkers[c].size()) + " of " + std::to_string(options.walkers) +
                               " walkers found room to start: " + compartmentNames[c]);
    }
  }
  return walkers;
}

void walk(const Walls& walls, const Options& options, Walker& walker, std::uint64_t stream)
{
  constexpr std::size_t betweenChecks = 1000;
  std::seed_seq seeds{ options.seed, stream };
  std::mt19937_64 random(seeds);
  for (std::size_t step = 1; step <= options.steps && !walker.leaked; ++step)
  {
    move(walls, walker, options.step * randomDirection(random));
    walker.middle = step == options.steps / 2 ? walker.moved : walker.middle;
    if (step % betweenChecks == 0 || step == options.steps)
    {
      const auto inside = walls.around(walker.position, random);
      walker.leaked = !inside || *inside != walker.inside;
    }
  }
}

void run(const Options& options)
{
  const Walls walls(options.folder, options.repeats);
  auto compartments = start(walls, options);
  std::cout.precision(9);
  std::cout << "{\"surfaces\": " << walls.surfaces().size() << ", \"triangles\": " << walls.triangles()
            << ", \"steps\": " << options.steps << ", \"step_um\": " << options.step;
  for (std::size_t c = 0; c < compartments.size(); ++c)
  {
    auto& walkers = compartments[c];
#pragma omp parallel for schedule(dynamic)
    for (std::size_t w = 0; w < walkers.size(); ++w)
    {
      walk(walls, options, walkers[w], 3 * w + c);
    }
    std::size_t leaked = 0;
    std::size_t reflections = 0;
    Vector squares;
    Vector growth;
    Vector squaredGrowth;
    for (const Walker& walker : walkers)
    {
      const Vector square = squared(walker.moved);
      const Vector more = square - squared(walker.middle);
      squares = squares + square;
      growth = growth + more;
      squaredGrowth = squaredGrowth + squared(more);
      leaked += walker.leaked ? 1 : 0;
      reflections += walker.reflections;
    }
    const double count = std::max<double>(1.0, double(walkers.size()));
    squares = (1.0 / count) * squares;
    growth = (1.0 / count) * growth;
    const Vector variance = (1.0 / count) * squaredGrowth - squared(growth);
    std::cout << ",\n\"" << compartmentNames[c] << "\": {\"walkers\": " << walkers.size() << ", \"leaked\": " << leaked
              << ", \"reflections\": " << reflections << ", \"squared_displacement_um2\": [" << squares.x << ", " << squares.y
              << ", " << squares.z << "], \"second_half_um2\": [" << growth.x << ", " << growth.y << ", " << growth.z
              << "], \"second_half_error_um2\": [" << std::sqrt(variance.x / count) << ", " << std::sqrt(variance.y / count)
              << ", " << std::sqrt(variance.z / count) << "]}";
  }
  std::cout << "}\n";
}

} // namespace

int main(int argc, char** argv)
{
  Options options;
  try
  {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    std::size_t i = 0;
    for (; i + 1 < arguments.size(); i += 2)
    {
      const std::string& name = arguments[i];
      const double value = std::stod(arguments[i + 1]);
      if (!(value >= 0.0))
      {
        throw std::invalid_argument(name);
      }
      if (name == "--walkers")
      {
        options.walkers = static_cast<std::size_t>(value);
      }
      else if (name == "--steps")
      {
        options.steps = static_cast<std::size_t>(value);
      }
      else if (name == "--step")
      {
        options.step = value;
      }
      else if (name == "--repeats" && value <= 3.0)
      {
        options.repeats = static_cast<int>(value);
      }
      else if (name == "--seed")
      {
        options.seed = static_cast<std::uint64_t>(value);
      }
      else
      {
        throw std::invalid_argument(name);
      }
    }
    if (i + 1 != arguments.size())
    {
      throw std::invalid_argument("FOLDER");
    }
    options.folder = arguments.back();
  }
  catch (const std::logic_error&)
  {
    std::cerr << "usage: cactus_random_walk [--walkers N] [--steps N] [--step LENGTH] [--seed N] [--repeats N] FOLDER\n";
    return 2;
  }
  try
  {
    run(options);
  }
  catch (const std::exception& error)
  {
    std::cerr << "cactus_random_walk: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
