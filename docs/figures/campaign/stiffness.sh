# Bulk and shear modulus and Z of jammed packings against pressure: linear and Hertz contacts, without and with friction, and SDEM.
document_stiffness=scenarios/stiffness/README.md
seeds_stiffness="1 2"

plan_stiffness() {
    local law friction seed
    for law in linear hertz; do for friction in 0 0.5; do for seed in $seeds_stiffness; do
        simulate rigid_dem "stiffness-$law-$friction-$seed" stiffness/isotropic.toml random.seed=$seed \
            rigid_dem.normal_law=$law material.friction=$friction
    done; done; done
    for seed in $seeds_stiffness; do
        simulate sdem "stiffness-sdem-0-$seed" stiffness/isotropic.toml random.seed=$seed packing.count=100
    done
}

kinds_stiffness="linear-0 linear-0.5 hertz-0 hertz-0.5 sdem-0"

label_of() {
    case $1 in
    sdem-0) echo "SDEM, 100 grains" ;;
    *-0) echo "${1%-*}" ;;
    *) echo "${1%-*}, friction ${1#*-}" ;;
    esac
}

make_stiffness() {
    local kind seed column
    for kind in $kinds_stiffness; do
        for seed in $seeds_stiffness; do derive stiffness.awk "stiffness-$kind-$seed"; done
        # The levels of all seeds that came to rest; Z beyond the isostatic 4 of frictionless discs.
        for seed in $seeds_stiffness; do cat "$runs/stiffness-$kind-$seed/derived.csv"; done | awk -F, -v OFS=, '
            !/^[0-9]/ { if (NR == 1) print $0, "level", "excess"; next }
            $6 <= 2e-5 { print $0, sprintf("%.1f", 2 * log($1) / log(10)), ($4 > 4 ? $4 - 4 : "") }' >"$made/stiffness_$kind.all.csv"
        by_level "$made/stiffness_$kind.all.csv" >"$made/stiffness_$kind.csv"
    done
    plot_stiffness K "bulk modulus K / E"
    plot_stiffness G "shear modulus G / E"
    plot_stiffness coordination "coordination number Z, without rattlers"
    {
        echo "| contacts | friction | pressures / E | K / E there | exponent of K | G / E there | exponent of G | Z there | exponent of Z - 4 | levels at rest |"
        echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
        for kind in $kinds_stiffness; do
            awk -F, -v name="${kind%-*}" -v friction="${kind#*-}" '
                function add(k, y) { y = log(y); ++n[k]; sx[k] += x; sy[k] += y; sxx[k] += x * x; sxy[k] += x * y; syy[k] += y * y }
                function exponent(k,   a, b, r) {
                    if (n[k] < 3) return "-"
                    a = n[k] * sxx[k] - sx[k] ^ 2; b = (n[k] * sxy[k] - sx[k] * sy[k]) / a
                    r = (n[k] * syy[k] - sy[k] ^ 2 - b * b * a) / (n[k] - 2) / a
                    return sprintf("%.2f +- %.2f", b, sqrt(r > 0 ? r : 0))
                }
                FNR == 1 { ++file; next }
                file == 1 { x = log($1); add("K", $2); if ($3 > 0) add("G", $3); else ++soft; if ($8 != "") add("Z", $8); next }
                { if (FNR == 2) low = $0; high = $0 }
                END {
                    split(low, a, FS); split(high, b, FS)
                    printf "| %s | %s | %.1e to %.1e | %.3g to %.3g | %s | %.2g to %.2g | %s | %.2f to %.2f | %s | %d |\n", name, friction,
                        a[1], b[1], a[2], b[2], exponent("K"), a[3], b[3], exponent("G"), a[4], b[4], friction == 0 ? exponent("Z") : "-", n["K"]
                }' "$made/stiffness_$kind.all.csv" "$made/stiffness_$kind.csv"
        done
    } | table stiffness
    seconds | table seconds_stiffness
    publish stiffness_{K,G,coordination}
}

# Means over the seeds of rows of one level of pressure (half decades), sorted by pressure.
by_level() {
    echo "pressure,K,G,coordination,seeds"
    awk -F, -v OFS=, '
        NR > 1 { k = sprintf("%.0f", $7); ++n[k]; p[k] += $1; K[k] += $2; G[k] += $3; Z[k] += $4 }
        END { for (k in n) print p[k] / n[k], K[k] / n[k], G[k] / n[k], Z[k] / n[k], n[k] }' "$1" | sort -t, -g -k1
}

# plot_stiffness COLUMN LABEL: all kinds against pressure.
plot_stiffness() {
    local kind colour=0 log=', "log": true' legend=bottom_right
    [ $1 != coordination ] || log="" legend=top_left
    for kind in $kinds_stiffness; do
        # 100 grains are too few for G.
        [ $1$kind != Gsdem-0 ] || continue
        curve "$(label_of $kind)" "stiffness_$kind.csv" pressure $1 "\"marker\": \"circle\", \"colour\": $((colour++))"
    done
    plot stiffness_$1 "Jammed packings, means of two seeds" '"label": "pressure / E", "log": true' "\"label\": \"$2\"$log" $legend
}
