#!/usr/bin/env python3
"""What optional features cost where a scene does not use them and where it does, and what scene-level skipping saves: counted
instructions of one thread (bench/guard/instructions.py).

    bench/skip/skip.py [TABLE...]    write TABLE.csv beside this file for the tables named, or for all of them:
        unused    a step of a plain scene, against a build without the feature. Patches in without/ are applied to the source
                  tree for that build and taken back after it; the tree must have no changes of its own.
        used      a step of the same scene with the feature on
        saved     whole runs with and without scene-level skipping
        written   what is observed and written at samples, by `softgrain run`, against a step
"""
import argparse
import csv
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "guard"))
from instructions import ROOT, STEPS, WHOLE_LOOP, Count, build, count, instructions, made_with  # noqa: E402

METHODS = ("sdem", "rigid_dem", "bpm", "mpm")
PROGRAMS = ROOT / "build/count/programs"


class Feature(NamedTuple):
    method: str
    name: str
    on: list[str]
    off: list[str] = []


FEATURES = [
    Feature("sdem", "friction", ["material.friction=0.3", "material.wall_friction=0.3"]),
    Feature("sdem", "cohesion", ["material.cohesion=0.001"]),
    Feature("sdem", "cohesion with a range", ["material.cohesion=0.001", "sdem.adhesion_range=0.01"]),
    Feature("sdem", "gravity", ["box.gravity_y=-1e-5"]),
    Feature("sdem", "plasticity", ["material.yield_stress=0.1"]),
    Feature("sdem", "contact damping", [], ["sdem.contact_damping=0"]),
    Feature("sdem", "shape damping", [], ["sdem.shape_damping=0"]),
    Feature("sdem", "dilation inertia", ["sdem.dilation_inertia=1"]),
    Feature("sdem", "incompressible branch", ["sdem.law=mollon2022", "material.poisson_ratio=0.5"], ["sdem.law=mollon2022"]),
    Feature("sdem", "D2F1, volume only", ["sdem.kinematics=D2F1"]),
    Feature("sdem", "D2F0, rigid", ["sdem.kinematics=D2F0"]),
    Feature("sdem", "periodic cell", ["box.periodic=true"]),
    Feature("rigid_dem", "friction, rotation", ["material.friction=0.3"]),
    Feature("rigid_dem", "the same, at walls too", ["material.friction=0.3", "material.wall_friction=0.3"]),
    Feature("rigid_dem", "friction, rolling", ["material.friction=0.3", "rigid_dem.rolling_friction=0.1"]),
    Feature("rigid_dem", "cohesion", ["material.cohesion=0.001"]),
    Feature("rigid_dem", "contact damping", ["rigid_dem.restitution=0.5"]),
    Feature("rigid_dem", "nonviscous damping", ["rigid_dem.nonviscous_damping=0.2"]),
    Feature("rigid_dem", "Hertz contacts", ["rigid_dem.normal_law=hertz"]),
    Feature("rigid_dem", "gravity", ["box.gravity_y=-1e-5"]),
    Feature("rigid_dem", "periodic cell", ["box.periodic=true"]),
    Feature("bpm", "friction between grains", ["material.friction=0.3"]),
    Feature("bpm", "friction within grains", ["bpm.friction_within=0.3"]),
    Feature("bpm", "friction within, rolling", ["bpm.friction_within=0.3", "bpm.rolling_resistance=0.1"]),
    Feature("bpm", "gravity", ["box.gravity_y=-1e-5"]),
    Feature("bpm", "bonds for attraction", ["bpm.grain=elastic"]),
    Feature("mpm", "friction", ["material.friction=0.3", "material.wall_friction=0.3"]),
    Feature("mpm", "gravity", ["box.gravity_y=-1e-5"]),
    Feature("mpm", "plasticity", ["material.yield_stress=0.1"]),
]


class Saving(NamedTuple):
    method: str
    name: str
    scene: str
    without: list[str] | str  # settings, or the name of a patch
    used: list[str] = []


SAVINGS = [
    Saving("sdem", "list of neighbours kept while they move little", "sdem.toml", ["sdem.skin=1e-9"]),
    Saving("rigid_dem", "list of neighbours kept while they move little", "rigid_dem.toml", ["rigid_dem.skin=1e-9"]),
    Saving("bpm", "no sweeps over blocks that have come to rest", "bpm.toml", "saved_bpm_resting_blocks"),
    Saving("sdem", "coarse rate before jamming", "loose.toml", ["loading.0.inertial_number=1e-3"]),
    Saving("rigid_dem", "coarse rate before jamming", "loose.toml", ["loading.0.inertial_number=1e-3"]),
    Saving("sdem", "early stop at equilibrium", "rest.toml", [], ["loading.1.until_unbalanced=0.01"]),
    Saving("rigid_dem", "early stop at equilibrium", "rest.toml", [], ["loading.1.until_unbalanced=0.01"]),
    Saving("sdem", "no work at rest far from the load", "strip.toml", [], ["sdem.rest_tolerance=1e-5"]),
    Saving("rigid_dem", "no work at rest far from the load", "strip.toml", [], ["rigid_dem.rest_tolerance=1e-5"]),
]

# What is called at samples: the function, and what it is called for.
WRITTEN = [
    ("row of the history, observed", "softgrain::TimeLoop::sample(*)", "row"),
    ("row of the history, written", "softgrain::HistoryWriter::observe(*)", "row"),
    ("grains and outlines of a frame", "softgrain::GrainWriter::observe(*)", "frame"),
    ("contacts of a frame", "softgrain::ContactWriter::observe(*)", "frame"),
    ("walls of a frame", "softgrain::WallWriter::observe(*)", "frame"),
    ("parts of a frame", "softgrain::PartWriter::observe(*)", "frame"),
    ("checkpoint", "softgrain::write_run_file(*)", "checkpoint"),
]

THREADS = re.compile(r"GOMP_|gomp_|omp_get_|ThreadChoice|clock_gettime")


SOURCES = ("--", "*.cpp", "*.hpp", ":!bench", ":!tests")


def git(*words: str) -> str:
    return subprocess.run(["git", *words], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


@cache
def program(patch: str = "") -> Path:
    """The program with without/PATCH.patch applied, built if that of the committed sources is not there yet. Raises
    CalledProcessError if the sources have changes, or the patch does not fit them any more."""
    git("diff", "--exit-code", "--stat", "HEAD", *SOURCES)
    PROGRAMS.mkdir(parents=True, exist_ok=True)
    made = PROGRAMS / (patch or "plain")
    file = HERE / "without" / f"{patch}.patch"
    newest = max(int(git("log", "-1", "--format=%ct", *SOURCES)), file.stat().st_mtime if patch else 0.0)
    if made.exists() and made.stat().st_mtime > newest:
        return made
    if not patch:
        return shutil.copy(build(), made)
    git("apply", str(file))
    try:
        return shutil.copy(build(), made)
    finally:
        git("apply", "--reverse", str(file))


@cache
def plain(method: str) -> Count:
    return count(program(), HERE / f"{method}.toml", method, switches=STEPS, by_function=True)


def compared(before: float, now: float) -> list[object]:
    return [round(before), round(now), f"{now / before:.4f}"]


def unused(patch: Path) -> list[list[object]]:
    method = next(m for m in METHODS if patch.stem.startswith(m))
    without = count(program(patch.stem), HERE / f"{method}.toml", method, switches=STEPS)
    feature = patch.stem.removeprefix(method + "_").replace("_", " ")
    return [[feature, method, *compared(without.each_step(), plain(method).each_step())]]


def unused_threads(method: str) -> list[list[object]]:
    """Counted by functions: a build without OpenMP would be another program."""
    all_steps = plain(method)
    spent = sum(own for name, own in all_steps.functions.items() if THREADS.search(name))
    return [["threads (own functions)", method,
             *compared((all_steps.instructions - spent) / all_steps.steps, all_steps.each_step())]]


def used(feature: Feature) -> list[list[object]]:
    off, on = (count(program(), HERE / f"{feature.method}.toml", feature.method, settings, STEPS)
               for settings in (feature.off, feature.on))
    return [[feature.name, feature.method, *compared(off.each_step(), on.each_step())]]


def strip(columns: int = 256, rows: int = 16, spacing: float = 0.998) -> list[str]:
    """Settings for the grains of strip.toml."""
    PROGRAMS.mkdir(parents=True, exist_ok=True)
    path = PROGRAMS / "strip.csv"
    path.write_text("x,y,r\n" + "".join(f"{spacing * (c + 0.5)},{spacing * (r + 0.5)},0.5\n"
                                        for c in range(columns) for r in range(rows)))
    return [f"packing.path={path}"]


def saved(saving: Saving) -> list[list[object]]:
    patched = isinstance(saving.without, str)
    made = strip() if saving.scene == "strip.toml" else []
    without = count(program(saving.without if patched else ""), HERE / saving.scene, saving.method,
                    [*made, *([] if patched else saving.without)], WHOLE_LOOP)
    with_it = count(program(), HERE / saving.scene, saving.method, [*made, *saving.used], WHOLE_LOOP)
    return [[saving.name, saving.method, saving.scene, *compared(without.instructions, with_it.instructions),
             without.steps, with_it.steps, f"{with_it.mean_stress / without.mean_stress - 1.0:.1e}"]]


def written(what: str, function: str, of: str, method: str) -> list[list[object]]:
    """Where a row is observed, without the writers that are called with it."""
    with tempfile.TemporaryDirectory() as folder:
        run = [str(build("softgrain")), "run", str(HERE / f"{method}.toml"), "--method", method, "--threads", "1", "--quiet",
               "--set", "sampling.parts=true", "--out", folder, "--force"]
        writers = [f for _, f, _ in WRITTEN if f.endswith("::observe(*)")]
        spent, _ = instructions(run, [function, *(writers if function == "softgrain::TimeLoop::sample(*)" else [])])
        calls = {"row": len((Path(folder) / "history.csv").read_text().splitlines()) - 1,
                 "frame": (Path(folder) / "grains.pvd").read_text().count("<DataSet"),
                 "checkpoint": 1}[of]
    each = spent / calls
    return [[what, method, round(each), f"{each / plain(method).each_step():.2f}"]]


def table_of(name: str) -> tuple[list[str], list[Callable[[], list[list[object]]]]]:
    """The heads of a table's columns, and what counts its rows. Builds the programs, one after the other."""
    patches = [p for p in sorted((HERE / "without").glob("*.patch")) if p.stem.startswith("saved_") == (name == "saved")]
    for patch in ["", *(p.stem for p in patches if name in ("unused", "saved"))]:
        program(patch)
    if name == "unused":
        return (["feature", "method", "without", "with", "ratio"],
                [lambda p=p: unused(p) for p in patches] + [lambda m=m: unused_threads(m) for m in METHODS])
    if name == "used":
        return ["feature", "method", "plain", "used", "ratio"], [lambda f=f: used(f) for f in FEATURES]
    if name == "written":
        build("softgrain")
        return (["what", "method", "instructions", "steps"],
                [lambda w=w, m=m: written(*w, m) for w in WRITTEN for m in (["bpm"] if "parts" in w[0] else METHODS)])
    return (["what", "method", "scene", "without", "with", "ratio", "steps_without", "steps_with", "stress_difference"],
            [lambda s=s: saved(s) for s in SAVINGS])


def write(name: str) -> None:
    heads, rows = table_of(name)
    with ThreadPoolExecutor(max_workers=2) as pool:
        found = [row for some in pool.map(lambda rows_of: rows_of(), rows) for row in some]
    with (HERE / f"{name}.csv").open("w", newline="") as file:
        file.write(f"# {git('describe', '--always', '--abbrev=12')}, {made_with()}, preset count\n")
        csv.writer(file, lineterminator="\n").writerows([heads, *found])


def main() -> None:
    tables = ("unused", "used", "saved", "written")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", nargs="*", choices=[*tables, []], default=[])
    for name in parser.parse_args().table or tables:
        write(name)


if __name__ == "__main__":
    main()
