#!/bin/sh
# Runs the disc without damping, with contact damping and with Cundall's, prints the rebounds, draws the phase portraits.
# Usage: run.sh OUT_DIR [SOFTGRAIN_BIN_DIR]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=$1
bin=${2:+$2/}
mkdir -p "$out"

trace() { # NAME METHOD KEY=VALUE...
    name=$1
    method=$2
    shift 2
    options=
    for key in "$@"; do options="$options --set $key"; done
    # shellcheck disable=SC2086
    "${bin}softgrain" run "$here/bouncing_disc.toml" --method "$method" --out "$out/$name" $options > "$out/$name.log" 2>&1
    awk -f "$here/trace.awk" "$out/$name"/measures/grains_*.csv > "$out/$name.csv"
    printf '%s: ' "$name"
    awk -f "$here/bounces.awk" "$out/$name.csv"
}

trace undamped rigid_dem
trace undamped_long_step rigid_dem rigid_dem.safety=0.9
trace contact_damping rigid_dem rigid_dem.restitution=0.8
trace nonviscous rigid_dem rigid_dem.nonviscous_damping=0.1
trace sdem sdem
trace bpm bpm

cat > "$out/phase_portrait.json" <<'JSON'
{"title": "A disc on the floor, rigid_dem", "x": {"label": "height of the lowest point [m]", "min": -0.5, "max": 5.5},
 "y": {"label": "velocity [m/s]", "min": -3.5, "max": 3.5}, "legend": "top_right", "width": 1200, "height": 1000,
 "series": [
  {"label": "undamped", "csv": "undamped.csv", "x_column": "height", "y_column": "velocity"},
  {"label": "contact damping, restitution 0.8", "csv": "contact_damping.csv", "x_column": "height", "y_column": "velocity"},
  {"label": "Cundall's damping 0.1", "csv": "nonviscous.csv", "x_column": "height", "y_column": "velocity"}]}
JSON
"${bin}softgrain-render" plot "$out/phase_portrait.json" --out "$out/phase_portrait.png"
