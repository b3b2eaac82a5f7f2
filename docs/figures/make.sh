#!/usr/bin/env bash
# Makes every number and picture of the README anew (about six minutes). Run after ./bootstrap.sh build.
set -euo pipefail
cd "$(dirname "$0")/../.."
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
out=results/readme
figures=docs/figures
rm -rf "$out"
mkdir -p "$out"

echo "== default comparison"
$softgrain compare scenarios/default.toml --out "$out/default" --quiet
$softgrain render SDEM="$out/default/sdem" BPM="$out/default/bpm" "rigid DEM=$out/default/rigid_dem" MPM="$out/default/mpm" \
    --at-phi 0.95 --range 0,0.3 --out "$figures/methods_at_095.png"
cp "$out/default/stress.png" "$figures/default_stress.png"
cp "$out/default/coordination.png" "$figures/default_coordination.png"

echo "== 24 grains beside the resolved solution"
$softgrain compare scenarios/packing24/isotropic.toml --methods sdem --quiet --out "$out/packing24" \
    --reference scenarios/packing24/reference_nu0.3.csv --at 0.82,0.86,0.90,0.94
cp "$out/packing24/stress.png" "$figures/packing24_stress.png"
cp "$out/packing24/coordination.png" "$figures/packing24_coordination.png"

echo "== stress probes from one state"
$softgrain fan scenarios/probes/fan.toml --methods rigid_dem,sdem --quiet --out "$out/fan"
cp "$out/fan/response.png" "$figures/probe_fan.png"

echo "== one grain between four walls"
series=""
colour=0
for nu in 0 0.3 0.45; do
    $softgrain run scenarios/single_grain/four_walls.toml --method sdem --quiet --set material.poisson_ratio=$nu \
        --out "$out/four_walls_$nu" >/dev/null
    awk -f scenarios/single_grain/force.awk "$out/four_walls_$nu/history.csv" >"$out/four_walls_$nu.csv"
    grep -v '^#' "scenarios/single_grain/reference_four_walls_nu$nu.csv" >"$out/four_walls_$nu.reference.csv"
    echo "nu = $nu: e, SDEM / resolved - 1"
    awk -F, 'FNR == 1 { next } NR == FNR { force[sprintf("%.3f", $1)] = $2; next }
             { e = sprintf("%.3f", $1) } e ~ /^0.(01|02|05|10|15|20|25)0$/ { printf "  %s %+.0f %%\n", e, 100 * (force[e] / $2 - 1) }' \
        "$out/four_walls_$nu.csv" "$out/four_walls_$nu.reference.csv"
    series+="{\"label\": \"SDEM, nu = $nu\", \"csv\": \"four_walls_$nu.csv\", \"x_column\": \"e\", \"y_column\": \"F\", \"colour\": $colour},"
    series+="{\"label\": \"resolved, nu = $nu\", \"csv\": \"four_walls_$nu.reference.csv\", \"x_column\": \"e\", \"y_column\": \"F\", \"line\": \"dashed\", \"colour\": $colour},"
    colour=$((colour + 1))
done
cat >"$out/four_walls.json" <<JSON
{"title": "One grain between four walls", "x": {"label": "wall displacement / radius", "max": 0.25},
 "y": {"label": "wall force [N]", "max": 0.8}, "series": [${series%,}]}
JSON
$softgrain render plot "$out/four_walls.json" --out "$figures/four_walls.png"

echo "== one BPM grain between two walls: plateau in F0/<a0>, five seeds"
for seed in 1 2 3 4 5; do
    $softgrain run scenarios/single_grain/two_walls.toml --method bpm --quiet --set random.seed=$seed \
        --out "$out/plateau_$seed" >/dev/null
    awk -f scenarios/single_grain/plateau.awk "$out/plateau_$seed/history.csv"
done
