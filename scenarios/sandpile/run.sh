#!/bin/sh
# Angles of repose of three seeds for each friction and rolling friction, as CSV; usage: run.sh OUT_DIR [SOFTGRAIN_BIN_DIR]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=$1
bin=${2:+$2/}
mkdir -p "$out"
echo "friction,rolling_friction,seed,angle,bins" > "$out/angles.csv"
for rolling in 0 0.1; do
    for friction in 0.2 0.5 0.8; do
        for seed in 1 2 3; do
            run="$out/friction_${friction}_rolling_${rolling}_seed_${seed}"
            "${bin}softgrain" run "$here/sandpile.toml" --method rigid_dem --out "$run" --threads 1 \
                --set material.friction=$friction --set material.wall_friction=$friction \
                --set rigid_dem.rolling_friction=$rolling --set random.seed=$seed > "$run.log" 2>&1
            last=$(ls "$run"/measures/grains_*.csv | tail -n 1)
            echo "$friction,$rolling,$seed,$(awk -f "$here/angle.awk" "$last" | tr ' ' ',')" >> "$out/angles.csv"
        done
    done
done
awk -F, 'NR > 1 { k = $1 " " $2; if (!(k in n)) order[++kinds] = k; ++n[k]; s[k] += $4; q[k] += $4 * $4 }
    END { for (i = 1; i <= kinds; ++i) { k = order[i]; m = s[k] / n[k]; v = (q[k] - n[k] * m * m) / (n[k] - 1)
          split(k, f, " "); printf "friction %s rolling %s: %.1f +- %.1f degrees\n", f[1], f[2], m, sqrt(v > 0 ? v : 0) } }' "$out/angles.csv"
