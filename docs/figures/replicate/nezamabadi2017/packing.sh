# Figs. 8 to 11: 300 grains in uniaxial compaction, three seeds; half the rate and half the tolerance (to phi 0.9), friction.
packing_seeds="1 2 3"
packing_variants="slow fine friction"
declare -A variant_of=([slow]="half the rate" [fine]="half the tolerance" [friction]="mu = 0.5")
packing_phis=$(seq -s, -f %.3f 0.66 0.005 0.98)
packing_strains=$(seq -s, -f %.3f 0.0 0.005 0.42)
packing_strains_after=$(seq -s, -f %.3f 0.005 0.005 0.22)

plan_packing() {
    local settings=() half=31 seed
    ! $quick || settings=(packing.count=40 loading.0.strain_rate=500) half=250
    for seed in $packing_seeds; do
        simulate packing-$seed nezamabadi2017/packing.toml random.seed=$seed "${settings[@]}"
    done
    local briefly=loading.0.until_packing_fraction=0.9
    simulate packing-slow nezamabadi2017/packing.toml "${settings[@]}" $briefly loading.0.strain_rate=$half
    simulate packing-fine nezamabadi2017/packing.toml "${settings[@]}" $briefly bpm.tolerance=2.5e-4
    simulate packing-friction nezamabadi2017/packing.toml "${settings[@]}" material.friction=0.5
}

# packing_curves RUN: its curves at equal packing fractions (means over +-0.01: stick-slip), strains, and strains since phi = 0.8.
packing_curves() {
    local run=$runs/$1
    awk -v attraction_stress=$attraction_stress -f $figures_here/packing_curve.awk "$run/history.csv" >"$run/curve.csv"
    local sigma0=$(awk -f $figures_here/pore_filling.awk "$run/curve.csv" | head -1 | cut -d" " -f1)
    awk -v sigma0=$sigma0 -f $figures_here/after_consolidation.awk "$run/curve.csv" >"$run/after.csv"
    awk -v x=packing_fraction -v y=z,stress -v grid="$packing_phis" -v half=0.01 -f $here/at.awk "$run/curve.csv" >"$run/by_phi.csv"
    awk -v x=cumulative_strain -v y=packing_fraction,z -v grid="$packing_strains" -f $here/at.awk "$run/curve.csv" >"$run/by_strain.csv"
    awk -v x=strain -v y=packing_fraction,ratio -v grid="$packing_strains_after" -f $here/at.awk "$run/after.csv" >"$run/by_strain_after.csv"
}

make_packing() {
    local seeds=() variant phi table filling alpha colour base
    for seed in $packing_seeds; do
        packing_curves packing-$seed
        seeds+=("$runs/packing-$seed/")
    done
    for variant in $packing_variants; do packing_curves packing-$variant; done
    for table in by_phi by_strain by_strain_after; do
        awk -f $here/band.awk "${seeds[@]/%/$table.csv}" >"$made/packing_$table.csv" </dev/null
        cp "$runs/packing-friction/$table.csv" "$made/packing_friction_$table.csv"
    done
    awk -f $figures_here/pore_filling.awk "${seeds[@]/%/curve.csv}" >"$made/pore_filling.txt"
    read -r sigma0 sigma0_error alpha alpha_error slope slope_error < <(tail -1 "$made/pore_filling.txt")
    awk -v alpha=$alpha 'BEGIN { print "ratio,packing_fraction"; for (r = 1; r < 10; r += 0.1) print r "," 1 - 0.2 * exp(-alpha * (r - 1)) }' \
        >"$made/eq14.csv"

    {
        echo "| run | steps | CPU time [min] | largest penetration [d] | steps not converged | Z at phi 0.75 | 0.80 | 0.89 | stress [F0/<a0>] at phi 0.80 | 0.89 | 0.95 |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for seed in $packing_seeds; do packing_row packing-$seed "mu = 0, seed $seed"; done
        for variant in $packing_variants; do packing_row packing-$variant "${variant_of[$variant]}, seed 1"; done
    } | table packing
    {
        echo "| stress at phi | 0.75 | 0.77 | 0.80 | 0.83 | 0.86 | 0.89 | 0.95 |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|"
        printf "| deviation of the seeds / mean |"
        for phi in 0.750 0.770 0.800 0.830 0.860 0.890 0.950; do
            printf " %s |" "$(awk -v s="$(value "$made/packing_by_phi.csv" $phi stress_deviation)" -v m="$(value "$made/packing_by_phi.csv" $phi stress)" \
                'BEGIN { printf "%.1f %%", 100 * s / m }')"
        done
        echo
        for variant in $packing_variants; do
            printf "| %s / seed 1 - 1 |" "${variant_of[$variant]}"
            for phi in 0.750 0.770 0.800 0.830 0.860 0.890 0.950; do
                base=$(value "$runs/packing-1/by_phi.csv" $phi stress)
                printf " %s |" "$(percent "$(value "$runs/packing-$variant/by_phi.csv" $phi stress)" "$base")"
            done
            echo
        done
    } | table packing_changes

    shaded "mu = 0, three seeds" packing_by_strain.csv cumulative_strain z '"colour": 0'
    curve "mu = 0.5" packing_friction_by_strain.csv cumulative_strain z '"line": "dashed", "colour": 1'
    plot figure_09_z "Fig. 9a: 300 aggregates, uniaxial compaction" '"label": "cumulative strain"' '"label": "coordination number Z"' top_left
    shaded "mu = 0, three seeds" packing_by_strain.csv cumulative_strain packing_fraction '"colour": 0'
    curve "mu = 0.5" packing_friction_by_strain.csv cumulative_strain packing_fraction '"line": "dashed", "colour": 1'
    plot figure_09_phi "Fig. 9b: 300 aggregates, uniaxial compaction" '"label": "cumulative strain"' '"label": "packing fraction"' top_left
    shaded "mu = 0, three seeds" packing_by_strain_after.csv strain ratio '"colour": 0'
    curve "mu = 0.5" packing_friction_by_strain_after.csv strain ratio '"line": "dashed", "colour": 1'
    plot figure_10 "Fig. 10: stress since phi = 0.8" '"label": "cumulative strain since phi = 0.8"' '"label": "vertical stress / sigma0"' top_left
    curve "mu = 0, mean of the seeds" packing_by_strain_after.csv ratio packing_fraction '"colour": 0'
    curve "mu = 0.5" packing_friction_by_strain_after.csv ratio packing_fraction '"line": "dashed", "colour": 1'
    curve "Eq. 14, alpha = $alpha" eq14.csv ratio packing_fraction '"line": "dotted", "colour": 4'
    plot figure_11 "Fig. 11: pore filling" '"label": "vertical stress / sigma0", "min": 0' '"label": "packing fraction"' bottom_right
    "$softgrain" render frames --run "BPM=$runs/packing-1" --at 0,0.46,0.76,1 --width 1600 --out "$made/pictures" >/dev/null
    mv "$made/pictures/sheet.png" "$made/figure_08.png"
    rm -r "$made/pictures"
    row "8" "\`nezamabadi2017/packing.toml\`" "round grains at phi 0.65 become polygons at 0.99" "the same, to phi $(last_phi)" figure_08.png
    row "9" "the same, three seeds; \`material.friction = 0.5\`" "jamming at phi = 0.75, Z = 3, strain 0.08; Z levels off at a strain of 0.4; friction changes nothing" \
        "at phi = 0.75 Z is $(range_at 0.750 z %.2f), the stress $(range_at 0.750 stress %.3f) F0/<a0> and the strain $(strain_at 0.75); Z grows to the end; with friction it differs by $(friction_moves_z 0 0.74) below phi 0.74 and by $(friction_moves_z 0.74 1) above" figure_09_{z,phi}.png
    row "10" "the same" "stress over that at phi = 0.8 grows at an increasing rate" "the same" figure_10.png
    row "11" "the same" "phi = 1 - 0.2 exp(-alpha (sigma/sigma0 - 1)) fits up to 0.98, alpha = 0.27" \
        "fitted from 0.8 to 0.97: $(eq14_misses 0.8 0.95) from 0.8 to 0.95, $(eq14_misses 0.95 1) beyond; alpha $alpha +- $alpha_error, sigma0 $sigma0 +- $sigma0_error F0/<a0>, alpha/sigma0 $slope +- $slope_error <a0>/F0" figure_11.png
}

# range_at PHI COLUMN FORMAT: least and largest of the seeds at this packing fraction.
range_at() { echo "$(number $3 "$(value "$made/packing_by_phi.csv" $1 $2_low)") to $(number $3 "$(value "$made/packing_by_phi.csv" $1 $2_high)")"; }

# strain_at PHI: cumulative strain where the mean of the seeds has this packing fraction.
strain_at() {
    awk -v x=packing_fraction -v y=cumulative_strain -v grid=$1 -f $here/at.awk "$made/packing_by_strain.csv" | awk -F, 'NR == 2 { printf "%.2f", $2 }'
}

# friction_moves_z LOW HIGH: Z with friction less that of the seeds without, at equal strains where phi lies between these.
friction_moves_z() {
    awk -F, -v low=$1 -v high=$2 '
        FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        NR == FNR { z[$1] = $column["z"]; next }
        $1 in z && $column["packing_fraction"] >= low && $column["packing_fraction"] < high {
            moved = $column["z"] - z[$1]
            if (!rows++ || moved < least) least = moved
            if (rows == 1 || moved > largest) largest = moved
        }
        END { if (rows) printf "%+.2f to %+.2f", least, largest; else printf "-" }' "$made/packing_by_strain.csv" "$made/packing_friction_by_strain.csv"
}

# eq14_misses LOW HIGH: by how much Eq. 14 misses the mean of the seeds at packing fractions between these.
eq14_misses() {
    awk -F, -v alpha=$alpha -v low=$1 -v high=$2 '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
        {
            phi = $column["packing_fraction"]
            if (phi < low || phi >= high) next
            missed = 1 - 0.2 * exp(-alpha * ($column["ratio"] - 1)) - phi
            if (missed < 0) missed = -missed
            if (missed > most) most = missed
            stress = (1 - log((1 - phi) / 0.2) / alpha) / $column["ratio"] - 1
            if (!rows++ || stress < least) least = stress
            if (rows == 1 || stress > largest) largest = stress
        }
        END {
            if (!rows) { printf "-"; exit }
            printf "phi within %.3f and stress %+.0f to %+.0f %%", most, 100 * least, 100 * largest
        }' "$made/packing_by_strain_after.csv"
}

last_phi() { awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "packing_fraction") c = i } END { printf "%.2f", $c }' "$runs/packing-1/history.csv"; }

# packing_row NAME LABEL
packing_row() {
    printf "| %s | %s | %s | %s |" "$2" "$(result $1 steps)" "$(awk -v t="$(result $1 cpu_time)" 'BEGIN { printf "%.0f", t / 60 }')" \
        "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i == "contact_penetration") c = i; if ($i == "unconverged_steps") u = i }; next }
            $c > most { most = $c } END { printf "%.1e | %d", most / 0.103e-3, $u }' "$runs/$1/history.csv")"
    local phi
    for phi in 0.750 0.800 0.890; do printf " %s |" "$(number %.2f "$(value "$runs/$1/by_phi.csv" $phi z)")"; done
    for phi in 0.800 0.890 0.950; do printf " %s |" "$(number %.3f "$(value "$runs/$1/by_phi.csv" $phi stress)")"; done
    echo
}
