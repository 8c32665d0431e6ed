// SPDX-License-Identifier: BSD-3-Clause
#include "base/Sha256.h"

#include <array>
#include <openssl/evp.h>
#include <stdexcept>

namespace cactus
{

Sha256::Sha256()
  : State(EVP_MD_CTX_new(), &EVP_MD_CTX_free)
{
  if (this->State == nullptr || EVP_DigestInit_ex(this->State.get(), EVP_sha256(), nullptr) != 1)
  {
    throw std::runtime_error("OpenSSL cannot compute SHA-256");
  }
}

void Sha256::add(const void* data, std::size_t size)
{
  EVP_DigestUpdate(this->State.get(), data, size);
}

std::string Sha256::digest()
{
  std::array<unsigned char, 32> bytes{};
  EVP_DigestFinal_ex(this->State.get(), bytes.data(), nullptr);
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
