// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/Fibres.h"

#include "base/Error.h"
#include "fibres/JoinFibres.h"
#include "fibres/ResampledFibres.h"
#include "fibres/SelectFibres.h"
#include "fibres/TrimToDomain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace
{

using cactus::Fibres;

Fibres pair()
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  for (int f = 0; f < 2; ++f)
  {
    fibres.addFibre(11 + f, 1, 0.5);
    for (int i = 0; i < 3; ++i)
    {
      fibres.addPoint({ 2.0 * f, 0.0, -5.0 + 5.0 * i }, 0.5);
    }
  }
  return fibres;
}

std::string errorOf(const std::function<void(Fibres&)>& spoil)
{
  Fibres fibres = pair();
  spoil(fibres);
  try
  {
    cactus::validate(fibres);
  }
  catch (const cactus::InvalidInput& error)
  {
    return error.what();
  }
  return "";
}

void expectNamed(const std::string& message, const char* part)
{
  EXPECT_NE(message.find(part), std::string::npos) << '"' << message << "\" does not say " << part;
}

} // namespace

// Guarantee 5: an invalid substrate is refused with the name of the fibre and the control point.
TEST(Fibres, NumbersBeyondThePhysicalLimitsAreRefusedByName)
{
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(errorOf([](Fibres&) {}), "");
  for (const double bad : { 0.0, -1.0, 1e-300, 1e-6, 9.9e-4, 1001.0, 1e30, 1e300, inf, -inf, std::nan("") })
  {
    const std::string message = errorOf([&](Fibres& fibres) { fibres.radii[4] = bad; });
    expectNamed(message, "fibre 12 (cell 1), control point 1");
    expectNamed(message, "Radius");
    expectNamed(errorOf([&](Fibres& fibres) { fibres.targetRadii[1] = bad; }), "fibre 12 (cell 1): TargetRadius");
  }
  for (const double bad : { 1.00001e5, -1e9, 1e40, -1e300, inf, std::nan("") })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::string message = errorOf([&](Fibres& fibres) { fibres.points[2][axis] = bad; });
      expectNamed(message, "fibre 11 (cell 0), control point 2");
      expectNamed(message, "coordinate");
      expectNamed(errorOf([&](Fibres& fibres) { fibres.domain.upper[axis] = bad; }), "Domain");
      expectNamed(errorOf([&](Fibres& fibres) { fibres.domain.lower[axis] = bad; }), "Domain");
    }
  }
  expectNamed(errorOf([](Fibres& fibres) { fibres.domain = cactus::Domain::cube(1e-300); }), "Domain");
}

TEST(Fibres, TheLimitsThemselvesAreGood)
{
  EXPECT_EQ(errorOf([](Fibres& fibres) { fibres.radii[0] = 1e-3; }), "");
  EXPECT_EQ(errorOf([](Fibres& fibres) { fibres.radii[0] = 1e3; }), "");
  EXPECT_EQ(errorOf([](Fibres& fibres) { fibres.points[0] = { -1e5, 1e5, 1e5 }; }), "");
  EXPECT_EQ(errorOf([](Fibres& fibres) { fibres.domain = cactus::Domain::cube(0.1); }), "");
  EXPECT_EQ(errorOf([](Fibres& fibres) { fibres.domain = cactus::Domain::cube(1e5); }), "");
}

TEST(Fibres, MyelinFractionsStayWithTheirControlPoints)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(10.0);
  const Fibres whole = pair();
  fibres.addFibre(whole, 0);
  fibres.addPoints(whole, 0, 3); // before anything is said of myelin
  fibres.addFibre(1, 1, 0.5);
  for (int i = 0; i < 201; ++i)
  {
    fibres.addPoint({ 4.0, 0.0, -10.0 + 0.1 * i }, 0.5);
    fibres.setMyelinFraction(0.005 * i);
  }
  fibres.addFibre(2, 1, 0.5);
  fibres.addPoint({ 4.0, 3.0, -6.0 }, 0.5);
  fibres.addPoint({ 4.0, 3.0, 6.0 }, 0.5);
  const auto expectLinear = [](const Fibres& given)
  {
    ASSERT_EQ(given.myelinFractions.size(), given.points.size());
    for (std::size_t f = 0; f < given.size(); ++f)
    {
      for (std::size_t i = given.offsets[f]; i < given.offsets[f + 1]; ++i)
      {
        EXPECT_NEAR(given.myelinFractions[i], given.fibreIds[f] == 1 ? 0.05 * (given.points[i].z() + 10.0) : 1.0, 1e-9);
      }
    }
  };
  expectLinear(fibres);
  expectLinear(cactus::trimToDomain(fibres));
  expectLinear(cactus::selectFibres(fibres, { 2, 1 }));
  Fibres all = whole;
  cactus::appendFibres(cactus::selectFibres(fibres, { 1 }), all);
  expectLinear(all);
  EXPECT_EQ(cactus::resampleDenseFibres(fibres).fibres, 1u);
  EXPECT_LT(fibres.pointCount(1), 100u);
  expectLinear(fibres);
  EXPECT_TRUE(cactus::selectFibres(whole, { 0, 1 }).myelinFractions.empty());
  expectNamed(errorOf([](Fibres& one) { one.setMyelinFraction(1.2); }), "control point 2: MyelinFraction");
  expectNamed(errorOf([](Fibres& one) { one.setMyelinFraction(std::nan("")); }), "MyelinFraction");
}
