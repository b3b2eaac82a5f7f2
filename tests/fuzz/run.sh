#!/usr/bin/env bash
# Builds the fuzzers with clang and runs them, one after the other.
#   tests/fuzz/run.sh [SECONDS [READER...]]    each so long (60), readers: scenario packing history run_file
#   tests/fuzz/run.sh keep                     put what they have learned into tests/fuzz/corpus, from which they begin
# A finding ends the script and is left in build/fuzz/findings. With FUZZ_SEED a run tries the same inputs as the last one.
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

for reader in "${readers[@]}"; do
    fuzz=$made/bin/fuzz_$reader kept=tests/fuzz/corpus/$reader found=$made/found/$reader
    mkdir -p "$kept" "$found"
    echo "#### $reader"
    if [ "$what" = keep ]; then
        "$fuzz" -merge=1 -max_len=300 "$kept" "$found"
    else
        "$fuzz" -seed="${FUZZ_SEED:-0}" -max_total_time="$what" -timeout=10 -rss_limit_mb=2048 -max_len=$longest -print_final_stats=1 -verbosity=0 \
            -print_funcs=0 -artifact_prefix="$made/findings/${reader}_" "$found" "$kept" "$seeds/$reader"
    fi
done
