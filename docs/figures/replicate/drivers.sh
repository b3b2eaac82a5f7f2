# Sample A with the quasi-static driver beside explicit dynamics: the same curve, and its price.
plan_drivers() {
    plan_rates
    local nu
    for nu in 0.3 0.5; do
        simulate "quasi_static-a-$nu" sample_a/isotropic.toml sdem.law=lens_potential sdem.driver=quasi_static \
            material.poisson_ratio=$nu sampling.frame_every=1000 "${coarse[@]}" loading.0.until_packing_fraction=0.97
    done
}

make_drivers() {
    local nu name phi what
    for nu in 0.3 0.5; do
        for name in quasi_static-a-$nu slow-a-$nu isotropic-a-lens_potential-$nu-1; do
            band packing_fraction mean_stress,coordination_number_no_rattlers $phis $name >"$made/drivers_$name.csv"
        done
        curve "quasi_static, nu = $nu" drivers_quasi_static-a-$nu.csv packing_fraction mean_stress
        curve "explicit, I = 3e-4, nu = $nu" drivers_slow-a-$nu.csv packing_fraction mean_stress '"line": "none", "marker": "circle"'
    done
    plot drivers "Sample A, two drivers" '"label": "packing fraction"' '"label": "mean stress / E", "log": true' top_left
    {
        echo "| nu | driver | CPU time to phi 0.97 [s] | wall time [s] | stress / that of quasi_static - 1 at phi 0.85 | 0.86 | 0.88 | 0.90 | 0.92 | 0.94 | 0.96 |"
        echo "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for nu in 0.3 0.5; do
            for name in quasi_static-a-$nu slow-a-$nu isotropic-a-lens_potential-$nu-1; do
                case $name in
                quasi*) what="quasi_static" ;;
                slow*) what="explicit, I = 3e-4" ;;
                *) what="explicit, I = $fast (to phi 0.99)" ;;
                esac
                printf "| %s | %s | %s | %s |" $nu "$what" "$(number %.1f "$(result $name cpu_time)")" "$(number %.1f "$(result $name wall_time)")"
                for phi in 0.850 0.860 0.880 0.900 0.920 0.940 0.960; do
                    printf " %s |" "$(percent "$(value "$made/drivers_$name.csv" $phi mean_stress)" "$(value "$made/drivers_quasi_static-a-$nu.csv" $phi mean_stress)")"
                done
                echo
            done
        done
    } | table drivers
}
