# 10 000 grains to phi 0.95: the rate at which the stress no longer depends on it, and the price. Two threads, one run at a time.
slowness="2e-3 1e-3 5e-4 2.5e-4"

plan_ten_thousand() { :; }

large_run() {
    local name=$1
    shift
    [ -e "$runs/$name/run.json" ] || "$softgrain" run scenarios/mollon2022/ten_thousand.toml --method sdem --threads 2 --quiet \
        --force --out "$runs/$name" "$@" >"$runs/$name.log" 2>&1 || echo "  $name failed: $(tail -1 "$runs/$name.log")"
}

make_ten_thousand() {
    local I name phi what few=()
    ! $quick || few=(--set packing.count=300)
    for I in $slowness; do large_run large-$I --set loading.0.inertial_number=$I "${few[@]}"; done
    {
        echo "| driver | steps | wall time [s] | CPU time [s] | stress / that at half the rate - 1 at phi 0.86 | 0.88 | 0.90 | 0.92 | 0.94 | stress at 0.94 |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        local half
        for name in large-2e-3 large-1e-3 large-5e-4 large-2.5e-4; do
            band packing_fraction mean_stress $phis $name >"$made/ten_thousand_$name.csv"
        done
        for name in large-2e-3 large-1e-3 large-5e-4 large-2.5e-4; do
            case $name in
            large-2e-3) what="explicit, I = 2e-3" half=large-1e-3 ;;
            large-1e-3) what="explicit, I = 1e-3" half=large-5e-4 ;;
            large-5e-4) what="explicit, I = 5e-4" half=large-2.5e-4 ;;
            *) what="explicit, I = 2.5e-4" half="" ;;
            esac
            printf "| %s | %s | %s | %s |" "$what" "$(result $name steps)" "$(number %.0f "$(result $name wall_time)")" "$(number %.0f "$(result $name cpu_time)")"
            for phi in 0.860 0.880 0.900 0.920 0.940; do
                if [ -z "$half" ]; then printf " - |"; else
                    printf " %s |" "$(percent "$(value "$made/ten_thousand_$name.csv" $phi mean_stress)" "$(value "$made/ten_thousand_$half.csv" $phi mean_stress)")"
                fi
            done
            echo " $(number %.4f "$(value "$made/ten_thousand_$name.csv" 0.940 mean_stress)") |"
        done
    } | table ten_thousand
}
