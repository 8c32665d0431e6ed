// SPDX-License-Identifier: BSD-3-Clause
// CACTUS_SANITIZED where the tests are compiled for the address or the thread sanitizer, by clang or g++.
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CACTUS_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CACTUS_SANITIZED
#endif

namespace cactus
{

/// How many random samples to look at: a tenth under a sanitizer, which is after faults of memory, not after statistics.
constexpr int fewerWhereSanitized(int samples)
{
#ifdef CACTUS_SANITIZED
  return samples / 10;
#else
  return samples;
#endif
}

} // namespace cactus
