// SPDX-License-Identifier: BSD-3-Clause
// The little of CUDA, cuRAND and Thrust that RMS's main.cu takes, for a processor: rms.py compiles it in their place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#define __global__
#define __device__

struct Place
{
  int x = 0;
};
inline Place threadIdx, blockIdx, blockDim, gridDim;

using curandStatePhilox4_32_10_t = std::mt19937_64;
inline void curand_init(unsigned long seed, int sequence, int, curandStatePhilox4_32_10_t* state)
{
  std::seed_seq both{ std::uint32_t(seed), std::uint32_t(seed >> 32), std::uint32_t(sequence) };
  state->seed(both);
}
inline double curand_uniform_double(curandStatePhilox4_32_10_t* state)
{
  return (double((*state)() >> 11) + 1.0) * 0x1p-53; // above 0, up to 1, as cuRAND's
}

inline double atomAdd(double* address, double value)
{
  const double old = *address;
  *address += value;
  return old;
}
inline void cudaDeviceSynchronize() {}

namespace thrust
{
template <typename T>
using host_vector = std::vector<T>;

template <typename T>
struct device_vector : std::vector<T>
{
  using std::vector<T>::vector;
  device_vector(const std::vector<T>& other)
    : std::vector<T>(other)
  {
  }
  struct Pointer
  {
    T* place;
    T* get() const { return this->place; }
  };
  Pointer data() { return { std::vector<T>::data() }; }
};
using std::copy;
} // namespace thrust

/// Runs a kernel's threads one after the other.
template <typename Kernel, typename... Arguments>
void launch(Kernel kernel, int blocks, int threads, Arguments... arguments)
{
  gridDim.x = blocks;
  blockDim.x = threads;
  for (blockIdx.x = 0; blockIdx.x < blocks; ++blockIdx.x)
  {
    for (threadIdx.x = 0; threadIdx.x < threads; ++threadIdx.x)
    {
      kernel(arguments...);
    }
  }
}
