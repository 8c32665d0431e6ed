// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ExactPredicates.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Half a unit in the last place of 1.
constexpr double epsilon = 1.1102230246251565e-16;

/// a + b = sum + rest, exactly (Knuth).
struct ExactSum
{
  ExactSum(double a, double b)
    : sum(a + b)
  {
    const double bShare = this->sum - a;
    const double aShare = this->sum - bShare;
    this->rest = (a - aShare) + (b - bShare);
  }
  double sum;
  double rest;
};

/// A number as the exact sum of `count` (at most capacity) non-overlapping, non-zero doubles in increasing order of size.
template <std::size_t capacity>
struct Expansion
{
  std::array<double, capacity> part;
  std::size_t count = 0;

  /// Adds one double (Shewchuk's grow-expansion, with zeros left out).
  void add(double b)
  {
    std::size_t kept = 0;
    double carry = b;
    for (std::size_t i = 0; i < this->count; ++i)
    {
      const ExactSum sum(carry, this->part[i]);
      carry = sum.sum;
      if (sum.rest != 0.0)
      {
        this->part[kept++] = sum.rest;
      }
    }
    if (carry != 0.0)
    {
      this->part[kept++] = carry;
    }
    this->count = kept;
  }

  /// Returns the sign of the largest part, which outweighs all others.
  int sign() const { return this->count == 0 ? 0 : this->part[this->count - 1] > 0.0 ? 1 : -1; }
};

Expansion<2> difference(double a, double b)
{
  const ExactSum sum(a, -b);
  Expansion<2> result;
  result.add(sum.rest);
  result.add(sum.sum);
  return result;
}

template <std::size_t n, std::size_t m>
Expansion<2 * n * m> product(const Expansion<n>& a, const Expansion<m>& b)
{
  Expansion<2 * n * m> result;
  for (std::size_t i = 0; i < a.count; ++i)
  {
    for (std::size_t j = 0; j < b.count; ++j)
    {
      const double high = a.part[i] * b.part[j];
      result.add(std::fma(a.part[i], b.part[j], -high));
      result.add(high);
    }
  }
  return result;
}

/// a + sign · b
template <std::size_t n, std::size_t m>
Expansion<n + m> sum(const Expansion<n>& a, const Expansion<m>& b, double sign)
{
  Expansion<n + m> result;
  for (std::size_t i = 0; i < a.count; ++i)
  {
    result.part[i] = a.part[i];
  }
  result.count = a.count;
  for (std::size_t i = 0; i < b.count; ++i)
  {
    result.add(sign * b.part[i]);
  }
  return result;
}

} // namespace

int exactOrientation(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d)
{
  std::array<Expansion<2>, 3> ad;
  std::array<Expansion<2>, 3> bd;
  std::array<Expansion<2>, 3> cd;
  for (int axis = 0; axis < 3; ++axis)
  {
    ad[std::size_t(axis)] = difference(a[axis], d[axis]);
    bd[std::size_t(axis)] = difference(b[axis], d[axis]);
    cd[std::size_t(axis)] = difference(c[axis], d[axis]);
  }
  const auto term = [&](std::size_t u)
  {
    const std::size_t v = (u + 1) % 3;
    const std::size_t w = (u + 2) % 3;
    return product(ad[u], sum(product(bd[v], cd[w]), product(bd[w], cd[v]), -1.0));
  };
  return sum(sum(term(0), term(1), 1.0), term(2), 1.0).sign();
}

int orientationAlong(int dropped, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const int u = (dropped + 1) % 3;
  const int v = (dropped + 2) % 3;
  const double left = (a[u] - c[u]) * (b[v] - c[v]);
  const double right = (a[v] - c[v]) * (b[u] - c[u]);
  const double area = left - right;
  const double size = std::fabs(left) + std::fabs(right);
  const double bound = (3.0 + 16.0 * epsilon) * epsilon * size;
  if (area > bound || -area > bound)
  {
    return area > 0.0 ? 1 : -1;
  }
  if (size == 0.0)
  {
    return 0;
  }
  return sum(
    product(difference(a[u], c[u]), difference(b[v], c[v])), product(difference(a[v], c[v]), difference(b[u], c[u])), -1.0)
    .sign();
}

} // namespace cactus
