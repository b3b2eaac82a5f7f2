#!/usr/bin/env bash
# Sets up, builds, and runs the default comparison or the tests. Safe to repeat; does only what is still missing.
#   ./bootstrap.sh run     install what is missing, build, compare all methods on scenarios/default.toml
#   ./bootstrap.sh test    install what is missing, build, run all tests
#   ./bootstrap.sh build   install what is missing, build
#   ./bootstrap.sh deps    install what is missing
set -euo pipefail
cd "$(dirname "$0")"

packages=(g++ cmake ninja-build git ca-certificates python3
          libeigen3-dev libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libbox2d-dev
          libhdf5-dev libvtk9-dev libgtest-dev libegl-dev libglew-dev libegl-mesa0 libgl1-mesa-dri xvfb xauth fonts-dejavu-core)

say() { printf '\n== %s\n' "$*"; }

install_packages() {
    local missing=()
    for package in "${packages[@]}"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        say "All ${#packages[@]} Debian packages are there"
        return
    fi
    say "Installing Debian packages: ${missing[*]}"
    local root=()
    [ "$(id -u)" -eq 0 ] || root=(sudo)
    "${root[@]}" apt-get update -qq
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

build() {
    install_packages
    say "Configuring (preset release)"
    cmake --preset release
    say "Building"
    cmake --build --preset release "$@"
}

case "${1:-}" in
    deps) install_packages ;;
    build) build ;;
    run)
        build --target softgrain softgrain-render
        say "Comparing all methods on scenarios/default.toml into results/default (three minutes)"
        exec build/release/bin/softgrain compare scenarios/default.toml --out results/default --force
        ;;
    test)
        build
        say "Running the tests"
        exec ctest --preset release
        ;;
    *)
        sed -n '2,6s/^# \{0,1\}//p' "$0"
        exit 2
        ;;
esac
