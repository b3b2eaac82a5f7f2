# history.csv of nezamabadi2017/packing.toml -> cumulative_strain,packing_fraction,z,stress: -ln(1 - e), and vertical stress in units of
# F0/<a0> (-v attraction_stress).
BEGIN { FS = OFS = ","; print "cumulative_strain", "packing_fraction", "z", "stress" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    print -log(1 - $column["axial_strain"]), $column["packing_fraction"], $column["coordination_number"],
        $column["stress_yy"] / attraction_stress
}
