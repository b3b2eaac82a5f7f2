# derived.csv of biaxial tests, one for each run -> a row for each: initial packing fraction and Z, initial stiffness (secant to an
# axial strain of 1e-3) in E; peak of q / p (largest running mean over `window` of strain), its strain, dilatancy angle there [degrees],
# residual (mean over axial strains from `from` on) of q / p, packing fraction, void ratio, Z; largest volumetric strain, and that at
# `at` = from; lateral stress: mean and range.
BEGIN {
    FS = OFS = ","
    if (!window) window = 0.01
    print "run,phi0,Z0,stiffness,peak,peak_strain,dilatancy,residual,residual_phi,residual_e,residual_Z,contraction,volumetric_end,lateral_mean,lateral_low,lateral_high"
}
function finish(   i, j, k, m, mean, best, sx, sy, sxx, sxy, slope, r, p, e, z, count, most, low, high, lateral, stiffness, place) {
    if (name == "") return
    best = -1
    for (i = j = 1; i <= n; ++i) {
        while (axial[i] - axial[j] > window * 1.0001) { sum -= ratio[j]; ++j }
        sum += ratio[i]
        if (axial[i] >= window) { mean = sum / (i - j + 1); if (mean > best) { best = mean; place = 0.5 * (axial[i] + axial[j]) } }
    }
    sum = 0
    for (i = 1; i <= n; ++i) if (axial[i] >= place - window && axial[i] <= place + window) {
        ++k; sx += axial[i]; sy += volumetric[i]; sxx += axial[i] * axial[i]; sxy += axial[i] * volumetric[i]
    }
    slope = (k * sxy - sx * sy) / (k * sxx - sx * sx)
    # d(volumetric) = slope d(axial), and the shear strain 2 d(axial) - d(volumetric): sin psi = -slope / (2 - slope)
    sine = -slope / (2 - slope)
    psi = atan2(sine, sqrt(1 - sine * sine)) * 57.29578
    for (i = 1; i <= n; ++i) {
        if (volumetric[i] > most) most = volumetric[i]
        if (stiffness == "" && axial[i] > 0.00099) stiffness = (axial_stress[i] - axial_stress[1]) / axial[i]
        if (i > 1) { lateral += side[i]; if (low == "" || side[i] < low) low = side[i]; if (side[i] > high) high = side[i] }
        if (axial[i] >= from) { ++count; r += ratio[i]; p += phi[i]; e += void[i]; z += Z[i]; last += volumetric[i] }
    }
    if (!count) { print "no strain beyond " from " in " name > "/dev/stderr"; exit 1 }
    print name, phi[1], Z[1], stiffness, best, place, psi, r / count, p / count, e / count, z / count, most, last / count, lateral / (n - 1), low, high
    last = 0
}
FNR == 1 { finish(); name = FILENAME; n = 0; next }
{
    ++n
    axial[n] = $1; ratio[n] = $2; volumetric[n] = $3; phi[n] = $4; void[n] = $5; Z[n] = $6; side[n] = $8; axial_stress[n] = $9
}
END { finish() }
