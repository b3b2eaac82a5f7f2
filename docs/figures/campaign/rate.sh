# The dense sample of the biaxial study at five inertial numbers, three seeds each.
document_rate=scenarios/biaxial/rate.md
rates="1e-4 3e-4 1e-3 3e-3 1e-2"
seeds_rate="1 2 3"

# RATE SEED: the slowest runs are those of the biaxial study.
rate_run() { if [ "$1" = 1e-4 ]; then echo "biaxial-dense-$2"; else echo "rate-$1-$2"; fi; }

plan_rate() {
    local rate seed
    for rate in $rates; do for seed in $seeds_rate; do
        simulate rigid_dem "$(rate_run $rate $seed)" biaxial/dense.toml random.seed=$seed loading.1.inertial_number=$rate
    done; done
}

make_rate() {
    local rate row seed table=$made/rate
    for rate in $rates; do
        features 0.2 $(for seed in $seeds_rate; do rate_run $rate $seed; done) >"$table.$rate.csv"
        band_of axial ratio,volumetric 0.001 "$(axial_grid 0.2)" $(for seed in $seeds_rate; do rate_run $rate $seed; done) \
            >"$made/rate_$rate.csv"
    done
    for rate in $rates; do curve "I = $rate" "rate_$rate.csv" axial ratio; done
    plot rate_ratio "Dense samples, means of three seeds" '"label": "axial strain"' '"label": "q / p"' top_right
    for rate in $rates; do curve "I = $rate" "rate_$rate.csv" axial volumetric; done
    plot rate_volumetric "Dense samples, means of three seeds" '"label": "axial strain"' \
        '"label": "volumetric strain (contraction positive)"' top_right
    {
        echo "| I | peak q/p | at axial strain | dilatancy angle there [deg] | residual q/p | residual phi | largest contraction | volumetric strain beyond 0.2 | lateral stress / 2e-3: least, largest | CPU time of one run [s] |"
        echo "|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for rate in $rates; do
            row=$table.$rate.csv
            printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s, %s | %s |\n" $rate "$(summary "$row" peak %.3f)" \
                "$(summary "$row" peak_strain %.3f)" "$(summary "$row" dilatancy %.1f)" "$(summary "$row" residual %.3f)" \
                "$(summary "$row" residual_phi %.4f)" "$(summary "$row" contraction %.4f)" "$(summary "$row" volumetric_end %.4f)" \
                "$(extreme "$row" lateral_low -1 500)" "$(extreme "$row" lateral_high 1 500)" \
                "$(for seed in $seeds_rate; do result "$(rate_run $rate $seed)" cpu_time; done | awk '{ sum += $1 } END { printf "%.1f", sum / NR }')"
        done
    } | table rate
    seconds | table seconds_rate
    publish rate_{ratio,volumetric}
}
