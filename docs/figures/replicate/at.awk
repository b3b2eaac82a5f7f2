# Table -> one row for each value in -v grid (comma separated) of the column -v x, with the columns -v y (comma separated):
# interpolated linearly between the rows around the first crossing; with -v half their means over the rows within half of
# the value. No row where the table did not get there.
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
        if (half) {
            if (now < at[k] - half || now > at[k] + half) continue
            ++count[k]
            for (i = 1; i <= columns; ++i) sum[k, i] += $column[name[i]]
        } else if (NR > 2 && !count[k] && last[0] <= at[k] && at[k] <= now) {
            share = now > last[0] ? (at[k] - last[0]) / (now - last[0]) : 0
            count[k] = 1
            for (i = 1; i <= columns; ++i) sum[k, i] = last[i] + share * ($column[name[i]] - last[i])
        }
    }
    last[0] = now
    for (i = 1; i <= columns; ++i) last[i] = $column[name[i]]
}
END {
    for (k = 1; k <= wanted; ++k) {
        if (!count[k] || (half && now < at[k] + 0.9 * half)) continue
        row = at[k]
        for (i = 1; i <= columns; ++i) row = row "," sum[k, i] / count[k]
        print row
    }
}
