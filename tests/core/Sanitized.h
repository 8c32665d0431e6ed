// SPDX-License-Identifier: BSD-3-Clause
// Defines CACTUS_SANITIZED if the tests are compiled for the address or the thread sanitizer, by clang or g++.
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

/// Returns how many random samples to test: a tenth under a sanitizer, which looks for memory faults, not for statistics.
constexpr int fewerWhereSanitized(int samples)
{
#ifdef CACTUS_SANITIZED
  return samples / 10;
#else
  return samples;
#endif
}

} // namespace cactus
