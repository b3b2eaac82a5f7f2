# history.csv of a consolidation and a biaxial stage -> one row for each sample of the biaxial stage and the last before it, from
# which strains are counted.
BEGIN { FS = OFS = ","; print "axial,ratio,volumetric,packing_fraction,void_ratio,coordination,anisotropy,lateral,axial_stress,lateral_share" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    if ($column["stage"] == 1) start = n + 1
    ++n
    width[n] = $column["box_width"]; height[n] = $column["box_height"]
    x[n] = $column["stress_xx"]; y[n] = $column["stress_yy"]
    phi[n] = $column["packing_fraction"]; Z[n] = $column["coordination_number_no_rattlers"]
    fabric[n] = $column["fabric_anisotropy"]
}
END {
    for (i = start; i <= n; ++i)
        print 1 - height[i] / height[start], (y[i] - x[i]) / (y[i] + x[i]), \
            1 - width[i] * height[i] / (width[start] * height[start]), phi[i], 1 / phi[i] - 1, Z[i], fabric[i], x[i], y[i], x[i] / x[start]
}
