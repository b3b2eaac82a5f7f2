# A table of packing_curve.awk -> "sigma0 slope miss": sigma0 is the mean stress at phi = 0.8 +- 0.005; slope that of phi over sigma/sigma0
# by least squares for 0.8 < phi < 0.95 (Eq. 16), miss the largest difference of phi from the line.
BEGIN { FS = "," }
NR > 1 && $2 > 0.795 && $2 < 0.805 { sum += $4; ++rows }
NR > 1 && $2 > 0.8 && $2 < 0.95 { ++n; x[n] = $4; y[n] = $2; sx += $4; sy += $2; sxx += $4 * $4; sxy += $4 * $2 }
END {
    if (n < 2 || !rows) { print "nan nan nan"; exit }
    b = (n * sxy - sx * sy) / (n * sxx - sx * sx)
    a = (sy - b * sx) / n
    for (k = 1; k <= n; ++k) { m = y[k] - a - b * x[k]; if (m < 0) m = -m; if (m > miss) miss = m }
    printf "%.6g %.4f %.4f\n", sum / rows, b * sum / rows, miss
}
