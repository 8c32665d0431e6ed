// SPDX-License-Identifier: BSD-3-Clause
// Selects the version of a kernel for this machine.
//
// A kernel is a loop in which much time is spent, written in the vectors of base/Vector.h. A file NAMEKernels.cpp holds some of
// them; it is compiled once for each vector unit of x86-64 and fills a table of functions, which NAMEKernels.h describes and
// declares with CACTUS_KERNEL_VERSIONS.
#pragma once

#include <cstddef>
#include <vector>

namespace cactus
{

/// Returns how many of the compiled vector units this machine has: SSE2 (or the baseline of another architecture), AVX2
/// (x86-64-v3) and AVX-512 (x86-64-v4), each of which includes those before it.
std::size_t runnableVectorUnits();

/// The versions of a table of kernels, one for each vector unit.
template <typename Table>
struct KernelVersions;

#if defined(__x86_64__)
#define CACTUS_KERNEL_VERSIONS(Table)                                                                                            \
  extern const Table portable##Table;                                                                                            \
  extern const Table x86V3##Table;                                                                                               \
  extern const Table x86V4##Table;                                                                                               \
  template <>                                                                                                                    \
  struct KernelVersions<Table>                                                                                                   \
  {                                                                                                                              \
    static constexpr const Table* all[] = { &portable##Table, &x86V3##Table, &x86V4##Table };                                    \
  }
#else
#define CACTUS_KERNEL_VERSIONS(Table)                                                                                            \
  extern const Table portable##Table;                                                                                            \
  template <>                                                                                                                    \
  struct KernelVersions<Table>                                                                                                   \
  {                                                                                                                              \
    static constexpr const Table* all[] = { &portable##Table };                                                                  \
  }
#endif

/// Returns the versions that this machine can run, the best last. All give the same bits.
template <typename Table>
std::vector<const Table*> runnableKernels()
{
  const auto& all = KernelVersions<Table>::all;
  return std::vector<const Table*>(all, all + runnableVectorUnits());
}

/// Returns the best of them.
template <typename Table>
const Table& bestKernels()
{
  static const Table& best = *runnableKernels<Table>().back();
  return best;
}

} // namespace cactus
