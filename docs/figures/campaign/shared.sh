# What all studies share, beside the functions of the replications. A study plans its runs (plan_STUDY) and then writes its tables
# and pictures (make_STUDY). Folders: $runs (simulations), $made (tables, plots), $gallery (pictures of the documents).
. docs/figures/replicate/shared.sh
here=docs/figures/campaign
numbers_of_curves=docs/figures/replicate # at.awk and band.awk

# simulate METHOD NAME SCENARIO [key=value...]: puts a run on the list of the study.
simulate() {
    local method=$1 name=$2 scenario=$3 settings=""
    shift 3
    for setting in "$@"; do settings+=" --set $setting"; done
    echo "$name $method $scenario$settings" >>"$out/$study.plan"
}

# Runs the list of the study one after the other on one thread; what is there already stays. A failed run is told, the others go on.
run_the_plan() {
    local name method scenario settings
    while read -r name method scenario settings; do
        [ ! -e "$runs/$name/run.json" ] || continue
        # settings are words
        "$softgrain" run "scenarios/$scenario" --method "$method" --threads 1 --quiet --force --out "$runs/$name" $settings \
            >"$runs/$name.log" 2>&1 </dev/null || echo "  $name failed: $(tail -1 "$runs/$name.log")"
    done < <(sort -u "$out/$study.plan")
}

# CPU seconds of all runs of the study.
seconds_of_study() {
    local name rest
    sort -u "$out/$study.plan" | while read -r name rest; do result "$name" cpu_time; done | awk '{ sum += $1 } END { printf "%.0f", sum }'
}

# derive AWK NAME: history of the run -> its table of derived columns, derived.csv beside it.
derive() { awk -f "$here/$1" "$runs/$2/history.csv" >"$runs/$2/derived.csv"; }

# band_of X Y HALF GRID NAME...: mean and range over the runs of the means of Y over X +- HALF (0: interpolated), of derived.csv.
band_of() {
    local x=$1 y=$2 half=$3 grid=$4 name files=()
    shift 4
    for name in "$@"; do
        [ -e "$runs/$name/derived.csv" ] || continue
        awk -v x="$x" -v y="$y" -v half="$half" -v grid="$grid" -f $numbers_of_curves/at.awk "$runs/$name/derived.csv" \
            >"$runs/$name/$x.table"
        files+=("$runs/$name/$x.table")
    done
    awk -f $numbers_of_curves/band.awk "${files[@]}" </dev/null
}

# names PREFIX SEED...: PREFIX-SEED of each.
names() {
    local prefix=$1 seed
    shift
    for seed in "$@"; do echo "$prefix-$seed"; done
}

# summary FILE COLUMN FORMAT [FACTOR]: mean +- standard deviation of a column of a table with a header.
summary() {
    awk -F, -v wanted="$2" -v f="$3" -v factor="${4:-1}" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == wanted) c = i; next }
        $c != "" { v = factor * $c; ++n; sum += v; square += v * v }
        END {
            if (!n) { printf "-"; exit }
            mean = sum / n; variance = n > 1 ? (square - n * mean * mean) / (n - 1) : 0
            printf (n > 1 ? f " +- " f : f), mean, sqrt(variance > 0 ? variance : 0) }' "$1"
}

# angles FILE COLUMN: friction angle asin(q / p) [degrees], mean +- standard deviation.
angles() {
    awk -F, -v OFS=, -v wanted="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == wanted) c = i; print "angle"; next }
        { print atan2($c, sqrt(1 - $c * $c)) * 57.29578 }' "$1" >"$made/angles.csv"
    summary "$made/angles.csv" angle %.1f
}

# seconds: one line with the time of the study's runs.
seconds() {
    echo "CPU time of the $(sort -u "$out/$study.plan" | wc -l) runs of this study: $(seconds_of_study) s (one thread, shared machine; $("$softgrain" --version))."
}

# publish NAME...: the plots of the study become those of the documents.
publish() {
    local name
    mkdir -p "$gallery"
    for name in "$@"; do cp "$made/$name.png" "$gallery/"; done
}

# features FROM NAME...: a row of features.awk for each run that is there; residual: beyond an axial strain of FROM.
features() {
    local from=$1 name files=()
    shift
    for name in "$@"; do
        derive biaxial.awk "$name"
        files+=("$runs/$name/derived.csv")
    done
    awk -v from="$from" -f $here/features.awk "${files[@]}"
}

# Grids of axial strain for curves, running means over HALF on each side.
axial_grid() { seq -s, -f %.4f 0 0.001 "$1"; }

# extreme FILE COLUMN SIGN FACTOR: largest (SIGN 1) or least (-1) over the rows, times FACTOR.
extreme() {
    awk -F, -v wanted="$2" -v sign="$3" -v factor="$4" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == wanted) c = i; next }
        NR == 2 || sign * $c > sign * best { best = $c }
        END { printf "%.2f", best * factor }' "$1"
}
