// SPDX-License-Identifier: BSD-3-Clause
#include "base/Sha256.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

// The examples of FIPS 180-4 and of NIST's validation program.
TEST(Sha256, KnownAnswers)
{
  EXPECT_EQ(cactus::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(cactus::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(cactus::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
    "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(cactus::sha256("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmno"
                           "pqrstnopqrstu"),
    "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(cactus::sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnThePieces)
{
  const std::string text(1000, 'x');
  for (const std::size_t piece : { 1u, 55u, 56u, 63u, 64u, 65u, 999u })
  {
    cactus::Sha256 hash;
    for (std::size_t from = 0; from < text.size(); from += piece)
    {
      hash.add(text.data() + from, std::min(piece, text.size() - from));
    }
    EXPECT_EQ(hash.digest(), cactus::sha256(text));
  }
}
