// SPDX-License-Identifier: BSD-3-Clause
#include "base/Numbers.h"
#include "ScratchPath.h"

#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "bundle/RadiusDistribution.h"
#include "io/McdcConfiguration.h"
#include "io/PlyFile.h"
#include "io/StrandFile.h"
#include "judge/SubstrateCertificate.h"
#include "optimiser/CapsuleOptimizer.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <locale>
#include <string>
#include <sys/wait.h>

namespace
{

using cactus_testing::contentOf;

using namespace cactus;

/// Returns a number read from a text; NaN if there is none.
double taken(const std::string& text, const std::string& left = "")
{
  std::string_view rest = text;
  double value = std::nan("");
  if (!takeNumber(rest, value))
  {
    EXPECT_EQ(rest, text);
    EXPECT_TRUE(std::isnan(value));
    return value;
  }
  EXPECT_EQ(rest, left) << text;
  return value;
}

/// The German format of numbers: 1.234,5.
struct German : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Sets both the C++ library's and the C library's locale to a German one, and restores them at the end. The C library's is made
/// by localedef, if installed.
class GermanLocale
{
public:
  GermanLocale()
    : Before(std::locale::global(std::locale(std::locale::classic(), new German)))
  {
    const std::string folder = cactus_testing::scratchPath("locales");
    std::filesystem::create_directories(folder);
    const std::string command = "localedef -i de_DE -f UTF-8 '" + folder + "/de_DE.UTF-8' >/dev/null 2>&1";
    this->HasC = std::system(command.c_str()) != -1 && ::setenv("LOCPATH", folder.c_str(), 1) == 0 &&
                 std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  }
  ~GermanLocale()
  {
    std::locale::global(this->Before);
    std::setlocale(LC_ALL, "C");
    ::unsetenv("LOCPATH");
    std::filesystem::remove_all(cactus_testing::scratchPath("locales"));
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;

  bool hasC() const { return this->HasC; }

private:
  std::locale Before;
  bool HasC = false;
};

std::string messageOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "no error";
}

/// Returns every kind of text that core writes, from numbers with decimals and thousands, as one text.
std::string everyText()
{
  Fibres fibres;
  fibres.domain = Domain::cube(1234.5);
  fibres.addFibre(1, 1, 0.5);
  for (int i = 0; i < 1500; ++i)
  {
    fibres.addPoint({ 0.25, -1000.125, 0.75 * i }, 1.5);
  }
  const std::string path = cactus_testing::scratchPath("numbers.strands");
  writeStrandFile(fibres, path);
  std::string all = contentOf(path);
  const Fibres back = readStrandFile(path);
  std::remove(path.c_str());
  EXPECT_EQ(back.points, fibres.points);
  EXPECT_EQ(back.radii, fibres.radii);
  EXPECT_EQ(back.domain.upper, fibres.domain.upper);

  EXPECT_EQ(parseRadiusTable("0.25 1.5;2e-1, 1500.5"), (std::vector<double>{ 0.25, 1.5, 0.2, 1500.5 }));

  TriangleMesh mesh;
  mesh.points = { { 0.5, 1234.5, 0.0 }, { 1.5, 0.0, 0.0 }, { 0.0, 1.5, 0.0 } };
  mesh.triangles.assign(1200, { 0, 1, 2 });
  all += plyText(mesh, "numbers");
  EXPECT_EQ(asWritten(mesh).points[0][1], 1234.5);

  McdcOptions options;
  options.walkers = 123456;
  all += mcdcConfiguration(options, fibres.domain, extraSimulation(options, fibres.domain)) + mcdcScheme(options);
  all += text("a message with ", 1234.5, " and ", 123456);
  all += messageOf([&] { readRadiusTable(testing::TempDir() + "no/such/file"); });
  all += messageOf(
    []
    {
      RadiusDistributionOptions radius;
      radius.minimum = 2345.5;
      radius.maximum = 0.5;
      radius.validate();
    });
  all += messageOf(
    []
    {
      CapsuleOptimizerOptions optimizer;
      optimizer.stepSize = 12345.5;
      validate(optimizer);
    });
  all += messageOf(
    []
    {
      Fibres thin;
      thin.domain = Domain::cube(5.0);
      thin.addFibre(1, 1, 0.5);
      thin.addPoint({ 0, 0, 0 }, -1234.5);
      thin.addPoint({ 0, 0, 1 }, 0.5);
      validate(thin);
    });
  return all;
}

} // namespace

// Guarantee: every text that strtod accepts in the C locale is read, to the nearest double; others and non-finite numbers are
// refused.
TEST(Numbers, AreReadAsInTheCLocale)
{
  EXPECT_EQ(taken("1.5"), 1.5);
  EXPECT_EQ(taken("+1.5"), 1.5);
  EXPECT_EQ(taken("-1.5"), -1.5);
  EXPECT_EQ(taken("1."), 1.0);
  EXPECT_EQ(taken(".5"), 0.5);
  EXPECT_EQ(taken("-.5"), -0.5);
  EXPECT_EQ(taken("1e-3"), 1e-3);
  EXPECT_EQ(taken("1E+3"), 1e3);
  EXPECT_EQ(taken("1.5exy", "exy"), 1.5);
  EXPECT_EQ(taken("1,5", ",5"), 1.0);
  EXPECT_EQ(taken("0x1.8p1"), 3.0);
  EXPECT_EQ(taken("-0XA"), -10.0);
  // strtod of Debian 12 rounds these to the wrong side.
  EXPECT_EQ(taken("0x.7efef6928463cap-1022"), 0x0.7efef6928463dp-1022);
  EXPECT_EQ(taken("0x2de7b14b5f.d683p-1060"), 0x0.b79ec52d7f5a1p-1022);
  EXPECT_EQ(taken("0x.000000000000080p-1022"), 0.0) << "halfway between two";
  EXPECT_EQ(taken("0x.00000000000018p-1022"), 0x0.0000000000002p-1022) << "halfway between two";
  EXPECT_EQ(taken("0x.p1", "x.p1"), 0.0);
  EXPECT_EQ(taken("0xinf", "xinf"), 0.0);
  EXPECT_EQ(taken("0x-1", "x-1"), 0.0);
  EXPECT_EQ(taken("0x1P+4"), 16.0);
  EXPECT_EQ(taken("0x1p", "p"), 1.0);
  EXPECT_EQ(taken("0x8p+-3", "p+-3"), 8.0);
  EXPECT_EQ(taken("0x8p--3", "p--3"), 8.0);
  EXPECT_EQ(taken("0x" + std::string(400, 'f') + "p-1650"), 0x1p-50);
  EXPECT_EQ(taken("0x." + std::string(400, '0') + "1p1000"), 0x1p-604);
  EXPECT_EQ(taken("0x" + std::string(400, 'f') + "p-999999999999999999999"), 0.0);
  EXPECT_EQ(taken("0x1p-5000"), 0.0);
  EXPECT_EQ(taken("0xy", "xy"), 0.0);
  EXPECT_EQ(taken("4.9e-324"), 4.9e-324);
  EXPECT_EQ(taken("1e-400"), 0.0);
  EXPECT_EQ(taken("0.0001e-399"), 0.0);
  EXPECT_EQ(taken("1" + std::string(100, '0') + "e-999999999999999999999"), 0.0);
  EXPECT_EQ(taken("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(taken("0." + std::string(400, '0') + "1e+401"), 1.0);
  EXPECT_TRUE(std::signbit(taken("-1e-400")));
  EXPECT_EQ(taken("0e999999"), 0.0);
  for (const char* none : { "", "+", "-", "++1", "+-1", "-+1", "--1", "e5", ".", "x", "nan", "inf", "-infinity", "1e400",
         "-1e400", "1e999999999999999999999", "0x1p5000", "0x1p999999999999999999999" })
  {
    EXPECT_TRUE(std::isnan(taken(none))) << none;
  }
}

TEST(Numbers, AreWrittenAsPrintfDoesInTheCLocale)
{
  for (const double value : { 0.0, -0.0, 1.0, 0.1, -1234567.891, 1e-7, 123456789012.0, 2.0 / 3.0, 1e300, 5e-324 })
  {
    for (const int digits : { 1, 6, 9, 17 })
    {
      char expected[64];
      std::snprintf(expected, sizeof(expected), "%.*g", digits, value);
      std::string found = ">";
      appendNumber(found, value, digits);
      EXPECT_EQ(found, std::string(">") + expected);
    }
    EXPECT_EQ(taken(exactText(value)), value);
  }
  EXPECT_EQ(exactText(0.1), "0.1");
}

TEST(Numbers, ExcerptsAreShortAndPrintable)
{
  EXPECT_EQ(excerpt(std::string("a\0b\tc", 5)), "a b c");
  EXPECT_EQ(excerpt(std::string(1000, 'x')).size(), 63u);
  EXPECT_EQ(excerpt("0.5 \xc2\xb5m \xe6\xbc\xa2 \xf0\x9f\xa7\xa0"), "0.5 \xc2\xb5m \xe6\xbc\xa2 \xf0\x9f\xa7\xa0");
  // Invalid UTF-8 could not be passed on to Python or the window.
  EXPECT_EQ(excerpt("\xff\xfe"
                    "6"),
    "??6");
  EXPECT_EQ(excerpt("\xc0\x80 \xed\xa0\x80 \xf5\x80 \xc2"), "?? ??? ?? ?");
}

// Guarantee: reading and writing in core does not depend on the locale, neither C++'s nor C's.
TEST(Numbers, DoNotDependOnTheLocale)
{
  const std::string plain = everyText();
  EXPECT_EQ(plain.find("1.234,5"), std::string::npos);
  std::string german;
  {
    const GermanLocale locale;
    std::ostringstream proof;
    proof << 1234.5;
    ASSERT_EQ(proof.str(), "1.234,5");
    if (locale.hasC())
    {
      char text[16];
      std::snprintf(text, sizeof(text), "%.1f", 0.5);
      ASSERT_STREQ(text, "0,5");
    }
    else
    {
      std::cerr << "[ WARNING  ] localedef cannot make de_DE here: C's locale is not tested, only C++'s\n";
    }
    german = everyText();
  }
  EXPECT_EQ(german, plain);
}
