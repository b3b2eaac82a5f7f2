#!/usr/bin/env python3
"""Counts the instructions of five small cases and compares them with counts.csv; exit code 1 if one is off by more than 3 %.

    bench/guard/guard.py             build (preset count), count, compare
    bench/guard/guard.py --update    write counts.csv anew; its diff is reviewed like any other
    --program P                      count the program P instead, made as the preset count says
"""
import argparse
import csv
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from instructions import Count, build, count, made_with

HERE = Path(__file__).resolve().parent
METHOD = {"sdem_packing": "sdem", "sdem_shear": "sdem", "bpm_packing": "bpm", "rigid_dem_biaxial": "rigid_dem", "mpm_packing": "mpm"}
TOLERANCE = 0.03


def read(counts: Path) -> tuple[str, dict[str, dict[str, str]]]:
    lines = counts.read_text().splitlines()
    return lines[0].removeprefix("# "), {row["case"]: row for row in csv.DictReader(lines[1:])}


def write(counts: Path, counted: dict[str, Count], tools: str) -> None:
    rows = [f"{case},{now.steps},{now.instructions}" for case, now in counted.items()]
    counts.write_text("\n".join([f"# {tools}", "case,steps,instructions", *rows]) + "\n")


def compare(counts: Path, counted: dict[str, Count], tools: str) -> bool:
    """Prints a table; true if all counts are as in the file."""
    tools_before, before = read(counts)
    good = True
    print(f"{'case':18} {'steps':>6} {'instructions':>13} {'a step and grain':>17} {'committed':>13}  ratio")
    for case, now in counted.items():
        was = before.get(case, {"steps": "0", "instructions": "nan"})
        ratio = now.instructions / float(was["instructions"])
        fits = abs(ratio - 1.0) <= TOLERANCE
        good = good and fits
        remark = "" if fits else "  <- off by more than 3 %"
        if now.steps != int(was["steps"]):
            remark += f"  (steps: {was['steps']} before)"
        print(f"{case:18} {now.steps:6} {now.instructions:13} {now.each_step() / now.grains:17.0f} {was['instructions']:>13}"
              f"  {ratio:.4f}{remark}")
    if not good:
        print("If this is meant: bench/guard/guard.py --update, and commit its diff with the reason.")
    if tools != tools_before:
        print(f"Counted with {tools}, committed with {tools_before}: counts depend on them.")
    return good


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--program", type=Path)
    arguments = parser.parse_args()
    if "avx2" not in Path("/proc/cpuinfo").read_text():
        print("the counts are those of AVX2 code, which this processor does not have", file=sys.stderr)
        return 2
    program = arguments.program or build()
    with ThreadPoolExecutor(max_workers=2) as pool:
        counted = dict(zip(METHOD, pool.map(lambda case: count(program, HERE / f"{case}.toml", METHOD[case]), METHOD)))
    if arguments.update:
        write(HERE / "counts.csv", counted, made_with())
        return 0
    return 0 if compare(HERE / "counts.csv", counted, made_with()) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RuntimeError as error:
        sys.exit(f"{error}")
