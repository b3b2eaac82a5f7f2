#!/usr/bin/env python3
"""run_commands.py ROOT BIN PAGE...: runs the ```bash blocks of each page in an empty folder, as from the project's folder
with its programs in BIN, and compares what they print with the ```text block that follows.

A block after a comment `<!-- not tested: reason -->` is left out. In a text block `...` stands for any text, and alone in a
line for any lines. Numbers may differ by 5 %, times, memory and percentages by anything.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from pages import Block, fenced_blocks

NUMBER = r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
NOT_COMPARED = re.compile(r"\s*(?:s\b|MB\b|%)")  # after a number: it differs from run to run, or is a small difference
PROGRESS = re.compile(r"^\w+ +\d+\.\d %  phi ")
TOLERANCE = 0.05
LONGEST = 120  # seconds of one block


def matches(shown: str, printed: str) -> bool:
    pattern, numbers = "", []
    for token in re.finditer(rf"\.\.\.|(?<![\w.]){NUMBER}|\s+|.", shown):
        text = token.group()
        if text == "...":
            pattern += ".*"
        elif re.fullmatch(NUMBER, text):
            pattern += f"({NUMBER})"
            numbers.append(None if NOT_COMPARED.match(shown, token.end()) else float(text))
        else:
            pattern += r"\s+" if text.isspace() else re.escape(text)
    found = re.fullmatch(pattern + r"\s*", printed)
    return found is not None and all(
        wanted is None or abs(float(got) - wanted) <= TOLERANCE * abs(wanted)
        for wanted, got in zip(numbers, found.groups())
    )


def difference(shown: str, printed: str) -> str | None:
    """The first line that is not as shown."""
    left = [line for line in printed.splitlines() if not PROGRESS.match(line)]
    skip = False
    for line in shown.splitlines():
        if line.strip() == "...":
            skip = True
            continue
        while left and skip and not matches(line, left[0]):
            left.pop(0)
        if not left or not matches(line, left[0]):
            return f"'{line}' was not printed" + (f", but '{left[0]}'" if left else "")
        left.pop(0)
        skip = False
    return f"'{left[0]}' is not shown" if left and not skip else None


def run(block: Block, folder: str) -> tuple[int, str]:
    try:
        done = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", block.text],
            cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            timeout=LONGEST, check=False, env={**os.environ, "LC_ALL": "C.UTF-8"},
        )
    except subprocess.TimeoutExpired:
        return -1, f"it took more than {LONGEST} s"
    return done.returncode, done.stdout


def faults_of(page: Path, root: Path, programs: Path) -> tuple[int, list[str]]:
    blocks = fenced_blocks(page.read_text(encoding="utf-8"))
    tested, faults = 0, []
    with tempfile.TemporaryDirectory(prefix="softgrain_docs_") as folder:
        (Path(folder) / "build/release").mkdir(parents=True)
        (Path(folder) / "build/release/bin").symlink_to(programs)
        (Path(folder) / "scenarios").symlink_to(root / "scenarios")
        for block, after in zip(blocks, blocks[1:] + [None]):
            if block.language != "bash" or block.before.startswith("<!-- not tested: "):
                continue
            tested += 1
            code, printed = run(block, folder)
            if code != 0:
                faults.append(f"{page}:{block.line}: exit code {code}:\n{block.text}{printed}")
                break
            if after is not None and after.language == "text":
                wrong = difference(after.text, printed)
                if wrong:
                    faults.append(f"{page}:{after.line}: {wrong}; all that was printed:\n{printed}")
    return tested, faults


def main() -> int:
    root, programs = (Path(argument).resolve() for argument in sys.argv[1:3])
    total, faults = 0, []
    for page in sys.argv[3:]:
        tested, wrong = faults_of(Path(page), root, programs)
        total += tested
        faults += wrong
    print("\n".join(faults) if faults else f"{total} blocks of {len(sys.argv) - 3} pages run and print what they show")
    return 1 if faults or total == 0 else 0


sys.exit(main())
