// SPDX-License-Identifier: BSD-3-Clause
// Commits the fault named on the command line. The matching sanitizer has to find it: otherwise it is not active.
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <thread>

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

/// Two threads write to one number without synchronisation.
void race()
{
  int sum = 0;
  const auto add = [&sum]
  {
    for (int i = 0; i < 1000; ++i)
    {
      sum += i;
    }
  };
  std::thread other(add);
  add();
  other.join();
  std::printf("%d\n", sum);
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
  else
  {
    std::puts("usage: cactus_deliberate_fault overflow|leak|undefined|race");
    return 2;
  }
  return 0;
}
