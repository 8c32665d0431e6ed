// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a provenance holds every stage once, with its values as values, on any path through the pipeline.
#include "base/Provenance.h"

#include "base/Error.h"
#include "base/JsonText.h"
#include "base/Sha256.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace
{

using cactus::checksumOf;
using cactus::DataOrigin;
using cactus::Json;
using cactus::Provenance;
using cactus::provenanceOf;
using cactus::provenanceOfOutput;

enum class Kind
{
  Thin,
  Thick
};

struct RecordedOptions
{
  double size = 0.1;
  int threads = 2;
  Kind kind = Kind::Thin;
  bool isOn = true;
  std::uint64_t seed = 7;
  double unused = 3.0;

  static const cactus::PropertyList<RecordedOptions>& properties()
  {
    static const auto list = cactus::PropertyList<RecordedOptions>()
                               .add("Size", &RecordedOptions::size, { 0.0, 1.0 }, "Size")
                               .add("Threads", &RecordedOptions::threads, { 0.0, 9.0 }, "Threads")
                               .use(cactus::PropertyUse::Run)
                               .add("Kind", &RecordedOptions::kind, { "Thin", "Thick" }, "Kind")
                               .add("IsOn", &RecordedOptions::isOn, "Whether")
                               .add("Seed", &RecordedOptions::seed, { 0.0, 9.0 }, "Seed")
                               .add("Unused", &RecordedOptions::unused, { 0.0, 9.0 }, "Unused")
                               .where("Kind", { 1 });
    return list;
  }
};

cactus::StageRecord stage(const std::string& filter, const RecordedOptions& options = {})
{
  cactus::StageRecord record;
  record.filter = filter;
  record.properties = RecordedOptions::properties().states(options);
  return record;
}

DataOrigin from(const Provenance& records)
{
  DataOrigin origin;
  origin.records = records;
  return origin;
}

Provenance source(int seed, const std::string& checksum)
{
  RecordedOptions options;
  options.seed = static_cast<std::uint64_t>(seed);
  return provenanceOfOutput(provenanceOf(stage("Source", options)), 0, checksum);
}

Json parsed(const std::string& text)
{
  const auto value = cactus::parsedJson(text);
  EXPECT_TRUE(value) << text;
  return value.value_or(Json());
}

TEST(Provenance, HoldsValuesThatMatter)
{
  auto record = stage("Source");
  record.reached = { { "Fibres", std::int64_t(12) } };
  const Provenance records = provenanceOf(record);
  ASSERT_EQ(records.size(), 1u);
  const Json json = parsed(records.front());
  EXPECT_EQ(json["filter"], "Source");
  EXPECT_EQ(json["version"], CACTUS_VERSION);
  EXPECT_EQ(json["properties"], Json::parse(R"({"Size": 0.1, "Kind": "Thin", "IsOn": true, "Seed": 7})"));
  EXPECT_TRUE(json["properties"]["Seed"].is_number_integer());
  EXPECT_EQ(json["reached"]["Fibres"], 12);
  EXPECT_TRUE(json["inputs"].empty());
}

TEST(Provenance, KnowsTheSameStageAgain)
{
  const auto id = [](const Provenance& records) { return parsed(records.back())["id"]; };
  EXPECT_EQ(id(source(1, "a")), id(source(1, "b"))) << "an output is no part of the stage";
  EXPECT_NE(id(source(1, "a")), id(source(2, "a")));
}

TEST(Provenance, JoinsInputsWithEachStageOnce)
{
  const Provenance one = source(1, "aa");
  const Provenance two = source(2, "bb");
  auto join = stage("Join");
  join.inputs = { { "Input", { from(one), from(two), from(one) } } };
  const Provenance joined = provenanceOf(join);
  ASSERT_EQ(joined.size(), 3u);
  const Json inputs = parsed(joined.back())["inputs"]["Input"];
  ASSERT_EQ(inputs.size(), 3u);
  EXPECT_EQ(inputs[0], inputs[2]);
  EXPECT_EQ(inputs[0]["stage"], parsed(one.back())["id"]);
  EXPECT_EQ(inputs[1]["checksum"], "bb");
  EXPECT_EQ(inputs[1]["port"], 0);

  // Two paths from one stage meet again.
  auto split = stage("Split");
  split.inputs = { { "Input", { from(provenanceOfOutput(joined, 0, "cc")) } } };
  const Provenance parts = provenanceOf(split);
  auto last = stage("Last");
  last.inputs = { { "Outer", { from(provenanceOfOutput(parts, 0, "dd")) } },
    { "Inner", { from(provenanceOfOutput(parts, 1, "ee")) } }, { "Fibres", { from(provenanceOfOutput(joined, 0, "cc")) } } };
  const Provenance all = provenanceOf(last);
  EXPECT_EQ(all.size(), 5u);
  const Json record = parsed(all.back());
  EXPECT_EQ(record["inputs"]["Inner"][0]["port"], 1);
  EXPECT_EQ(record["inputs"]["Inner"][0]["stage"], record["inputs"]["Outer"][0]["stage"]);
  for (std::size_t i = 0; i + 1 < all.size(); ++i)
  {
    EXPECT_FALSE(parsed(all[i]).contains("output")) << "only the last is known by its data";
  }
}

TEST(Provenance, SaysWhatItDoesNotKnow)
{
  auto changed = from(source(1, "aa"));
  changed.isChanged = true;
  DataOrigin foreign;
  foreign.filter = "vtkTransformFilter";
  foreign.parts = { from(source(1, "aa")) };
  DataOrigin blocks;
  blocks.parts = { from(source(1, "aa")), from(source(2, "bb")) };
  DataOrigin same;
  same.parts = { from(source(1, "aa")), from(source(1, "aa")) };
  auto record = stage("Last");
  record.inputs = { { "Input", { changed, foreign, blocks, same, DataOrigin(), from({ "StrandReader 0.1.0: FileName=a" }) } } };
  const Provenance all = provenanceOf(record);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[2], "StrandReader 0.1.0: FileName=a") << "what others have written is kept";
  const Json inputs = parsed(all.back())["inputs"]["Input"];
  EXPECT_EQ(inputs[0]["changed"], true);
  EXPECT_EQ(inputs[1]["filter"], "vtkTransformFilter");
  EXPECT_EQ(inputs[1]["inputs"].size(), 1u);
  EXPECT_EQ(inputs[2]["blocks"].size(), 2u);
  EXPECT_FALSE(inputs[3].contains("blocks"));
  EXPECT_TRUE(inputs[3].contains("stage"));
  EXPECT_TRUE(inputs[4].empty() && inputs[4].is_object());
  EXPECT_TRUE(inputs[5].empty());
  EXPECT_FALSE(DataOrigin().isKnown());
  EXPECT_TRUE(foreign.isKnown());
}

TEST(Provenance, IsReadBehindManyFiltersOfOthers)
{
  DataOrigin origin = from(source(1, "aa"));
  for (int filter = 0; filter < 100; ++filter)
  {
    DataOrigin next;
    next.filter = "vtkTransformFilter";
    next.parts = { std::move(origin) };
    origin = std::move(next);
  }
  auto record = stage("Last");
  record.inputs = { { "Input", { origin } } };
  EXPECT_EQ(parsed(provenanceOf(record).back())["inputs"]["Input"][0]["filter"], "vtkTransformFilter");

  const std::string nested = std::string(250, '[') + std::string(250, ']');
  record.inputs = { { "Input", { from({ R"({"id": "a", "filter": "b", "output": {"port": )" + nested + "}}" }) } } };
  const Provenance all = provenanceOfOutput(provenanceOf(record), 0, "cc");
  EXPECT_EQ(parsed(all.back())["inputs"]["Input"][0], Json::object({ { "stage", "a" } }));
  EXPECT_EQ(cactus::checksumOf(all), "cc");
}

TEST(Provenance, KeepsTextsThatAreTheIdOfAStage)
{
  const Provenance one = source(1, "aa");
  const Json id = parsed(one.back())["id"];
  auto record = stage("Last");
  record.inputs = { { "Input", { from({ id.get<std::string>() }), from(one) } } };
  EXPECT_EQ(provenanceOf(record).size(), 3u);
}

TEST(Provenance, ChecksFiles)
{
  const std::string path = (std::filesystem::temp_directory_path() / "cactus-provenance-test.txt").string();
  std::ofstream(path) << "0.4 0.5";
  auto record = stage("Reader");
  record.files = { { "FileName", path } };
  const Json files = parsed(provenanceOf(record).back())["files"];
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0]["property"], "FileName");
  EXPECT_EQ(files[0]["path"], path);
  EXPECT_EQ(files[0]["sha256"], cactus::sha256("0.4 0.5"));
  std::filesystem::remove(path);
  EXPECT_THROW(provenanceOf(record), cactus::FileError);
}

TEST(Provenance, KnowsDataByTheLastRecord)
{
  EXPECT_EQ(checksumOf(source(1, "aa")), "aa");
  EXPECT_EQ(checksumOf({}), "");
  EXPECT_EQ(checksumOf({ "words" }), "");
  EXPECT_EQ(checksumOf({ R"({"id": "a", "filter": "b", "output": 3})" }), "");
}

} // namespace
