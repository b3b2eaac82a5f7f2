# Isotropic and oedometric compaction of the same 50 grains by all methods.
document_oedometric=scenarios/oedometric/README.md

plan_oedometric() {
    local method
    for method in sdem bpm rigid_dem; do
        simulate $method "isotropic-$method" default.toml sampling.frame_every=1000
        simulate $method "oedometric-$method" oedometric/three_methods.toml sampling.frame_every=1000
    done
}

make_oedometric() {
    local kind method phi phis=0.80,0.82,0.84,0.86,0.88,0.90,0.92,0.94 table=$made/oedometric colour
    for kind in isotropic oedometric; do for method in sdem bpm rigid_dem; do
        derive compaction.awk $kind-$method
        band_of packing_fraction mean,ratio,coordination 0 $(seq -s, -f %.3f 0.78 0.005 0.95) $kind-$method >"${table}_$kind-$method.csv"
    done; done
    colour=0
    for method in sdem bpm rigid_dem; do
        curve "$method, isotropic" "oedometric_isotropic-$method.csv" packing_fraction mean "\"colour\": $colour"
        curve "$method, oedometric" "oedometric_oedometric-$method.csv" packing_fraction mean "\"line\": \"dashed\", \"colour\": $((colour++))"
    done
    plot oedometric_stress "50 grains, one file for all methods" '"label": "packing fraction"' '"label": "mean stress / E", "log": true' bottom_right
    colour=0
    for method in sdem bpm rigid_dem; do
        curve "$method" "oedometric_oedometric-$method.csv" packing_fraction ratio "\"colour\": $((colour++))"
    done
    plot oedometric_ratio "Oedometric compaction of 50 grains" '"label": "packing fraction", "min": 0.8' \
        '"label": "lateral / axial stress", "min": 0, "max": 1.2' bottom_right
    {
        echo "| method | | phi = ${phis//,/ | } |"
        echo "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|"
        for method in sdem bpm rigid_dem; do
            echo "| \`$method\` | mean stress / E, isotropic |$(cells "${table}_isotropic-$method.csv" mean %.2e) "
            echo "| | mean stress / E, oedometric |$(cells "${table}_oedometric-$method.csv" mean %.2e)"
            echo "| | lateral / axial stress, oedometric |$(cells "${table}_oedometric-$method.csv" ratio %.2f)"
            echo "| | Z, isotropic |$(cells "${table}_isotropic-$method.csv" coordination %.2f)"
            echo "| | Z, oedometric |$(cells "${table}_oedometric-$method.csv" coordination %.2f)"
        done
    } | sed 's/ *$//' | table oedometric
    {
        echo "| method | CPU time [s], isotropic | oedometric | ended, isotropic | oedometric |"
        echo "|---|--:|--:|---|---|"
        for method in sdem bpm rigid_dem; do
            echo "| \`$method\` | $(number %.1f "$(result isotropic-$method cpu_time)") | $(number %.1f "$(result oedometric-$method cpu_time)") | $(result isotropic-$method ended) | $(result oedometric-$method ended) |"
        done
    } | table seconds_oedometric
    publish oedometric_{stress,ratio}
}

# cells FILE COLUMN FORMAT: of a row of the table, one for each packing fraction.
cells() {
    local phi
    for phi in ${phis//,/ }; do printf " %s |" "$(number "$3" "$(value "$1" ${phi}0 "$2")")"; done
}
