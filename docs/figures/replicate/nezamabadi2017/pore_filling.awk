# Tables of packing_curve.awk, one for each run -> for each "sigma0 alpha alpha/sigma0", and a last line "mean error" of the three, the error
# that of the mean. Eq. 14 as the straight line -ln(1 - phi) = a + b sigma, fitted to 0.8 < phi < 0.97: b = alpha/sigma0, and sigma0 is where
# the line has phi = 0.8.
BEGIN { FS = "," }
FNR == 1 { fitted(); next }
$2 > 0.8 && $2 < 0.97 { y = -log(1 - $2); ++n; sx += $4; sy += y; sxx += $4 * $4; sxy += $4 * y }
END {
    fitted()
    for (k = 1; k <= 3; ++k) {
        mean = sum[k] / runs
        variance = runs > 1 ? (square[k] - runs * mean * mean) / (runs - 1) : 0
        printf "%.3f %.3f%s", mean, sqrt((variance > 0 ? variance : 0) / runs), k < 3 ? " " : "\n"
    }
}
function fitted(    k, value) {
    if (n > 1) {
        ++runs
        value[3] = (n * sxy - sx * sy) / (n * sxx - sx * sx)
        value[1] = (-log(0.2) - (sy - value[3] * sx) / n) / value[3]
        value[2] = value[1] * value[3]
        for (k = 1; k <= 3; ++k) { sum[k] += value[k]; square[k] += value[k] * value[k] }
        printf "%.4f %.3f %.3f\n", value[1], value[2], value[3]
    }
    n = sx = sy = sxx = sxy = 0
}
