# history.csv of two_walls.toml run with bpm -> mean stress of the grain in F0/<a0> between strains 0.1 and 0.3.
# Stress is F / L with L the largest section of a flattened disc that keeps its area: height h, round ends of radius h/2.
# Pass -v attraction_stress=... (default 0.28).
BEGIN { FS = ","; if (!attraction_stress) attraction_stress = 0.28 }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
$column["axial_strain"] > 0.0999 {
    h = $column["box_height"]
    L = h + atan2(0, -1) / 4 * (1 - h * h) / h
    sum += $column["stress_yy"] * $column["box_width"] / L / attraction_stress
    ++n
}
END { printf "%.3f\n", sum / n }
