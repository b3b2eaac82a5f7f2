#!/usr/bin/env bash
# Measures cost and memory over the number of grains and puts tables and plots into docs/benchmarks_scaling.md. Options go to
# `softgrain bench scaling`. Counts of kernels are not made anew: bench/scaling/count_kernels.py --update.
set -euo pipefail
cd "$(dirname "$0")/../.."
. docs/figures/replicate/shared.sh
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
out=results/bench_scaling
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
document=docs/benchmarks_scaling.md
gallery=docs/figures/bench/scaling

OMP_WAIT_POLICY=passive "$softgrain" bench scaling --force --out $out "$@"
rm -rf $gallery
mkdir -p $gallery
cp $out/*.svg $out/scaling.csv $out/roofline.csv $gallery/
tail -n +3 $out/scaling.md | sed 's/^## /### /' | table scaling
