# Rows of two histories at equal strain: those of the second, and by how much the first differs.
function round(strain) { return sprintf("%.6f", strain) }
BEGIN { wanted = split("axial_strain box_width box_height packing_fraction stress_xx stress_yy mean_stress coordination_number", name, " ") }
FNR == 1 {
    for (i = 1; i <= NF; ++i) column[$i] = i
    ++file
    next
}
file == 1 {
    k = round($column["axial_strain"])
    stress[k] = $column["mean_stress"]
    across[k] = $column["stress_xx"]
    along[k] = $column["stress_yy"]
    z[k] = $column["coordination_number"]
    next
}
!begun++ {
    print "# Resolved grains: MPM, implicit, " fine " points across a radius; _error: difference to " coarse " points. Stresses by walls [E]. See README.md."
    for (i = 1; i <= wanted; ++i) printf "%s,", name[i]
    print "mean_stress_error,stress_xx_error,stress_yy_error,coordination_number_error"
}
(k = round($column["axial_strain"])) in stress && k > 0 {
    for (i = 1; i <= wanted; ++i) printf "%.6g,", $column[name[i]]
    printf "%.2g,%.2g,%.2g,%.2g\n", difference($column["mean_stress"], stress[k]), difference($column["stress_xx"], across[k]),
        difference($column["stress_yy"], along[k]), difference($column["coordination_number"], z[k])
}
function difference(a, b) { return a > b ? a - b : b - a }
