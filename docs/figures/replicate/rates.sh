# How much the rate of loading changes the mean stress: inertial numbers 1e-3 (all figures) and 3e-4.
plan_rates() {
    plan_isotropic
    local sample nu
    for sample in a b; do for nu in 0.3 0.5; do
        simulate "slow-$sample-$nu" sample_$sample/isotropic.toml sdem.law=lens_potential material.poisson_ratio=$nu \
            sampling.frame_every=1000 "${coarse[@]}" loading.0.inertial_number=3e-4 loading.0.until_packing_fraction=0.97
    done; done
}

make_rates() {
    local sample nu phi
    {
        echo "| stress at I = $fast / stress at 3e-4 - 1 | phi = 0.85 | 0.86 | 0.87 | 0.88 | 0.90 | 0.92 | 0.94 | 0.96 |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|"
        for sample in a b; do for nu in 0.3 0.5; do
            band packing_fraction mean_stress $phis slow-$sample-$nu >"$made/slow_$sample.csv"
            band packing_fraction mean_stress $phis isotropic-$sample-lens_potential-$nu-1 >"$made/fast_$sample.csv"
            printf "| %s, nu = %s, seed 1 |" ${sample^^} $nu
            for phi in 0.850 0.860 0.870 0.880 0.900 0.920 0.940 0.960; do
                printf " %s |" "$(percent "$(value "$made/fast_$sample.csv" $phi mean_stress)" "$(value "$made/slow_$sample.csv" $phi mean_stress)")"
            done
            echo
        done; done
    } | table rates
    rm "$made"/slow_?.csv "$made"/fast_?.csv
}
