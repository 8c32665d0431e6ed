// SPDX-License-Identifier: BSD-3-Clause
#include "base/Memory.h"
#include "Sanitized.h"
#include "base/Context.h"
#include "base/Error.h"
#include "base/Parallel.h"
#include "base/Threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace
{

constexpr std::uint64_t gigabyte = 1000000000;

/// A machine's files that say how much memory is left.
class Machine
{
public:
  Machine()
    : Root(::testing::TempDir() + "cactus-machine-" + std::to_string(getpid()))
  {
    std::filesystem::remove_all(this->Root);
    this->write("/proc/meminfo", "MemTotal: 64000000 kB\nMemFree: 1 kB\nMemAvailable:   8000000 kB\nBuffers: 2 kB\n");
  }
  ~Machine() { std::filesystem::remove_all(this->Root); }

  void write(const std::string& path, const std::string& content) const
  {
    std::filesystem::create_directories(std::filesystem::path(this->Root + path).parent_path());
    std::ofstream(this->Root + path) << content;
  }
  std::uint64_t left() const { return cactus::sharedMemoryLeft(this->Root); }

private:
  std::string Root;
};

} // namespace

TEST(Memory, IsWhatTheMachineHasAvailable)
{
  const Machine machine;
  EXPECT_EQ(machine.left(), 8192 * (gigabyte / 1000));
}

TEST(Memory, IsLimitedByEachControlGroupThatTheProcessLiesIn)
{
  const Machine machine;
  machine.write("/proc/self/cgroup", "0::/job.slice/step_0\n");
  machine.write("/sys/fs/cgroup/job.slice/step_0/memory.max", "max\n");
  machine.write("/sys/fs/cgroup/job.slice/step_0/memory.current", "1000000000\n");
  EXPECT_EQ(machine.left(), 8192 * (gigabyte / 1000)) << "no limit";
  machine.write("/sys/fs/cgroup/job.slice/memory.max", "4000000000\n");
  machine.write("/sys/fs/cgroup/job.slice/memory.current", "1500000000\n");
  EXPECT_EQ(machine.left(), 2500000000u) << "that of the job";
  machine.write("/sys/fs/cgroup/job.slice/memory.stat", "anon 1000000000\nfile 500000000\ninactive_file 500000000\n");
  EXPECT_EQ(machine.left(), 3000000000u) << "cached files give way";
  machine.write("/sys/fs/cgroup/job.slice/step_0/memory.max", "2000000000\n");
  EXPECT_EQ(machine.left(), gigabyte) << "that of the step";
  machine.write("/sys/fs/cgroup/job.slice/step_0/memory.current", "2100000000\n");
  EXPECT_EQ(machine.left(), 0u) << "nothing is left";
}

TEST(Memory, IsLimitedByControlGroupsOfVersion1)
{
  const Machine machine;
  machine.write("/proc/self/cgroup", "5:cpu,cpuacct:/other\n4:memory:/slurm/uid_1/job_2\n0::/\n");
  machine.write("/sys/fs/cgroup/memory/slurm/uid_1/memory.limit_in_bytes", "3000000000\n");
  machine.write("/sys/fs/cgroup/memory/slurm/uid_1/memory.usage_in_bytes", "2000000000\n");
  machine.write("/sys/fs/cgroup/memory/slurm/uid_1/memory.stat", "cache 7\ntotal_inactive_file 100000000\n");
  machine.write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  machine.write("/sys/fs/cgroup/memory/memory.usage_in_bytes", "5000000000\n");
  EXPECT_EQ(machine.left(), 1100000000u);
}

TEST(Memory, CountsWhatTheKernelCanReclaimAsFree)
{
  // A job that has read its input: most of what is used are cached files, read more than once.
  const Machine second;
  second.write("/proc/self/cgroup", "0::/job\n");
  second.write("/sys/fs/cgroup/job/memory.max", "4000000000\n");
  second.write("/sys/fs/cgroup/job/memory.current", "3900000000\n");
  second.write("/sys/fs/cgroup/job/memory.stat",
    "anon 400000000\nfile 3200000000\nkernel 300000000\nshmem 200000000\ninactive_anon 500000000\nactive_anon 100000000\n"
    "inactive_file 700000000\nactive_file 2300000000\nunevictable 0\nslab_reclaimable 250000000\nslab_unreclaimable 50000000\n"
    "slab 300000000\n");
  EXPECT_EQ(second.left(), 3350000000u) << "tmpfs, which is in `file`, stays taken, and so does the rest of the kernel's";

  const Machine first;
  first.write("/proc/self/cgroup", "4:memory:/job\n");
  first.write("/sys/fs/cgroup/memory/job/memory.limit_in_bytes", "4000000000\n");
  first.write("/sys/fs/cgroup/memory/job/memory.usage_in_bytes", "3900000000\n");
  first.write("/sys/fs/cgroup/memory/job/memory.stat",
    "cache 1000000000\nshmem 0\ninactive_file 100000000\nactive_file 200000000\ntotal_cache 3200000000\ntotal_shmem 200000000\n"
    "total_inactive_file 700000000\ntotal_active_file 2300000000\n");
  EXPECT_EQ(first.left(), 3100000000u) << "with the groups inside it";
}

TEST(Memory, InAContainerTheGroupIsWhatIsMounted)
{
  const Machine machine;
  machine.write("/proc/self/cgroup", "0::/docker/0123/not/to/be/seen\n");
  machine.write("/sys/fs/cgroup/memory.max", "700000000\n");
  machine.write("/sys/fs/cgroup/memory.current", "200000000\n");
  EXPECT_EQ(machine.left(), 500000000u);
}

TEST(Memory, IsSharedByProcesses)
{
  const auto alone = static_cast<double>(cactus::availableMemory());
  cactus::setProcessesSharingMemory(4);
  const auto shared = static_cast<double>(cactus::availableMemory());
  cactus::setProcessesSharingMemory(1);
  EXPECT_NEAR(shared / alone, 0.25, 0.1);
}

namespace
{

/// Limits the address space of this process.
void limitAddressSpace(rlim_t bytes)
{
  const rlimit lowered = { bytes, bytes };
  setrlimit(RLIMIT_AS, &lowered);
}

/// Tells whether a request for more than is left is refused.
int refusesWhatDoesNotFit()
{
  limitAddressSpace(3 * gigabyte);
  if (cactus::availableMemory() >= 3 * gigabyte)
  {
    return 1;
  }
  try
  {
    cactus::requireMemory(3e9, "this", "less");
  }
  catch (const cactus::OutOfMemory&)
  {
    return 0;
  }
  return 2;
}

/// Shares loops among threads with little room for stacks.
int sharesLoopsWithin(rlim_t bytes)
{
  limitAddressSpace(bytes);
  cactus::Context context;
  for (const int asked : { 1000, 2, 7, 1, 16 })
  {
    context.threads = asked;
    const int count = context.threadCount();
    if (count < 1 || count > std::max(16, cactus::processorCount()))
    {
      return 1;
    }
    cactus::parallelBlocks(1000, 1, count, [](std::size_t, std::size_t, std::size_t) {});
  }
  return 0;
}

/// Limits need their own process, which has not started any threads yet.
class LimitedProcess : public ::testing::Test
{
protected:
  void SetUp() override
  {
#ifdef CACTUS_SANITIZED
    GTEST_SKIP() << "sanitizers want all of the address space";
#endif
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

} // namespace

TEST_F(LimitedProcess, IsRefusedWhatDoesNotFitIntoItsAddressSpace)
{
  EXPECT_EXIT(_exit(refusesWhatDoesNotFit()), ::testing::ExitedWithCode(0), "");
}

TEST_F(LimitedProcess, DoesWithoutThreadsThatCannotBeStarted)
{
  EXPECT_EXIT(_exit(sharesLoopsWithin(500000000)), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(_exit(sharesLoopsWithin(5 * gigabyte)), ::testing::ExitedWithCode(0), "");
}

TEST(Memory, IsWrittenAsPeopleReadIt)
{
  const auto message = [](double bytes)
  {
    try
    {
      cactus::requireMemory(bytes, "this", "do less");
    }
    catch (const cactus::OutOfMemory& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(1.0), "");
  EXPECT_EQ(message(8.1234e15).find("this needs 8123400 GB of memory, and "), 0u) << message(8.1234e15);
  EXPECT_EQ(message(8.1234e30).find("this needs 8.12e+21 GB"), 0u) << message(8.1234e30);
}
