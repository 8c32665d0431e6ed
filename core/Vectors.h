// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One binary for every x86-64 machine: of a function so marked the compiler makes a version per vector unit, and the loader takes
// the best. Contraction is off for the whole library, so all versions give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define CACTUS_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CACTUS_VECTOR_CLONES
#endif
