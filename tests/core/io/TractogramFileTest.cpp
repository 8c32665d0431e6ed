// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: tractograms are read according to their layout, byte by byte, and a truncated or damaged one gives one error of
// ours. (tests/paraview/TestTractograms.py compares the readers and writers with nibabel.)
#include "io/TractogramFile.h"

#include "ScratchPath.h"
#include "base/ByteOrder.h"
#include "base/Error.h"
#include "io/FileCollection.h"
#include "io/TckFile.h"
#include "io/TrkFile.h"
#include "io/TrxFile.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <tuple>

namespace
{

using cactus::FileError;
using cactus::Tractogram;
using Doubles = std::vector<double>;
using Offsets = std::vector<std::size_t>;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <typename Number>
std::string bytes(const std::vector<Number>& numbers, bool swapped = false)
{
  std::vector<Number> copy = numbers;
  if (swapped)
  {
    cactus::swapBytes(copy.data(), copy.size());
  }
  return { reinterpret_cast<const char*>(copy.data()), copy.size() * sizeof(Number) };
}

void writeGzip(const std::string& path, const std::string& text)
{
  gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(gzwrite(file, text.data(), unsigned(text.size())), int(text.size()));
  EXPECT_EQ(gzclose(file), Z_OK);
}

Tractogram tck(const std::string& text)
{
  std::istringstream stream(text);
  return cactus::readTck(stream, "some.tck");
}

/// Two streamlines, in any of the four types.
std::string tckText(const std::string& type, const std::string& more = "", bool withFile = true)
{
  const Doubles numbers = { 1, 2, 3, 4, 5, 6.5, notANumber, notANumber, notANumber, -1, 0, 1e-3, 7, 8, 9, notANumber, notANumber,
    notANumber, infinity, infinity, infinity };
  const bool swapped = (type.substr(7) == "BE") == cactus::isLittleEndian();
  const std::string header = "mrtrix tracks\ndatatype: " + type + "\n" + more + (withFile ? "file: . 120\n" : "") + "END\n";
  const std::string body =
    type.substr(0, 7) == "Float64" ? bytes(numbers, swapped) : bytes(std::vector<float>(numbers.begin(), numbers.end()), swapped);
  return header + (withFile ? std::string(120 - header.size(), '#') : "") + body;
}

TEST(Tck, IsReadInEachTypeAndOrder)
{
  for (const std::string type : { "Float32LE", "Float32BE", "Float64LE", "Float64BE" })
  {
    for (const bool withFile : { true, false })
    {
      SCOPED_TRACE(type);
      const Tractogram tracks = tck(tckText(type, "count: 2\n", withFile));
      EXPECT_EQ(tracks.offsets, (Offsets{ 0, 2, 4 }));
      ASSERT_EQ(tracks.points.size(), 12u);
      EXPECT_EQ(tracks.points[5], 6.5);
      EXPECT_EQ(tracks.points[8], type.substr(0, 7) == "Float64" ? 1e-3 : double(1e-3F));
      EXPECT_TRUE(tracks.remarks.empty());
    }
  }
}

// MRtrix writes END right after the first line, then the rest of the header, and then blanks over that END.
TEST(Tck, IsReadAsMrtrixWritesIt)
{
  std::string header = "mrtrix tracks    \ncommand_history: tckedit " + std::string(100000, 'x') +
                       "\nmax_num_tracks: 2\t\ndatatype: Float32LE \nfile: . ";
  const std::size_t offset = (header.size() + 65 + 3) / 4 * 4;
  header += std::to_string(offset) + "\ncount: 2\ntotal_count: 2\nEND\n";
  ASSERT_LT(header.size(), offset);
  const std::string plain = tckText("Float32LE", "", false);
  const std::string body = plain.substr(plain.find("END\n") + 4);
  const Tractogram tracks = tck(header + std::string(offset - header.size(), '\0') + body);
  EXPECT_EQ(tracks.offsets, (Offsets{ 0, 2, 4 }));
  EXPECT_EQ(tracks.points.size(), 12u);
  EXPECT_TRUE(tracks.remarks.empty());
}

TEST(Tck, AWrongCountIsRemarked)
{
  const Tractogram tracks = tck(tckText("Float32LE", "count: 0000000005\n"));
  ASSERT_EQ(tracks.remarks.size(), 1u);
  EXPECT_NE(tracks.remarks[0].find("5 streamlines, and there are 2"), std::string::npos) << tracks.remarks[0];
  EXPECT_TRUE(tck(tckText("Float32LE", "count: 0000000000\n")).remarks.empty()) << "0 is what a run that was stopped leaves";
}

TEST(Tck, CapitalsAndAMissingTypeAreRead)
{
  const std::string whole = tckText("Float32LE", "count: 5\n");
  const auto with = [&](const std::string& old, const std::string& fresh)
  {
    std::string text = whole;
    return text.replace(text.find(old), old.size(), fresh);
  };
  const Doubles wanted = tck(whole).points;
  EXPECT_EQ(tck(with("datatype: Float32LE", "DataType :FLOAT32le")).points, wanted);
  EXPECT_EQ(tck(with("count", "Count")).remarks, tck(whole).remarks) << "the count is read, too";
  const Tractogram without = tck(with("datatype", "kindofit"));
  EXPECT_EQ(without.points, wanted);
  ASSERT_EQ(without.remarks.size(), 2u);
  EXPECT_EQ(without.remarks[0], "its header has no datatype, which is taken as Float32LE");
}

TEST(Tck, CutOffAnywhereIsAnError)
{
  const std::string whole = tckText("Float32BE");
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    EXPECT_THROW(tck(whole.substr(0, size)), FileError) << size;
  }
}

TEST(Tck, BadHeadersAndNumbersAreErrors)
{
  const std::string good = tckText("Float32LE");
  const auto with = [&](const std::string& old, const std::string& fresh)
  {
    std::string text = good;
    return text.replace(text.find(old), old.size(), fresh);
  };
  for (const std::string& bad : { with("mrtrix tracks", "mrtrix image?"), with("Float32LE", "Int16LE##"), with(". 120", ". 1  "),
         with(". 120", ". 1e9"), with(". 120", "x 120"), with(". 120", ". 12.") })
  {
    EXPECT_THROW(tck(bad), FileError) << bad.substr(0, 100);
  }
  std::string half = good;
  half.replace(120, 4, bytes(std::vector<float>{ std::numeric_limits<float>::quiet_NaN() }));
  try
  {
    tck(half);
    FAIL() << "a point whose x alone is NaN";
  }
  catch (const FileError& error)
  {
    EXPECT_NE(std::string(error.what()).find("some.tck: streamline 1, point 1"), std::string::npos) << error.what();
  }
}

/// A header of 1000 bytes that is built number by number.
class TrkText
{
public:
  explicit TrkText(int version = 2, bool swapped = false)
    : Swapped(swapped)
  {
    std::memcpy(this->Text.data(), "TRACK", 5);
    this->put<std::int16_t>(6, { 10, 20, 30 });
    this->put<float>(12, { 2, 3, 4 });
    this->put<std::int32_t>(992, { version, 1000 });
    if (version == 2)
    {
      this->put<float>(440, { 2, 0, 0, -10, 0, 3, 0, -20, 0, 0, 4, -30, 0, 0, 0, 1 });
      this->Text.replace(948, 3, "RAS");
    }
  }
  template <typename Number>
  TrkText& put(std::size_t at, const std::vector<Number>& numbers)
  {
    const std::string part = bytes(numbers, this->Swapped);
    this->Text.replace(at, part.size(), part);
    return *this;
  }
  TrkText& put(std::size_t at, const std::string& text)
  {
    this->Text.replace(at, text.size(), text);
    return *this;
  }
  TrkText& streamline(std::int32_t points, const std::vector<float>& numbers)
  {
    this->Text += bytes(std::vector<std::int32_t>{ points }, this->Swapped) + bytes(numbers, this->Swapped);
    return *this;
  }
  const std::string& text() const { return this->Text; }
  Tractogram read() const
  {
    std::istringstream stream(this->Text);
    return cactus::readTrk(stream, "some.trk");
  }

private:
  std::string Text = std::string(1000, '\0');
  bool Swapped;
};

TEST(Trk, IsReadInEitherOrderWithItsValues)
{
  for (const bool swapped : { false, true })
  {
    TrkText file(2, swapped);
    file.put<std::int16_t>(36, { 3 }).put(38, "FA").put(58, std::string("dir\0002", 5));
    file.put<std::int16_t>(238, { 1 }).put<std::int32_t>(988, { 2 });
    file.streamline(2, { 1, 1.5, 2, /*FA*/ 0.5, /*dir*/ 7, 8, 3, 4.5, 6, 0.25, 9, 10, /*property*/ 42 });
    file.streamline(1, { 0, 0, 0, 0, 0, 0, 43 });
    const Tractogram tracks = file.read();
    EXPECT_EQ(tracks.offsets, (Offsets{ 0, 2, 3 }));
    // Half a voxel off the corner: mm in the file are scanner mm minus origin and half a voxel.
    EXPECT_EQ(tracks.points, (Doubles{ -10, -20, -30, -8, -17, -26, -11, -21.5, -32 }));
    ASSERT_EQ(tracks.pointValues.size(), 2u);
    EXPECT_EQ(tracks.pointValues[0].name, "FA");
    EXPECT_EQ(tracks.pointValues[0].values, (Doubles{ 0.5, 0.25, 0 }));
    EXPECT_EQ(tracks.pointValues[1].name, "dir");
    EXPECT_EQ(tracks.pointValues[1].components, 2u);
    EXPECT_EQ(tracks.pointValues[1].values, (Doubles{ 7, 8, 9, 10, 0, 0 }));
    ASSERT_EQ(tracks.streamlineValues.size(), 1u);
    EXPECT_EQ(tracks.streamlineValues[0].name, "Property 1");
    EXPECT_EQ(tracks.streamlineValues[0].values, (Doubles{ 42, 43 }));
    EXPECT_TRUE(tracks.remarks.empty());
  }
}

TEST(Trk, WithoutACountGoesOnToTheEnd)
{
  TrkText file;
  file.streamline(1, { 0, 0, 0 }).streamline(0, {}).streamline(1, { 2, 3, 4 });
  EXPECT_EQ(file.read().offsets, (Offsets{ 0, 1, 1, 2 }));
  file.put<std::int32_t>(988, { 2 });
  const Tractogram two = file.read();
  EXPECT_EQ(two.size(), 2u);
  EXPECT_EQ(two.remarks.size(), 1u) << "more bytes than the count says";
}

TEST(Trk, VersionOneHasTheIdentityAndLps)
{
  TrkText file(1);
  file.streamline(1, { 1, 1.5, 2 });
  const Tractogram tracks = file.read();
  // The first voxel's centre, counted from the other end along x and y.
  EXPECT_EQ(tracks.points, (Doubles{ 9, 19, 0 }));
  EXPECT_EQ(tracks.remarks.size(), 2u);
}

TEST(Trk, VersionThreeAndBlanksAreReadWithARemark)
{
  const auto file = [] { return TrkText().streamline(1, { 1, 1.5, 2 }); };
  const Doubles wanted = file().read().points;
  const Tractogram third = file().put<std::int32_t>(992, { 3 }).read();
  EXPECT_EQ(third.points, wanted);
  EXPECT_EQ(third.remarks, (std::vector<std::string>{ "its header has version 3, which is read as version 2" }));
  const Tractogram blank = file().put(948, "RAS ").read();
  EXPECT_EQ(blank.points, wanted);
  EXPECT_EQ(blank.remarks, (std::vector<std::string>{ "its voxel_order 'RAS ' has blanks, which are left out" }));
  EXPECT_EQ(file().put(948, "    ").read().points, file().put(948, "LPS").read().points) << "as if it were missing";
}

TEST(Trk, CutOffAnywhereIsAnError)
{
  TrkText file;
  file.put<std::int32_t>(988, { 2 }).streamline(2, { 1, 2, 3, 4, 5, 6 }).streamline(1, { 1, 2, 3 });
  for (std::size_t size = 0; size < file.text().size(); ++size)
  {
    std::istringstream stream(file.text().substr(0, size));
    EXPECT_THROW(cactus::readTrk(stream, "some.trk"), FileError) << size;
  }
}

TEST(Trk, BadHeadersAndNumbersAreErrors)
{
  const auto good = [] { return TrkText().streamline(1, { 1, 2, 3 }); };
  EXPECT_NO_THROW(good().read());
  EXPECT_THROW(good().put(0, "TRUCK").read(), FileError);
  EXPECT_THROW(good().put<std::int32_t>(996, { 999 }).read(), FileError);
  EXPECT_THROW(good().put<std::int32_t>(992, { 4 }).read(), FileError) << "a version that is not known";
  EXPECT_THROW(good().put<std::int16_t>(36, { -1 }).read(), FileError);
  EXPECT_THROW(good().put<float>(12, { 0 }).read(), FileError) << "a voxel without a size";
  EXPECT_THROW(good().put<float>(440, { 0 }).read(), FileError) << "a vox_to_ras without an inverse";
  EXPECT_THROW(good().put(948, "RRS").read(), FileError);
  EXPECT_THROW(good().put(948, "XYZ").read(), FileError);
  EXPECT_THROW(TrkText().streamline(-1, {}).read(), FileError);
  EXPECT_THROW(TrkText().streamline(2147483647, { 1, 2, 3 }).read(), FileError) << "a count is not believed";
  EXPECT_THROW(TrkText().streamline(1, { 1, std::numeric_limits<float>::quiet_NaN(), 3 }).read(), FileError);
}

using Files = std::vector<std::pair<std::string, std::string>>;

Files trxFiles()
{
  return { { "header.json", R"({"VOXEL_TO_RASMM": [], "DIMENSIONS": [1,1,1], "NB_VERTICES": 5, "NB_STREAMLINES": 3})" },
    { "positions.3.float32", bytes(std::vector<float>{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 }) },
    { "offsets.uint64", bytes(std::vector<std::uint64_t>{ 0, 2, 3, 5 }) },
    { "dpv/Radius.float16", bytes(std::vector<std::uint16_t>{ 0x3c00, 0x3800, 0x4000, 0xc000, 0x0001 }) },
    { "dps/colour.2.uint8", bytes(std::vector<std::uint8_t>{ 0, 255, 1, 2, 3, 4 }) },
    { "groups/CST_left.uint32", bytes(std::vector<std::uint32_t>{ 2, 0, 2 }) } };
}

Tractogram trx(const Files& files)
{
  const std::string archive = cactus::zipText(files);
  return cactus::readTrx(cactus::ZipArchive(archive, "some.trx"), "some.trx");
}

TEST(Trx, IsReadFromAnArchiveAndFromAFolder)
{
  const std::string folder = cactus_testing::scratchPath("folder.trx");
  std::filesystem::remove_all(folder);
  for (const auto& [name, text] : trxFiles())
  {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
  for (const Tractogram& tracks : { trx(trxFiles()), cactus::readTrx(cactus::Folder(folder), folder) })
  {
    EXPECT_EQ(tracks.points.size(), 15u);
    EXPECT_EQ(tracks.points[14], 15);
    EXPECT_EQ(tracks.offsets, (Offsets{ 0, 2, 3, 5 }));
    ASSERT_EQ(tracks.pointValues.size(), 1u);
    EXPECT_EQ(tracks.pointValues[0].values, (Doubles{ 1, 0.5, 2, -2, 0x1p-24 }));
    ASSERT_EQ(tracks.streamlineValues.size(), 1u);
    EXPECT_EQ(tracks.streamlineValues[0].name, "colour");
    EXPECT_EQ(tracks.streamlineValues[0].values, (Doubles{ 0, 255, 1, 2, 3, 4 }));
    ASSERT_EQ(tracks.groups.size(), 1u);
    EXPECT_EQ(tracks.groups[0].streamlines, (std::vector<std::uint32_t>{ 0, 2 }));
  }
  // The second of the three streamlines has one point.
  const Tractogram kept = cactus::readTractogram(folder);
  EXPECT_EQ(kept.offsets, (Offsets{ 0, 2, 4 }));
  EXPECT_EQ(kept.points, (Doubles{ 1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15 }));
  EXPECT_EQ(kept.pointValues[0].values, (Doubles{ 1, 0.5, -2, 0x1p-24 }));
  EXPECT_EQ(kept.streamlineValues[0].values, (Doubles{ 0, 255, 3, 4 }));
  EXPECT_EQ(kept.groups[0].streamlines, (std::vector<std::uint32_t>{ 0, 1 }));
  EXPECT_EQ(kept.remarks.size(), 1u);
  std::filesystem::remove_all(folder);
}

TEST(Trx, OtherTypesOfPositionsAndOffsets)
{
  Files files = trxFiles();
  files[1] = { "positions.3.float64", bytes(Doubles{ 1e-9, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 }) };
  files[2] = { "offsets.uint32", bytes(std::vector<std::uint32_t>{ 0, 2, 3 }) }; // without the end
  const Tractogram tracks = trx(files);
  EXPECT_EQ(tracks.points[0], 1e-9);
  EXPECT_EQ(tracks.offsets, (Offsets{ 0, 2, 3, 5 }));
}

TEST(Trx, BackslashesInNamesAreSlashes)
{
  Files files = trxFiles();
  for (auto& [name, text] : files)
  {
    std::replace(name.begin(), name.end(), '/', '\\');
  }
  const Tractogram tracks = trx(files);
  ASSERT_EQ(tracks.streamlineValues.size(), 1u);
  EXPECT_EQ(tracks.streamlineValues[0].name, "colour");
  EXPECT_EQ(tracks.pointValues.size(), 1u);
  EXPECT_EQ(tracks.groups.size(), 1u);
  EXPECT_EQ(tracks.remarks, (std::vector<std::string>{ "names in it have backslashes, which are read as slashes" }));
}

TEST(Trx, AHeaderWithoutStreamlinesIsEnough)
{
  const std::string none = R"({"NB_VERTICES": 0, "NB_STREAMLINES": 0})";
  for (const Files& files :
    { Files{ { "header.json", none } }, Files{ { "header.json", none }, { "positions.3.float32", "" }, { "offsets.uint64", "" } },
      Files{ { "header.json", none }, { "offsets.uint64", bytes(std::vector<std::uint64_t>{ 0 }) } } })
  {
    const Tractogram tracks = trx(files);
    EXPECT_EQ(tracks.offsets, (Offsets{ 0 }));
    EXPECT_EQ(tracks.remarks, (std::vector<std::string>{ "it holds no streamlines" }));
  }
  EXPECT_THROW(trx({ { "header.json", R"({"NB_VERTICES": 3, "NB_STREAMLINES": 0})" } }), FileError);
}

TEST(Trx, WhatDoesNotFitIsAnError)
{
  const auto with = [](std::size_t place, const std::string& name, const std::string& text)
  {
    Files files = trxFiles();
    files[place] = { name, text };
    return files;
  };
  const std::string header = trxFiles()[0].second;
  EXPECT_THROW(trx(with(0, "header.txt", header)), FileError);
  EXPECT_THROW(trx(with(0, "header.json", "{")), FileError);
  EXPECT_THROW(trx(with(0, "header.json", R"({"NB_VERTICES": 5})")), FileError);
  EXPECT_THROW(trx(with(0, "header.json", R"({"NB_VERTICES": 5, "NB_STREAMLINES": -3})")), FileError);
  EXPECT_THROW(trx(with(0, "header.json", R"({"NB_VERTICES": 4000000000, "NB_STREAMLINES": 3})")), FileError);
  EXPECT_THROW(trx(with(1, "positions.2.float32", "")), FileError);
  EXPECT_THROW(trx(with(1, "positions.3.float32", "1234")), FileError);
  EXPECT_THROW(trx(with(1, "places.3.float32", trxFiles()[1].second)), FileError);
  EXPECT_THROW(trx(with(1, "positions.3.float32", bytes(std::vector<float>(15, float(notANumber))))), FileError);
  EXPECT_THROW(trx(with(2, "offsets.uint64", bytes(std::vector<std::uint64_t>{ 0, 3, 2, 5 }))), FileError);
  EXPECT_THROW(trx(with(2, "offsets.uint64", bytes(std::vector<std::uint64_t>{ 0, 2, 3, ~0ULL }))), FileError);
  EXPECT_THROW(trx(with(5, "groups/a.uint32", bytes(std::vector<std::uint32_t>{ 3 }))), FileError) << "there are 0, 1 and 2";
  EXPECT_EQ(trx(with(5, "notes.txt", "hello")).remarks.size(), 1u);
  const std::string archive = cactus::zipText(trxFiles());
  for (std::size_t size = 0; size < archive.size(); size += 7)
  {
    const std::string cut = archive.substr(0, size);
    EXPECT_THROW(cactus::readTrx(cactus::ZipArchive(cut, "some.trx"), "some.trx"), FileError) << size;
  }
}

TEST(Tractogram, OtherNamesAreErrors)
{
  EXPECT_THROW(cactus::readTractogram("streamlines.vtk"), FileError);
  EXPECT_THROW(cactus::readTractogram(cactus_testing::scratchPath("nowhere.tck")), FileError);
  cactus::Fibres fibres;
  fibres.addFibre(1, 1, 1.0);
  fibres.addPoint({ 0, 0, -1 }, 1.0);
  fibres.addPoint({ 0, 0, 1 }, 1.0);
  EXPECT_THROW(cactus::writeTractogram(fibres, {}, cactus_testing::scratchPath("fibres.trk")), cactus::InvalidInput);
}

TEST(Tractogram, PackedByGzipIsRead)
{
  const std::string plain = tckText("Float32LE");
  for (const std::string name : { "packed.tck.gz", "Packed.TCK.GZ" })
  {
    const std::string path = cactus_testing::scratchPath(name);
    writeGzip(path, plain);
    EXPECT_EQ(cactus::readTractogram(path).points, tck(plain).points);
    EXPECT_TRUE(cactus::isTractogram(path));
    const auto size = std::filesystem::file_size(path);
    std::filesystem::resize_file(path, size - 9);
    EXPECT_THROW(cactus::readTractogram(path), FileError) << "cut off";
    std::filesystem::remove(path);
  }
  EXPECT_THROW(cactus::readTractogram(cactus_testing::scratchPath("nowhere.tck.gz")), FileError);
  EXPECT_THROW(cactus::readTractogram(cactus_testing::scratchPath("some.trx.gz")), FileError);
}

TEST(Tractogram, IsKnownByItsContent)
{
  const auto isOne = [](const std::string& name, const std::string& content)
  {
    const std::string path = cactus_testing::scratchPath(name);
    std::ofstream(path, std::ios::binary) << content;
    const bool found = cactus::isTractogram(path);
    std::filesystem::remove(path);
    return found;
  };
  EXPECT_TRUE(isOne("a.tck", tckText("Float32LE")));
  EXPECT_TRUE(isOne("run.1.tck", tckText("Float32LE")));
  EXPECT_TRUE(isOne("run.1.trk", TrkText().text()));
  EXPECT_TRUE(isOne("run.1.trx", cactus::zipText(trxFiles())));
  EXPECT_TRUE(isOne("damaged.tck", "hello")) << "the reader says what is wrong with it";
  EXPECT_FALSE(isOne("x.vtp.trk", "<VTKFile")) << "another format may be meant";
  EXPECT_FALSE(isOne("x.trk.vtp", "<VTKFile"));
  EXPECT_FALSE(isOne("x.vtk.trx", cactus::zipText({ { "header.json", "{}" } })));
  EXPECT_FALSE(isOne("x.vtk.trx", "PK and nothing else"));
  EXPECT_FALSE(cactus::isTractogram(cactus_testing::scratchPath("nowhere.tck")));
  const std::string folder = cactus_testing::scratchPath("known.trx");
  std::filesystem::create_directories(folder);
  EXPECT_FALSE(cactus::isTractogram(folder));
  std::ofstream(folder + "/header.json") << trxFiles()[0].second;
  EXPECT_TRUE(cactus::isTractogram(folder));
  std::filesystem::remove_all(folder);
}

TEST(Tractogram, OfAWholeHeadIsWritten)
{
  // Too large, and too flat, for the domain of a substrate.
  cactus::Fibres fibres;
  fibres.domain.lower = { -9e4, 0.0, -1.3e5 };
  fibres.domain.upper = { 9e4, 0.0, 1.3e5 };
  fibres.addFibre(7, 2, 3.0);
  fibres.addPoint({ -9e4, 0.0, -1.3e5 }, 3.0);
  fibres.addPoint({ -9e4, 0.0, -1.3e5 }, 3.0);
  fibres.addPoint({ 9e4, 0.0, 1.3e5 }, 3.0);
  for (const char* name : { "head.tck", "head.trx" })
  {
    const std::string path = cactus_testing::scratchPath(name);
    cactus::writeTractogram(fibres, {}, path);
    const cactus::Tractogram read = cactus::readTractogram(path);
    EXPECT_EQ(read.points, Doubles({ -90, 0, -130, -90, 0, -130, 90, 0, 130 })) << name;
    std::filesystem::remove(path);
    fibres.points[1] = { 2e9, 0.0, 0.0 };
    EXPECT_THROW(cactus::writeTractogram(fibres, {}, path), cactus::InvalidInput);
    fibres.points[1] = fibres.points[0];
  }
  EXPECT_THROW(cactus::writeTractogram({}, {}, cactus_testing::scratchPath("none.tck")), cactus::InvalidInput);
}

/// Two fibres of two bundles.
cactus::Fibres twoFibres()
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(20.0);
  for (const int bundle : { 3, 100000 })
  {
    fibres.addFibre(bundle, bundle, 1.0);
    fibres.addPoint({ 0, bundle > 3 ? 5.0 : -5.0, -8 }, 1.0);
    fibres.addPoint({ 0, bundle > 3 ? 5.0 : -5.0, 8 }, 1.0);
  }
  return fibres;
}

TEST(Tractogram, IsWrittenInTheUnitThatIsAskedFor)
{
  const std::string tckPath = cactus_testing::scratchPath("unit.tck");
  const std::string trxPath = cactus_testing::scratchPath("unit.trx");
  for (const auto& [unit, length, name] : { std::tuple(cactus::LengthUnit::Millimetre, 1e-3, "length_unit: mm\n"),
         std::tuple(cactus::LengthUnit::Micrometre, 1.0, "length_unit: um\n") })
  {
    cactus::writeTractogram(twoFibres(), {}, tckPath, unit);
    cactus::writeTractogram(twoFibres(), {}, trxPath, unit);
    std::ifstream file(tckPath, std::ios::binary);
    EXPECT_NE(std::string(std::istreambuf_iterator<char>(file), {}).find(name), std::string::npos);
    for (const Tractogram& tracks : { cactus::readTractogram(tckPath), cactus::readTractogram(trxPath) })
    {
      EXPECT_NEAR(tracks.points[1], -5.0 * length, 1e-6 * length);
      EXPECT_NEAR(tracks.points[5], 8.0 * length, 1e-6 * length);
    }
    EXPECT_NEAR(cactus::readTractogram(trxPath).pointValues.at(0).values.at(0), length, 1e-6 * length) << "a radius";
  }
  cactus::Placement placement;
  placement.position = { 0.0, 100.0, 0.0 };
  cactus::writeTractogram(twoFibres(), placement, trxPath, cactus::LengthUnit::Micrometre);
  EXPECT_NEAR(cactus::readTractogram(trxPath).points[1], 1e5 - 5.0, 1e-9) << "positions, too";
}

TEST(Trx, HoldsTheFibresColumns)
{
  cactus::Fibres fibres = twoFibres();
  fibres.columns.set("TargetGRatio", 1, 0.75);
  const std::string path = cactus_testing::scratchPath("columns.trx");
  cactus::writeTractogram(fibres, {}, path);
  const Tractogram tracks = cactus::readTractogram(path);
  const auto* gRatios = cactus::valuesNamed(tracks.streamlineValues, "TargetGRatio");
  ASSERT_NE(gRatios, nullptr);
  EXPECT_TRUE(std::isnan(gRatios->values[0]));
  EXPECT_EQ(gRatios->values[1], 0.75);
  std::filesystem::remove(path);
}

TEST(Trx, NamesOfBundlesSortAsTheirNumbersDo)
{
  const std::string path = cactus_testing::scratchPath("bundles.trx");
  cactus::writeTractogram(twoFibres(), {}, path);
  const auto& groups = cactus::readTractogram(path).groups;
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].name, "bundle_000003");
  EXPECT_EQ(groups[1].name, "bundle_100000");
}

TEST(Tractogram, PointsFarFromAnyScannerAreErrors)
{
  const std::string path = cactus_testing::scratchPath("far.tck");
  const Doubles numbers = { 1, 2, 3, 4, 5, 6, notANumber, notANumber, notANumber, -1, 0, 0, 7, 3e38, 9, notANumber, notANumber,
    notANumber, infinity, infinity, infinity };
  const std::string header = "mrtrix tracks\ndatatype: Float64LE\nfile: . 60\nEND\n";
  std::ofstream(path, std::ios::binary) << header << std::string(60 - header.size(), '#')
                                        << bytes(numbers, !cactus::isLittleEndian());
  try
  {
    cactus::readTractogram(path);
    FAIL() << "a point 3e38 mm away";
  }
  catch (const FileError& error)
  {
    EXPECT_NE(std::string(error.what()).find("streamline 2, point 2 has a coordinate of 3e+38 mm"), std::string::npos)
      << error.what();
  }
  std::filesystem::remove(path);
}

} // namespace
