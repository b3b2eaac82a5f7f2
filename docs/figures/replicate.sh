#!/usr/bin/env bash
# Makes every figure of Mollon 2022 from 7 to 13, and the tables of docs/replicability.md, anew: about ten minutes on two cores.
#   replicate.sh [--quick] [--keep] [--large] [--out FOLDER]
# --quick: small samples, two seeds, about a minute; its document and figures stay in FOLDER (results/replicate_quick)
# --keep: simulations that are in FOLDER are not run again
# --large: also 10 000 grains (about five minutes more); without it that table stays as it is
# SOFTGRAIN: the program, build/release/bin/softgrain if not set
set -euo pipefail
cd "$(dirname "$0")/../.."
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
quick=false keep=false large=false out=""
while [ $# -gt 0 ]; do
    case $1 in
    --quick) quick=true ;;
    --keep) keep=true ;;
    --large) large=true ;;
    --out) out=$2 && shift ;;
    *) echo "unknown option $1" >&2 && exit 2 ;;
    esac
    shift
done

method=sdem gallery=mollon2022
laws="lens_potential mollon2022"
seeds="1 2 3 4 5"
coarse=() fast=1e-3 # inertial number of all figures
figures="figure_07 figure_08 figure_09 figure_10 figure_11 figure_12 compression rates drivers"
document=docs/replicability.md
if $quick; then
    seeds="1 2"
    fast=3e-3
    coarse=(packing.count=200 loading.0.inertial_number=$fast)
    out=${out:-results/replicate_quick}
else
    out=${out:-results/replicate}
fi
$large && figures+=" ten_thousand"
. docs/figures/replicate/shared.sh
open_folders
make_figures "$here"
