# Tables of equal columns, one for each seed -> for each value of the first column that every table has: mean, smallest, largest
# and standard deviation of each other column (c, c_low, c_high, c_deviation).
BEGIN { FS = OFS = "," }
FNR == 1 {
    ++files
    columns = NF
    for (i = 1; i <= NF; ++i) name[i] = $i
    next
}
{
    if (!($1 in count)) order[++rows] = $1
    n = ++count[$1]
    for (i = 2; i <= NF; ++i) {
        sum[$1, i] += $i
        square[$1, i] += $i * $i
        if (n == 1 || $i < low[$1, i]) low[$1, i] = $i
        if (n == 1 || $i > high[$1, i]) high[$1, i] = $i
    }
}
END {
    line = name[1]
    for (i = 2; i <= columns; ++i) line = line OFS name[i] OFS name[i] "_low" OFS name[i] "_high" OFS name[i] "_deviation"
    print line
    for (k = 1; k <= rows; ++k) {
        x = order[k]
        if (count[x] < files) continue
        line = x
        for (i = 2; i <= columns; ++i) {
            mean = sum[x, i] / files
            variance = files > 1 ? (square[x, i] - files * mean * mean) / (files - 1) : 0
            line = line OFS mean OFS low[x, i] OFS high[x, i] OFS sqrt(variance > 0 ? variance : 0)
        }
        print line
    }
}
