# Figs. 5 to 7: one grain between two walls, three ranges of disc sizes, several seeds.
declare -A discs=([a]=2400 [b]=1750 [c]=1300) ratio_of=([a]=2.4 [b]=1.625 [c]=1.2727)
declare -A sizes_of=([a]="0.10 to 0.24" [b]="0.16 to 0.26" [c]="0.22 to 0.28") mean_size=([a]=0.1796 [b]=0.2140 [c]=0.2512)
strains=$(seq -s, -f %.3f 0.005 0.005 0.3)
attraction_stress=2.8e6 # of single_grain.toml

plan_single_grain() {
    local range seed parts
    for range in a b c; do for seed in $seeds; do
        parts=false
        [ $range$seed != b1 ] || parts=true
        simulate "grain-$range-$seed" nezamabadi2017/single_grain.toml random.seed=$seed sampling.parts=$parts \
            bpm.discs_per_grain=${discs[$range]} bpm.disc_size_ratio=${ratio_of[$range]} "${coarse[@]}"
    done; done
}

make_single_grain() {
    local range seed files mean deviation error low high
    for range in a b c; do
        files=()
        for seed in $seeds; do
            awk -v diameter=0.01 -v attraction_stress=$attraction_stress -f $figures_here/grain_stress.awk \
                "$runs/grain-$range-$seed/history.csv" >"$runs/grain-$range-$seed/stress.csv"
            files+=("$runs/grain-$range-$seed/stress.csv")
        done
        for file in "${files[@]}"; do
            awk -v x=cumulative_strain -v y=stress -v grid="$strains" -f $here/at.awk "$file" >"$file.table"
        done
        awk -f $here/band.awk "${files[@]/%/.table}" >"$made/grain_$range.csv"
        read -r mean deviation error low high < <(awk -f $figures_here/plateau.awk "${files[@]}")
        echo "| ${sizes_of[$range]} | ${discs[$range]} | $mean +- $error | $low to $high |" \
            "$(awk -v m="$mean" -v d="${mean_size[$range]}" 'BEGIN { printf "%.3f", m * 0.2140 / d }') |"
    done >"$made/sizes.rows"
    {
        echo "| disc diameters [mm] | discs | plateau [F0/<a0>], standard error | range over the seeds | at equal F0 [F0/<a0> of the middle range] |"
        echo "|---|--:|--:|--:|--:|"
        cat "$made/sizes.rows"
    } | table sizes
    local colour=0
    shaded "mean and range of $(echo $seeds | wc -w) seeds" grain_b.csv cumulative_strain stress '"colour": 0'
    plot figure_06 "Fig. 6: one aggregate between two walls" '"label": "cumulative strain", "min": 0, "max": 0.3' \
        '"label": "stress [F0/<a0>]", "min": 0'
    for range in a b c; do
        curve "${sizes_of[$range]} mm" grain_$range.csv cumulative_strain stress "\"colour\": $((colour++))"
    done
    plot figure_07 "Fig. 7: three ranges of disc sizes, means of the seeds" '"label": "cumulative strain", "min": 0, "max": 0.3' \
        '"label": "stress [F0/<a0>]", "min": 0'
    "$softgrain" render frames --run "BPM=$runs/grain-b-1" --at 0,1 --parts --field contact_force --window 0.15 0.85 0 1 --width 1200 \
        --out "$made/pictures" >/dev/null
    mv "$made/pictures/sheet.png" "$made/figure_05.png"
    rm -r "$made/pictures"
    row "5" "\`nezamabadi2017/single_grain.toml\`" "a grain at strain 0 and 0.3 with its force chains" "the same; walls meet flat faces" figure_05.png
    row "6" "the same, $(echo $seeds | wc -w) seeds" "linear up to about 2 %, then a plateau near F0/<a0>" \
        "plateau $(awk -F'|' 'NR == 2 { gsub(/^ +| +$/, "", $4); print $4 }' "$made/sizes.rows") F0/<a0>" figure_06.png
    row "7" "the same with \`bpm.discs_per_grain\`, \`bpm.disc_size_ratio\`" "the threshold depends a little on the size span" "table below" figure_07.png
}
