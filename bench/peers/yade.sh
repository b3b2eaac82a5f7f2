#!/usr/bin/env bash
# Rigid DEM against Yade (Debian: apt install yade) on the same discs, one core each, in one run.
#   bench/peers/yade.sh [--build DIR] [--grains N] [--steps N] [--rounds N] [--out FILE]
# A line for each law and round: first what both computed after the same steps, then their seconds, in turns.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build/bench grains=10000 steps=1000 rounds=2 out=/dev/null
while [ $# -gt 0 ]; do
    case $1 in
        --build) build=$2 ;; --grains) grains=$2 ;; --steps) steps=$2 ;; --rounds) rounds=$2 ;; --out) out=$2 ;;
        *) echo "unknown option $1, see the head of $0" >&2; exit 2 ;;
    esac
    shift 2
done
command -v yade >/dev/null || { echo "Yade is not installed: apt install yade" >&2; exit 2; }
peer=$build/bin/rigid_dem_peer
[ -x "$peer" ] || { echo "no $peer: configure with -DSOFTGRAIN_BENCH=ON and build rigid_dem_peer" >&2; exit 2; }
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
"$peer" --grains "$grains" --lammps "$work/discs.data"

{
    echo "# discs: $grains, steps: $steps, $(date -u +%F), $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2), load $(cut -d' ' -f1 /proc/loadavg)"
    echo "friction,shear,round,kinetic,kinetic_yade,stress_xx,stress_xx_yade,stress_yy,stress_yy_yade,z,z_yade,seconds,seconds_yade,ratio,cpu_seconds,cpu_seconds_yade"
    for friction in 0 0.5; do
        for shear in 0 1; do
            for round in $(seq "$rounds"); do
                ours=$(OMP_NUM_THREADS=1 "$peer" --grains "$grains" --friction $friction --shear-rate $shear --steps "$steps")
                theirs=$(yade -n -x -j1 "$here/yade.py" "$work/discs.data" $friction $shear "$steps" 2>/dev/null | grep '^yade')
                echo "$ours,$theirs" | awk -F, -v head="$friction,$shear,$round" \
                    '{ print head "," $7 "," $16 "," $9 "," $17 "," $10 "," $18 "," $11 "," $19 "," $4 "," $20 "," $20 / $4 "," $5 "," $21 }'
            done
        done
    done
} | tee "$out"
