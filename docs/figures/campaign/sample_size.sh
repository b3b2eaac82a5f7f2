# Scatter over seeds of the biaxial test of dense samples of 100, 400 and 1600 grains.
document_sample_size=scenarios/biaxial/sample_size.md
sizes="100 400 1600"

seeds_of() { if [ "$1" = 100 ]; then seq 16; else seq 8; fi; }

plan_sample_size() {
    local size seed
    for size in $sizes; do for seed in $(seeds_of $size); do
        simulate rigid_dem "size-$size-$seed" biaxial/dense.toml random.seed=$seed packing.count=$size \
            loading.1.inertial_number=3e-4 loading.1.until_strain=0.25
    done; done
}

make_sample_size() {
    local size column table=$made/size count
    for size in $sizes; do features 0.15 $(names "size-$size" $(seeds_of $size)) >"$table.$size.csv"; done
    for column in peak residual stiffness residual_phi; do
        {
            echo "grains,scatter,scatter_low,scatter_high"
            for size in $sizes; do relative_scatter "$table.$size.csv" $column "$size"; done
        } >"$made/size_$column.csv"
    done
    curve "peak q / p" size_peak.csv grains scatter '"marker": "circle", "lower_column": "scatter_low", "upper_column": "scatter_high"'
    curve "residual q / p" size_residual.csv grains scatter '"marker": "square"'
    curve "initial stiffness" size_stiffness.csv grains scatter '"marker": "diamond"'
    curve "residual packing fraction" size_residual_phi.csv grains scatter '"marker": "cross"'
    curves+="{\"label\": \"slope -1/2\", \"x\": [100, 1600], \"y\": [0.1, 0.025], \"line\": \"dashed\", \"colour\": 4},"
    plot sample_size "Scatter between samples" '"label": "grains", "log": true' '"label": "standard deviation / mean", "log": true' right
    {
        echo "| grains | samples | peak q/p | residual q/p | initial stiffness / E | phi at the start | residual phi | CPU time of one run [s] |"
        echo "|--:|--:|--:|--:|--:|--:|--:|--:|"
        for size in $sizes; do
            count=$(seeds_of $size | wc -l)
            printf "| %s | %s | %s | %s | %s | %s | %s | %s |\n" $size $count "$(summary "$table.$size.csv" peak %.4f)" \
                "$(summary "$table.$size.csv" residual %.4f)" "$(summary "$table.$size.csv" stiffness %.4f)" \
                "$(summary "$table.$size.csv" phi0 %.5f)" "$(summary "$table.$size.csv" residual_phi %.5f)" \
                "$(names "size-$size" $(seeds_of $size) | while read -r name; do result "$name" cpu_time; done |
                    awk '{ sum += $1 } END { printf "%.1f", sum / NR }')"
        done
    } | table sample_size
    {
        echo "| standard deviation: exponent of N (expected -0.5) | peak q/p | residual q/p | initial stiffness | phi at the start | residual phi |"
        echo "|---|--:|--:|--:|--:|--:|"
        printf "| from the fit through the three sizes |"
        for column in peak residual stiffness phi0 residual_phi; do
            for size in $sizes; do relative_scatter "$table.$size.csv" $column $size; done | awk -F, '
                { x = log($1); y = log($2); sx += x; sy += y; sxx += x * x; sxy += x * y }
                END { printf " %.2f |", (NR * sxy - sx * sy) / (NR * sxx - sx * sx) }'
        done
        echo
    } | table sample_size_slope
    seconds | table seconds_sample_size
    publish sample_size
}

# relative_scatter FILE COLUMN X: X, standard deviation / mean, and that less and more its standard error (1 / sqrt(2 (n - 1))).
relative_scatter() {
    awk -F, -v OFS=, -v wanted="$2" -v x="$3" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == wanted) c = i; next }
        { ++n; sum += $c; square += $c * $c }
        END {
            mean = sum / n; scatter = sqrt((square - n * mean * mean) / (n - 1)) / mean; error = 1 / sqrt(2 * (n - 1))
            print x, scatter, scatter * (1 - error), scatter * (1 + error) }' "$1"
}
