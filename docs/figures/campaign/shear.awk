# history.csv of a consolidation and a shear at constant normal stress -> one row for each sample of the shear. The volumetric strain is
# counted from its beginning.
BEGIN { FS = OFS = ","; print "shear,ratio,volumetric,packing_fraction,coordination,anisotropy,angle,normal,normal_difference" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    shear = $column["shear_strain"]
    area = $column["box_width"] * $column["box_height"]
    if (shear == 0) start = area
    x = $column["stress_xx"]; y = $column["stress_yy"]
    tau = $column["stress_xy"]
    print shear, (tau < 0 ? -tau : tau) / y, 1 - area / start, $column["packing_fraction"], $column["coordination_number_no_rattlers"], \
        $column["fabric_anisotropy"], $column["fabric_angle"] * 57.29578, y, (y - x) / (x + y)
}
