#!/usr/bin/env bash
# Draws work against penetration of BPM's two contact engines from bench/bpm/engines.csv, which `bpm_engines` writes.
set -euo pipefail
cd "$(dirname "$0")/../.."
softgrain=${SOFTGRAIN:-build/release/bin/softgrain}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
series=""
colour=0
for sample in grain packing; do
    for engine in nscd box2d; do
        # The cheapest setting for each penetration that any setting reaches.
        tail -n +2 bench/bpm/engines.csv | awk -F, -v s=$sample -v e=$engine '$1 == s && $2 == e { print $8 "," 1e3 * $7 }' |
            sort -t, -k2,2g | awk -F, 'BEGIN { print "penetration,cost" } NR == 1 || $1 < least { print; least = $1 }' >"$out/$sample-$engine.csv"
        label="$sample, $engine"
        line=solid
        [ $engine = nscd ] || line=dashed
        series+="{\"label\": \"$label\", \"csv\": \"$sample-$engine.csv\", \"x_column\": \"penetration\", \"y_column\": \"cost\", \"line\": \"$line\", \"colour\": $colour},"
    done
    colour=$((colour + 1))
done
cat >"$out/plot.json" <<JSON
{"title": "Work of the contact engines", "x": {"label": "largest penetration [disc diameters]", "log": true},
 "y": {"label": "CPU time for sqrt(m d/F0) [ms]", "log": true}, "legend": "top_left", "series": [${series%,}]}
JSON
"$softgrain" render plot "$out/plot.json" --out docs/figures/bpm_engines.png
