# Fig. 9: pictures of samples A and B, nu = 0.3, at four stages of the loading; the stages are the packing fractions at which the
# conservative law carries these mean stresses.
stages="0.01,0.03,0.1,0.3"

plan_figure_09() { plan_isotropic; }

make_figure_09() {
    local sample law phis_at row_text="" arguments
    for sample in a b; do
        phis_at=$(awk -v x=mean_stress -v y=packing_fraction -v grid=$stages -f $here/at.awk \
            "$runs/isotropic-$sample-lens_potential-0.3-1/history.csv" | awk -F, 'NR > 1 { printf "%s%.4f", sep, $2; sep = "," }')
        arguments=()
        for law in $laws; do arguments+=(--run "$law=$runs/isotropic-$sample-$law-0.3-1"); done
        "$softgrain" render frames "${arguments[@]}" --at-phi "$phis_at" --range 0,0.4 --width 1300 --out "$made/pictures_$sample" >/dev/null
        mv "$made/pictures_$sample/sheet.png" "$made/figure_09_$sample.png"
        rm -r "$made/pictures_$sample"
        row_text+="${sample^^}: phi ${phis_at//,/, }. "
    done
    row 9 "\`sample_{a,b}/isotropic.toml\`, nu = 0.3" \
        "pores close and contacts straighten; at the last stage (stress 0.3) next to no pore is left" \
        "stages at stress 0.01, 0.03, 0.1 (0.3 is not reached before phi 0.99) of \`lens_potential\`: $row_text" figure_09_a.png figure_09_b.png
}
