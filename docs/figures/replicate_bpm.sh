#!/usr/bin/env bash
# Makes the figures of Nezamabadi et al. 2017 for BPM, and the tables of docs/bpm_replicability.md, anew: about an hour and a half on two cores.
#   replicate_bpm.sh [--quick] [--keep] [--out FOLDER]
# --quick: two seeds at five times the speed; its document and figures stay in FOLDER (results/replicate_bpm_quick)
# --keep: simulations that are in FOLDER are not run again
# SOFTGRAIN: the program, build/release/bin/softgrain if not set
set -euo pipefail
cd "$(dirname "$0")/../.."
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
. docs/figures/replicate/shared.sh
read_options "$@"

method=bpm gallery=nezamabadi2017
seeds="1 2 3 4 5"
coarse=()
figures="single_grain packing friction"
document=docs/bpm_replicability.md
if $quick; then
    seeds="1 2"
    coarse=(loading.0.strain_rate=100)
    out=${out:-results/replicate_bpm_quick}
else
    out=${out:-results/replicate_bpm}
fi
open_folders
make_figures "$here/nezamabadi2017"
