# history.csv of a compaction along y -> packing fraction, mean stress, lateral / axial stress, Z.
BEGIN { FS = OFS = ","; print "packing_fraction,mean,ratio,coordination" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
$column["stress_yy"] > 0 {
    print $column["packing_fraction"], $column["mean_stress"], $column["stress_xx"] / $column["stress_yy"], \
        $column["coordination_number_no_rattlers"]
}
