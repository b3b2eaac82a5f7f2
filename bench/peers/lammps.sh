#!/usr/bin/env bash
# Rigid DEM against LAMMPS (Debian: apt install lammps) on the same discs, in one run.
#   bench/peers/lammps.sh [--build DIR] [--grains N] [--tiles N] [--steps N] [--rounds N] [--check no] [--out FILE]
# First whether both compute the same (unless --check no), then their speed in turns; CSV to the screen and to FILE.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../../build/bench grains=10000 tiles=1 steps=2000 rounds=5 check=yes out=/dev/null
while [ $# -gt 0 ]; do
    case $1 in
        --build) build=$2 ;; --grains) grains=$2 ;; --tiles) tiles=$2 ;;
        --steps) steps=$2 ;; --rounds) rounds=$2 ;;
        --check) check=$2 ;; --out) out=$2 ;;
        *) echo "unknown option $1, see the head of $0" >&2; exit 2 ;;
    esac
    shift 2
done
command -v lmp >/dev/null || { echo "LAMMPS is not installed: apt install lammps" >&2; exit 2; }
peer=$build/bin/rigid_dem_peer
[ -x "$peer" ] || { echo "no $peer: configure with -DSOFTGRAIN_BENCH=ON and build rigid_dem_peer" >&2; exit 2; }
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
sample=(--grains "$grains" --tiles "$tiles")

# ours FRICTION SHEAR STEPS THREADS, lammps the same: energy per grain, stresses, Z, seconds.
ours() { OMP_NUM_THREADS=$4 "$peer" "${sample[@]}" --friction "$1" --shear-rate "$2" --steps "$3"; }
lammps() {
    OMP_NUM_THREADS=1 mpirun --allow-run-as-root --oversubscribe -n "$4" \
        lmp -in "$here/lammps.in" -log none -var data "$work/$2.data" \
        -var friction "$1" -var shear "$2" -var steps "$3" -var rounds 1
}
for shear in 0 1; do "$peer" "${sample[@]}" --shear-rate $shear --lammps "$work/$shear.data"; done

{
    echo "# discs: $(("$grains" * tiles * tiles)), $(date -u +%F), $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2), load $(cut -d' ' -f1 /proc/loadavg)"
    if [ "$check" = yes ]; then
        echo "check,friction,shear,steps,kinetic,kinetic_lammps,stress_xx,stress_xx_lammps,stress_yy,stress_yy_lammps,z,z_lammps"
        for friction in 0 0.5; do
            for shear in 0 1; do
                for n in 100 1000; do
                    theirs=$(lammps $friction $shear $n 1 | awk -v n=$n '$1 == n { print $3 + $4, $5, $6, $7 }')
                    ours $friction $shear $n 1 | awk -F, -v head="check,$friction,$shear,$n" -v theirs="$theirs" \
                        '{ split(theirs, t, " "); print head "," $7 "," t[1] "," $9 "," t[2] "," $10 "," t[3] "," $11 "," t[4] }'
                done
            done
        done
    fi
    # Wall-clock seconds of each loop, and those of the processor: they differ on a crowded machine.
    echo "speed,friction,shear,round,threads,seconds,cpu_seconds,lammps_seconds,lammps_cpu_seconds,ratio,cpu_ratio"
    for friction in 0 0.5; do
        for shear in 0 1; do
            for threads in 1 2; do
                for round in $(seq "$rounds"); do
                    ours $friction $shear "$steps" $threads >"$work/ours"
                    lammps $friction $shear "$steps" $threads >"$work/theirs"
                    theirs=$(awk '/^Loop time/ { t = $4 } /CPU use/ { sub("%", "", $1); c = t * $1 / 100 } END { print t, c }' "$work/theirs")
                    awk -F, -v head="speed,$friction,$shear,$round,$threads" -v theirs="$theirs" -v threads=$threads \
                        '{ split(theirs, t, " "); c = t[2] * threads; print head "," $4 "," $5 "," t[1] "," c "," t[1] / $4 "," c / $5 }' "$work/ours"
                done
            done
        done
    done
} | tee "$out"
