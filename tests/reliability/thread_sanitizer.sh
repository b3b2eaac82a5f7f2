#!/usr/bin/env bash
# tests/reliability/thread_sanitizer.sh: the contract suite, which runs every method with several threads, under clang's thread
# sanitizer. Exit code 66 if it finds a race. Archer tells it what OpenMP orders.
set -euo pipefail
cd "$(dirname "$0")/../.."
env -u SOFTGRAIN_WERROR cmake --preset tsan >/dev/null  # warnings are looked at by the compiler of releases
cmake --build --preset tsan --target contract_tests
archer=$(ls /usr/lib/llvm-*/lib/libarcher.so | tail -1)
OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS="ignore_noninstrumented_modules=1 exitcode=66" OMP_NUM_THREADS=2 \
    build/tsan/bin/contract_tests --gtest_brief=1
