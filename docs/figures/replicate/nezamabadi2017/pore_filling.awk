# Tables of after_consolidation.awk, one for each run -> for each "sigma0 alpha alpha/sigma0", and a last line "mean error" of the three, the
# error that of the mean: -ln((1 - phi)/0.2) = alpha (sigma/sigma0 - 1) fitted up to phi = 0.97 (Eq. 14).
BEGIN { FS = ","; OFMT = "%.4g" }
FNR == 1 { fitted(); next }
$2 < 0.97 { xy -= ($3 - 1) * log((1 - $2) / 0.2); xx += ($3 - 1) ^ 2; sigma0 = $4 }
END {
    fitted()
    for (k = 1; k <= 3; ++k) {
        mean = sum[k] / runs
        variance = runs > 1 ? (square[k] - runs * mean * mean) / (runs - 1) : 0
        printf "%.3f %.3f%s", mean, sqrt((variance > 0 ? variance : 0) / runs), k < 3 ? " " : "\n"
    }
}
function fitted(    k, value) {
    if (xx > 0) {
        ++runs
        value[1] = sigma0
        value[2] = xy / xx
        value[3] = xy / xx / sigma0
        for (k = 1; k <= 3; ++k) { sum[k] += value[k]; square[k] += value[k] * value[k] }
        printf "%.3f %.3f %.3f\n", value[1], value[2], value[3]
    }
    xy = xx = 0
}
