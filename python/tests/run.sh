#!/bin/sh
# Runs the tests with a Python that has what they need; exit code 77 (skipped) without one. SOFTGRAIN_PYTHON names another.
cd "$(dirname "$0")" || exit 1
export PYTHONPATH=.. PYTHONDONTWRITEBYTECODE=1
for python in ${SOFTGRAIN_PYTHON:-python3 /usr/bin/python3}; do
    if "$python" -c 'import h5py, numpy, pandas, tomllib' 2>/dev/null; then
        exec "$python" -m unittest "$@"
    fi
done
echo "skipped: no Python 3.11 with h5py, numpy and pandas (Debian: python3-h5py python3-pandas)"
exit 77
