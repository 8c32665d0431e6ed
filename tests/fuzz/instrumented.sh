#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# instrumented.sh NM OBJECT...: each of these object files tells libFuzzer what an input reaches. A fuzzer of a reader that does not
# would throw bytes at it blindly.
nm=$1
shift
[ $# -gt 0 ] || exit 1
for object; do
  case $object in
    *.pch) ;; # CMake counts precompiled headers among them
    *) "$nm" "$object" | grep -q __sancov || { echo "not compiled for libFuzzer: $object"; failed=1; } ;;
  esac
done
exit "${failed:-0}"
