#!/usr/bin/env bash
# Builds the fuzzers with clang and runs them, one for each processor at a time.
#   tests/fuzz/run.sh [SECONDS [READER...]]    each so long (60), readers: scenario packing history run_file
#   tests/fuzz/run.sh keep                     put what they have learned into tests/fuzz/corpus, from which they begin
# A finding makes the script fail and is left in build/fuzz/findings. With FUZZ_SEED a run tries the same inputs as the last one.
set -euo pipefail
cd "$(dirname "$0")/../.."
what=${1:-60}
shift || true
readers=("$@")
[ ${#readers[@]} -gt 0 ] || readers=(scenario packing history run_file)
made=build/fuzz
longest=4000

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "${readers[@]/#/fuzz_}"

seeds=$made/seeds
rm -rf $seeds
mkdir -p $seeds/{scenario,packing,history,run_file} $made/findings
git ls-files 'scenarios/*.toml' | while read -r file; do cp "$file" "$seeds/scenario/$(echo "$file" | tr / _)"; done
# The first byte of what the fuzzer of packings takes says of which kind the box is.
git ls-files 'scenarios/*.csv' | xargs grep -l '^x,y,r' | while read -r file; do
    { printf '\0'; head -c $longest "$file"; } >"$seeds/packing/$(echo "$file" | tr / _)"
done
git ls-files 'tests/golden/*.csv' | while read -r file; do head -c $longest "$file" >"$seeds/history/$(basename "$file")"; done

search() {
    local reader=$1 fuzz=$made/bin/fuzz_$1 kept=tests/fuzz/corpus/$1 found=$made/found/$1
    mkdir -p "$kept" "$found"
    if [ "$what" = keep ]; then
        "$fuzz" -merge=1 -max_len=300 "$kept" "$found"
    else
        "$fuzz" -seed="${FUZZ_SEED:-0}" -max_total_time="$what" -timeout=10 -rss_limit_mb=2048 -max_len=$longest -print_final_stats=1 -verbosity=0 \
            -print_funcs=0 -artifact_prefix="$made/findings/${reader}_" "$found" "$kept" "$seeds/$reader"
    fi
}

# One for each processor at a time; each tells what it found when it ends.
export -f search
export what made longest seeds
printf '%s\n' "${readers[@]}" | xargs -P "$(nproc)" -I{} bash -c 'log=$(search {} 2>&1) && rc=0 || rc=$?; printf "#### {}\n%s\n" "$log"; exit $rc'
