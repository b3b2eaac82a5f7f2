# How far each sample goes: both laws, nu 0.3, 0.49 and 0.5, to a covered packing fraction of 0.99 or a stress of E.
plan_compression() {
    plan_isotropic
    local sample law
    for sample in a b; do for law in $laws; do
        simulate "isotropic-$sample-$law-0.49-1" sample_$sample/isotropic.toml sdem.law=$law random.seed=1 \
            material.poisson_ratio=0.49 sampling.frame_every=1000 "${coarse[@]}"
    done; done
}

make_compression() {
    local sample law nu seed name every
    {
        echo "| sample | nu | law | runs | ended | phi reached | undeformed | stress / E there | CPU time [s] |"
        echo "|---|---|---|--:|---|--:|--:|--:|--:|"
        for sample in a b; do for nu in 0.3 0.49 0.5; do for law in $laws; do
            every=$seeds
            [ $nu != 0.49 ] || every=1
            for seed in $every; do
                name=isotropic-$sample-$law-$nu-$seed
                [ ! -e "$runs/$name/run.json" ] || echo "$(result "$name" ended),$(result "$name" cpu_time),$(last_sample "$name")"
            done | awk -F, -v sample=${sample^^} -v nu=$nu -v law=$law '
                function span(low, high, f) { return low == high ? sprintf(f, low) : sprintf(f " to " f, low, high) }
                { sub(/: grain [0-9]+ is/, ": a grain is", $1); if (!($1 in ends)) order[++kinds] = $1; ++ends[$1]; cpu += $2
                  for (i = 3; i <= 5; ++i) { if (NR == 1 || $i < low[i]) low[i] = $i; if (NR == 1 || $i > high[i]) high[i] = $i } }
                END {
                    if (!NR) { printf "| %s | %s | `%s` | 0 | failed | - | - | - | - |\n", sample, nu, law; exit }
                    for (k = 1; k <= kinds; ++k) text = text (k > 1 ? "; " : "") (kinds > 1 ? ends[order[k]] " " : "") order[k]
                    printf "| %s | %s | `%s` | %d | %s | %s | %s | %s | %.1f |\n", sample, nu, law, NR, text, span(low[3], high[3], "%.3f"),
                        span(low[4], high[4], "%.3f"), span(low[5], high[5], "%.2f"), cpu / NR }'
        done; done; done
    } | table compression
}

# NAME: packing fraction, undeformed one and mean stress of the last sample.
last_sample() {
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) c[$i] = i }
        END { print $c["packing_fraction"] "," $c["packing_fraction_undeformed"] "," $c["mean_stress"] }' "$runs/$1/history.csv"
}
