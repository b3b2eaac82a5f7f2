# Friction angles of dense samples in biaxial compression against the friction between grains, three seeds each.
document_friction=scenarios/biaxial/friction.md
frictions="0 0.1 0.2 0.3 0.5 0.8"
seeds_friction="1 2 3"

plan_friction() {
    local friction seed
    for friction in $frictions; do for seed in $seeds_friction; do
        simulate rigid_dem "friction-$friction-$seed" biaxial/dense.toml random.seed=$seed material.friction=$friction \
            packing.count=1000 loading.1.inertial_number=3e-4 loading.1.until_strain=0.25
    done; done
}

make_friction() {
    local friction which table=$made/friction row
    for friction in $frictions; do
        features 0.15 $(names "friction-$friction" $seeds_friction) >"$table.$friction.csv"
    done
    for which in peak residual; do
        {
            echo "friction,sine,sine_low,sine_high,angle,angle_low,angle_high"
            for friction in $frictions; do spread "$table.$friction.csv" $which "$friction"; done
        } >"$made/friction_$which.csv"
        curve "$which: mean and range of three seeds" "friction_$which.csv" friction angle \
            '"marker": "circle", "lower_column": "angle_low", "upper_column": "angle_high"'
    done
    plot friction_angle "Dense samples in biaxial compression" '"label": "friction coefficient between grains"' \
        '"label": "friction angle asin(q / p) [degrees]", "min": 0' bottom_right
    {
        echo "| friction | angle of it, atan [deg] | peak q/p | peak angle [deg] | at axial strain | dilatancy angle there [deg] | residual q/p | residual angle [deg] | residual phi | residual Z | (peak - residual angle) / dilatancy angle |"
        echo "|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for friction in $frictions; do
            row=$table.$friction.csv
            printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n" "$friction" \
                "$(awk -v f="$friction" 'BEGIN { printf "%.1f", atan2(f, 1) * 57.29578 }')" \
                "$(summary "$row" peak %.3f)" "$(angles "$row" peak)" "$(summary "$row" peak_strain %.3f)" \
                "$(summary "$row" dilatancy %.1f)" "$(summary "$row" residual %.3f)" "$(angles "$row" residual)" \
                "$(summary "$row" residual_phi %.4f)" "$(summary "$row" residual_Z %.2f)" "$(share_of_dilatancy "$row")"
        done
    } | table friction
    seconds | table seconds_friction
    publish friction_angle
}

# spread FILE COLUMN X: X, mean, least and largest of q / p and of its angle [degrees].
spread() {
    awk -F, -v OFS=, -v wanted="$2" -v x="$3" '
        function angle(sine) { return atan2(sine, sqrt(1 - sine * sine)) * 57.29578 }
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == wanted) c = i; next }
        { sum += $c; if (NR == 2 || $c < low) low = $c; if (NR == 2 || $c > high) high = $c }
        END { mean = sum / (NR - 1); print x, mean, low, high, angle(mean), angle(low), angle(high) }' "$1"
}

# share_of_dilatancy FILE: of the means over the samples.
share_of_dilatancy() {
    awk -F, 'function angle(sine) { return atan2(sine, sqrt(1 - sine * sine)) * 57.29578 }
        NR == 1 { for (i = 1; i <= NF; ++i) c[$i] = i; next }
        { over += angle($c["peak"]) - angle($c["residual"]); psi += $c["dilatancy"] }
        END { printf "%.2f", over / psi }' "$1"
}
