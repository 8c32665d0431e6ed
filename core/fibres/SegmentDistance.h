// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace cactus
{

/// The parameters (s, t) in [0, 1]² that minimise |(p0 + s·d1) − (q0 + t·d2)| over both segments at once (paper, Eq. for t_p,
/// t_q), with a = d1·d1, e = d2·d2 (both positive), b = d1·d2, c = d1·(p0 − q0), f = d2·(p0 − q0). Closed form: the stationary s
/// is clamped, t follows from it, and where t has to be clamped s follows from that; clamping both independently is wrong unless
/// the segments are parallel. Of parallel segments, whose closest points are not unique, it takes the middle of the part that
/// runs side by side. Free of branches; Real is a Scalar or a vector of them (of which `?:` picks lane by lane). inverseA: 1 / a.
template <typename Real, typename Scalar = double>
inline __attribute__((always_inline)) void closestParameters(
  const Real& a, const Real& inverseA, const Real& e, const Real& b, const Real& c, const Real& f, Real& s, Real& t)
{
  constexpr Scalar parallel = 1e-12; // sin² of the angle below which segments count as parallel
  const Real zero = a - a;
  const Real one = zero + Scalar(1);
  const auto isParallel = a * e - b * b <= parallel * a * e;
  const Real stationary = (b * f - c * e) / (isParallel ? one : a * e - b * b);
  const Real from = -c * inverseA;
  const Real to = (b - c) * inverseA;
  Real low = from < to ? from : to;
  Real high = from < to ? to : from;
  low = low > zero ? low : zero;
  high = high < one ? high : one;
  Real first = isParallel ? Scalar(0.5) * (low + high) : stationary;
  first = first > zero ? first : zero;
  first = first < one ? first : one;
  const Real free = (b * first + f) / e;
  t = free > zero ? free : zero;
  t = t < one ? t : one;
  Real second = (b * t - c) * inverseA;
  second = second > zero ? second : zero;
  second = second < one ? second : one;
  s = free == t ? first : second;
}

/// Computes parameters in single precision, for vectors of floats. The squared distance of their points exceeds the smallest one
/// by at most 10⁻⁵ (a + e + distance²), even for nearly parallel segments, whose determinant is only rounding (below 10⁻⁶ a·e).
/// For those, an s other than the stationary one costs little if it lies on the same side.
template <typename Floats>
inline __attribute__((always_inline)) void nearlyClosestParameters(const Floats& a, const Floats& inverseA, const Floats& e,
  const Floats& b, const Floats& c, const Floats& f, Floats& s, Floats& t)
{
  const Floats zero = a - a;
  const Floats one = zero + 1.0f;
  const auto clamp = [&](const Floats& x) __attribute__((always_inline))
  {
    const Floats positive = x > zero ? x : zero;
    return positive < one ? positive : one;
  };
  const Floats determinant = a * e - b * b;
  const Floats least = 1e-6f * a * e;
  const Floats first = clamp((b * f - c * e) / (determinant > least ? determinant : least));
  t = clamp((b * first + f) / e);
  s = clamp((b * t - c) * inverseA);
}

/// Closest points of two segments: their parameters and distance (µm).
struct SegmentPair
{
  double s = 0.0;
  double t = 0.0;
  double distance = 0.0;
};

/// Closest points of the segments p0–p1 and q0–q1, neither of zero length.
inline SegmentPair closestPoints(
  const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0, const Eigen::Vector3d& q1)
{
  const Eigen::Vector3d d1 = p1 - p0;
  const Eigen::Vector3d d2 = q1 - q0;
  const Eigen::Vector3d r = p0 - q0;
  SegmentPair pair;
  closestParameters(d1.dot(d1), 1.0 / d1.dot(d1), d2.dot(d2), d1.dot(d2), d1.dot(r), d2.dot(r), pair.s, pair.t);
  pair.distance = (r + pair.s * d1 - pair.t * d2).norm();
  return pair;
}

} // namespace cactus
