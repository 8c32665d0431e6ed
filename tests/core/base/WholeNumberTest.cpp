// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a given number is a whole one in its range, or is named in an error.
#include "base/WholeNumber.h"

#include "base/Error.h"

#include <gtest/gtest.h>

namespace
{

using namespace cactus;

TEST(WholeNumber, IsWholeAndInItsRange)
{
  EXPECT_EQ(wholeNumber("--progress", "0", progressPauses), 0);
  EXPECT_EQ(wholeNumber("--progress", "86400", progressPauses), 86400);
  EXPECT_EQ(wholeNumber("--progress", "6e1", progressPauses), usualProgressPause);
  for (const char* given : { "", " ", "often", "-1", "1.5", "86401", "99999999999999", "1e999", "60 s", "nan" })
  {
    try
    {
      wholeNumber("--progress", given, progressPauses);
      ADD_FAILURE() << given;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_EQ(std::string(error.what()), std::string("--progress is ") + given + ": give a whole number from 0 to 86400");
    }
  }
}

} // namespace
