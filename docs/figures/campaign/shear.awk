# history.csv of a consolidation and a shear at constant normal stress -> one row for each sample of the shear and the last before it.
# The volumetric strain is counted from that.
BEGIN { FS = OFS = ","; print "shear,ratio,volumetric,packing_fraction,coordination,anisotropy,angle,normal,normal_difference" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    shear = $column["shear_strain"]
    area = $column["box_width"] * $column["box_height"]
    if (shear == 0) start = area
    x = $column["stress_xx"]; y = $column["stress_yy"]
    tau = $column["stress_xy"]
    row = shear OFS (tau < 0 ? -tau : tau) / y OFS 1 - area / start OFS $column["packing_fraction"] OFS \
        $column["coordination_number_no_rattlers"] OFS $column["fabric_anisotropy"] OFS $column["fabric_angle"] * 57.29578 OFS y OFS \
        (y - x) / (x + y)
    if (shear > 0 && rest) { print rest; rest = "" }
    if (shear > 0) print row
    else rest = row
}
