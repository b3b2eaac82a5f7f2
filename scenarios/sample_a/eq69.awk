# history.csv of an isotropic compaction -> the curve of Cantor et al. 2020 (Eq. 69 of Mollon 2022) with phi0 and Z0 as found:
# the jamming point is the first sample whose mean stress exceeds 1e-3 E; Z0 is its coordination number without rattlers.
# E = 1, b = 0.12, k = 5.1, phi_max = 1. Pass -v phi0=... -v Z0=... to use other values.
BEGIN { FS = ","; OFS = "," }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    phi = $column["packing_fraction"]
    if (!phi0 && $column["mean_stress"] > 1e-3) phi0 = phi
    if (!Z0 && phi >= phi0 && phi0) Z0 = $column["coordination_number_no_rattlers"]
    if (!phi0 || phi <= phi0) next
    if (!header++) {
        printf "# Eq. 69 of Mollon 2022 with phi0 = %.4f, Z0 = %.2f\n", phi0, Z0
        print "packing_fraction,mean_stress,coordination_number"
    }
    b = 0.12; k = 5.1; phi_max = 1; pi = atan2(0, -1)
    Z = Z0 + k * sqrt(phi - phi0)
    print phi, -b * phi / (2 * pi) * Z * log((phi_max - phi) / (phi_max - phi0)), Z
}
