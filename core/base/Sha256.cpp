// SPDX-License-Identifier: BSD-3-Clause
#include "base/Sha256.h"

#include <array>
#include <openssl/evp.h>
#include <stdexcept>

namespace cactus
{

namespace
{

void requireDone(bool isDone)
{
  if (!isDone)
  {
    throw std::runtime_error("OpenSSL cannot compute SHA-256");
  }
}

} // namespace

Sha256::Sha256()
  : State(EVP_MD_CTX_new(), &EVP_MD_CTX_free)
{
  requireDone(this->State != nullptr && EVP_DigestInit_ex(this->State.get(), EVP_sha256(), nullptr) == 1);
}

void Sha256::add(const void* data, std::size_t size)
{
  requireDone(EVP_DigestUpdate(this->State.get(), data, size) == 1);
}

std::string Sha256::digest()
{
  std::array<unsigned char, 32> bytes{};
  requireDone(EVP_DigestFinal_ex(this->State.get(), bytes.data(), nullptr) == 1);
  std::string text;
  for (const unsigned char byte : bytes)
  {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

std::string sha256(const std::string& text)
{
  Sha256 hash;
  hash.add(text.data(), text.size());
  return hash.digest();
}

} // namespace cactus
