#!/usr/bin/env bash
# SDEM with chords solved in batches beside chords by polygons, the algorithm of the SDEM paper: 100 grains, one thread.
#   bench/peers/sdem_polygon.sh SOFTGRAIN [STEPS]       CSV: seconds of CPU time of STEPS steps, 200 if not given
set -euo pipefail
softgrain=$1 steps=${2:-200}
scenario=$(dirname "$0")/../../scenarios/packing100/isotropic.toml
seconds() {
    "$softgrain" bench steps "$scenario" --method sdem --warm-up 100 --steps "$steps" --set sdem.law="$1" --set sdem.geometry="$2" \
        --set sdem.inertial_number=1e-2 | sed 's/.*"cpu":\([^,]*\),.*/\1/'
}
echo "law,batch,polygon"
for law in mollon2022 lens_potential; do
    batch=$(seconds $law batch)
    polygon=$(seconds $law polygon)
    echo "$law,$batch,$polygon"
done
