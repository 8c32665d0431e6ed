#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# fuzz.sh PROGRAM FOLDER: runs a fuzzer for CACTUS_FUZZ_SECONDS, from CACTUS_FUZZ_SEED where that is above 0. What it finds new is
# kept in FOLDER; an input that breaks a promise in FOLDER-crash-…, FOLDER-timeout-… and so on, and the run fails.
mkdir -p "$2"
exec "$1" -max_total_time="${CACTUS_FUZZ_SECONDS:-60}" -seed="${CACTUS_FUZZ_SEED:-0}" -max_len=4096 -timeout=60 \
  -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$2-" "$2"
