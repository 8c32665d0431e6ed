// SPDX-License-Identifier: BSD-3-Clause
// The sanitizers' options; part of every instrumented test program, so that they are the same by hand and from CTest. The
// environment variables ASAN_OPTIONS, LSAN_OPTIONS, TSAN_OPTIONS and UBSAN_OPTIONS are added.
#ifdef CACTUS_SYMBOLIZER
#define SYMBOLIZER ":external_symbolizer_path=" CACTUS_SYMBOLIZER
#else
#define SYMBOLIZER ""
#endif

extern "C"
{

  const char* __asan_default_options();
  const char* __ubsan_default_options();
  const char* __tsan_default_options();
  const char* __lsan_default_suppressions();

  const char* __asan_default_options()
  {
    return "detect_leaks=1:detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1" SYMBOLIZER;
  }

  const char* __ubsan_default_options()
  {
    return "print_stacktrace=1" SYMBOLIZER;
  }

  // LLVM's OpenMP library (14) loses memory when a team of threads outgrows the one before it, with empty regions, too: 2,880
  // bytes when 16 threads follow on 2. A leak of ours inside of a parallel region is left out with it, since it is allocated by a
  // function that the library calls.
  const char* __lsan_default_suppressions()
  {
    return "leak:libomp.so\n";
  }

  // libomp and the C library are not instrumented: of what they do the sanitizer sees a part only.
  const char* __tsan_default_options()
  {
    return "ignore_noninstrumented_modules=1:halt_on_error=1" SYMBOLIZER;
  }

} // extern "C"
