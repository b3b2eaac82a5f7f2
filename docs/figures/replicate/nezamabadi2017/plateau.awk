# Tables cumulative_strain,stress, one for each seed -> "mean deviation standard_error lowest highest" of their mean stress between
# the strains 0.05 and 0.3.
BEGIN { FS = "," }
FNR == 1 { ++files; next }
$1 > 0.05 && $1 < 0.3 { sum[files] += $2; ++count[files] }
END {
    for (k = 1; k <= files; ++k) {
        value = sum[k] / count[k]
        total += value
        square += value * value
        if (k == 1 || value < low) low = value
        if (k == 1 || value > high) high = value
    }
    mean = total / files
    deviation = files > 1 ? sqrt((square - files * mean * mean) / (files - 1)) : 0
    printf "%.4f %.4f %.4f %.4f %.4f\n", mean, deviation, deviation / sqrt(files), low, high
}
