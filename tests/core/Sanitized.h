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
