# Fig. 12 and 13: stresses of the oedometric compression against time, and the deviatoric against the mean stress.
pressures="0.002,0.003,0.005,0.007,0.01,0.015,0.02,0.03,0.05,0.07,0.1"

plan_figure_12() { plan_oedometric; }
squeezed() { for seed in $seeds; do echo "oedometric-$1-$2-$seed"; done; }

make_figure_12() {
    local sample law colour level low=0.01 high=0.1
    for sample in a b; do
        for law in $laws; do
            cut_columns time,axial_strain,stress_xx,stress_yy "$runs/oedometric-$sample-$law-1/history.csv" >"$made/figure_12_${sample}_$law.csv"
            band mean_stress deviatoric_stress,stress_xx,stress_yy $pressures $(squeezed $sample $law) >"$made/figure_13_${sample}_$law.csv"
        done
        colour=0
        for law in $laws; do
            curve "xx (loading), $law" figure_12_${sample}_$law.csv time stress_xx "\"colour\": $colour"
            curve "yy, $law" figure_12_${sample}_$law.csv time stress_yy "\"line\": \"dashed\", \"colour\": $((colour++))"
        done
        plot figure_12_$sample "Fig. 12: sample ${sample^^}, oedometric, nu = 0.3" '"label": "time / (unit length sqrt(rho / E))"' \
            '"label": "stress / E"' top_left
    done
    curve "A" figure_12_a_lens_potential.csv time axial_strain
    curve "B" figure_12_b_lens_potential.csv time axial_strain
    plot figure_12_strain "Fig. 12a: loading history" '"label": "time / (unit length sqrt(rho / E))"' '"label": "strain"' bottom_right
    colour=0
    for sample in a b; do
        shaded "${sample^^}, lens_potential" figure_13_${sample}_lens_potential.csv mean_stress deviatoric_stress "\"colour\": $colour"
        curve "${sample^^}, mollon2022" figure_13_${sample}_mollon2022.csv mean_stress deviatoric_stress "\"line\": \"dashed\", \"colour\": $((colour++))"
    done
    plot figure_13 "Fig. 13: oedometric compression, mean and range of the seeds" '"label": "mean stress / E", "log": true' \
        '"label": "deviatoric stress / E", "log": true, "min": 1e-5' bottom_right
    {
        echo "| sample | law | xx / yy at mean stress 0.01 | 0.03 | 0.1 | deviatoric / mean at 0.01 | 0.03 | 0.1 | exponent of deviatoric ~ mean^n, $low to $high | stress xx, yy at the end of the hold |"
        echo "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|"
        for sample in a b; do for law in $laws; do
            local file="$made/figure_13_${sample}_$law.csv"
            printf "| %s | \`%s\` |" ${sample^^} $law
            for level in 0.01 0.03 0.1; do printf " %s |" "$(quotient %.3f "$(value "$file" $level stress_xx)" "$(value "$file" $level stress_yy)")"; done
            for level in 0.01 0.03 0.1; do printf " %s |" "$(quotient %.4f "$(value "$file" $level deviatoric_stress)" $level)"; done
            echo " $(exponent "$file" $low $high) | $(tail -1 "$made/figure_12_${sample}_$law.csv" | awk -F, '{ printf "%.3g, %.3g", $3, $4 }') |"
        done; done
    } | table figure_12
    local a=$made/figure_13_a_lens_potential.csv b=$made/figure_13_b_lens_potential.csv
    row 12 "\`sample_{a,b}/oedometric.toml\`" "the stress in the direction of loading is slightly larger than the one across; both stay when the wall stops" \
        "xx / yy at mean stress 0.01 and 0.1, \`lens_potential\`: A $(quotient %.3f "$(value $a 0.01 stress_xx)" "$(value $a 0.01 stress_yy)"), $(quotient %.3f "$(value $a 0.1 stress_xx)" "$(value $a 0.1 stress_yy)"), B $(quotient %.3f "$(value $b 0.01 stress_xx)" "$(value $b 0.01 stress_yy)"), $(quotient %.3f "$(value $b 0.1 stress_xx)" "$(value $b 0.1 stress_yy)")" \
        figure_12_strain.png figure_12_a.png figure_12_b.png
    row 13 "\`sample_{a,b}/oedometric.toml\`" "the deviatoric stress grows with the mean stress, perhaps as a power; B resists slightly more than A" \
        "exponent A $(exponent $a $low $high), B $(exponent $b $low $high); deviatoric stress B / A at mean stress 0.03 and 0.1: $(quotient %.2f "$(value $b 0.03 deviatoric_stress)" "$(value $a 0.03 deviatoric_stress)"), $(quotient %.2f "$(value $b 0.1 deviatoric_stress)" "$(value $a 0.1 deviatoric_stress)")" \
        figure_13.png
}


# FILE LOW HIGH: slope of log(deviatoric) over log(mean), least squares over the means of the seeds.
exponent() {
    awk -F, -v low="$2" -v high="$3" 'NR > 1 && $1 >= low && $1 <= high && $2 > 0 {
            x = log($1); y = log($2); ++n; sx += x; sy += y; sxx += x * x; sxy += x * y }
        END { if (n > 2) printf "%.2f", (n * sxy - sx * sy) / (n * sxx - sx * sx); else printf "-" }' "$1"
}

# COLUMNS FILE: these columns of a history.
cut_columns() {
    awk -F, -v names="$1" 'NR == 1 { n = split(names, wanted, ","); for (i = 1; i <= NF; ++i) column[$i] = i }
        { line = ""; for (i = 1; i <= n; ++i) line = line (i > 1 ? "," : "") (NR == 1 ? wanted[i] : $column[wanted[i]]); print line }' "$2"
}
