#!/usr/bin/env bash
# tests/reliability/memcheck.sh: one small run of every method under valgrind's memcheck. Invalid reads and writes, values that
# decide something before they are set, and memory that is lost for certain make it fail. Built by the preset count, whose
# instructions valgrind knows.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset count >/dev/null
cmake --build --preset count --target softgrain
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
printf '%s\n' sdem bpm rigid_dem mpm | SOFTGRAIN_CACHE=off xargs -P "$(nproc)" -I{} \
    valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
    build/count/bin/softgrain run tests/reliability/memcheck.toml --method {} --threads 1 --quiet --out "$made/{}"
