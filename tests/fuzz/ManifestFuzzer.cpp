// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as the manifest of a folder: no fault, and only the program's own output counts as written; also with a corrected
// checksum of the manifest itself.
#include "io/SubstrateManifest.h"

#include "Fuzzing.h"
#include "base/Sha256.h"

namespace
{

const std::string blank(64, '0');

std::string own;

/// Returns the place of a manifest's own checksum; its end if it has none.
std::size_t placeOfChecksum(const std::string& text)
{
  const std::string before = "manifest_sha256\": \"";
  const std::size_t place = text.rfind(before);
  return place == std::string::npos ? text.size() : place + before.size();
}

/// Tells whether a string of the text is the checksum of the rest, which libFuzzer finds, too, by watching the comparison. It
/// accepts any string of that length, since blanks may stand around it, and its name may be escaped.
bool isSealed(const std::string& text)
{
  for (std::size_t quote = text.find('"'); quote != std::string::npos; quote = text.find('"', quote + 1))
  {
    const std::size_t place = quote + 1;
    if (place + blank.size() < text.size() && text[place + blank.size()] == '"')
    {
      std::string without = text;
      without.replace(place, blank.size(), blank);
      if (text.compare(place, blank.size(), cactus::sha256(without)) == 0)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  cactus::SubstrateFolderContents contents;
  contents.domain = cactus::Domain::cube(5.0);
  contents.provenance = { "BundleInitializer 0.1.0: Side=5", "a \"name\" \\ of \xff any kind" };
  cactus::WrittenSubstrate substrate;
  substrate.files.emplace_back();
  substrate.files.back().path = "outer/fibre_00001.ply";
  substrate.files.back().surface = "outer";
  cactus::WrittenFiles written;
  written.checksums = { { "outer/fibre_00001.ply", std::string(64, 'a') }, { "README.txt", std::string(64, '7') } };
  written.folders = { "outer", "mcdc/output" };
  own = cactus::manifestText(contents, substrate, written);
  std::string unsealed = own;
  unsealed.replace(placeOfChecksum(unsealed), blank.size(), blank);
  writeSeeds(*argc, *argv,
    { own, unsealed, "{\"format\": \"CACTUS substrate folder\", \"version\": \"0.1.0\"}", "[[[[{\"a\":[1e400,-0]}]]]]" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::string text(reinterpret_cast<const char*>(data), size);
  if (text.rfind(blank) != std::string::npos)
  {
    text.replace(text.rfind(blank), blank.size(), cactus::sha256(text));
  }
  const auto manifest = cactus::readManifest(text);
  promise(
    text != own || (manifest && manifest->asWritten && manifest->written.checksums.size() == 2), "our own manifest is read");
  promise(!manifest || !manifest->asWritten || isSealed(text), "a manifest with any change is not as it was written");
  return 0;
}
