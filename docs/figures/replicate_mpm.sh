#!/usr/bin/env bash
# Makes the figures of Nezamabadi et al. 2017 for MPM beside BPM, and the tables of docs/mpm_replicability.md, anew: about an hour on two
# cores. BPM's curves are those of replicate_bpm.sh.
#   replicate_mpm.sh [--quick] [--keep] [--out FOLDER]
# --quick: 40 grains; its document and figures stay in FOLDER (results/replicate_mpm_quick)
# --keep: simulations that are in FOLDER are not run again
# SOFTGRAIN: the program, build/release/bin/softgrain if not set
set -euo pipefail
cd "$(dirname "$0")/../.."
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
. docs/figures/replicate/shared.sh
read_options "$@"

method=mpm gallery=nezamabadi2017_mpm
figures="beside_bpm"
document=docs/mpm_replicability.md
out=${out:-results/replicate_mpm$($quick && echo _quick || true)}
open_folders
make_figures "$here/nezamabadi2017_mpm"
