# history.csv files, one for each seed -> file,phi0,Z0,phi0_load,Z0_load: of the packing that the run begins with (the rigid
# jamming point) and of the first sample with a mean stress above 1e-3 E; Z without rattlers.
BEGIN { FS = OFS = ","; print "run,phi0,Z0,phi0_load,Z0_load" }
function finish() { if (name != "") print name, phi0, Z0, load_phi, load_Z }
FNR == 1 {
    finish()
    name = FILENAME
    load_phi = load_Z = ""
    for (i = 1; i <= NF; ++i) column[$i] = i
    next
}
{
    phi = $column["packing_fraction"]
    Z = $column["coordination_number_no_rattlers"]
    if (FNR == 2) { phi0 = phi; Z0 = Z }
    if (load_phi == "" && $column["mean_stress"] > 1e-3) { load_phi = phi; load_Z = Z }
}
END { finish() }
