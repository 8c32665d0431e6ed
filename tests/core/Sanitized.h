// SPDX-License-Identifier: BSD-3-Clause
// Whether the tests are compiled for a sanitizer, by clang or g++: CACTUS_ADDRESS_SANITIZED, and CACTUS_SANITIZED for any of the
// two.
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CACTUS_ADDRESS_SANITIZED
#elif __has_feature(thread_sanitizer)
#define CACTUS_THREAD_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define CACTUS_ADDRESS_SANITIZED
#elif defined(__SANITIZE_THREAD__)
#define CACTUS_THREAD_SANITIZED
#endif
#if defined(CACTUS_ADDRESS_SANITIZED) || defined(CACTUS_THREAD_SANITIZED)
#define CACTUS_SANITIZED
#endif
