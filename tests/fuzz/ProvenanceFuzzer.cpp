// SPDX-License-Identifier: BSD-3-Clause
// Any text as a record in the field data of an input: no fault, one more record for the stage that takes it, on one line, and the
// same again in the next stage's.
#include "base/Provenance.h"

#include "Fuzzing.h"
#include "base/JsonText.h"

namespace
{

cactus::Provenance next(const cactus::Provenance& records)
{
  cactus::StageRecord stage;
  stage.filter = "CapsuleOptimizer";
  cactus::DataOrigin origin;
  origin.records = records;
  stage.inputs = { { "Input", { origin, origin } } };
  return cactus::provenanceOfOutput(cactus::provenanceOf(stage), 1, "0123456789abcdef");
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  writeSeeds(*argc, *argv,
    { next({}).back(), next(next({})).back(), "{\"id\": \"a\", \"filter\": \"b\", \"output\": {\"port\": [1e400, -0]}}",
      "{\"id\": \"a\", \"filter\": \"b\", \"output\": {\"port\": " + std::string(254, '[') + std::string(254, ']') + "}}",
      "BundleInitializer 0.1.0: Side=5", "[[[[{\"\\u0073pacing\": \" \\ud83d\\ude00 origin\"}]]]]" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const cactus::Provenance before = { std::string(reinterpret_cast<const char*>(data), size) };
  const cactus::Provenance after = next(before);
  promise(after.size() == 2, "each stage is there once");
  promise(cactus::checksumOf(after) == "0123456789abcdef", "what a record says of its data is read");
  const cactus::Provenance again = next(after);
  promise(again.size() == 3 && again.front() == after.front(), "what came before stays as it is");
  for (const std::string& text : { after.back(), again.back() })
  {
    const auto record = cactus::parsedJson(text);
    promise(record && cactus::singleLine(*record) == text, "our own records are read");
    promise(text.find('\n') == std::string::npos, "a record is a line");
  }
  return 0;
}
