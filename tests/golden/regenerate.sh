#!/usr/bin/env bash
# Makes the golden curves anew: stress and coordination of the default comparison at equal packing fraction.
# Run after ./bootstrap.sh build; look at the difference before you commit it, and say in the commit why it changed.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/bin/softgrain compare scenarios/default.toml --methods sdem,bpm,rigid_dem --out "$folder" --force --no-pictures --quiet
cp "$folder/comparison.csv" tests/golden/default_comparison.csv
git --no-pager diff --stat -- tests/golden
