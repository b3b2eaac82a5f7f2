#!/usr/bin/env bash
# Unpacks Debian 12's ParaView (pvbatch, pvpython, paraview) into a folder, where it does not meet libvtk9-dev: its Python
# package conflicts with python3-vtk9, so that the two cannot be installed together.
#   tests/paraview/install_aside.sh FOLDER     then FOLDER/pvbatch view.py, or SOFTGRAIN_PARAVIEW=FOLDER ctest -L paraview
# Shared libraries that are missing are installed by apt (as root or with sudo), if nothing has to be removed for them.
# 75 MB are downloaded; the folder then has 540 MB. Safe to repeat.
set -euo pipefail
[ $# -eq 1 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 2; }
mkdir -p "$1"
folder=$(cd "$1" && pwd)
if [ -x "$folder/pvbatch" ]; then
    echo "$folder: ParaView is there"
    exit 0
fi

root=()
[ "$(id -u)" -eq 0 ] || root=(sudo)
apt-cache show python3-paraview >/dev/null 2>&1 || "${root[@]}" apt-get update -qq

debs=$(mktemp -d)
trap 'rm -rf "$debs"' EXIT
(cd "$debs" && apt-get -o APT::Sandbox::User=root download -qq paraview python3-paraview)

# Python's numpy, and the libraries that the packages name first among equals; those of the window are few.
missing=()
for library in $(for deb in "$debs"/*.deb; do dpkg-deb -f "$deb" Depends; done |
                 tr ',' '\n' | sed 's/[|(].*//; s/ //g' | grep '^lib' | sort -u) python3 python3-numpy; do
    dpkg-query -W -f='${Status}' "$library" 2>/dev/null | grep -q 'install ok installed' || missing+=("$library")
done
if [ ${#missing[@]} -gt 0 ]; then
    echo "Installing Debian packages: ${missing[*]}"
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -qq --no-install-recommends --no-remove "${missing[@]}" >/dev/null
fi

for deb in "$debs"/*.deb; do dpkg-deb -x "$deb" "$folder"; done
for program in paraview pvpython pvbatch; do
    cat >"$folder/$program" <<'RUN'
#!/bin/sh
here=$(cd "$(dirname "$0")" && pwd)
export LD_LIBRARY_PATH="$here/usr/lib/x86_64-linux-gnu${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
export PYTHONPATH="$here/usr/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}"
exec "$here/usr/bin/$(basename "$0")" "$@"
RUN
    chmod +x "$folder/$program"
done
echo "$folder: ParaView $(dpkg-deb -f "$debs"/paraview_*.deb Version)"
