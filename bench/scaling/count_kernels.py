#!/usr/bin/env python3
"""Counts what the parts of a step do for a grain: double operations, bytes loaded and stored, bytes from beyond the second cache.

    bench/scaling/count_kernels.py                    build (preset count), count, print
    bench/scaling/count_kernels.py --update           write kernels.csv anew, which the roofline of `softgrain bench scaling` is from
    --program P       count with the program P instead, made as the preset count says
    --softgrain S     the program that makes the packings; build/release/bin/softgrain if not given
    --method M        only this one; --update then keeps the rows of the others

Every instruction of the time loop is counted by valgrind's callgrind, and looked up in the program's disassembly. An addition,
subtraction, multiplication, division or square root of n doubles counts as n, masked or not; comparisons, minima and conversions do not.
Bytes are those of the instructions' memory operands. Bytes from beyond the second cache are 64 for every line that a cache of 1 MiB does
not have, without what is written back. The code is that for AVX2, which does the same operations in other pieces than AVX-512.
"""
import argparse
import re
import subprocess
import sys
import tempfile
import tomllib
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "guard"))
from instructions import STEPS, build, instructions, made_with  # noqa: E402

WHOLE_STEP = "whole step"  # as in app/bench/scaling/scaling_tables.hpp
LINE = 64  # bytes
SIZES = {"b": 1, "w": 2, "l": 4, "q": 8}  # bytes, by the last letter of an instruction
OPTIONS = ["--dump-instr=yes", "--compress-strings=no", "--compress-pos=no", "--cache-sim=yes", "--LL=1048576,16,64"]
ARITHMETIC = re.compile(r"v?(add|sub|mul|div|sqrt|hadd|hsub|addsub)(pd|sd)")
FUSED = re.compile(r"vfn?m(add|sub)\d*(pd|sd)")


@dataclass
class Work:
    flops: float = 0.0
    bytes: float = 0.0
    far_bytes: float = 0.0

    def add(self, other: "Work") -> None:
        self.flops += other.flops
        self.bytes += other.bytes
        self.far_bytes += other.far_bytes


def without_addresses(operands: str) -> str:
    return re.sub(r"[^ ,]*\([^)]*\)", "", operands)


def width(operands: str) -> int:
    """Bytes of the widest register among the operands."""
    if "%zmm" in operands:
        return 64
    if "%ymm" in operands:
        return 32
    if "%xmm" in operands:
        return 16
    for register in re.findall(r"%([a-z0-9]+)", without_addresses(operands)):
        for pattern, size in ((r"r[a-z]{2}|r\d+", 8), (r"e[a-z]{2}|r\d+d", 4), (r"[a-d]x|[sd]i|[sb]p|r\d+w", 2),
                              (r"[a-d][lh]|[sd]il|[sb]pl|r\d+b", 1)):
            if re.fullmatch(pattern, register):
                return size
    return 8


def flops_of(name: str, operands: str) -> int:
    found = ARITHMETIC.fullmatch(name) or FUSED.fullmatch(name)
    if not found:
        return 0
    lanes = 1 if found[2] == "sd" else width(operands) // 8
    return lanes * (2 if FUSED.fullmatch(name) else 1)


def bytes_of(name: str, operands: str) -> int:
    """Of one access to memory of this instruction."""
    if re.fullmatch(r"v?gather.*|vp?gather.*", name) or name.startswith("vbroadcastsd"):
        return 8
    if name.startswith(("vbroadcastf128", "vinsertf128", "vextractf128", "vinserti128", "vextracti128")):
        return 16
    if re.fullmatch(r"v?mov[lh]pd|v?movddup", name) or re.fullmatch(r"v?[a-z0-9]+sd", name) or name in ("vmovq", "movq"):
        return 8
    if re.fullmatch(r"v?[a-z0-9]+ss", name) or name in ("vmovd", "movd"):
        return 4
    if re.fullmatch(r"v?cvt(dq2pd|ps2pd)", name):
        return width(operands) // 2
    if extended := re.fullmatch(r"mov[sz]([bwl])[wlq]", name):
        return SIZES[extended[1]]
    if name == "call":
        return 8
    if name[-1] in SIZES and "%" not in without_addresses(operands):  # an immediate and memory: the name tells the size
        return SIZES[name[-1]]
    return width(operands)


def disassembly(program: Path) -> dict[int, tuple[str, str]]:
    """Name and operands of the instruction at each address."""
    listed = subprocess.run(["objdump", "-d", "--no-show-raw-insn", str(program)], capture_output=True, text=True, check=True).stdout
    found = {}
    for line in listed.splitlines():
        if row := re.match(r"\s*([0-9a-f]+):\s+(?:(?:lock|rep[nez]*|bnd|notrack|data16|cs) )*(\S+)\s*([^#<]*)", line):
            found[int(row[1], 16)] = (row[2], row[3])
    return found


def work_by_function(profile: Path, program: Path) -> dict[str, Work]:
    """Of the functions of the program itself; those of libraries are left out, but for their misses."""
    code = disassembly(program)
    work: dict[str, Work] = defaultdict(Work)
    events: list[str] = []
    function, of_program, skip = "", False, False
    for line in profile.read_text().splitlines():
        if line.startswith("events:"):
            events = line.split()[1:]
        elif line.startswith("ob="):
            of_program = Path(line[3:]).name == program.name
        elif line.startswith("fn="):
            function = line[3:]
        elif line.startswith("calls="):
            skip = True  # the next line has the costs of what is called
        elif line.startswith("0x"):
            if skip:
                skip = False
                continue
            address, _, *costs = line.split()
            cost = dict(zip(events, map(int, costs)))
            one = Work(far_bytes=LINE * (cost.get("DLmr", 0) + cost.get("DLmw", 0)))
            if of_program and int(address, 16) in code:
                name, operands = code[int(address, 16)]
                one.flops = cost["Ir"] * flops_of(name, operands)
                one.bytes = (cost.get("Dr", 0) + cost.get("Dw", 0)) * bytes_of(name, operands)
            work[function].add(one)
    return work


def parts(work: dict[str, Work], kernels: list[tuple[str, list[str]]]) -> dict[str, Work]:
    """By kernel, the first that a function belongs to; and all of a step."""
    found = {title: Work() for title, _ in kernels} | {WHOLE_STEP: Work()}
    for function, one in work.items():
        found[WHOLE_STEP].add(one)
        for title, names in kernels:
            if any(name in function for name in names):
                found[title].add(one)
                break
    return found


def words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]


def count(subject: dict, kernels: list[tuple[str, list[str]]], program: Path, softgrain: Path) -> dict[str, Work]:
    """Of a grain in a step."""
    grains = int(subject["counts"])
    scenario = HERE / subject["scenario"]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([str(softgrain), "bench", "scaling", "--plan", str(HERE / "counted.toml"), "--method", subject["name"],
                        "--packings-only", "--out", folder], check=True, stdout=sys.stderr)
        packing = Path(folder) / "packings" / f"{scenario.stem}_{grains}.csv"
        box = re.match(r"# box.width = (\S+), box.height = (\S+)", packing.read_text())
        settings = [*words(subject.get("set", "")), f"packing.path={packing}", f"box.width={box[1]}", f"box.height={box[2]}"]
        # What a method prepares is taken from the cache, not prepared under valgrind.
        subprocess.run([str(softgrain), "bench", "steps", str(scenario), "--method", subject["method"], "--steps", "1",
                        *(word for one in settings for word in ("--set", one))],
                       check=True, stdout=sys.stderr, env={"SOFTGRAIN_CACHE": folder})
        profile = Path(folder) / "profile"
        _, printed = instructions([str(program), str(scenario), subject["method"], *settings], STEPS, profile, OPTIONS, folder)
        steps, counted, _ = printed.split(",")
        grain_steps = int(steps) * int(counted)
        found = parts(work_by_function(profile, program), kernels)
    return {title: Work(one.flops / grain_steps, one.bytes / grain_steps, one.far_bytes / grain_steps) for title, one in found.items()}


def update(counts: Path, rows: list[str], tools: str) -> None:
    """Replaces the rows of the methods that were counted."""
    counted = {row.split(",")[0] for row in rows}
    before = counts.read_text().splitlines()[2:] if counts.exists() else []
    kept = [row for row in before if row.split(",")[0] not in counted]
    by_method = sorted(kept + rows, key=lambda row: row.split(",")[0])
    counts.write_text("\n".join([f"# {tools}", "method,kernel,flops,bytes,far_bytes", *by_method]) + "\n")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--program", type=Path)
    parser.add_argument("--softgrain", type=Path, default=HERE.parents[1] / "build/release/bin/softgrain")
    parser.add_argument("--method")
    arguments = parser.parse_args()
    subjects = tomllib.loads((HERE / "counted.toml").read_text())["subject"]
    if arguments.method:
        subjects = [one for one in subjects if one["method"] == arguments.method]
    program = arguments.program or build()
    kernels = tomllib.loads((HERE / "kernels.toml").read_text())["kernel"]
    rows = []
    for subject in subjects:
        own = [(one["title"], words(one["functions"])) for one in kernels if one["method"] == subject["method"]]
        for title, one in count(subject, own, program, arguments.softgrain).items():
            rows.append(f"{subject['method']},{title},{one.flops:.1f},{one.bytes:.1f},{one.far_bytes:.1f}")
            print(rows[-1], flush=True)
    if arguments.update:
        update(HERE / "kernels.csv", rows, made_with())
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RuntimeError as error:
        sys.exit(f"{error}")
