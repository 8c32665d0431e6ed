// SPDX-License-Identifier: BSD-3-Clause
// Kernels of the cost terms that apply to all control points of a fibre.
//
// They work in two steps: the contributions of each bend and each segment to its control points are computed first, a vector of
// them at once. Each control point then adds its contributions in the order of the bends, or segments.
#include "optimiser/FibreCostKernels.h"

#include "base/Vector.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

namespace
{

/// Columns of a fibre's numbers by control point, readable up to a vector before the first and behind the last.
class Columns
{
public:
  CACTUS_KERNEL_INLINE Columns(double* room, std::size_t points)
    : Next(room + 16)
    , Stride(points + 32)
  {
  }

  CACTUS_KERNEL_INLINE double* take()
  {
    double* column = this->Next;
    this->Next += this->Stride;
    return column;
  }

private:
  double* Next;
  std::size_t Stride;
};

struct Vectors
{
  double* axis[3];
};

CACTUS_KERNEL_INLINE Vectors takeVectors(Columns& columns)
{
  Vectors vectors;
  for (double*& axis : vectors.axis)
  {
    axis = columns.take();
  }
  return vectors;
}

CACTUS_KERNEL_INLINE void part(const double* from, std::size_t count, const Vectors& to)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      to.axis[axis][i] = from[3 * i + std::size_t(axis)];
    }
  }
}

CACTUS_KERNEL_INLINE void join(const Vectors& from, std::size_t count, double* to)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      to[3 * i + std::size_t(axis)] = from.axis[axis][i];
    }
  }
}

/// Sums in Eigen's order.
CACTUS_KERNEL_INLINE Doubles dot(const Doubles (&x)[3], const Doubles (&y)[3])
{
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// Do the same as store() and load() for arrays that may end before the vector does.
CACTUS_KERNEL_INLINE void storeSome(double* to, const Doubles& vector, std::size_t count)
{
  if (count >= width)
  {
    store(to, vector);
    return;
  }
  for (std::size_t l = 0; l < count; ++l)
  {
    to[l] = vector[l];
  }
}

CACTUS_KERNEL_INLINE Doubles loadSome(const double* from, std::size_t count)
{
  if (count >= width)
  {
    return load(from);
  }
  Doubles vector = {};
  for (std::size_t l = 0; l < count; ++l)
  {
    vector[l] = from[l];
  }
  return vector;
}

/// The segments that start at the control points, and their lengths.
struct Segments
{
  Vectors along;
  double* length;
};

CACTUS_KERNEL_INLINE Segments segmentsOf(const FibreColumns& fibre, Columns& columns)
{
  const Vectors points = takeVectors(columns);
  part(fibre.points, fibre.count, points);
  const Segments segments = { takeVectors(columns), columns.take() };
  for (std::size_t i = 0; i + 1 < fibre.count; i += width)
  {
    Doubles d[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      d[axis] = load(points.axis[axis] + i + 1) - load(points.axis[axis] + i);
      store(segments.along.axis[axis] + i, d[axis]);
    }
    store(segments.length + i, squareRoot(dot(d, d)));
  }
  return segments;
}

/// Radii where vectors can read them.
CACTUS_KERNEL_INLINE double* radiiOf(const FibreColumns& fibre, Columns& columns)
{
  double* radii = columns.take();
  for (std::size_t i = 0; i < fibre.count; ++i)
  {
    radii[i] = fibre.radii[i];
  }
  return radii;
}

/// Sets a column to zero at the control points from … to − 1.
CACTUS_KERNEL_INLINE void clear(double* column, std::ptrdiff_t from, std::ptrdiff_t to)
{
  for (std::ptrdiff_t i = from; i < to; ++i)
  {
    column[i] = 0.0;
  }
}

std::size_t addCurvature(const FibreColumns& fibre, double weight, double& total, const FibreColumnGradients& gradients,
  double* room, std::uint32_t* sharp)
{
  const std::size_t count = fibre.count;
  if (count < 3)
  {
    return 0;
  }
  Columns columns(room, count);
  const Segments segments = segmentsOf(fibre, columns);
  const double* radii = radiiOf(fibre, columns);
  // Per bend, at its control point.
  const Vectors byU = takeVectors(columns);
  const Vectors byW = takeVectors(columns);
  double* byRadius = columns.take();
  double* stiffnessBefore = columns.take(); // for the control point before it
  double* stiffness = columns.take();
  double* stiffnessAfter = columns.take();
  double* cost = columns.take();
  double* limitedCosine = columns.take();
  const Doubles zero = {};
  for (std::size_t i = 1; i + 1 < count; i += width)
  {
    Doubles u[3], w[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      u[axis] = load(segments.along.axis[axis] + i - 1);
      w[axis] = load(segments.along.axis[axis] + i);
    }
    const Doubles lengthU = load(segments.length + i - 1);
    const Doubles lengthW = load(segments.length + i);
    const Doubles squaredU = lengthU * lengthU;
    const Doubles squaredW = lengthW * lengthW;
    const Doubles inverse = 1.0 / (lengthU * lengthW);
    const Doubles product = dot(u, w);
    const Doubles cosine = product * inverse;
    const Doubles radiusSum = load(radii + i - 1) + load(radii + i) + load(radii + i + 1);
    const Doubles bend = 1.0 - cosine;
    const Doubles scale = (zero + weight * 3.0) / radiusSum;
    store(cost + i, scale * bend * bend);
    const Doubles byCosine = -2.0 * scale * bend;
    const Doubles cosineU = cosine / squaredU;
    const Doubles cosineW = cosine / squaredW;
    for (int axis = 0; axis < 3; ++axis)
    {
      store(byU.axis[axis] + i, byCosine * (w[axis] * inverse - cosineU * u[axis]));
      store(byW.axis[axis] + i, byCosine * (u[axis] * inverse - cosineW * w[axis]));
    }
    store(byRadius + i, -scale * bend * bend / radiusSum);
    // (1 − cos θ)² ≈ θ⁴/4 has curvature 3 θ² ≈ 6 (1 − cos θ) in θ, and θ changes by 1/ℓ per unit of displacement.
    const Doubles curvature = 6.0 * scale * bend;
    store(stiffnessBefore + i, 4.0 * curvature / squaredU);
    store(stiffness + i, 4.0 * curvature * inverse * 4.0);
    store(stiffnessAfter + i, 4.0 * curvature / squaredW);
    // Rounded as in FibreCosts::addBendLimit.
    store(limitedCosine + i, product * (1.0 / squareRoot(dot(u, u) * dot(w, w))));
  }
  const auto end = static_cast<std::ptrdiff_t>(count);
  for (int axis = 0; axis < 3; ++axis)
  {
    clear(byU.axis[axis], -1, 1);
    clear(byU.axis[axis], end - 1, end + 1);
    clear(byW.axis[axis], -1, 1);
    clear(byW.axis[axis], end - 1, end + 1);
  }
  for (double* column : { byRadius, stiffnessBefore, stiffness, stiffnessAfter })
  {
    clear(column, -1, 1);
    clear(column, end - 1, end + 1);
  }
  const Vectors gradient = takeVectors(columns);
  part(gradients.byPoint, count, gradient);
  for (std::size_t i = 0; i < count; i += width)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* u = byU.axis[axis] + i;
      const double* w = byW.axis[axis] + i;
      store(gradient.axis[axis] + i, load(gradient.axis[axis] + i) + load(w - 1) + (load(u) - load(w)) - load(u + 1));
    }
    const double* radius = byRadius + i;
    storeSome(gradients.byRadius + i,
      loadSome(gradients.byRadius + i, count - i) + load(radius - 1) + load(radius) + load(radius + 1), count - i);
    storeSome(gradients.stiffness + i,
      loadSome(gradients.stiffness + i, count - i) + load(stiffnessAfter + i - 1) + load(stiffness + i) +
        load(stiffnessBefore + i + 1),
      count - i);
  }
  join(gradient, count, gradients.byPoint);
  std::size_t sharpOnes = 0;
  for (std::size_t i = 1; i + 1 < count; ++i)
  {
    total += cost[i];
    sharp[sharpOnes] = static_cast<std::uint32_t>(i);
    sharpOnes += fibre.smallestCosines[i] - limitedCosine[i] > 0.0 ? 1 : 0;
  }
  return sharpOnes;
}

void addLength(const FibreColumns& fibre, double weight, double& total, const FibreColumnGradients& gradients, double* room)
{
  const std::size_t count = fibre.count;
  Columns columns(room, count);
  const Segments segments = segmentsOf(fibre, columns);
  const double* radii = radiiOf(fibre, columns);
  // Per segment.
  const Vectors pull = takeVectors(columns);
  double* byFirstRadius = columns.take();
  double* byLastRadius = columns.take();
  double* stiffness = columns.take();
  double* cost = columns.take();
  const Doubles zero = {};
  const Doubles one = zero + 1.0;
  for (std::size_t i = 0; i + 1 < count; i += width)
  {
    const Doubles length = load(segments.length + i);
    const Doubles change = length - loadSome(fibre.referenceLengths + i, count - i);
    const Doubles first = load(radii + i);
    const Doubles last = load(radii + i + 1);
    const Doubles inverseRadii = one / first + one / last;
    const Doubles k = (zero + weight * 20.0) / inverseRadii;
    store(cost + i, 0.5 * k * change * change);
    const Doubles byLength = k * change / length;
    for (int axis = 0; axis < 3; ++axis)
    {
      store(pull.axis[axis] + i, byLength * load(segments.along.axis[axis] + i));
    }
    const Doubles byInverse = -0.5 * k * change * change / inverseRadii;
    store(byFirstRadius + i, byInverse / (first * first));
    store(byLastRadius + i, byInverse / (last * last));
    store(stiffness + i, 2.0 * k);
  }
  const auto end = static_cast<std::ptrdiff_t>(count);
  for (double* column : { pull.axis[0], pull.axis[1], pull.axis[2], byFirstRadius, byLastRadius, stiffness })
  {
    clear(column, -1, 0);
    clear(column, end - 1, end);
  }
  const Vectors gradient = takeVectors(columns);
  part(gradients.byPoint, count, gradient);
  for (std::size_t i = 0; i < count; i += width)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* p = pull.axis[axis] + i;
      store(gradient.axis[axis] + i, load(gradient.axis[axis] + i) + load(p - 1) - load(p));
    }
    storeSome(gradients.byRadius + i,
      loadSome(gradients.byRadius + i, count - i) - load(byLastRadius + i - 1) - load(byFirstRadius + i), count - i);
    storeSome(gradients.stiffness + i,
      loadSome(gradients.stiffness + i, count - i) + load(stiffness + i - 1) + load(stiffness + i), count - i);
  }
  join(gradient, count, gradients.byPoint);
  for (std::size_t i = 0; i + 1 < count; ++i)
  {
    total += cost[i];
  }
}

} // namespace

const FibreCostKernels CACTUS_KERNELS_OF_UNIT(FibreCostKernels) = { addCurvature, addLength };

} // namespace cactus
