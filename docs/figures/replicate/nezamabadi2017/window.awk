# Table -> one row for each value in -v grid (comma separated) of the column -v x: means of the columns -v y (comma separated) over the rows
# within -v half of it; no row where the table ends before.
BEGIN {
    FS = ","
    wanted = split(grid, at, ",")
    columns = split(y, name, ",")
    print x "," y
}
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    last = $column[x]
    for (k = 1; k <= wanted; ++k) {
        if (last < at[k] - half || last > at[k] + half) continue
        ++count[k]
        for (i = 1; i <= columns; ++i) sum[k, i] += $column[name[i]]
    }
}
END {
    for (k = 1; k <= wanted; ++k) {
        if (!count[k] || last < at[k] + 0.9 * half) continue
        row = at[k]
        for (i = 1; i <= columns; ++i) row = row "," sum[k, i] / count[k]
        print row
    }
}
