#!/usr/bin/env bash
# Measures stability and puts tables and plots into docs/benchmarks_stability.md. Options go to `softgrain bench stability`; with
# --from FOLDER nothing is run and the results in that folder are taken.
set -euo pipefail
cd "$(dirname "$0")/../.."
. docs/figures/replicate/shared.sh
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
out=results/bench_stability
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
document=docs/benchmarks_stability.md
gallery=docs/figures/bench/stability

if [ "${1:-}" = --from ]; then
    out=$2
else
    # Exit 1: some run failed as none may; the table says which.
    "$softgrain" bench stability --force --out $out "$@" || [ $? = 1 ]
fi
rm -rf $gallery
mkdir -p $gallery
cp $out/*.svg $out/*.csv $gallery/
tail -n +3 $out/stability.md | sed 's/^## /### /' | table stability
