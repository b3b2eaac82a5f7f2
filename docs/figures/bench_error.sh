#!/usr/bin/env bash
# Measures error against cost and puts tables and plots into docs/benchmarks.md. Options go to `softgrain bench error`; with
# --resume the runs that are there are kept.
set -euo pipefail
cd "$(dirname "$0")/../.."
. docs/figures/replicate/shared.sh
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
out=results/bench_error
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
document=docs/benchmarks.md
gallery=docs/figures/bench/error

"$softgrain" bench error --out $out "$@"
rm -rf $gallery
mkdir -p $gallery
cp $out/*.svg $out/error.csv $gallery/
tail -n +3 $out/error.md | sed 's/^## /### /' | table error
