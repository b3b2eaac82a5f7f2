# Dense samples of 400 grains at five inertial numbers, five seeds each, and the 2000 grains of the biaxial study, three seeds.
document_rate=scenarios/biaxial/rate.md
rates="1e-4 3e-4 1e-3 3e-3 1e-2"

# GRAINS RATE: the runs; the slowest of 2000 grains are those of the biaxial study.
rate_runs() {
    case $1-$2 in
    400-*) names "rate-400-$2" 1 2 3 4 5 ;;
    2000-1e-4) names biaxial-dense 1 2 3 ;;
    *) names "rate-$2" 1 2 3 ;;
    esac
}

plan_rate() {
    local rate name
    for rate in $rates; do for name in $(rate_runs 400 $rate); do
        # Until the lateral stress is back, fast tests squeeze the grains by more than they should.
        simulate rigid_dem "$name" biaxial/dense.toml random.seed=${name##*-} loading.1.inertial_number=$rate packing.count=400 \
            rigid_dem.overlap_limit=0.3
    done; done
    for rate in $rates; do for name in $(rate_runs 2000 $rate); do
        simulate rigid_dem "$name" biaxial/dense.toml random.seed=${name##*-} loading.1.inertial_number=$rate
    done; done
}

make_rate() {
    local rate column label name
    for rate in $rates; do
        for name in $(rate_runs 400 $rate); do derive biaxial.awk "$name"; done
        band_of axial ratio,volumetric,lateral_share 0.002 "$(axial_grid 0.28)" $(rate_runs 400 $rate) >"$made/rate_$rate.csv"
    done
    for column in ratio volumetric lateral_share; do
        for rate in $rates; do curve "I = $rate" "rate_$rate.csv" axial $column; done
        case $column in
        ratio) label="q / p" ;;
        volumetric) label="volumetric strain (contraction positive)" ;;
        *) label="lateral stress / its target" ;;
        esac
        plot rate_$column "400 dense grains, means of five seeds" '"label": "axial strain"' "\"label\": \"$label\"" right
    done
    {
        echo "| grains | I | peak q/p | at axial strain | dilatancy angle there [deg] | residual q/p | residual phi | largest contraction | volumetric strain beyond 0.2 | lateral stress / target: least, largest | CPU time of one run [s] |"
        echo "|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for rate in $rates; do row_of_rate 400 $rate 0.3; done
        for rate in $rates; do row_of_rate 2000 $rate 0.15; done
    } | table rate
    seconds | table seconds_rate
    publish rate_{ratio,volumetric,lateral_share}
}

# row_of_rate GRAINS RATE LIMIT: of overlaps
row_of_rate() {
    local row=$made/rate.$1.$2.csv name
    for name in $(rate_runs $1 $2); do
        [ "$(result "$name" ended)" = "loading done" ] || { ends_of_rate $1 $2 $3 && return; }
    done
    features 0.2 $(rate_runs $1 $2) >"$row"
    printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s, %s | %s |\n" $1 $2 "$(summary "$row" peak %.3f)" \
        "$(summary "$row" peak_strain %.3f)" "$(summary "$row" dilatancy %.1f)" "$(summary "$row" residual %.3f)" \
        "$(summary "$row" residual_phi %.4f)" "$(summary "$row" contraction %.4f)" "$(summary "$row" volumetric_end %.4f)" \
        "$(extreme "$row" lateral_low -1 500)" "$(extreme "$row" lateral_high 1 500)" \
        "$(rate_runs $1 $2 | while read -r name; do result "$name" cpu_time; done | awk '{ sum += $1 } END { printf "%.1f", sum / NR }')"
}

# ends_of_rate GRAINS RATE LIMIT: where the runs ended whose overlaps went beyond their limit.
ends_of_rate() {
    local name
    for name in $(rate_runs $1 $2); do
        derive biaxial.awk "$name"
        tail -1 "$runs/$name/derived.csv"
    done | awk -F, -v grains=$1 -v rate=$2 -v limit=$3 '
        { if (NR == 1 || $1 < low) low = $1; if ($1 > high) high = $1; stress += $8 * 500 }
        END { printf "| %s | %s | the runs end at an axial strain of %.3f to %.3f: overlaps beyond %s of a radius, at a lateral stress of %.1f times its target | | | | | | | | |\n", grains, rate, low, high, limit, stress / NR }'
}
