// SPDX-License-Identifier: BSD-3-Clause
#include "io/FindingsFile.h"

#include "base/Bytes.h"

#include <utility>

namespace cactus
{

FindingsFile::FindingsFile(const std::filesystem::path& folder, const std::string& identity, const Sharing& sharing)
  : Log(folder, "findings", identity, sharing)
{
  for (const std::string& record : this->Log.takeRecords())
  {
    ByteReader get(record);
    const auto name = get.get<std::string>();
    this->Known[name] = get.get<std::string>();
  }
  this->FoundSome = !this->Known.empty();
}

std::optional<std::string> FindingsFile::take(const std::string& name)
{
  const auto found = this->Known.find(name);
  if (found == this->Known.end())
  {
    return std::nullopt;
  }
  std::string bytes = std::move(found->second);
  this->Known.erase(found);
  return bytes;
}

void FindingsFile::keep(const std::string& name, const std::string& bytes)
{
  ByteWriter put;
  put(name);
  put(bytes);
  this->Log.add(put.bytes());
}

} // namespace cactus
