# Angle of repose from grains_*.csv of the final frame: highest grain in each bin of 4 mean radii, and a straight line (least
# squares) through the bins between 0.15 and 0.85 of the largest height. Prints the angle in degrees, and the bins used.
BEGIN { FS = ","; n = 0 }
/^[0-9]/ && $7 == 0 {
    x[n] = $2; y[n] = $3; r[n] = $6; radii += $6; ++n
}
END {
    width = 4 * radii / n
    for (k = 0; k < n; ++k) {
        bin = int(x[k] / width)
        if (y[k] + r[k] > top[bin]) { top[bin] = y[k] + r[k]; at[bin] = x[k] }
        if (y[k] + r[k] > highest) highest = y[k] + r[k]
    }
    for (bin in top) {
        if (top[bin] < 0.15 * highest || top[bin] > 0.85 * highest) continue
        ++bins; sx += at[bin]; sy += top[bin]; sxx += at[bin] * at[bin]; sxy += at[bin] * top[bin]
    }
    if (bins < 3) { print "nan " bins + 0; exit }
    slope = (bins * sxy - sx * sy) / (bins * sxx - sx * sx)
    printf "%.2f %d\n", atan2(-slope, 1) * 180 / atan2(0, -1), bins
}
