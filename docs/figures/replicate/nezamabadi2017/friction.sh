# The paper's claim that friction between grains needs discs that resist rolling: three kinds of grains, several seeds.
kinds="none friction rolling"
declare -A kind_settings=([none]="" [friction]="material.friction=0.5" [rolling]="material.friction=0.5 bpm.rolling_resistance=0.5")
declare -A kind_label=([none]="no friction" [friction]="friction 0.5" [rolling]="friction 0.5, rolling resistance 0.5")

plan_friction() {
    local kind seed few=()
    ! $quick || few=(packing.count=20 loading.0.strain_rate=500)
    for kind in $kinds; do for seed in $seeds; do
        simulate friction-$kind-$seed nezamabadi2017/friction.toml random.seed=$seed ${kind_settings[$kind]} "${few[@]}"
    done; done
}

make_friction() {
    local kind seed tables colour=0 phi
    for kind in $kinds; do
        tables=()
        for seed in $seeds; do
            packing_curves friction-$kind-$seed
            tables+=("$runs/friction-$kind-$seed/by_phi.csv")
        done
        awk -f $here/band.awk "${tables[@]}" </dev/null >"$made/friction_$kind.csv"
    done
    {
        echo "| | Z at phi 0.75 | 0.80 | 0.90 | stress [F0/<a0>] at phi 0.75 | 0.80 | 0.85 | 0.90 |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|"
        for kind in $kinds; do
            printf "| %s |" "${kind_label[$kind]}"
            for phi in 0.750 0.800 0.900; do printf " %s |" "$(mean_and_error friction_$kind $phi z %.2f)"; done
            for phi in 0.750 0.800 0.850 0.900; do printf " %s |" "$(mean_and_error friction_$kind $phi stress %.3f)"; done
            echo
        done
    } | table friction
    for kind in $kinds; do
        shaded "${kind_label[$kind]}" friction_$kind.csv packing_fraction stress "\"colour\": $((colour++))"
    done
    plot friction "60 aggregates, bands: all seeds" '"label": "packing fraction", "min": 0.68, "max": 0.95' '"label": "vertical stress [F0/<a0>]", "min": 0' top_left
    row "text, section 4" "\`nezamabadi2017/friction.toml\`" "friction does nothing unless discs resist rolling" "table below" friction.png
}

# mean_and_error TABLE PHI COLUMN FORMAT: with the standard error of the seeds.
mean_and_error() {
    local mean deviation
    mean=$(value "$made/$1.csv" $2 $3) deviation=$(value "$made/$1.csv" $2 $3_deviation)
    [ -n "$mean" ] && awk -v m="$mean" -v s="$deviation" -v n=$(echo $seeds | wc -w) -v f="$4 +- $4" 'BEGIN { printf f, m, s / sqrt(n) }' || printf -- "-"
}
