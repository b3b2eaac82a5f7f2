# history.csv of scenarios/stiffness -> one row for each pressure: that before the probes, K and G from the last samples of the
# rests (samples with the same cell) around the first and the second probe, Z and packing fraction before them, largest unbalanced
# force of the three rests.
BEGIN { FS = OFS = ","; print "pressure,K,G,coordination,packing_fraction,unbalanced" }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    cell = $column["box_width"] " " $column["box_height"]
    if (cell != last && rests) take()
    rests = cell == last
    last = cell
    width = $column["box_width"]; height = $column["box_height"]; xx = $column["stress_xx"]; yy = $column["stress_yy"]
    Z = $column["coordination_number_no_rattlers"]; phi = $column["packing_fraction"]; unbalanced = $column["unbalanced_force"]
}
END { if (rests) take() }
function take(   x, y) {
    if (stop) { x = 1 - width / width0; y = 1 - height / height0 }
    if (++stop == 1) { p = (xx + yy) / 2; Z0 = Z; phi0 = phi; worst = 0 }
    if (unbalanced > worst) worst = unbalanced
    if (stop == 2) K = (xx - xx0 + yy - yy0) / (2 * (x + y))
    if (stop == 3) { print p, K, (xx - xx0 - yy + yy0) / (2 * (x - y)), Z0, phi0, worst; stop = 0 }
    width0 = width; height0 = height; xx0 = xx; yy0 = yy
}
