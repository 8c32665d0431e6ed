// SPDX-License-Identifier: BSD-3-Clause
#include "base/Sha256.h"

#include <gtest/gtest.h>

#include <string>

// The examples of FIPS 180-4.
TEST(Sha256, KnownAnswers)
{
  EXPECT_EQ(cactus::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(cactus::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  cactus::Sha256 hash;
  const std::string piece(1000, 'a');
  for (int i = 0; i < 1000; ++i)
  {
    hash.add(piece.data(), piece.size());
  }
  EXPECT_EQ(hash.digest(), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}
