# Fig. 10: packing fraction and coordination number against mean stress, nu = 0.3 and 0.5; and Z against Z0 + k sqrt(phi - phi0).
levels="0.002,0.003,0.004,0.006,0.01,0.015,0.02,0.03,0.04,0.06,0.1,0.15,0.2,0.3,0.4"

plan_figure_10() { plan_isotropic; }

make_figure_10() {
    local sample law nu file what colour
    local z=coordination_number_no_rattlers
    for sample in a b; do
        for nu in 0.3 0.5; do for law in $laws; do
            file=figure_10_${sample}_${nu}_$law.csv
            band mean_stress packing_fraction,$z $levels $(ensemble $sample $law $nu) >"$made/$file"
            band packing_fraction $z $phis $(ensemble $sample $law $nu) >"$made/figure_10_z_${sample}_${nu}_$law.csv"
        done; done
        for what in packing_fraction $z; do
            colour=0
            for nu in 0.3 0.5; do
                shaded "nu = $nu, lens_potential" figure_10_${sample}_${nu}_lens_potential.csv mean_stress $what "\"colour\": $colour"
                shaded "nu = $nu, mollon2022" figure_10_${sample}_${nu}_mollon2022.csv mean_stress $what "\"line\": \"dashed\", \"colour\": $((colour++))"
            done
            local name=phi label="packing fraction"
            [ $what = packing_fraction ] || name=z label="coordination number Z, without rattlers"
            plot figure_10_${sample}_$name "Fig. 10: sample ${sample^^}, bands: all seeds" '"label": "mean stress / E", "log": true' \
                "\"label\": \"$label\"" top_left
        done
        colour=0
        for nu in 0.3 0.5; do for law in $laws; do
            shaded "nu = $nu, $law" figure_10_z_${sample}_${nu}_$law.csv packing_fraction $z "\"colour\": $((colour++))"
        done; done
        curve "Z0 + 5.1 sqrt(phi - phi0), as found" eq69_$sample.csv packing_fraction coordination_number '"line": "dashed", "colour": 4'
        curve "with Z0 and phi0 of the paper" eq69_paper_$sample.csv packing_fraction coordination_number '"line": "dotted", "colour": 4'
        plot figure_10_${sample}_z_phi "Sample ${sample^^}: Z and its square-root law" '"label": "packing fraction", "min": 0.82, "max": 1' \
            '"label": "coordination number Z, without rattlers", "min": 3, "max": 7' top_left
    done
    {
        echo "| at mean stress / E | | | 0.003 | 0.01 | 0.03 | 0.1 | 0.3 |"
        echo "|---|---|---|--:|--:|--:|--:|--:|"
        for sample in a b; do for nu in 0.3 0.5; do for what in packing_fraction $z; do for law in $laws; do
            local format=%.3f
            [ $what = packing_fraction ] || format=%.2f
            printf "| %s, nu = %s | %s | \`%s\` |" ${sample^^} $nu "$([ $what = $z ] && echo Z || echo phi)" $law
            for level in 0.003 0.01 0.03 0.1 0.3; do
                printf " %s |" "$(number $format "$(value "$made/figure_10_${sample}_${nu}_$law.csv" $level $what)")"
            done
            echo
        done; done; done; done
    } | table figure_10
    {
        echo "| Z - (Z0 + 5.1 sqrt(phi - phi0)), Z0 and phi0 as found | | phi = 0.86 | 0.88 | 0.90 | 0.92 | 0.94 | 0.96 | 0.98 |"
        echo "|---|---|--:|--:|--:|--:|--:|--:|--:|"
        for sample in a b; do for nu in 0.3 0.5; do for law in $laws; do
            printf "| %s, nu = %s | \`%s\` |" ${sample^^} $nu $law
            for phi in 0.86 0.88 0.90 0.92 0.94 0.96 0.98; do
                printf " %s |" "$(number %+.2f "$(above_square_root $sample "$(value "$made/figure_10_z_${sample}_${nu}_$law.csv" ${phi}0 $z)" $phi)")"
            done
            echo
        done; done; done
    } | table square_root
    row 10 "\`sample_{a,b}/isotropic.toml\`, nu = 0.3 and 0.5" \
        "beside MELODY: good prediction of the compressibility, slightly under-estimated below a stress of 0.01 and over-estimated above 0.1; Z good at nu = 0.3, a bit too large at nu = 0.5 and low stress" \
        "Z at stress 0.003 and 0.1, \`lens_potential\`: A, nu 0.3: $(z_at a 0.3 0.003), $(z_at a 0.3 0.1), nu 0.5: $(z_at a 0.5 0.003), $(z_at a 0.5 0.1). phi of \`mollon2022\` - phi of \`lens_potential\`, A, nu 0.3, at stress 0.003, 0.03, 0.2: $(phi_apart 0.003), $(phi_apart 0.03), $(phi_apart 0.2)" \
        figure_10_{a,b}_{phi,z,z_phi}.png
}

z_at() { number %.2f "$(value "$made/figure_10_$1_$2_lens_potential.csv" "$3" coordination_number_no_rattlers)"; }
phi_apart() {
    local printed lens
    printed=$(value "$made/figure_10_a_0.3_mollon2022.csv" "$1" packing_fraction)
    lens=$(value "$made/figure_10_a_0.3_lens_potential.csv" "$1" packing_fraction)
    if [ -n "$printed" ] && [ -n "$lens" ]; then awk -v a="$printed" -v b="$lens" 'BEGIN { printf "%+.3f", a - b }'; else printf -- "-"; fi
}

# SAMPLE Z PHI
above_square_root() {
    [ -z "$2" ] || awk -v Z="$2" -v phi="$3" -v phi0="$(mean_of "$1" 4)" -v Z0="$(mean_of "$1" 5)" \
        'BEGIN { if (phi > phi0) print Z - Z0 - 5.1 * sqrt(phi - phi0) }'
}
