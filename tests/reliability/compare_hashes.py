#!/usr/bin/env python3
"""Whether two builds of one source compute the same: both run every method on hashes.toml, the first with one thread and the
other with two, and all state hashes of their run.json must be equal.

    tests/reliability/compare_hashes.py PROGRAM OTHER [--within METHOD=BOUND]

--within   hashes of this method may differ, if mean stress and elastic energy agree to BOUND of their largest value
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SCENARIO = Path(__file__).resolve().parent / "hashes.toml"


def run(program: str, method: str, threads: int, folder: Path) -> tuple[list[str], list[dict[str, float]]]:
    """State hashes and history."""
    subprocess.run([program, "run", str(SCENARIO), "--method", method, "--threads", str(threads), "--quiet", "--out", str(folder)],
                   check=True, stdout=subprocess.DEVNULL, env={**os.environ, "OMP_WAIT_POLICY": "passive", "SOFTGRAIN_CACHE": "off"})
    with open(folder / "history.csv") as file:
        history = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    return json.loads((folder / "run.json").read_text())["state_hashes"], history


def difference(one: list[dict[str, float]], other: list[dict[str, float]], column: str) -> float:
    if len(one) != len(other):
        return float("inf")
    return max(abs(a[column] - b[column]) for a, b in zip(one, other)) / max(abs(row[column]) for row in one)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("other")
    parser.add_argument("--within", action="append", default=[], metavar="METHOD=BOUND")
    arguments = parser.parse_args()
    within = {method: float(bound) for method, bound in (one.split("=") for one in arguments.within)}
    failed = False
    for method in ("sdem", "bpm", "rigid_dem", "mpm"):
        with tempfile.TemporaryDirectory() as made:
            hashes, history = run(arguments.program, method, 1, Path(made) / "one")
            others, other_history = run(arguments.other, method, 2, Path(made) / "other")
        if hashes == others:
            print(f"{method}: {len(hashes)} state hashes are equal")
            continue
        far = max(difference(history, other_history, column) for column in ("mean_stress", "elastic_energy"))
        print(f"{method}: state hashes differ, stress and elastic energy by {far:.1e} of the largest; allowed: "
              f"{within.get(method, 'nothing')}")
        failed = failed or not far <= within.get(method, -1.0)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
