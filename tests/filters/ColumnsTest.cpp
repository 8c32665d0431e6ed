// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: an array that uses a vector's memory behaves like any other, for as long as it is held.
#include "Columns.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace
{

std::vector<double> numbers()
{
  std::vector<double> values(3000);
  std::iota(values.begin(), values.end(), 0.0);
  return values;
}

TEST(AdoptedArray, HasTheValuesWhereTheyWere)
{
  std::vector<double> values = numbers();
  const double* place = values.data();
  auto array = cactus::adoptedArray("Points", std::move(values), 3);
  EXPECT_EQ(array->GetPointer(0), place);
  EXPECT_STREQ(array->GetName(), "Points");
  EXPECT_EQ(array->GetNumberOfTuples(), 1000);
  EXPECT_EQ(array->GetComponent(999, 2), 2999.0);
  EXPECT_EQ(cactus::adoptedArray("Empty", std::vector<double>(), 3)->GetNumberOfTuples(), 0);
  auto whole = cactus::adoptedArray("", std::vector<std::size_t>{ 0, 5, 7 });
  EXPECT_EQ(whole->GetValue(2), 7);
}

TEST(AdoptedArray, OutlivesTheOneThatItWasCopiedFrom)
{
  auto copy = vtkSmartPointer<vtkDoubleArray>::New();
  {
    auto array = cactus::adoptedArray("Points", numbers(), 3);
    copy->ShallowCopy(array);
  }
  EXPECT_EQ(copy->GetComponent(999, 2), 2999.0);
  copy->SetValue(5, -1.0);
  EXPECT_EQ(copy->GetValue(5), -1.0);
}

TEST(AdoptedArray, CanBeMadeLargerSmallerAndAnew)
{
  auto array = cactus::adoptedArray("Points", numbers(), 3);
  for (int i = 0; i < 1000; ++i)
  {
    array->InsertNextTuple3(i, i, i); // beyond the vector's memory
  }
  EXPECT_EQ(array->GetComponent(999, 2), 2999.0);
  EXPECT_EQ(array->GetComponent(1999, 0), 999.0);
  array->Resize(10);
  EXPECT_EQ(array->GetComponent(9, 2), 29.0);
  array->SetNumberOfTuples(5000);
  array->Fill(4.0);
  EXPECT_EQ(array->GetComponent(4999, 0), 4.0);
  auto other = cactus::adoptedArray("Points", numbers(), 3);
  other->Initialize();
  other->SetNumberOfTuples(20);
  other->Fill(1.0);
  EXPECT_EQ(other->GetComponent(19, 2), 1.0);
}

} // namespace
