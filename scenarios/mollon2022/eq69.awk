# Cantor et al. 2020 (Eq. 69 of Mollon 2022) with E = 1, b = 0.12, k = 5.1, phi_max = 1, from -v phi0 and -v Z0 of the jamming
# point: packing_fraction,mean_stress,coordination_number in 100 steps up to phi 0.995. awk -v phi0=0.833 -v Z0=4.2 -f eq69.awk
BEGIN {
    b = 0.12; k = 5.1; phi_max = 1; pi = atan2(0, -1); steps = 100
    print "packing_fraction,mean_stress,coordination_number"
    for (i = 1; i <= steps; ++i) {
        phi = phi0 + (0.995 - phi0) * i / steps
        Z = Z0 + k * sqrt(phi - phi0)
        print phi "," (-b * phi / (2 * pi) * Z * log((phi_max - phi) / (phi_max - phi0))) "," Z
    }
}
