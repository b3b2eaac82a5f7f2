# Fig. 11: pictures of sample B during the oedometric compression, nu = 0.3.
plan_oedometric() {
    local sample law seed frames
    for sample in a b; do for law in $laws; do for seed in $seeds; do
        frames=1000
        [ $sample$seed != b1 ] || frames=2
        simulate "oedometric-$sample-$law-$seed" sample_$sample/oedometric.toml sdem.law=$law random.seed=$seed \
            sampling.frame_every=$frames "${coarse[@]}"
    done; done; done
}
plan_figure_11() { plan_oedometric; }

make_figure_11() {
    local law arguments=()
    for law in $laws; do arguments+=(--run "$law=$runs/oedometric-b-$law-1"); done
    "$softgrain" render frames "${arguments[@]}" --at 0,0.3,0.6,1 --range 0,0.4 --width 1300 --out "$made/pictures" >/dev/null
    mv "$made/pictures/sheet.png" "$made/figure_11.png"
    rm -r "$made/pictures"
    row 11 "\`sample_b/oedometric.toml\`" "grains keep a roughly circular shape, some are a little longer across the loading" \
        "pictures at 0, 30, 60 and 100 % of the run" figure_11.png
}
