// SPDX-License-Identifier: BSD-3-Clause
// Commits the fault named on the command line. The matching sanitizer has to find it: otherwise it is not active.
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace
{

/// Writes behind the end of an array.
void overflow()
{
  std::unique_ptr<volatile int[]> numbers(new volatile int[4]);
  volatile int index = 4;
  numbers[index] = 1;
}

/// Loses an array.
void leak()
{
  volatile int* numbers = new volatile int[4];
  numbers[0] = 1;
  numbers = nullptr;
}

/// Adds one to the largest integer.
void undefined()
{
  volatile int number = std::numeric_limits<int>::max();
  number = number + 1;
}

/// Two threads of OpenMP write to one number without a word to each other.
void race()
{
  int sum = 0;
#pragma omp parallel for num_threads(4)
  for (int i = 0; i < 1000; ++i)
  {
    sum += i;
  }
  std::printf("%d\n", sum);
}

/// Two parallel regions that are no race, since one ends before the other begins: found to be one where the thread sanitizer does
/// not know of OpenMP.
void noRace()
{
  std::vector<int> numbers(1000);
#pragma omp parallel for num_threads(4)
  for (int i = 0; i < 1000; ++i)
  {
    numbers[i] = i;
  }
#pragma omp parallel for num_threads(4)
  for (int i = 0; i < 1000; ++i)
  {
    numbers[999 - i] += i;
  }
  std::printf("%d\n", numbers[1]);
}

} // namespace

int main(int argc, char** argv)
{
  const char* fault = argc > 1 ? argv[1] : "";
  if (std::strcmp(fault, "overflow") == 0)
  {
    overflow();
  }
  else if (std::strcmp(fault, "leak") == 0)
  {
    leak();
  }
  else if (std::strcmp(fault, "undefined") == 0)
  {
    undefined();
  }
  else if (std::strcmp(fault, "race") == 0)
  {
    race();
  }
  else if (std::strcmp(fault, "no_race") == 0)
  {
    noRace();
  }
  else
  {
    std::puts("usage: cactus_deliberate_fault overflow|leak|undefined|race|no_race");
    return 2;
  }
  return 0;
}
