#!/usr/bin/env bash
# How the error of MPM falls with its grid, h = R/4, R/8, R/16 (8, 16, 32 points across a radius): rms of the wall force / resolved
# reference - 1 over wall displacements of 0.03 to 0.25 radii, and the order between two grids.
#   scenarios/single_grain/order.sh [folder for the runs]
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${1:-results/order}
for walls in four two; do
    reference=scenarios/single_grain/reference_${walls}_walls_nu0.3.csv
    last=
    for points in 8 16 32; do
        run=$out/$walls-$points
        build/release/bin/softgrain run scenarios/single_grain/${walls}_walls.toml --method mpm --out "$run" --force --quiet \
            --set mpm.points_across_radius=$points --set sampling.strain_interval=0.01 --set mpm.strain_step=0.01 >/dev/null
        error=$(awk -F, -f scenarios/single_grain/force.awk "$run/history.csv" | awk -F, '
            FNR == NR { if ($1 + 0 == $1) F[sprintf("%.4f", $1)] = $2; next }
            $1 >= 0.0299 && $1 <= 0.2501 { k = sprintf("%.4f", $1); if (k in F) { e = $2 / F[k] - 1; sum += e * e; ++n } }
            END { print sqrt(sum / n) }' "$reference" -)
        awk -v w=$walls -v p=$points -v e="$error" -v l="${last:-0}" 'BEGIN {
            printf "%s walls  h = R/%-2d  rms error %.2e%s\n", w, p / 2, e, (l > 0 ? sprintf("  order %.2f", log(l / e) / log(2)) : "") }'
        last=$error
    done
done
