"""Runs made by the real program, once for all tests: SOFTGRAIN_EXECUTABLE, or that of build/release."""
import atexit
import os
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXECUTABLE = os.environ.get("SOFTGRAIN_EXECUTABLE", str(ROOT / "build/release/bin/softgrain"))
MEASURES = ("chains", "forces", "grains", "pair_correlation", "tessellation")

SCENARIO = """
title = "Thirty grains"
[material]
youngs_modulus = 1.0
poisson_ratio = 0.3
[packing]
count = 30
radius_mean = 1.0
radius_deviation = 0.2
[[loading]]
kind = "isotropic"
inertial_number = 1e-2
until_packing_fraction = 0.82
[sampling]
frame_every = 5
parts = true
measures = "forces,chains,grains,pair_correlation,tessellation"
[bpm]
discs_per_grain = 20
inertial_number = 3e-2
"""


def softgrain(*arguments: str | Path) -> subprocess.CompletedProcess:
    return subprocess.run([EXECUTABLE, *map(str, arguments)], check=True, capture_output=True, text=True,
                          env=os.environ | {"SOFTGRAIN_CACHE": "off", "OMP_WAIT_POLICY": "passive"})


@cache
def folder() -> Path:
    path = Path(tempfile.mkdtemp(prefix="softgrain_reader_"))
    atexit.register(shutil.rmtree, path, ignore_errors=True)
    (path / "scenario.toml").write_text(SCENARIO)
    return path


@cache
def comparison() -> Path:
    out = folder() / "comparison"
    softgrain("compare", folder() / "scenario.toml", "--methods", "sdem,bpm,rigid_dem", "--out", out, "--threads", 1,
              "--quiet", "--no-pictures")
    return out


@cache
def run(name: str, *settings: str, until: float = 0.82) -> Path:
    """By rigid_dem."""
    scenario = folder() / f"{name}.toml"
    scenario.write_text(SCENARIO.replace("0.82", str(until)))
    softgrain("run", scenario, "--method", "rigid_dem", "--out", folder() / name, "--threads", 1, "--quiet",
              *(word for setting in settings for word in ("--set", setting)))
    return folder() / name


@cache
def cycle() -> Path:
    """A comparison whose packing fraction goes up, down and up again."""
    scenario = folder() / "cycle.toml"
    loading = SCENARIO[SCENARIO.index("[[loading]]"):SCENARIO.index("[sampling]")]
    back = loading.replace("0.82", "0.79") + "reverse = true\n"
    scenario.write_text(SCENARIO.replace(loading, loading + back + loading))
    softgrain("compare", scenario, "--methods", "sdem", "--out", folder() / "cycle", "--threads", 1, "--quiet",
              "--no-pictures")
    return folder() / "cycle"


@cache
def periodic() -> Path:
    return run("periodic", "box.periodic=true", until=0.84)


@cache
def bare() -> Path:
    return run("bare", "sampling.outlines=false", "sampling.contacts=false", "sampling.measures=''")


def copy_of(source: Path, name: str) -> Path:
    """A copy to be damaged."""
    return Path(shutil.copytree(source, folder() / name))
