# A table of packing_curve.awk -> strain,packing_fraction,ratio from where phi = 0.8: the strain since then, and the stress / -v sigma0.
BEGIN { FS = OFS = ","; print "strain", "packing_fraction", "ratio" }
FNR == 1 { next }
$2 >= 0.8 && start == "" { start = strain + (0.8 - phi) / ($2 - phi) * ($1 - strain) }
{
    strain = $1
    phi = $2
    if (start != "") print strain - start, phi, $4 / sigma0
}
