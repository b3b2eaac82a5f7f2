# history.csv of nezamabadi2017/single_grain.toml -> cumulative_strain,stress: -ln(1 - e), and wall force / largest section in
# units of F0/<a0> (-v attraction_stress). The section is that of a flattened disc of diameter -v diameter that keeps its area.
BEGIN { FS = OFS = ","; print "cumulative_strain", "stress" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    h = $column["box_height"]
    section = h + atan2(0, -1) / 4 * (diameter * diameter - h * h) / h
    print -log(1 - $column["axial_strain"]), $column["stress_yy"] * $column["box_width"] / section / attraction_stress
}
