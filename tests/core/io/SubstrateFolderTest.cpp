// SPDX-License-Identifier: BSD-3-Clause
#include "io/SubstrateFolder.h"

#include "ExampleSurfaces.h"
#include "RandomBundle.h"
#include "ScratchPath.h"
#include "base/Error.h"
#include "io/CombinedSurfaces.h"
#include "io/OpenSurfaces.h"
#include "io/PlyFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{

using cactus_testing::contentOf;
using example::surfacesOf;

cactus::TriangleMesh tetrahedron(double size)
{
  cactus::TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { size, 0, 0 }, { 0, size, 0 }, { 0, 0, size } };
  mesh.triangles = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 0, 3, 2 } }, { { 1, 2, 3 } } };
  return mesh;
}

/// Makes fibres from the domain's lower to its upper face, straight.
cactus::Fibres fibresAcross(const cactus::Domain& domain, const std::vector<int>& ids)
{
  cactus::Fibres fibres;
  fibres.domain = domain;
  for (const int id : ids)
  {
    fibres.addFibre(id, 1, 1.0);
    fibres.addPoint({ 0, 0, domain.lower[2] }, 1.0);
    fibres.addPoint({ 0, 0, domain.upper[2] }, 1.0);
  }
  return fibres;
}

class SubstrateFolder : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Scratch = fs::path(::testing::TempDir()) / ("substrate-folder-test-" + std::to_string(::getpid()));
    fs::remove_all(this->Scratch);
    fs::create_directories(this->Scratch);
    this->Contents.domain = cactus::Domain::cube(30.0);
    this->Contents.outer = surfacesOf({ 2, 70000 }, { tetrahedron(1.0), tetrahedron(2.0) });
    this->Contents.inner = surfacesOf({ 2 }, { tetrahedron(0.5) });
  }
  void TearDown() override
  {
    fs::permissions(this->Scratch, fs::perms::owner_all);
    fs::remove_all(this->Scratch);
  }

  /// Replaces the substrate by fibre 2 alone, with both surfaces.
  void takeFibre(const cactus::Fibres& fibres)
  {
    this->Contents.fibres = &fibres;
    this->Contents.outer = surfacesOf({ 2 }, { tetrahedron(13.0) });
    this->Contents.inner = surfacesOf({ 2 }, { tetrahedron(8.0) });
  }

  std::string write(const fs::path& folder)
  {
    try
    {
      cactus::writeSubstrateFolder(this->Contents, folder.string());
    }
    catch (const cactus::Error& error)
    {
      return error.what();
    }
    return "";
  }
  /// Returns the entries of the scratch folder, sorted.
  std::vector<std::string> entries() const
  {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(this->Scratch))
    {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path Scratch;
  cactus::SubstrateFolderContents Contents;
};

} // namespace

TEST(PlyFile, Text)
{
  auto mesh = tetrahedron(1.0);
  mesh.points[1] = { 1.0 / 3.0, -2e-7, 123456.789123 };
  const std::string text = cactus::plyText(mesh, "one surface");
  std::istringstream lines(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);)
  {
    all.push_back(line);
  }
  ASSERT_EQ(all.size(), 10u + 4u + 4u);
  EXPECT_EQ(all[0], "ply");
  EXPECT_EQ(all[2], "comment one surface");
  EXPECT_EQ(all[3], "element vertex 4");
  EXPECT_EQ(all[7], "element face 4");
  EXPECT_EQ(all[9], "end_header");
  EXPECT_EQ(all[11], "0.333333333 -2e-07 123456.789");
  EXPECT_EQ(all[14], "3 0 2 1");
  EXPECT_THROW(cactus::plyText(mesh, "a face of it"), cactus::InvalidInput);
  EXPECT_THROW(cactus::plyText(mesh, "two\nlines"), cactus::InvalidInput);
}

// Reads it byte by byte: single precision and triangles, little-endian, and nothing else.
TEST(PlyFile, Bytes)
{
  auto mesh = tetrahedron(1.0);
  mesh.points[1] = { 1.0 / 3.0, -2e-7, 123456.789123 };
  const std::string text = cactus::plyText(mesh, "one surface", cactus::PlyEncoding::Binary);
  const std::string end = "end_header\n";
  const std::string head = text.substr(0, text.find(end));
  EXPECT_EQ(head, "ply\nformat binary_little_endian 1.0\ncomment one surface\nelement vertex 4\nproperty float x\n"
                  "property float y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\n");
  const std::string bytes = text.substr(head.size() + end.size());
  ASSERT_EQ(bytes.size(), 4u * 12u + 4u * 13u);
  const auto number = [&](std::size_t at)
  {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      bits |= std::uint32_t(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    }
    return bits;
  };
  EXPECT_EQ(number(12), 0x3eaaaaabu); // 1/3
  EXPECT_EQ(number(20), 0x47f12065u); // 123456.789
  EXPECT_EQ(bytes[48], 3);
  EXPECT_EQ(number(48 + 1), 0u);
  EXPECT_EQ(number(48 + 5), 2u);
  const auto written = cactus::asWritten(mesh, cactus::PlyEncoding::Binary);
  EXPECT_EQ(written.points[1][0], double(1.0F / 3.0F));
  EXPECT_EQ(written.points[1][2], double(123456.789123F));
  EXPECT_THROW(cactus::plyText(mesh, "a face of it", cactus::PlyEncoding::Binary), cactus::InvalidInput);
}

// Simulators that read PLY files know text only, and do not get binary ones.
TEST_F(SubstrateFolder, HasBytesWhereNoSimulatorReadsThem)
{
  using Format = cactus::SubstrateFormat;
  const cactus::Fibres fibres = randomBundle(1, 2, 4, 30.0, 0.0);
  this->Contents.fibres = &fibres;
  this->Contents.encoding = cactus::PlyEncoding::Binary;
  for (const Format format : { Format::Mcdc, Format::Reference, Format::Camino, Format::Disimpy })
  {
    this->Contents.format = format;
    EXPECT_NE(this->write(this->Scratch / "s").find("Encoding Binary is not for"), std::string::npos);
    EXPECT_FALSE(fs::exists(this->Scratch / "s"));
  }
  this->Contents.format = Format::Surfaces;
  ASSERT_EQ(this->write(this->Scratch / "s"), "");
  EXPECT_EQ(contentOf(this->Scratch / "s/outer/fibre_00002.ply").substr(0, 31), "ply\nformat binary_little_endian");
  EXPECT_FALSE(fs::exists(this->Scratch / "s/mcdc"));
  EXPECT_NE(contentOf(this->Scratch / "s/README.txt").find("one binary PLY file per fibre"), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"simulator\": \"Surfaces alone\""), std::string::npos);
  EXPECT_EQ(this->write(this->Scratch / "s"), "") << "is replaced";
}

// A PLY file for Camino numbers points with 32 bits and a sign; NumPy's arrays have 64.
TEST(CombinedSurfaces, SaysWhereAFileCannotNumberItsPoints)
{
  cactus::SurfaceBox box;
  box.points = 2147483647;
  box.triangles = 4294967290;
  EXPECT_NE(cactus::caminoHead(box).find("vertex 2147483647\n"), std::string::npos);
  EXPECT_NE(cactus::caminoHead(box).find("face 4294967290\n"), std::string::npos);
  const auto head = [&box] { return cactus::bundleHead(box, "bundle 1", cactus::PlyEncoding::Binary); };
  EXPECT_NE(head().find("vertex 2147483647\n"), std::string::npos);
  EXPECT_NE(head().find("face 4294967290\n"), std::string::npos);
  ++box.points;
  EXPECT_THROW(cactus::caminoHead(box), cactus::InvalidInput);
  EXPECT_THROW(head(), cactus::InvalidInput);
}

// A file has the fibres of its bundle one after the other, and no others; corners are numbered consecutively.
TEST_F(SubstrateFolder, HasAFileForEachBundle)
{
  this->Contents.outer = surfacesOf({ 2, 5, 9 }, { tetrahedron(1.0), tetrahedron(2.0), tetrahedron(3.0) });
  this->Contents.outer.bundleIds = { 1, 4, 1 };
  this->Contents.inner = {};
  this->Contents.format = cactus::SubstrateFormat::Bundles;
  const fs::path place = this->Scratch / "s/outer";
  ASSERT_EQ(this->write(this->Scratch / "s"), "");
  const std::string first = contentOf(place / "bundle_00001.ply");
  const std::string body = "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n"
                           "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n";
  EXPECT_NE(first.find("outer surfaces of bundle 1, micrometres\nelement vertex 8\n"), std::string::npos);
  EXPECT_NE(first.find("element face 8\n"), std::string::npos);
  EXPECT_EQ(first.substr(first.find("end_header")), body);
  // A surface alone in its file has the bytes of a separate file except for the comment.
  const auto after = [](const std::string& text) { return text.substr(text.find("element")); };
  EXPECT_EQ(after(contentOf(place / "bundle_00004.ply")), after(cactus::plyText(tetrahedron(2.0), "")));
  EXPECT_EQ(std::distance(fs::directory_iterator(place), fs::directory_iterator()), 2);
  const std::string manifest = contentOf(this->Scratch / "s/manifest.json");
  EXPECT_NE(manifest.find("\"path\": \"outer/bundle_00001.ply\", \"surface\": \"outer\", \"fibre\": 9"), std::string::npos)
    << manifest;
  EXPECT_NE(contentOf(this->Scratch / "s/README.txt").find("one ASCII PLY file per bundle"), std::string::npos);
  this->Contents.encoding = cactus::PlyEncoding::Binary;
  ASSERT_EQ(this->write(this->Scratch / "s"), "") << "is replaced";
  EXPECT_EQ(
    after(contentOf(place / "bundle_00004.ply")), after(cactus::plyText(tetrahedron(2.0), "", cactus::PlyEncoding::Binary)));
}

// With more than a thousand fibres each folder holds at most a thousand files. MC/DC's lists have the new paths, and the folder
// is recognised as ours, and replaced.
TEST_F(SubstrateFolder, HasFoldersForEachThousandOfMany)
{
  std::vector<int> ids(1001);
  std::iota(ids.begin(), ids.end(), 500);
  const auto mesh = [](std::size_t i) {
    return example::tetrahedron({ -14.0 + 0.5 * double(i % 50), 0.5 * double(i / 50), 0 }, 0.2);
  };
  this->Contents.outer.fibreIds = ids;
  this->Contents.outer.bundleIds.assign(ids.size(), 1);
  this->Contents.outer.mesh = mesh;
  this->Contents.inner = {};
  ASSERT_EQ(this->write(this->Scratch / "s"), "");
  std::map<std::string, std::size_t> files;
  for (const auto& entry : fs::recursive_directory_iterator(this->Scratch / "s/outer"))
  {
    files[entry.path().parent_path().filename().string()] += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(files, (std::map<std::string, std::size_t>{ { "outer", 0 }, { "00000", 500 }, { "00001", 501 } }));
  const std::string list = contentOf(this->Scratch / "s/mcdc/extra_ply_list.txt");
  EXPECT_NE(list.find("\nouter/00000/fibre_00999.ply\nouter/00001/fibre_01000.ply\n"), std::string::npos);
  EXPECT_EQ(this->write(this->Scratch / "s"), "") << "is replaced";
  std::ofstream(this->Scratch / "s/outer/00001/mine.ply") << "mine";
  EXPECT_NE(this->write(this->Scratch / "s").find("outer/00001/mine.ply"), std::string::npos);
}

// A listing of a folder, and of what a shell makes of *.ply, has files in the order of their ids, also above 99,999.
TEST_F(SubstrateFolder, HasNamesThatSortAsTheirNumbersDo)
{
  using Paths = std::vector<std::string>;
  const auto paths = [this](cactus::SubstrateFormat format)
  {
    this->Contents.format = format;
    Paths all;
    for (const auto& file : cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string()).files)
    {
      all.push_back(file.path);
      EXPECT_TRUE(fs::exists(this->Scratch / "s" / file.path)) << file.path;
    }
    return all;
  };
  this->Contents.inner = {};
  this->Contents.outer = surfacesOf({ 2, 99999 }, { tetrahedron(1.0), tetrahedron(2.0) });
  EXPECT_EQ(paths(cactus::SubstrateFormat::Surfaces), (Paths{ "outer/fibre_00002.ply", "outer/fibre_99999.ply" }));
  this->Contents.outer = surfacesOf({ 2, 100000 }, { tetrahedron(1.0), tetrahedron(2.0) });
  EXPECT_EQ(paths(cactus::SubstrateFormat::Surfaces), (Paths{ "outer/fibre_000002.ply", "outer/fibre_100000.ply" }));
  this->Contents.outer.bundleIds = { 7, 1234567 };
  EXPECT_EQ(paths(cactus::SubstrateFormat::Bundles), (Paths{ "outer/bundle_0000007.ply", "outer/bundle_1234567.ply" }));
  // Inner surfaces have the digits of the outer ones.
  this->Contents.inner = surfacesOf({ 2 }, { tetrahedron(0.5) });
  EXPECT_EQ(paths(cactus::SubstrateFormat::Surfaces).back(), "inner/fibre_000002.ply");
}

TEST_F(SubstrateFolder, HoldsWhatTheManifestSays)
{
  const auto files = cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s/").string()).files;
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].path, "outer/fibre_00002.ply");
  EXPECT_EQ(files[1].path, "outer/fibre_70000.ply");
  EXPECT_EQ(files[2].path, "inner/fibre_00002.ply");
  EXPECT_NEAR(files[1].volume, 8.0 / 6.0, 1e-12);
  EXPECT_TRUE(files[1].closed);
  EXPECT_EQ(this->entries(), std::vector<std::string>{ "s" });
  for (const auto& file : files)
  {
    EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"" + file.path + "\""), std::string::npos);
    EXPECT_EQ(contentOf(this->Scratch / "s" / file.path).substr(0, 4), "ply\n");
  }
  EXPECT_EQ(contentOf(this->Scratch / "s/mcdc/extra_ply_list.txt"), "1e-3\nouter/fibre_00002.ply\nouter/fibre_70000.ply\n");
  EXPECT_EQ(contentOf(this->Scratch / "s/mcdc/intra_ply_list.txt"), "1e-3\ninner/fibre_00002.ply\n");
  EXPECT_TRUE(fs::is_directory(this->Scratch / "s/mcdc/output"));
  EXPECT_FALSE(fs::exists(this->Scratch / "s/fibres.strands"));
}

// Of a periodic substrate, a simulator that repeats it joins the pieces of fibres: the certificate judges them with their caps.
TEST_F(SubstrateFolder, IsAnOpenTile)
{
  this->Contents.domain = cactus::Domain::cube(8.0);
  this->Contents.domain.periodic = { { true, true, true } };
  this->Contents.outer =
    surfacesOf({ 2, 3 }, { example::box({ -1, -1, -4 }, { 1, 1, 4 }), example::box({ 2, 2, -1 }, { 3, 3, 1 }) });
  this->Contents.inner = surfacesOf({ 2 }, { example::box({ -0.5, -0.5, -3.98 }, { 0.5, 0.5, 3.98 }) });
  this->Contents.periodicFaces = cactus::PeriodicFaces::Open;
  const auto written = cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string());
  EXPECT_TRUE(written.certificate.certified());
  ASSERT_EQ(written.files.size(), 3u);
  const auto isAs = [&](std::size_t i, std::size_t triangles, double area, double volume, bool isClosed)
  {
    const cactus::SubstrateFile& file = written.files[i];
    EXPECT_EQ(file.triangles, triangles) << file.path;
    EXPECT_NEAR(file.area, area, 1e-12) << file.path;
    EXPECT_NEAR(file.volume, volume, 1e-12) << file.path;
    EXPECT_EQ(file.closed, isClosed) << file.path;
  };
  isAs(0, 8, 64.0, 32.0, false);
  isAs(1, 12, 10.0, 2.0, true);
  isAs(2, 8, 32.0, 7.96, false);
  const std::string axon = contentOf(this->Scratch / "s/inner/fibre_00002.ply");
  EXPECT_NE(axon.find("element face 8\n"), std::string::npos);
  EXPECT_NE(axon.find("0.5 0.5 4\n"), std::string::npos);
  EXPECT_EQ(axon.find("3.98"), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"periodic_faces\": \"Open\""), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "s/README.txt").find("Surfaces are open there"), std::string::npos);
  // Walkers start from points up to the faces: by lines, MC/DC could not tell where they are.
  EXPECT_NE(contentOf(this->Scratch / "s/mcdc/intra.conf").find("ini_walkers_file start/intra.txt"), std::string::npos);
  std::istringstream starts(contentOf(this->Scratch / "s/start/intra.txt"));
  double highest = 0.0;
  for (double x, y, z; starts >> x >> y >> z;)
  {
    highest = std::max(highest, z);
  }
  EXPECT_GT(highest, 3.9e-3);
  // MC/DC does not keep caps and the voxel's wall apart, so that walkers outside get in.
  const std::string passing = "caps of fibres lie there, too";
  EXPECT_EQ(contentOf(this->Scratch / "s/README.txt").find(passing), std::string::npos);

  this->Contents.periodicFaces = cactus::PeriodicFaces::Caps;
  ASSERT_EQ(this->write(this->Scratch / "capped"), "");
  EXPECT_NE(contentOf(this->Scratch / "capped/README.txt").find(passing), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "capped/manifest.json").find("\"periodic_faces\": \"Caps\""), std::string::npos);
}

TEST(SubstrateFolderFaces, FollowTheFormat)
{
  using cactus::PeriodicFaces, cactus::SubstrateFormat;
  const cactus::Domain cube = cactus::Domain::cube(8.0);
  cactus::Domain periodic = cube;
  periodic.periodic = { { true, true, false } };
  const auto faces = [](SubstrateFormat format, const cactus::Domain& domain, bool allowOpen = false)
  { return cactus::facesFor(PeriodicFaces::ByFormat, format, domain, allowOpen); };
  EXPECT_EQ(faces(SubstrateFormat::Mcdc, periodic), PeriodicFaces::Open);
  EXPECT_EQ(faces(SubstrateFormat::Mcdc, cube), PeriodicFaces::Caps);
  EXPECT_EQ(faces(SubstrateFormat::Mcdc, periodic, true), PeriodicFaces::Caps);
  EXPECT_EQ(faces(SubstrateFormat::Surfaces, periodic), PeriodicFaces::Caps);
  EXPECT_EQ(cactus::facesFor(PeriodicFaces::Caps, SubstrateFormat::Mcdc, periodic, false), PeriodicFaces::Caps);
  EXPECT_EQ(cactus::facesFor(PeriodicFaces::Open, SubstrateFormat::Surfaces, periodic, false), PeriodicFaces::Open);
}

TEST_F(SubstrateFolder, IsNoOpenTileOfOtherThings)
{
  this->Contents.periodicFaces = cactus::PeriodicFaces::Open;
  const auto refused = [&](const std::string& why)
  {
    const std::string error = this->write(this->Scratch / "s");
    EXPECT_NE(error.find(why), std::string::npos) << error;
    EXPECT_FALSE(fs::exists(this->Scratch / "s"));
  };
  refused("this one is not periodic");
  this->Contents.domain = cactus::Domain::cube(8.0);
  this->Contents.domain.periodic = { { true, true, true } };
  for (const auto format : { cactus::SubstrateFormat::Camino, cactus::SubstrateFormat::Disimpy, cactus::SubstrateFormat::Rms,
         cactus::SubstrateFormat::SpinDoctor, cactus::SubstrateFormat::Mcmr })
  {
    this->Contents.format = format;
    refused(std::string("Format ") + cactus::formatNames[std::size_t(format)] + " needs closed ones");
  }
  this->Contents.format = cactus::SubstrateFormat::Surfaces;
  this->Contents.allowOpenSurfaces = true;
  refused("with AllowOpenSurfaces they need not be closed");
  this->Contents.allowOpenSurfaces = false;
  cactus::TriangleMesh bent = example::box({ -1, -1, -4 }, { 1, 1, 4 });
  bent.points[7] = { 0.9, 0.9, 4 };
  this->Contents.outer = surfacesOf({ 2 }, { bent });
  this->Contents.inner = {};
  refused("the outer surface of fibre 2 does not end alike in the two faces across z, and copies of it would not join");
  this->Contents.outer = surfacesOf({ 2 }, { example::box({ -1, -1, -4 }, { 1, 1, 4 }) });
  this->Contents.inner = surfacesOf({ 2 }, { example::box({ -0.5, -0.5, -3.98 }, { 0.5, 0.5, 3.98 }) });
  EXPECT_EQ(this->write(this->Scratch / "s"), "");
}

// The folder's certificate judges the surfaces as stored in its files.
TEST_F(SubstrateFolder, HoldsItsCertificate)
{
  auto inside = tetrahedron(0.5);
  for (auto& point : inside.points)
  {
    point += Eigen::Vector3d(0.1, 0.1, 0.1);
  }
  this->Contents.outer = surfacesOf({ 2 }, { tetrahedron(1.0) });
  this->Contents.inner = surfacesOf({ 2 }, { inside });
  auto written = cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string());
  EXPECT_TRUE(written.certificate.certified());
  EXPECT_EQ(contentOf(this->Scratch / "s/certificate.csv").substr(0, 27), "quantity,value\nCertified,1\n");
  EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"certified\": true"), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "s/README.txt").find("\nCERTIFIED: "), std::string::npos);
  EXPECT_NE(
    contentOf(this->Scratch / "s/manifest.json").find("\"judged\": [\n    \"outer\",\n    \"inner\"\n  ]"), std::string::npos);
  std::istringstream fibres(contentOf(this->Scratch / "s/certificate_fibres.csv"));
  std::string names;
  std::string row;
  std::getline(fibres, names);
  std::getline(fibres, row);
  EXPECT_EQ(names.substr(0, 8), "FibreId,");
  EXPECT_EQ(row.substr(0, 6), "2,1,1,");
  EXPECT_EQ(std::count(names.begin(), names.end(), ','), std::count(row.begin(), row.end(), ','));

  // Apart by less than nine digits can hold: in the files they touch.
  auto beside = tetrahedron(1.0);
  for (auto& point : beside.points)
  {
    point[0] += 1.0 + 1e-12;
  }
  this->Contents.outer = surfacesOf({ 2, 3 }, { tetrahedron(1.0), beside });
  this->Contents.certificate.minimumGap = 0.0;
  written = cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string());
  EXPECT_EQ(written.certificate.meetingPairs, 1u);
  EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"certified\": false"), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "s/README.txt").find("NOT CERTIFIED"), std::string::npos);
  EXPECT_NE(contentOf(this->Scratch / "s/README.txt").find("1 pairs of outer surfaces cut or touch"), std::string::npos);
}

// Half a substrate is not passed off as a whole one.
TEST_F(SubstrateFolder, SaysFirstWhatWasNotJudged)
{
  this->Contents.outer = surfacesOf({ 2 }, { tetrahedron(1.0) });
  this->Contents.inner = {};
  const auto written = cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string());
  EXPECT_TRUE(written.certificate.certified());
  const std::string readme = contentOf(this->Scratch / "s/README.txt");
  EXPECT_EQ(readme.find("A substrate of 1 fibres without inner surfaces"), 0u) << readme;
  EXPECT_NE(readme.find("\nCERTIFIED for its outer surfaces alone, as there are no inner ones: "), std::string::npos) << readme;
  EXPECT_EQ(
    contentOf(this->Scratch / "s/certificate.csv").find("quantity,value\nCertified,1\nOuterJudged,1\nInnerJudged,0\n"), 0u);
  EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"judged\": [\n    \"outer\"\n  ]"), std::string::npos);
}

// The simulator confuses similar keys and ignores unknown ones: only keys that it knows, in its own spelling.
TEST_F(SubstrateFolder, ConfigurationHoldsKnownKeysAndBoxesInMillimetres)
{
  ASSERT_EQ(this->write(this->Scratch / "s"), "");
  std::istringstream conf(contentOf(this->Scratch / "s/mcdc/extra.conf"));
  std::map<std::string, std::vector<std::string>> values;
  std::string key;
  for (std::string line; std::getline(conf, line);)
  {
    std::istringstream words(line);
    std::string first;
    words >> first;
    const bool isNumber = std::isdigit(first[0]) || first[0] == '-';
    if (!isNumber)
    {
      key = first;
      EXPECT_TRUE(values.emplace(key, std::vector<std::string>()).second) << key << " stands there twice";
    }
    else
    {
      values[key].push_back(first);
    }
    for (std::string word; words >> word;)
    {
      values[key].push_back(word);
    }
  }
  const std::set<std::string> known{ "N", "T", "duration", "diffusivity", "exp_prefix", "scheme_file", "scale_from_stu",
    "write_txt", "write_bin", "write_traj_file", "<obstacle>", "ply_file_list", "</obstacle>", "<voxels>", "</voxels>",
    "<spawning_area>", "</spawning_area>", "ini_walkers_pos", "num_process", "sphere_size", "<END>" };
  for (const auto& entry : values)
  {
    EXPECT_EQ(known.count(entry.first), 1u) << entry.first;
  }
  EXPECT_EQ(values["ini_walkers_pos"], std::vector<std::string>{ "extra" });
  ASSERT_EQ(values["<spawning_area>"].size(), 6u);
  ASSERT_EQ(values["<voxels>"].size(), 6u);
  // A free walker moves sqrt(2 · 2e-9 · 0.035) m = 11.8 µm, and three eighths of the side are less than four times that.
  EXPECT_DOUBLE_EQ(std::stod(values["<spawning_area>"][0]), -3.75e-3);
  EXPECT_DOUBLE_EQ(std::stod(values["<spawning_area>"][5]), 3.75e-3);
  EXPECT_NEAR(std::stod(values["<voxels>"][2]), -15e-3 - 10.0 * std::sqrt(2.0 * 2e-9 * 0.035) * 1e3, 1e-9);
  EXPECT_TRUE(fs::exists(this->Scratch / "s" / values["ply_file_list"].at(0)));
  EXPECT_TRUE(fs::exists(this->Scratch / "s" / values["scheme_file"].at(0)));
  EXPECT_TRUE(fs::is_directory((this->Scratch / "s" / values["exp_prefix"].at(0)).parent_path()));
}

TEST_F(SubstrateFolder, SchemeHasTheBValuesAskedFor)
{
  ASSERT_EQ(this->write(this->Scratch / "s"), "");
  std::istringstream scheme(contentOf(this->Scratch / "s/mcdc/pgse.scheme"));
  std::string version;
  std::getline(scheme, version);
  EXPECT_EQ(version, "VERSION: STEJSKALTANNER");
  double x, y, z, gradient, separation, duration, echo;
  int count = 0;
  while (scheme >> x >> y >> z >> gradient >> separation >> duration >> echo)
  {
    EXPECT_NEAR(x * x + y * y + z * z, 1.0, 1e-7);
    const double dephasing = 2.6751525e8 * gradient * duration;
    const double b = dephasing * dephasing * (separation - duration / 3.0) * 1e-6;
    EXPECT_NEAR(b, count == 0 ? 0.0 : 1000.0 * ((count - 1) / 30 + 1), 1e-3);
    EXPECT_LE(separation + duration, echo);
    ++count;
  }
  EXPECT_EQ(count, 91);
}

TEST_F(SubstrateFolder, ReplacesItsOwn)
{
  const fs::path folder = this->Scratch / "s";
  ASSERT_EQ(this->write(folder), "");
  this->Contents.inner = {};
  EXPECT_EQ(this->write(folder), "");
  EXPECT_FALSE(fs::exists(folder / "inner")) << "nothing of the former folder stays";
  EXPECT_EQ(contentOf(folder / "mcdc/intra_ply_list.txt").substr(0, 11), "1e-3\nouter/") << "inside the outer ones then";
  fs::create_directory(this->Scratch / "empty");
  EXPECT_EQ(this->write(this->Scratch / "empty"), "");
  EXPECT_EQ(this->entries(), (std::vector<std::string>{ "empty", "s" }));
}

// Guarantee 5: one clear error, and nothing half-written.
TEST_F(SubstrateFolder, LeavesNothingBehindWhereItFails)
{
  EXPECT_NE(this->write(this->Scratch / "no/such/folder").find("cannot write folder"), std::string::npos);
  EXPECT_NE(this->write("").find("FolderName"), std::string::npos);
  auto open = tetrahedron(1.0);
  open.triangles.pop_back();
  this->Contents.outer = surfacesOf({ 2, 9 }, { tetrahedron(1.0), open });
  EXPECT_NE(this->write(this->Scratch / "s").find("outer surface of fibre 9 is not closed (3 open"), std::string::npos);
  auto inward = tetrahedron(1.0);
  for (auto& t : inward.triangles)
  {
    std::swap(t[0], t[1]);
  }
  this->Contents.outer = surfacesOf({ 9 }, { inward });
  EXPECT_NE(this->write(this->Scratch / "s").find("fibre 9 points inward"), std::string::npos);
  inward.points[0][0] = std::numeric_limits<double>::quiet_NaN();
  this->Contents.outer = surfacesOf({ 9 }, { inward });
  EXPECT_NE(this->write(this->Scratch / "s").find("fibre 9: point 0"), std::string::npos);
  this->Contents.outer = {};
  this->Contents.inner = {};
  EXPECT_NE(this->write(this->Scratch / "s").find("no surfaces"), std::string::npos);
  EXPECT_TRUE(this->entries().empty());

  this->Contents.outer = surfacesOf({ 9 }, { open });
  this->Contents.allowOpenSurfaces = true;
  EXPECT_EQ(this->write(this->Scratch / "s"), "");
  EXPECT_NE(contentOf(this->Scratch / "s/manifest.json").find("\"closed\": false"), std::string::npos);
}

// A file that a format writes without listing it counts as the user's, and would stay.
TEST_F(SubstrateFolder, StopsAtAnyTimeWithoutATraceInAnyFormat)
{
  const cactus::Fibres fibres = fibresAcross(this->Contents.domain, { 2 });
  this->takeFibre(fibres);
  this->Contents.voxelSize = 1.5;
  for (std::size_t format = 0; format < std::size(cactus::formatNames); ++format)
  {
    this->Contents.format = static_cast<cactus::SubstrateFormat>(format);
    int stops = 0;
    for (int most = 0;; most = most * 3 / 2 + 1)
    {
      int asked = 0;
      cactus::Context context;
      context.threads = 1;
      context.cancelled = [&] { return ++asked > most; };
      try
      {
        cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string(), context);
        break;
      }
      catch (const cactus::Cancelled&)
      {
        ++stops;
        EXPECT_TRUE(this->entries().empty()) << cactus::formatNames[format] << ", stopped after " << most;
      }
    }
    EXPECT_GT(stops, 2) << cactus::formatNames[format];
    fs::remove_all(this->Scratch / "s");
  }
}

// Pieces of fibres have ids beyond all others, and follow their fibre.
TEST_F(SubstrateFolder, HasCentreLinesInTheOrderOfIds)
{
  cactus::Fibres fibres = fibresAcross(this->Contents.domain, { 2, 5, 4 });
  fibres.radii = { 0.2, 0.2, 0.5, 0.5, 0.4, 0.4 };
  this->Contents.fibres = &fibres;
  EXPECT_EQ(this->write(this->Scratch / "s"), "");
  const cactus::Fibres read = cactus::readStrandFile((this->Scratch / "s/fibres.strands").string());
  EXPECT_EQ(read.radii, (std::vector<double>{ 0.2, 0.2, 0.4, 0.4, 0.5, 0.5 }));
}

TEST_F(SubstrateFolder, IsWrittenOfAnyBox)
{
  this->Contents.domain.upper[2] += 10.0;
  const cactus::Fibres fibres = fibresAcross(this->Contents.domain, { 2 });
  this->takeFibre(fibres);
  this->Contents.voxelSize = 0.5;
  for (std::size_t format = 0; format < std::size(cactus::formatNames); ++format)
  {
    this->Contents.format = static_cast<cactus::SubstrateFormat>(format);
    const fs::path folder = this->Scratch / std::to_string(format);
    const bool isReference = this->Contents.format == cactus::SubstrateFormat::Reference;
    const std::string told = this->write(folder);
    EXPECT_EQ(told.substr(0, told.find(',')), isReference ? "Format Reference program has the fibres in a strand file" : "")
      << told;
    EXPECT_EQ(fs::exists(folder / "manifest.json"), !isReference);
    EXPECT_FALSE(fs::exists(folder / "fibres.strands"));
    if (!isReference)
    {
      const std::string readme = contentOf(folder / "README.txt");
      EXPECT_NE(readme.find("the centre lines are not in the folder"), std::string::npos);
      EXPECT_EQ(readme.find("fibres.strands  centre"), std::string::npos);
    }
  }
}

TEST_F(SubstrateFolder, StopsWithoutATrace)
{
  cactus::Context context;
  context.cancelled = [] { return true; };
  EXPECT_THROW(cactus::writeSubstrateFolder(this->Contents, (this->Scratch / "s").string(), context), cactus::Cancelled);
  EXPECT_TRUE(this->entries().empty());
}

TEST_F(SubstrateFolder, SameBytesOnAnyNumberOfThreads)
{
  cactus::Context context;
  for (const int threads : { 1, 3 })
  {
    context.threads = threads;
    cactus::writeSubstrateFolder(this->Contents, (this->Scratch / std::to_string(threads)).string(), context);
  }
  for (const auto& entry : fs::recursive_directory_iterator(this->Scratch / "1"))
  {
    if (entry.is_regular_file())
    {
      EXPECT_EQ(contentOf(entry.path()), contentOf(this->Scratch / "3" / fs::relative(entry.path(), this->Scratch / "1")));
    }
  }
}
