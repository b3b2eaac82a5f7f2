"""Instructions that a run of softgrain executes, counted by valgrind's callgrind: the same on a busy and an idle machine."""
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# What is counted: collection is switched on and off where these functions begin and end. Start-up and packing are left out.
WHOLE_LOOP = ["softgrain::TimeLoop::go(*)"]
STEPS = ["softgrain::TimeLoop::go(*)", "softgrain::TimeLoop::sample(*)"]


@dataclass
class Count:
    instructions: int
    steps: int
    grains: int
    mean_stress: float  # at the end [N/m]
    functions: dict[str, int]  # their own, without what they call; empty if not asked for

    def each_step(self) -> float:
        return self.instructions / self.steps


def build(target: str = "softgrain_counted_run") -> Path:
    """A program built as the preset `count` says: for processors that valgrind knows."""
    for command in (["cmake", "--preset", "count"], ["cmake", "--build", "--preset", "count", "--target", target]):
        subprocess.run(command, cwd=ROOT, check=True, stdout=sys.stderr)
    return ROOT / "build/count/bin" / target


def made_with() -> str:
    """The compiler and valgrind, on which counts depend."""
    return ", ".join(subprocess.run([tool, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
                     for tool in ("c++", "valgrind"))


def instructions(command: list[str], switches: list[str], profile: Path = Path("/dev/null"), options: list[str] = [],
                 cache: str = "off") -> tuple[int, str]:
    """Of a program while collection is on, and what it prints. Raises RuntimeError if it fails or nothing was counted."""
    callgrind = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}", *options]
    done = subprocess.run([*callgrind, *(f"--toggle-collect={function}" for function in switches), *command],
                          capture_output=True, text=True, env=os.environ | {"SOFTGRAIN_CACHE": cache})
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not collected or collected[1] == "0":
        own_words = [line for line in done.stderr.splitlines() if line and not line.startswith("==")]
        raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode} under valgrind; " + " ".join(own_words))
    return int(collected[1]), done.stdout


def count(program: Path, scenario: Path, method: str, settings: list[str] = [], switches: list[str] = WHOLE_LOOP,
          by_function: bool = False) -> Count:
    """A scenario's time loop on one thread."""
    with tempfile.TemporaryDirectory() as folder:
        profile = Path(folder) / "profile"
        collected, printed = instructions([str(program), str(scenario), method, *settings], switches, profile)
        functions = own_instructions(profile) if by_function else {}
    steps, grains, mean_stress = printed.split(",")
    return Count(collected, int(steps), int(grains), float(mean_stress), functions)


def own_instructions(profile: Path) -> dict[str, int]:
    listed = subprocess.run(["callgrind_annotate", "--threshold=100", "--show-percs=no", str(profile)],
                            capture_output=True, text=True, check=True).stdout
    found: dict[str, int] = {}
    for line in listed.splitlines():
        if row := re.match(r"\s*([\d,]+)\s+\S+?:(.+?)(?: \[/.*\])?$", line):
            found[row[2]] = found.get(row[2], 0) + int(row[1].replace(",", ""))
    return found
