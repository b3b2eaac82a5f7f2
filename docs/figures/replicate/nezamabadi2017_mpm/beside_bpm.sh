# Figs. 6 and 8 to 11: a grain between two walls, and 300 grains in uniaxial compaction without and with friction, by MPM and by BPM.
modulus=10e6           # of the scenarios [N/m^2]
attraction_stress=2.8e6
paper_scripts=docs/figures/replicate/nezamabadi2017
of_bpm=$PWD/docs/figures/nezamabadi2017/numbers
frictions="0 0.5"

plan_beside_bpm() {
    local settings=() friction
    ! $quick || settings=(packing.count=40)
    simulate grain nezamabadi2017/single_grain.toml sampling.parts=false
    for friction in $frictions; do
        simulate packing-$friction nezamabadi2017/packing.toml material.friction=$friction "${settings[@]}"
    done
}

# bpm_in_moduli CSV COLUMN: BPM's table with a column and its range in units of E instead of F0/<a0>.
bpm_in_moduli() {
    awk -F, -v OFS=, -v name="$2" -v factor=$(awk -v a=$attraction_stress -v e=$modulus 'BEGIN { print a / e }') '
        NR == 1 { for (i = 1; i <= NF; ++i) if (index($i, name) == 1) scaled[i]; print; next } { for (i in scaled) $i *= factor; print }' "$of_bpm/$1" >"$made/bpm_$1"
}

make_beside_bpm() {
    local friction run sigma0 phi grid=$(seq -s, -f %.3f 0.66 0.005 0.98) strains=$(seq -s, -f %.3f 0.0 0.005 0.42)
    awk -v diameter=0.01 -v attraction_stress=$modulus -f $paper_scripts/grain_stress.awk "$runs/grain/history.csv" >"$made/grain.csv"
    bpm_in_moduli grain_b.csv stress
    for friction in $frictions; do
        run=$runs/packing-$friction
        awk -v attraction_stress=$modulus -f $paper_scripts/packing_curve.awk "$run/history.csv" >"$run/curve.csv"
        awk -v x=packing_fraction -v y=cumulative_strain,z,stress -v grid="$grid" -v half=0.005 -f $here/at.awk "$run/curve.csv" >"$made/packing_${friction}_by_phi.csv"
        awk -v x=cumulative_strain -v y=packing_fraction,z -v grid="$strains" -f $here/at.awk "$run/curve.csv" >"$made/packing_${friction}_by_strain.csv"
        awk -f docs/figures/replicate/nezamabadi2017_mpm/linear_filling.awk "$run/curve.csv" >"$run/fit"
        read -r sigma0 _ <"$run/fit"
        awk -F, 'NR == 1 { print "cumulative_strain,packing_fraction,z,stress"; next } { print $2 "," $1 "," $3 "," $4 }' \
            "$made/packing_${friction}_by_phi.csv" | awk -v sigma0="$sigma0" -f $paper_scripts/after_consolidation.awk >"$made/packing_${friction}_after.csv"
    done
    {
        echo "| run | steps | CPU time [min] | Z at phi 0.75 | 0.80 | 0.89 | stress [E] at phi 0.80 | 0.89 | 0.95 | sigma0 [E] | slope of phi(sigma/sigma0) | largest miss of the line in phi |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for friction in $frictions; do
            printf "| mu = %s | %s | %s |" $friction "$(result packing-$friction steps)" "$(awk -v t="$(result packing-$friction cpu_time)" 'BEGIN { printf "%.0f", t / 60 }')"
            for phi in 0.750 0.800 0.890; do printf " %s |" "$(number %.2f "$(value "$made/packing_${friction}_by_phi.csv" $phi z)")"; done
            for phi in 0.800 0.890 0.950; do printf " %s |" "$(number %.4f "$(value "$made/packing_${friction}_by_phi.csv" $phi stress)")"; done
            awk '{ printf " %.4f | %.4f | %.3f |\n", $1, $2, $3 }' "$runs/packing-$friction/fit"
        done
    } | table packing

    curve "MPM" grain.csv cumulative_strain stress '"colour": 0'
    shaded "BPM, five seeds" bpm_grain_b.csv cumulative_strain stress '"colour": 1'
    plot figure_06 "Fig. 6: one grain between two walls" '"label": "cumulative strain"' '"label": "stress [E]"' top_left
    local column name
    for column in z packing_fraction; do
        for friction in $frictions; do
            curve "MPM, mu = $friction" packing_${friction}_by_strain.csv cumulative_strain $column "\"colour\": 0$([ $friction = 0 ] || echo ', "line": "dashed"')"
        done
        curve "BPM, mu = 0" "$of_bpm/packing_by_strain.csv" cumulative_strain $column '"colour": 1'
        curve "BPM, mu = 0.5" "$of_bpm/packing_friction_by_strain.csv" cumulative_strain $column '"colour": 1, "line": "dashed"'
        name="coordination number Z"
        [ $column = z ] || name="packing fraction"
        plot figure_09_${column/packing_fraction/phi} "Fig. 9: 300 grains, uniaxial compaction" '"label": "cumulative strain"' "\"label\": \"$name\"" top_left
    done
    for friction in $frictions; do
        curve "MPM, mu = $friction" packing_${friction}_after.csv strain ratio "\"colour\": 0$([ $friction = 0 ] || echo ', "line": "dashed"')"
    done
    curve "BPM, mu = 0" "$of_bpm/packing_by_strain_after.csv" strain ratio '"colour": 1'
    curve "BPM, mu = 0.5" "$of_bpm/packing_friction_by_strain_after.csv" strain ratio '"colour": 1, "line": "dashed"'
    plot figure_10 "Fig. 10: stress since phi = 0.8" '"label": "cumulative strain since phi = 0.8"' '"label": "vertical stress / sigma0"' top_left
    for friction in $frictions; do
        curve "MPM, mu = $friction" packing_${friction}_after.csv ratio packing_fraction "\"colour\": 0$([ $friction = 0 ] || echo ', "line": "dashed"')"
    done
    curve "BPM, mu = 0" "$of_bpm/packing_by_strain_after.csv" ratio packing_fraction '"colour": 1'
    curve "BPM, mu = 0.5" "$of_bpm/packing_friction_by_strain_after.csv" ratio packing_fraction '"colour": 1, "line": "dashed"'
    plot figure_11 "Fig. 11: pore filling" '"label": "vertical stress / sigma0", "min": 0' '"label": "packing fraction"' bottom_right
    "$softgrain" render frames --run "frictionless=$runs/packing-0" --run "friction 0.5=$runs/packing-0.5" --at 0,0.46,0.76,1 --width 1600 --out "$made/pictures" >/dev/null
    mv "$made/pictures/sheet.png" "$made/figure_08.png"
    rm -r "$made/pictures"
    row "6" "\`nezamabadi2017/single_grain.toml\`" "MPM linear, BPM a plateau" "the same kind: MPM nearly linear, BPM a plateau" figure_06.png
    row "8" "\`nezamabadi2017/packing.toml\`, \`material.friction\` 0 and 0.5" "polygons, with gaps of a cell" "polygons without gaps" figure_08.png
    row "9" "the same" "phi alike with and without friction, Z higher without" "table below" figure_09_z.png figure_09_phi.png
    row "10" "the same" "MPM linear in strain" "not linear: surfaces that touch only where they meet stiffen from nothing" figure_10.png
    row "11" "the same" "phi linear in sigma/sigma0, slope 0.08" "not linear, table below" figure_11.png
}
