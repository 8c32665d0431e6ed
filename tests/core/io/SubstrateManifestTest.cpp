// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateManifest.h"

#include "base/Constants.h"
#include "base/JsonText.h"
#include "base/Sha256.h"
#include "judge/SubstrateStatistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace
{

std::string exampleText()
{
  cactus::SubstrateFolderContents contents;
  contents.domain = cactus::Domain::cube(30.0);
  contents.provenance = { "StrandReader FileName=\"a\\b\"\n", "not UTF-8: \xff" };
  cactus::WrittenSubstrate substrate;
  substrate.files = { { "outer/fibre_00001.ply", "outer", 1, 1, 4, std::numeric_limits<double>::quiet_NaN(), 0.1, true } };
  cactus::WrittenFiles written;
  written.checksums = { { "README.txt", cactus::sha256("read me") }, { "outer/fibre_00001.ply", cactus::sha256("ply") } };
  written.folders = { "outer" };
  return cactus::manifestText(contents, substrate, written);
}

} // namespace

TEST(SubstrateManifest, SaysWhatWasWritten)
{
  const std::string text = exampleText();
  const auto manifest = cactus::readManifest(text);
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->version, CACTUS_VERSION);
  EXPECT_TRUE(manifest->hasChecksums);
  EXPECT_TRUE(manifest->asWritten);
  EXPECT_EQ(manifest->written.checksums.size(), 2u);
  EXPECT_EQ(manifest->written.checksums.at("README.txt"), cactus::sha256("read me"));
  EXPECT_EQ(manifest->written.folders, std::set<std::string>{ "outer" });
  EXPECT_NE(text.find("\n  \"domain\": [-15.0, 15.0, -15.0, 15.0, -15.0, 15.0],\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\"volume_um3\": null, \"area_um2\": 0.1,"), std::string::npos) << "JSON has no NaN";
}

// Two straight fibres, each at 10° to z, and 20° to each other.
TEST(SubstrateManifest, HasTheDirectionsOfTheFibres)
{
  const double slant = std::tan(10.0 * cactus::pi / 180.0);
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(30.0);
  for (const int side : { -1, 1 })
  {
    fibres.addFibre(side + 2, 1, 0.5);
    for (const double z : { -20.0, -3.0, 20.0 })
    {
      fibres.addPoint({ side * slant * z, 2.0 * side, z }, 0.5);
    }
  }
  cactus::SubstrateFolderContents contents;
  contents.domain = fibres.domain;
  EXPECT_EQ(cactus::manifestText(contents, {}, {}).find("directions"), std::string::npos);
  contents.fibres = &fibres;
  cactus::WrittenSubstrate substrate;
  substrate.certificate.fibres.resize(1);
  substrate.certificate.fibres[0].fibreId = 1; // the other one has no axon
  substrate.certificate.fibres[0].innerRadius.mean = 0.3;
  const auto manifest = cactus::parsedJson(cactus::manifestText(contents, substrate, {}));
  ASSERT_TRUE(manifest);
  const cactus::Json& directions = manifest->at("directions");
  const double p2 = 1.5 * std::pow(std::cos(10.0 * cactus::pi / 180.0), 2.0) - 0.5;
  EXPECT_NEAR(directions.at("mean_dispersion_deg").get<double>(), 10.0, 1e-5);
  EXPECT_NEAR(directions.at("tangent_dispersion_deg").get<double>(), 10.0, 1e-5);
  EXPECT_NEAR(directions.at("p2").get<double>(), p2, 1e-5);
  EXPECT_NEAR(directions.at("p2_by_axon_volume").get<double>(), p2, 1e-5);
  EXPECT_NEAR(directions.at("odi").get<double>(), 2.0 / cactus::pi * std::atan(1.0 / directions.at("kappa").get<double>()), 1e-5);
  EXPECT_NEAR(directions.at("local_spread_deg").get<double>(), 20.0, 1e-5);
  EXPECT_NEAR(directions.at("sinuosity").get<double>(), 1.0, 1e-5);
  // A curved one, of which less is in the domain: means are over length, as in the statistics.
  fibres.addFibre(7, 1, 0.5);
  for (const Eigen::Vector3d& point : { Eigen::Vector3d(5, 5, 0), Eigen::Vector3d(7, 5, 6), Eigen::Vector3d(5, 5, 12) })
  {
    fibres.addPoint(point, 0.5);
  }
  const auto more = cactus::parsedJson(cactus::manifestText(contents, substrate, {}))->at("directions");
  const cactus::SubstrateStatistics statistics = cactus::measureSubstrate(fibres, {}, {});
  EXPECT_GT(statistics.meanSinuosity, 1.005);
  EXPECT_NEAR(more.at("sinuosity").get<double>(), statistics.meanSinuosity, 1e-5);
  EXPECT_NEAR(more.at("twist").get<double>(), statistics.directions.twist, 1e-5);
  EXPECT_NEAR(more.at("kappa").get<double>(), statistics.directions.kappa, 1e-4 * statistics.directions.kappa);
  fibres = fibres.emptyCopy();
  const auto none = cactus::parsedJson(cactus::manifestText(contents, substrate, {}));
  EXPECT_TRUE(none->at("directions").at("p2").is_null()) << "JSON has no NaN";
}

TEST(SubstrateManifest, CountsBeyond32Bits)
{
  cactus::WrittenSubstrate substrate;
  for (int id = 1; id <= 3; ++id)
  {
    substrate.files.push_back({ "outer/fibre.ply", "outer", id, 1, std::size_t(3000000000), 1.0, 1.0, true });
  }
  const std::string text = cactus::manifestText({}, substrate, {});
  EXPECT_NE(text.find("\"triangles\": 9000000000,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"triangles\": 3000000000,"), std::string::npos);
}

TEST(SubstrateManifest, ShowsEveryChangeToIt)
{
  const std::string text = exampleText();
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    const auto manifest = cactus::readManifest(changed);
    EXPECT_TRUE(!manifest || !manifest->asWritten) << "byte " << i;
    const auto cut = cactus::readManifest(text.substr(0, i));
    EXPECT_FALSE(cut && cut->asWritten) << "cut at " << i;
  }
}

TEST(SubstrateManifest, TellsOthersFromOurs)
{
  for (const char* text :
    { "", "{}", "[]", "null", "{\"format\": 3}", "{\"format\": \"another\"}", "{\"name\": \"CACTUS substrate folder\"}",
      "{\"format\": \"CACTUS substrate folder\"", "\"CACTUS substrate folder\"", "\xff\xfe" })
  {
    EXPECT_FALSE(cactus::readManifest(text)) << text;
  }
  EXPECT_FALSE(cactus::readManifest(std::string(1000000, '['))) << "deeply nested";
  const auto early =
    cactus::readManifest("{\"format\": \"CACTUS substrate folder\", \"version\": \"0.1.0\", \"files\": [{\"path\": \"x\"}]}");
  ASSERT_TRUE(early);
  EXPECT_FALSE(early->hasChecksums);
  const auto odd = cactus::readManifest("{\"format\": \"CACTUS substrate folder\", \"version\": 1, \"folders\": [1, [\"x\"]], "
                                        "\"sha256\": {\"a\": 1, \"b\": {}}, \"manifest_sha256\": \"\"}");
  ASSERT_TRUE(odd);
  EXPECT_TRUE(odd->written.checksums.empty());
  EXPECT_TRUE(odd->written.folders.empty());
  EXPECT_FALSE(odd->asWritten);
}
