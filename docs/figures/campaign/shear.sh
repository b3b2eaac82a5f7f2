# Simple shear at constant normal stress: dense and loose samples, three seeds each, and a smaller SDEM sample of each.
document_shear=scenarios/shear/README.md
seeds_shear="1 2 3"

plan_shear() {
    local state seed
    for state in dense loose; do
        for seed in $seeds_shear; do
            simulate rigid_dem "shear-$state-$seed" shear/$state.toml random.seed=$seed
        done
        simulate sdem "shear-$state-sdem" shear/$state.toml packing.count=200 loading.1.inertial_number=1e-3
        simulate rigid_dem "shear-$state-200" shear/$state.toml packing.count=200 loading.1.inertial_number=1e-3
    done
}

# Residual over shears from FROM on, peak as the largest running mean over 0.02 of shear: a row for each run.
features_of_shear() {
    local from=$1 name
    shift
    echo "run,phi0,peak,peak_shear,residual,residual_phi,residual_Z,anisotropy,angle,volumetric,normal_low,normal_high"
    for name in "$@"; do
        derive shear.awk "$name"
        awk -F, -v OFS=, -v from="$from" -v name="$name" -v window=0.02 '
            NR == 1 { next }
            $1 == 0 { phi0 = $4; next }
            {
                ++n; shear[n] = $1; ratio[n] = $2; sum += $2
                for (first += !first; shear[n] - shear[first] > window * 1.0001; ++first) sum -= ratio[first]
                mean = sum / (n - first + 1)
                if ($1 >= window && mean > peak) { peak = mean; place = 0.5 * (shear[n] + shear[first]) }
                if (low == "" || $8 < low) low = $8
                if ($8 > high) high = $8
                if ($1 >= from) { ++m; r += $2; phi += $4; Z += $5; a += $6; angle += $7 < 0 ? $7 + 180 : $7; v += $3 }
            }
            END { print name, phi0, peak, place, r / m, phi / m, Z / m, a / m, angle / m, v / m, low, high }' \
            "$runs/$name/derived.csv"
    done
}

make_shear() {
    local state column name table=$made/shear method
    for state in dense loose; do
        features_of_shear 0.6 $(names "shear-$state" $seeds_shear) >"$table.$state.csv"
        band_of shear ratio,volumetric,packing_fraction,anisotropy 0.004 "$(seq -s, -f %.4f 0.004 0.004 0.992)" \
            $(names "shear-$state" $seeds_shear) >"$made/shear_$state.csv"
    done
    for column in ratio packing_fraction anisotropy; do
        for state in dense loose; do shaded "$state" "shear_$state.csv" shear $column; done
        name='"label": "stress_xy / stress_yy", "min": 0'
        [ $column != packing_fraction ] || name='"label": "packing fraction"'
        [ $column != anisotropy ] || name='"label": "fabric anisotropy", "min": 0'
        plot shear_$column "Simple shear at constant normal stress, three seeds" '"label": "shear strain"' "$name" \
            "$([ $column = anisotropy ] && echo bottom_right || echo top_right)"
    done
    {
        echo "| sample | phi at the start | peak stress ratio | at shear strain | residual stress ratio | residual phi | volumetric strain there | residual Z | fabric anisotropy | its direction [deg] | normal stress / 2e-3: least, largest |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for state in dense loose; do row_of_shear $state "$table.$state.csv"; done
    } | table shear
    {
        echo "| sample of 200 grains | phi at the start | peak stress ratio | at shear strain | residual stress ratio | residual phi | volumetric strain there | residual Z | fabric anisotropy | its direction [deg] | normal stress / 2e-3: least, largest | CPU time [s] |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for state in dense loose; do for method in sdem 200; do
            features_of_shear 0.6 "shear-$state-$method" >"$table.small.csv"
            name=sdem
            [ $method = sdem ] || name=rigid_dem
            echo "$(row_of_shear "$state, \`$name\`" "$table.small.csv") $(number %.1f "$(result "shear-$state-$method" cpu_time)") |"
        done; done
    } | table shear_sdem
    seconds | table seconds_shear
    publish shear_{ratio,packing_fraction,anisotropy}
}

# row_of_shear NAME FILE
row_of_shear() {
    printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s, %s |\n" "$1" "$(summary "$2" phi0 %.4f)" "$(summary "$2" peak %.3f)" \
        "$(summary "$2" peak_shear %.3f)" "$(summary "$2" residual %.3f)" "$(summary "$2" residual_phi %.4f)" \
        "$(summary "$2" volumetric %.4f)" "$(summary "$2" residual_Z %.2f)" "$(summary "$2" anisotropy %.3f)" \
        "$(summary "$2" angle %.0f)" "$(extreme "$2" normal_low -1 500)" "$(extreme "$2" normal_high 1 500)"
}
