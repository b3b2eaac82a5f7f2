#!/usr/bin/env bash
# tests/reliability/compare_hashes.sh PROGRAM OTHER [SCENARIO]: both run every method on a small scenario, and all state
# hashes of their run.json must be equal. For two builds of one source: other flags, other instruction sets.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,3s/^# //p' "$0"; exit 2; }
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
scenario=${3:-$(dirname "$0")/hashes.toml}
export OMP_WAIT_POLICY=passive SOFTGRAIN_CACHE=off
hashes() { python3 -c 'import json, sys; print(*json.load(open(sys.argv[1]))["state_hashes"], sep="\n")' "$1/run.json"; }
differ=0
for method in sdem bpm rigid_dem mpm; do
    "$1" run "$scenario" --method $method --threads 1 --quiet --out "$made/one/$method" >/dev/null
    "$2" run "$scenario" --method $method --threads 2 --quiet --out "$made/other/$method" >/dev/null
    hashes "$made/one/$method" >"$made/one.txt"
    hashes "$made/other/$method" >"$made/other.txt"
    if cmp -s "$made/one.txt" "$made/other.txt"; then
        echo "$method: $(wc -l <"$made/one.txt") hashes are equal"
    else
        echo "$method: hashes differ from sample $(diff "$made/one.txt" "$made/other.txt" | sed -n '1s/[^0-9].*//p') on" >&2
        differ=1
    fi
done
exit $differ
