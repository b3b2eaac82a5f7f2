# Fig. 8: mean stress against packing fraction of incompressible grains, beside Eq. 69; several seeds. Areas are kept, so the
# packing fraction is that of the undeformed areas; the covered area (caps cut off) is a little smaller.
phis=$(seq -s, -f %.3f 0.835 0.005 0.995)

plan_isotropic() {
    local sample law nu seed
    for sample in a b; do for law in $laws; do for nu in 0.3 0.5; do for seed in $seeds; do
        local frames=1000
        [ $nu$seed != 0.31 ] || frames=2
        simulate "isotropic-$sample-$law-$nu-$seed" sample_$sample/isotropic.toml sdem.law=$law random.seed=$seed \
            material.poisson_ratio=$nu sampling.frame_every=$frames "${coarse[@]}"
    done; done; done; done
}
plan_figure_08() { plan_isotropic; }

# SAMPLE LAW NU: the names of its runs.
ensemble() { for seed in $seeds; do echo "isotropic-$1-$2-$3-$seed"; done; }

# Number of a column of jamming.awk, over the seeds of a sample: mean_of SAMPLE COLUMN, range_of SAMPLE COLUMN.
mean_of() { awk -F, -v c="$2" 'NR > 1 { sum += $c; ++n } END { printf "%.4f", sum / n }' "$made/jamming_$1.csv"; }
range_of() {
    awk -F, -v c="$2" -v f="$3" 'NR > 1 { if (!n++ || $c < low) low = $c; if (n == 1 || $c > high) high = $c }
        END { printf f " to " f, low, high }' "$made/jamming_$1.csv"
}

make_figure_08() {
    local sample law phi file numbers=""
    declare -A paper_phi=([a]=0.833 [b]=0.858) paper_Z=([a]=4.20 [b]=4.22)
    for sample in a b; do
        awk -f $here/jamming.awk $(histories $(ensemble $sample mollon2022 0.5)) | sed 's/[^,]*isotropic/isotropic/; s/.history.csv//' \
            >"$made/jamming_$sample.csv"
        awk -v phi0=${paper_phi[$sample]} -v Z0=${paper_Z[$sample]} -f scenarios/mollon2022/eq69.awk >"$made/eq69_paper_$sample.csv"
        awk -v phi0="$(mean_of $sample 4)" -v Z0="$(mean_of $sample 5)" -f scenarios/mollon2022/eq69.awk >"$made/eq69_$sample.csv"
        local colour=0
        for law in $laws; do
            file=figure_08_${sample}_$law.csv
            band packing_fraction_undeformed mean_stress,packing_fraction $phis $(ensemble $sample $law 0.5) >"$made/$file"
            shaded "$law" $file packing_fraction_undeformed mean_stress "\"colour\": $((colour++))"
        done
        curve "Eq. 69, phi0 and Z0 as found" eq69_$sample.csv packing_fraction mean_stress '"line": "dashed", "colour": 4'
        curve "Eq. 69, phi0 and Z0 of the paper" eq69_paper_$sample.csv packing_fraction mean_stress '"line": "dotted", "colour": 4'
        plot figure_08_$sample "Fig. 8: sample ${sample^^}, nu = 0.5, bands: all seeds" \
            '"label": "packing fraction", "min": 0.82, "max": 1' '"label": "mean stress / E", "max": 0.5' top_left
    done

    {
        echo "| sample | phi0 of the rigid packing | phi0 at 10^-3 E | Z0 there | paper: phi0 | Z0 |"
        echo "|---|--:|--:|--:|--:|--:|"
        for sample in a b; do
            echo "| ${sample^^} | $(range_of $sample 2 %.3f) | $(range_of $sample 4 %.3f) | $(range_of $sample 5 %.2f) | ${paper_phi[$sample]} | ${paper_Z[$sample]} |"
        done
    } | table jamming

    {
        echo "| stress / E at phi | | 0.86 | 0.88 | 0.90 | 0.92 | 0.94 | 0.96 | 0.98 | 0.99 |"
        echo "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|"
        for sample in a b; do
            printf "| %s | Eq. 69, phi0 and Z0 as found |" ${sample^^}
            for phi in 0.86 0.88 0.90 0.92 0.94 0.96 0.98 0.99; do printf " %s |" "$(number %.3g "$(eq69_at $sample $phi)")"; done
            echo
            for law in $laws; do
                file="$made/figure_08_${sample}_$law.csv"
                printf "| | \`%s\` |" $law
                for phi in 0.86 0.88 0.90 0.92 0.94 0.96 0.98 0.99; do
                    local mean deviation
                    mean=$(value "$file" ${phi}0 mean_stress)
                    deviation=$(value "$file" ${phi}0 mean_stress_deviation)
                    printf " %s ± %s (%s) |" "$(number %.3g "$mean")" "$(number %.2g "$deviation")" "$(ratio "$mean" "$(eq69_at $sample $phi)")"
                done
                echo
            done
        done
    } | table figure_08
    for law in $laws; do
        numbers+="\`$law\`, phi 0.88 and 0.96: A $(beside_eq69 a $law 0.88), $(beside_eq69 a $law 0.96), B $(beside_eq69 b $law 0.88), $(beside_eq69 b $law 0.96). "
    done
    row 8 "\`sample_{a,b}/isotropic.toml\`, nu = 0.5" "very satisfactory agreement with Eq. 69" "$numbers" figure_08_a.png figure_08_b.png
}

eq69_at() {
    awk -F, -v phi="$2" 'NR > 2 && last <= phi && phi <= $1 { print y + (phi - last) / ($1 - last) * ($2 - y); exit } { last = $1; y = $2 }' \
        "$made/eq69_$1.csv"
}
beside_eq69() { ratio "$(value "$made/figure_08_$1_$2.csv" "${3}0" mean_stress)" "$(eq69_at "$1" "$3")"; }
