# history.csv -> one row for each value in -v grid (comma separated) of the column -v x, with the columns -v y (comma
# separated) interpolated linearly between the samples around its first crossing; no row where the run did not get there.
BEGIN {
    FS = ","
    wanted = split(grid, at, ",")
    columns = split(y, name, ",")
    print x "," y
}
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
    now = $column[x]
    for (k = 1; k <= wanted; ++k) {
        if (NR == 2 || done[k] || !(last[0] <= at[k] && at[k] <= now)) continue
        share = now > last[0] ? (at[k] - last[0]) / (now - last[0]) : 0
        row[k] = at[k]
        for (i = 1; i <= columns; ++i) row[k] = row[k] "," last[i] + share * ($column[name[i]] - last[i])
        done[k] = 1
    }
    last[0] = now
    for (i = 1; i <= columns; ++i) last[i] = $column[name[i]]
}
END { for (k = 1; k <= wanted; ++k) if (done[k]) print row[k] }
