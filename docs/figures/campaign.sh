#!/usr/bin/env bash
# Makes the studies of scenarios/{biaxial,stiffness,shear,oedometric} anew: their runs (one at a time, one thread each), their figures,
# and the tables in their documents. About a quarter of an hour of CPU time.
#   campaign.sh [--keep] [--out FOLDER] [STUDY...]
# STUDY: biaxial friction stiffness rate sample_size shear oedometric; all if none is named
# --keep: simulations that are in FOLDER (results/campaign) are not run again
# SOFTGRAIN: the program, build/release/bin/softgrain if not set
set -euo pipefail
cd "$(dirname "$0")/../.."
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
keep=false out=results/campaign studies=""
while [ $# -gt 0 ]; do
    case $1 in
    --keep) keep=true ;;
    --out) out=$2 && shift ;;
    biaxial | friction | stiffness | rate | sample_size | shear | oedometric) studies+=" $1" ;;
    *) echo "unknown option $1" >&2 && exit 2 ;;
    esac
    shift
done
studies=${studies:-biaxial friction stiffness rate sample_size shear oedometric}

$keep || rm -rf "$out"
runs=$out/runs
made=$out/made
gallery=docs/figures/campaign
mkdir -p "$runs" "$made"
rm -f "$out"/*.plan
. docs/figures/campaign/shared.sh
for study in $studies; do
    echo "== $study"
    . "$here/$study.sh"
    document_name=document_$study
    document=${!document_name}
    "plan_$study"
    run_the_plan
    "make_$study"
done
