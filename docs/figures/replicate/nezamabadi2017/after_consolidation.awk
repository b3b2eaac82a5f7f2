# A table of packing_curve.awk -> strain,packing_fraction,ratio,sigma0 from where phi = 0.8: the strain since then, and the stress over
# sigma0, that at phi = 0.8 [F0/<a0>].
BEGIN { FS = OFS = ","; print "strain", "packing_fraction", "ratio", "sigma0" }
FNR == 1 { next }
{
    if (!sigma0 && $2 >= 0.8) {
        share = (0.8 - phi) / ($2 - phi)
        start = strain + share * ($1 - strain)
        sigma0 = stress + share * ($4 - stress)
        print 0, 0.8, 1, sigma0
    }
    strain = $1
    phi = $2
    stress = $4
    if (sigma0) print strain - start, phi, stress / sigma0, sigma0
}
