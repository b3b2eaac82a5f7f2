# Fig. 7: one grain between four walls. (i) The printed formula on the contact lengths of resolved grains, as the paper calibrates
# it; (ii) what one SDEM grain gives.
plan_figure_07() {
    local law nu
    for law in $laws; do for nu in 0 0.2 0.3 0.4 0.45 0.49; do
        simulate "grain-$law-$nu" single_grain/four_walls.toml sdem.law=$law material.poisson_ratio=$nu \
            sampling.frame_every=1000
    done; done
}

resolved_grain() { echo "tests/data/sdem/grain_fourwall_nu$1.csv"; }

# NU: force of Eq. 55-57 from the length of contact of a resolved grain; the depth is that of the circle through the ends of the
# contacts.
formula_on_resolved() {
    awk -F, 'BEGIN { print "e,resolved,formula" }
        /^[0-9]/ && $1 <= 0.2501 {
            half = 0.5 * (1 - $1)
            depth = sqrt(half * half + 0.25 * $3 * $3) - half
            printf "%.2f,%s,%.6g\n", $1, $2, $3 * depth / (0.58 * $3 - depth)
        }' "$(resolved_grain "$1")"
}

# NU: wall forces of the resolved grain and of one SDEM grain of each law.
forces_of_grain() {
    local law files=() grid
    grid=$(seq -s, -f %.2f 0.01 0.01 0.25)
    for law in $laws; do
        awk -v x=axial_strain -v y=stress_yy,box_width -v grid="$grid" -f $here/at.awk "$runs/grain-$law-$1/history.csv" \
            >"$runs/grain-$law-$1/force.table"
        files+=("$runs/grain-$law-$1/force.table")
    done
    awk -F, -v laws="$laws" 'BEGIN { gsub(" ", ",", laws); print "e,resolved," laws }
        FNR == 1 { ++file }
        !/^[0-9]/ { next }
        file == 1 { e = sprintf("%.2f", $1); order[++rows] = e; row[e] = e "," $2; next }
        { e = sprintf("%.2f", $1); row[e] = row[e] sprintf(",%.6g", $2 * $3); ++full[e] }
        END { for (i = 1; i <= rows; ++i) if (full[order[i]] == file - 1) print row[order[i]] }' \
        "$(resolved_grain "$1")" "${files[@]}"
}

make_figure_07() {
    local nu law e colour=0
    local every="0 0.2 0.3 0.4 0.45 0.49" points='"line": "none", "marker": "circle"'
    for nu in $every; do
        formula_on_resolved $nu >"$made/figure_07_formula_$nu.csv"
        forces_of_grain $nu >"$made/figure_07_grain_$nu.csv"
    done

    for nu in 0 0.2 0.4; do
        curve "nu = $nu, resolved" "figure_07_formula_$nu.csv" e resolved "$points, \"colour\": $colour"
        curve "nu = $nu, Eq. 57" "figure_07_formula_$nu.csv" e formula "\"colour\": $((colour++))"
    done
    plot figure_07c "Fig. 7c: the printed formula on resolved contacts" '"label": "wall displacement / radius"' \
        '"label": "wall force / (E D)"' top_left

    curve "" figure_07_formula_0.4.csv resolved resolved '"line": "dashed", "colour": 4'
    colour=0
    for nu in 0 0.2 0.4; do
        curve "nu = $nu" "figure_07_formula_$nu.csv" resolved formula "$points, \"colour\": $((colour++))"
    done
    plot figure_07d "Fig. 7d: the printed formula beside the resolved force" '"label": "resolved wall force / (E D)"' \
        '"label": "force of Eq. 57 / (E D)"' top_left

    colour=0
    for nu in 0 0.3 0.45; do
        curve "nu = $nu, resolved" "figure_07_grain_$nu.csv" e resolved "$points, \"colour\": $colour"
        curve "lens_potential" "figure_07_grain_$nu.csv" e lens_potential "\"colour\": $colour"
        curve "mollon2022" "figure_07_grain_$nu.csv" e mollon2022 "\"line\": \"dashed\", \"colour\": $((colour++))"
    done
    plot figure_07_grain "One SDEM grain between four walls" '"label": "wall displacement / radius"' \
        '"label": "wall force / (E D)"' top_left

    {
        echo "| wall force / resolved - 1 | nu | e = 0.01 | 0.02 | 0.05 | 0.10 | 0.15 | 0.20 | 0.25 |"
        echo "|---|---|--:|--:|--:|--:|--:|--:|--:|"
        for law in formula $laws; do for nu in $every; do
            local file="$made/figure_07_grain_$nu.csv" name="one grain, \`$law\`"
            [ $law != formula ] || file="$made/figure_07_formula_$nu.csv" name="Eq. 57 on resolved contacts"
            printf "| %s | %s |" "$name" $nu
            for e in 0.01 0.02 0.05 0.10 0.15 0.20 0.25; do
                printf " %s |" "$(ratio "$(value "$file" $e $law)" "$(value "$file" $e resolved)")"
            done
            echo
        done; done
    } | table figure_07
    row 7 "\`single_grain/four_walls.toml\`" "Eq. 57 follows the resolved force; at nu < 0.2 and large strain up to 15 % too low" \
        "Eq. 57 on our resolved grains at e = 0.25: $(at_quarter 0) (nu 0), $(at_quarter 0.2) (nu 0.2), $(at_quarter 0.4) (nu 0.4)" \
        figure_07c.png figure_07d.png figure_07_grain.png
}

at_quarter() {
    ratio "$(value "$made/figure_07_formula_$1.csv" 0.25 formula)" "$(value "$made/figure_07_formula_$1.csv" 0.25 resolved)"
}
