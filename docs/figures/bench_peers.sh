#!/usr/bin/env bash
# Measures other programs beside ours and puts tables and the plot into docs/benchmarks_peers.md. Options go to `softgrain bench
# peers`. What is not installed is left out: apt install lammps yade libsiconos-numerics-dev, and build with -DSOFTGRAIN_BENCH=ON.
set -euo pipefail
cd "$(dirname "$0")/../.."
. docs/figures/replicate/shared.sh
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
out=results/bench_peers
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
document=docs/benchmarks_peers.md
gallery=docs/figures/bench/peers

OMP_WAIT_POLICY=passive "$softgrain" bench peers --force --out $out "$@"
rm -rf $gallery
mkdir -p $gallery
cp $out/*.svg $out/peers.csv $gallery/
tail -n +3 $out/peers.md | sed 's/^## /### /' | table peers
