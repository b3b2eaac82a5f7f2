# A table of packing_curve.awk -> "sigma0 slope miss": Eq. 16, phi = slope (sigma/sigma0 - 1) + 0.8, fitted to 0.8 < phi < 0.95; sigma0 is
# where the line has phi = 0.8, miss the largest difference of phi from it.
BEGIN { FS = "," }
NR > 1 && $2 > 0.8 && $2 < 0.95 { ++n; x[n] = $4; y[n] = $2; sx += $4; sy += $2; sxx += $4 * $4; sxy += $4 * $2 }
END {
    if (n < 2) { print "nan nan nan"; exit }
    b = (n * sxy - sx * sy) / (n * sxx - sx * sx)
    a = (sy - b * sx) / n
    sigma0 = (0.8 - a) / b
    for (k = 1; k <= n; ++k) { m = y[k] - a - b * x[k]; if (m < 0) m = -m; if (m > miss) miss = m }
    printf "%.6g %.4f %.4f\n", sigma0, b * sigma0, miss
}
