# Dense and loose samples in biaxial compression, three seeds each: peak, residual, dilatancy, one critical state?
document_biaxial=scenarios/biaxial/README.md
seeds_biaxial="1 2 3"

plan_biaxial() {
    local state seed method
    for state in dense loose; do for seed in $seeds_biaxial; do
        simulate rigid_dem "biaxial-$state-$seed" biaxial/$state.toml random.seed=$seed
    done; done
    for method in sdem rigid_dem; do simulate $method "biaxial-small-$method" biaxial/small.toml; done
}

make_biaxial() {
    local state colour=0 column table=$made/biaxial
    for state in dense loose; do
        features 0.2 $(names "biaxial-$state" $seeds_biaxial) >"$table.$state.csv"
        band_of axial ratio,volumetric,packing_fraction 0.001 "$(axial_grid 0.28)" $(names "biaxial-$state" $seeds_biaxial) \
            >"$made/biaxial_$state.csv"
    done
    for column in ratio volumetric packing_fraction; do
        for state in dense loose; do shaded "$state" "biaxial_$state.csv" axial $column; done
        case $column in
        ratio) plot biaxial_ratio "Biaxial compression, mean and range of three seeds" '"label": "axial strain"' '"label": "q / p"' top_right ;;
        volumetric) plot biaxial_volumetric "Biaxial compression, mean and range of three seeds" '"label": "axial strain"' \
            '"label": "volumetric strain (contraction positive)"' bottom_left ;;
        *) plot biaxial_packing "Towards one packing fraction" '"label": "axial strain"' '"label": "packing fraction"' top_right ;;
        esac
    done
    {
        echo "| sample | phi at the start | Z there | peak q/p | its friction angle [deg] | at axial strain | dilatancy angle there [deg] | residual q/p | residual phi | residual void ratio | residual Z |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for state in dense loose; do
            printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n" $state "$(summary "$table.$state.csv" phi0 %.4f)" \
                "$(summary "$table.$state.csv" Z0 %.2f)" "$(summary "$table.$state.csv" peak %.3f)" \
                "$(angles "$table.$state.csv" peak)" "$(summary "$table.$state.csv" peak_strain %.3f)" \
                "$(summary "$table.$state.csv" dilatancy %.1f)" "$(summary "$table.$state.csv" residual %.3f)" \
                "$(summary "$table.$state.csv" residual_phi %.4f)" "$(summary "$table.$state.csv" residual_e %.4f)" \
                "$(summary "$table.$state.csv" residual_Z %.2f)"
        done
    } | table biaxial
    {
        echo "| sample | seed | peak q/p | residual q/p | residual phi | lateral stress / 2e-3: mean | least | largest |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|"
        for state in dense loose; do
            awk -F, -v state=$state 'NR > 1 { printf "| %s | %d | %.3f | %.3f | %.4f | %.3f | %.3f | %.3f |\n", state, NR - 1, $5, $8, $9,
                $14 / 2e-3, $15 / 2e-3, $16 / 2e-3 }' "$table.$state.csv"
        done
    } | table biaxial_seeds
    {
        echo "| method | largest q/p | at axial strain | q/p at axial strain 0.09 | largest volumetric strain | that at axial strain 0.09 | lateral stress / target: least, largest | CPU time [s] |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|"
        for method in sdem rigid_dem; do
            features 0.09 "biaxial-small-$method" >"$table.small.csv"
            printf "| \`%s\` | %s | %s | %s | %s | %s | %s, %s | %.1f |\n" $method "$(summary "$table.small.csv" peak %.3f)" \
                "$(summary "$table.small.csv" peak_strain %.3f)" "$(summary "$table.small.csv" residual %.3f)" \
                "$(summary "$table.small.csv" contraction %.4f)" "$(summary "$table.small.csv" volumetric_end %.4f)" \
                "$(extreme "$table.small.csv" lateral_low -1 500)" "$(extreme "$table.small.csv" lateral_high 1 500)" \
                "$(result "biaxial-small-$method" cpu_time)"
        done
    } | table small
    seconds | table seconds_biaxial
    publish biaxial_{ratio,volumetric,packing}
}
