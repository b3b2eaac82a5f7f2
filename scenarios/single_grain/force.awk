# history.csv of a single grain -> e,F: wall displacement / radius and force on the top and bottom walls [N].
BEGIN { FS = ","; print "e,F" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{ print $column["axial_strain"] "," $column["stress_yy"] * $column["box_width"] }
