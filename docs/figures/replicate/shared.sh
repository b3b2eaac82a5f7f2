# Shell functions that all figures share. Folders: $runs (results of the simulations), $made (tables and plots); $method runs them,
# $gallery holds the pictures of the document.
here=docs/figures/replicate

# read_options OPTION...: $quick, $keep and $out.
read_options() {
    quick=false keep=false out=""
    while [ $# -gt 0 ]; do
        case $1 in
        --quick) quick=true ;;
        --keep) keep=true ;;
        --out) out=$2 && shift ;;
        *) echo "unknown option $1" >&2 && exit 2 ;;
        esac
        shift
    done
}

# simulate NAME SCENARIO [key=value...]: puts a run on the list.
simulate() {
    local name=$1 scenario=$2 settings=""
    shift 2
    for setting in "$@"; do settings+=" --set $setting"; done
    echo "$name $scenario$settings" >>"$out/plan"
}

# Runs the list, two at a time with one thread each; what is there already stays. A run that fails is told and the others go on.
run_the_plan() {
    sort -u "$out/plan" | while read -r name rest; do
        [ -e "$runs/$name/run.json" ] || echo "$name $rest"
    done | xargs -r -P 2 -L 1 bash -c '
        name=$4 scenario=$5
        "$1" run "scenarios/$scenario" --method "$3" --threads 1 --quiet --force --out "$2/$name" "${@:6}" >"$2/$name.log" 2>&1 ||
            echo "  $name failed: $(tail -1 "$2/$name.log")"' replicate "$softgrain" "$runs" "$method"
}

# histories NAME...: their history.csv, of those that are there.
histories() {
    local name
    for name in "$@"; do [ ! -e "$runs/$name/history.csv" ] || echo "$runs/$name/history.csv"; done
}

# band X Y GRID NAME...: mean and range of the runs' columns Y at the values GRID of column X.
band() {
    local x=$1 y=$2 grid=$3 files=() history
    shift 3
    for history in $(histories "$@"); do
        local table=${history%history.csv}$x.table
        awk -v x="$x" -v y="$y" -v grid="$grid" -f $here/at.awk "$history" >"$table"
        files+=("$table")
    done
    awk -f $here/band.awk "${files[@]}" </dev/null
}

# value FILE X COLUMN: of the row whose first column is X; empty if there is none.
value() {
    awk -F, -v x="$2" -v wanted="$3" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == wanted) c = i; next }
        NR > 1 && $1 == x { print $c; exit }' "$1"
}

# number FORMAT VALUE: "-" if there is no value.
number() { if [ -n "$2" ]; then printf "$1" "$2"; else printf -- "-"; fi; }

# ratio VALUE BASE: "+12 %", "-" if one is missing.
ratio() {
    if [ -n "$1" ] && [ -n "$2" ]; then awk -v a="$1" -v b="$2" 'BEGIN { printf "%+.0f %%", 100 * (a / b - 1) }'; else printf -- "-"; fi
}

# percent A B: A / B - 1 with one decimal; quotient FORMAT A B: A / B; "-" if one is missing.
percent() { if [ -n "$1" ] && [ -n "$2" ]; then awk -v a="$1" -v b="$2" 'BEGIN { printf "%+.1f %%", 100 * (a / b - 1) }'; else printf -- "-"; fi; }
quotient() { if [ -n "$2" ] && [ -n "$3" ]; then awk -v f="$1" -v a="$2" -v b="$3" 'BEGIN { printf f, a / b }'; else printf -- "-"; fi; }

# result NAME KEY: from run.json.
result() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\"]*[^\",]\)\"\{0,1\},\{0,1\}$/\1/p" "$runs/$1/run.json" 2>/dev/null; }

# Curves of the plot being made: curve LABEL CSV X Y [JSON of further keys], shaded LABEL CSV X Y ... with Y_low and Y_high.
curves=""
curve() { curves+="{\"label\": \"$1\", \"csv\": \"$2\", \"x_column\": \"$3\", \"y_column\": \"$4\"${5:+, $5}},"; }
shaded() { curve "$1" "$2" "$3" "$4" "\"lower_column\": \"$4_low\", \"upper_column\": \"$4_high\"${5:+, $5}"; }

# plot FILE TITLE X Y [LEGEND]: X and Y are JSON of the axes; draws the curves and forgets them.
plot() {
    printf '{"title": "%s", "x": {%s}, "y": {%s}, "legend": "%s", "series": [%s]}\n' "$2" "$3" "$4" "${5:-auto}" "${curves%,}" \
        >"$made/$1.json"
    "$softgrain" render plot "$made/$1.json" --out "$made/$1.png"
    curves=""
}

# table NAME: standard input replaces what is between the markers of that name in the document.
table() {
    cat >"$made/$1.md"
    awk -v name="$1" -v file="$made/$1.md" '
        $0 == "<!-- end " name " -->" { inside = 0 }
        !inside { print }
        $0 == "<!-- begin " name " -->" { found = inside = 1; while ((getline line < file) > 0) print line }
        END { if (!found) { print "no markers for " name > "/dev/stderr"; exit 1 } }' "$document" >"$document.new"
    mv "$document.new" "$document"
}

# row FIGURE SCENARIO STATEMENT NUMBERS PICTURE...: a line of the overview.
row() {
    local links="" picture
    for picture in "${@:5}"; do links+="${links:+, }[$picture](figures/$gallery/$picture)"; done
    echo "| $1 | $2 | $3 | $4 | $links |" >>"$out/overview"
}

# open_folders: $runs and $made in $out, empty unless $keep; a $quick run works on a copy of the document.
open_folders() {
    $keep || rm -rf "$out"
    runs=$out/runs
    made=$out/figures
    mkdir -p "$runs" "$made"
    rm -f "$out/plan" "$out/overview"
    if $quick; then
        cp "$document" "$out/"
        document=$out/$(basename "$document")
    fi
}

# make_figures FOLDER: runs the plans of all $figures, whose scripts are in FOLDER, makes them, and publishes them unless $quick.
make_figures() {
    figures_here=$1
    local figure
    for figure in $figures; do . "$figures_here/$figure.sh"; done
    for figure in $figures; do "plan_$figure"; done
    run_the_plan
    for figure in $figures; do
        echo "== $figure"
        "make_$figure"
    done
    {
        echo "| figure | scenario | the paper | softgrain | plots |"
        echo "|---|---|---|---|---|"
        cat "$out/overview"
    } | table overview
    "$softgrain" --version | sed 's/^/Made with /; s/$/\n/' | table version
    if ! $quick; then
        rm -rf "docs/figures/$gallery"
        mkdir -p "docs/figures/$gallery/numbers"
        cp "$made"/*.png "docs/figures/$gallery/"
        cp "$made"/*.csv "docs/figures/$gallery/numbers/"
    fi
}
