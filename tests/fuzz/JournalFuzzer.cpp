// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as the file of a journal: unchanged, or as records that have the checksums of their bytes. A journal of this work
// gives its findings up to the first damage, keeps new ones behind them, and changes none; anything else is one error of ours,
// and stays as it is.
#include "io/Journal.h"

#include "Fuzzing.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "base/Hash64.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

namespace
{

using namespace cactus;
using Findings = std::map<std::string, std::string>;

std::string path()
{
  return scratchFolder() + "/journal";
}

std::string content()
{
  std::ifstream file(path(), std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

void replaceContent(const std::string& bytes)
{
  std::ofstream(path(), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string entryOf(const std::string& record)
{
  const std::string entry = bytesOf(record);
  return entry + bytesOf(hash64(entry.data(), entry.size()));
}

/// Returns a journal whose records are pieces of these bytes, each after a byte that is its length.
std::string journalOf(const std::string& bytes)
{
  std::string journal = entryOf("mine");
  for (std::size_t at = 0; at < bytes.size();)
  {
    const std::size_t length = std::min<std::size_t>(static_cast<unsigned char>(bytes[at]), bytes.size() - at - 1);
    journal += entryOf(bytes.substr(at + 1, length));
    at += 1 + length;
  }
  return journal;
}

/// Returns what of these names a journal holds.
Findings foundIn(const Journal& journal, const std::vector<std::string>& names)
{
  Findings found;
  for (const std::string& name : names)
  {
    if (const std::string* bytes = journal.find(name))
    {
      found[name] = *bytes;
    }
  }
  return found;
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  scratchFolder();
  {
    Journal journal(scratchFolder(), "mine", Sharing());
    journal.keep("one", "1");
    journal.keep("two", std::string("a\0b", 3));
    journal.keep("one", "changed");
  }
  const std::string whole = content();
  std::string pieces;
  for (const std::string& record : { bytesOf(std::string("one"), std::string("1")), bytesOf(std::string("two"), std::string()) })
  {
    pieces += static_cast<char>(record.size()) + record;
  }
  writeSeeds(*argc, *argv, { '\0' + whole, '\0' + whole.substr(0, whole.size() - 3), '\1' + pieces });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
  {
    return 0;
  }
  const bool asIs = (data[0] & 1) == 0;
  const std::string rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string bytes = asIs ? rest : journalOf(rest);
  replaceContent(bytes);
  const std::vector<std::string> names{ "one", "two", "", "new" };
  try
  {
    Findings found;
    {
      Journal journal(scratchFolder(), "mine", Sharing());
      const std::string left = content();
      promise(bytes.empty() || bytes.compare(0, left.size(), left) == 0, "what is cut off a journal is its end");
      found = foundIn(journal, names);
      promise(found.empty() || journal.foundSome(), "a finding is one of some");
      promise(journal.foundSome() == journal.holds(""), "what is found at first is what is held");
      journal.keep("new", rest);
      found["new"] = rest;
    }
    const Journal journal(scratchFolder(), "mine", Sharing());
    promise(foundIn(journal, names) == found, "what is kept is found by the next run, and changes nothing else");
  }
  catch (const Error& error)
  {
    promise(asIs, "a journal with correct checksums is gone on with");
    promise(std::string(error.what()).find(path()) != std::string::npos, "a message names the file");
    promise(content() == bytes, "a file that is refused stays as it is");
  }
  return 0;
}
