#!/usr/bin/env bash
# tests/reliability/memcheck.sh: one small run of every method under valgrind's memcheck. Invalid reads and writes, values that
# decide something before they are set, and memory that is lost for certain end it with 9. Built by the preset count, whose
# instructions valgrind knows.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset count >/dev/null
cmake --build --preset count --target softgrain
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
for method in sdem bpm rigid_dem mpm; do
    echo "#### $method"
    SOFTGRAIN_CACHE=off valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
        build/count/bin/softgrain run tests/reliability/memcheck.toml --method $method --threads 1 --quiet --out "$made/$method"
done
