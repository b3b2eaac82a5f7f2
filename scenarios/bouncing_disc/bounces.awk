# From a trace: height of each rebound / that before, down to a fiftieth of the drop, and the times of the first tops, found by a
# parabola through three samples.
BEGIN { FS = "," }
NR == 2 { drop = last_top = $2 }
NR > 3 && h1 > h0 && h1 >= $2 {
    bend = h0 - 2 * h1 + $2
    top = h1 - (h0 - $2) * (h0 - $2) / (8 * bend)
    if (top < 0.02 * drop) exit
    time = t1 + 0.5 * (h0 - $2) / bend * ($1 - t1)
    if (++tops > 1 && first_period == "") first_period = time - last_time
    else if (tops == 1) half_period = time
    ratios = ratios (tops > 1 ? " " : "") sprintf("%.4f", top / last_top)
    last_top = top; last_time = time
}
{ h0 = h1; h1 = $2; t1 = $1 }
END { printf "first top after %.4f s, the next %.4f s later; heights / those before: %s\n", half_period, first_period, ratios }
