#!/usr/bin/env bash
# Makes the figures of Nezamabadi et al. 2017 for BPM, and the tables of docs/bpm_replicability.md, anew.
#   replicate_bpm.sh [--quick] [--keep] [--out FOLDER]
# --quick: two seeds at five times the speed; its document and figures stay in FOLDER (results/replicate_bpm_quick)
# --keep: simulations that are in FOLDER are not run again
# SOFTGRAIN: the program, build/release/bin/softgrain if not set
set -euo pipefail
cd "$(dirname "$0")/../.."
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
quick=false keep=false out=""
while [ $# -gt 0 ]; do
    case $1 in
    --quick) quick=true ;;
    --keep) keep=true ;;
    --out) out=$2 && shift ;;
    *) echo "unknown option $1" >&2 && exit 2 ;;
    esac
    shift
done

method=bpm gallery=nezamabadi2017
seeds="1 2 3 4 5"
coarse=()
figures="single_grain"
document=docs/bpm_replicability.md
if $quick; then
    seeds="1 2"
    coarse=(loading.0.strain_rate=100)
    out=${out:-results/replicate_bpm_quick}
else
    out=${out:-results/replicate_bpm}
fi
$keep || rm -rf "$out"
runs=$out/runs
made=$out/figures
mkdir -p "$runs" "$made"
rm -f "$out/plan" "$out/overview"
if $quick; then
    cp $document "$out/bpm_replicability.md"
    document=$out/bpm_replicability.md
fi

. docs/figures/replicate/shared.sh
figures_here=$here/nezamabadi2017
for figure in $figures; do . "$figures_here/$figure.sh"; done
for figure in $figures; do "plan_$figure"; done
run_the_plan
for figure in $figures; do
    echo "== $figure"
    "make_$figure"
done
{
    echo "| figure | scenario | the paper | softgrain | plots |"
    echo "|---|---|---|---|---|"
    cat "$out/overview"
} | table overview
"$softgrain" --version | sed 's/^/Made with /; s/$/\n/' | table version
if ! $quick; then
    rm -rf docs/figures/nezamabadi2017
    mkdir -p docs/figures/nezamabadi2017/numbers
    cp "$made"/*.png docs/figures/nezamabadi2017/
    cp "$made"/*.csv docs/figures/nezamabadi2017/numbers/
fi
