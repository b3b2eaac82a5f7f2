# Dynamic angle of the free surface of each frame measures/grains_*.csv from -v start=TIME on: highest free grain in each bin of 4
# mean radii, and a straight line (least squares) through the bins within half the drum's radius of its middle. Prints time,angle
# in degrees; at the end, on standard error, mean and standard deviation.
function finish(    width, k, bin, top, at, bins, sx, sy, sxx, sxy, slope, angle) {
    if (n == 0 || time < start) return
    width = 4 * radii / n
    for (k = 0; k < n; ++k) {
        bin = int(x[k] / width)
        if ((bin + 0.5) * width < middle - 0.5 * drum || (bin + 0.5) * width > middle + 0.5 * drum) continue
        if (!(bin in top) || y[k] + r[k] > top[bin]) { top[bin] = y[k] + r[k]; at[bin] = x[k] }
    }
    for (bin in top) { ++bins; sx += at[bin]; sy += top[bin]; sxx += at[bin] * at[bin]; sxy += at[bin] * top[bin] }
    slope = (bins * sxy - sx * sy) / (bins * sxx - sx * sx)
    angle = atan2(slope, 1) * 180 / atan2(0, -1)
    print time "," angle
    ++frames; sum += angle; squares += angle * angle
}
BEGIN { FS = ","; n = 0; middle = 52; drum = 49; print "time,angle" }
FNR == 1 { finish(); n = radii = 0; split($0, words, " "); time = words[3] }
/^[0-9]/ && $7 == 0 { x[n] = $2; y[n] = $3; r[n] = $6; radii += $6; ++n }
END {
    finish()
    mean = sum / frames
    printf "%d frames: %.1f +- %.1f degrees\n", frames, mean, sqrt((squares - frames * mean * mean) / (frames - 1)) > "/dev/stderr"
}
