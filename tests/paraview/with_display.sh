#!/usr/bin/env bash
# Runs a command with an Xvfb of its own (Debian's pvbatch draws only with a display): with_display.sh COMMAND...
# xvfb-run looks for a free number first and then takes it, which fails when two do so at once.
set -euo pipefail
folder=$(mktemp -d)
mkfifo "$folder/number"
Xvfb -displayfd 3 -screen 0 1280x1024x24 -noreset -nolisten tcp 3<>"$folder/number" >/dev/null 2>&1 &
server=$!
trap 'kill $server 2>/dev/null; rm -rf "$folder"' EXIT
exec 4<>"$folder/number"
read -r -t 30 number <&4 || { echo "Xvfb cannot be started (package xvfb)" >&2; exit 4; }
DISPLAY=":$number" "$@"
