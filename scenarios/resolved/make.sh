#!/usr/bin/env bash
# Makes the resolved curves of this folder anew, each by MPM on two grids; their difference is the error bar. Two simulations at a time.
#   scenarios/resolved/make.sh [--keep] [--out FOLDER] [CURVE...]
# --keep: simulations that are in FOLDER (results/resolved) are not run again, those that were stopped go on
# CURVE: such as 24_isotropic_nu0.3; all if none
# SOFTGRAIN: the program, build/release/bin/softgrain if not set
set -euo pipefail
cd "$(dirname "$0")/../.."
here=scenarios/resolved
export softgrain=${SOFTGRAIN:-build/release/bin/softgrain} out=results/resolved keep=false
while [[ ${1:-} == --* ]]; do
    case $1 in
    --keep) keep=true ;;
    --out) out=$2 && shift ;;
    *) echo "unknown option $1" >&2 && exit 2 ;;
    esac
    shift
done
curves=("$@")
(($#)) || curves=({24,100}_{isotropic,oedometric}_nu{0.3,0.45,0.49})

grids() { [[ $1 == 24_* ]] && echo 12 16 || echo 8 12; }

# simulate CURVE POINTS
simulate() {
    local grains loading nu run=$out/$1-$2 interval=0.004 again=--force
    IFS=_ read -r grains loading nu <<<"$1"
    [[ $loading == isotropic ]] || interval=0.008
    if $keep; then
        again=--resume
        ! grep -qs '"exit_code": 0' "$run/run.json" || return 0
    fi
    "$softgrain" run "scenarios/packing$grains/$loading.toml" --method mpm --threads 1 --out "$run" $again --quiet \
        --set material.poisson_ratio="${nu#nu}" --set mpm.points_across_radius="$2" --set mpm.inertial_number=1e-3 \
        --set loading.0.until_packing_fraction=0.97 --set sampling.strain_interval=$interval >"$run.log" 2>&1 ||
        { echo "$run failed: $(tail -1 "$run.log")" >&2 && return 1; }
}
export -f simulate
mkdir -p "$out"
for curve in "${curves[@]}"; do for points in $(grids "$curve"); do echo "$curve $points"; done; done |
    xargs -P 2 -L 1 bash -c 'simulate "$@"' simulate

for curve in "${curves[@]}"; do
    read -r coarse fine <<<"$(grids "$curve")"
    awk -F, -v curve="$curve" -v coarse="$coarse" -v fine="$fine" -f $here/two_grids.awk \
        "$out/$curve-$coarse/history.csv" "$out/$curve-$fine/history.csv" >"$here/$curve.csv"
done
