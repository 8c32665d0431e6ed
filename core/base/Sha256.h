// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

struct evp_md_ctx_st;

namespace cactus
{

/// The SHA-256 checksum (FIPS 180-4, by OpenSSL) of bytes added piece by piece; equal to the output of `sha256sum`.
class Sha256
{
public:
  // Each throws std::runtime_error where OpenSSL is out of memory, or set up without this checksum.

  Sha256();
  void add(const void* data, std::size_t size);
  /// Returns 64 hexadecimal digits for all bytes added. Call it once, last.
  std::string digest();

private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> State;
};

/// Returns the checksum of a text.
std::string sha256(const std::string& text);

} // namespace cactus
