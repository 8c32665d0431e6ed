// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a .trx tractogram: unchanged; and as the files of one, so that most mutations get past the archive. The result is
// consistent streamlines of finite points, or one error of ours.
#include "io/TrxFile.h"

#include "Fuzzing.h"
#include "TractogramPromises.h"

#include <algorithm>

namespace
{

using Files = std::vector<std::pair<std::string, std::string>>;

const Files& seed()
{
  static const Files files = { { "header.json", R"({"NB_VERTICES": 3, "NB_STREAMLINES": 2})" },
    { "positions.3.float16", std::string(18, '\x3c') }, { "offsets.uint32", std::string("\0\0\0\0\2\0\0\0\3\0\0\0", 12) },
    { "dpv/a.uint8", "abc" }, { "dps/b.2.int8", "abcd" }, { "groups/c.uint32", std::string("\1\0\0\0", 4) } };
  return files;
}

/// Lines with a length and a name, each followed by so many bytes.
class Parts : public cactus::FileCollection
{
public:
  explicit Parts(std::string text)
  {
    while (!text.empty())
    {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::size_t blank = std::min(text.find(' '), end);
      const std::size_t length = std::min<std::size_t>(text.size() - end, 1 + std::strtoul(text.c_str(), nullptr, 10) % 4096);
      this->Files.emplace_back(text.substr(std::min(blank + 1, end), end - std::min(blank + 1, end)),
        length > 0 ? text.substr(std::min(end + 1, text.size()), length - 1) : "");
      text.erase(0, std::min(text.size(), end + std::max<std::size_t>(length, 1)));
    }
  }
  std::vector<std::string> names() const override
  {
    std::vector<std::string> all;
    for (const auto& file : this->Files)
    {
      all.push_back(file.first);
    }
    return all;
  }
  std::uint64_t size(const std::string& name) const override { return this->find(name).size(); }
  std::vector<char> read(const std::string& name) const override
  {
    const std::string& text = this->find(name);
    return { text.begin(), text.end() };
  }

private:
  const std::string& find(const std::string& name) const
  {
    const auto found = std::find_if(this->Files.begin(), this->Files.end(), [&](const auto& file) { return file.first == name; });
    if (found == this->Files.end())
    {
      throw cactus::FileError("fuzz.trx has no " + name);
    }
    return found->second;
  }

  ::Files Files;
};

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  std::string parts;
  for (const auto& [name, text] : seed())
  {
    parts += std::to_string(text.size()) + ' ' + name + '\n' + text;
  }
  writeSeeds(*argc, *argv, { cactus::zipText(seed()), parts });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  const bool isArchive = text.compare(0, 2, "PK") == 0;
  // Uncompressed content may be a thousand times as long.
  keepsPromises("fuzz.trx", isArchive ? 2000 * size : size,
    [&]
    {
      return isArchive ? cactus::readTrx(cactus::ZipArchive(text, "fuzz.trx"), "fuzz.trx")
                       : cactus::readTrx(Parts(text), "fuzz.trx");
    });
  return 0;
}
