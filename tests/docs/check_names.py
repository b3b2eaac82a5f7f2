#!/usr/bin/env python3
"""check_names.py ROOT BIN: every option of softgrain and every scenario key that a page names exists, and
docs/file_formats.md lists the columns of the history with their units."""
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from pages import fenced_blocks, markdown_pages, without_blocks

COMMAND = re.compile(r"\bsoftgrain(-render)? +([a-z]+)\b(.*)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
SET = re.compile(r"--set[ =]\"?([\w.]+)=")
PLACEHOLDERS = {"key", "table.key"}
FILE_ENDINGS = r"(?:cpp|hpp|h5|md|sh|csv|toml|json|png|pvd|vtp|py|awk|txt)"


class Program:
    def __init__(self, programs: Path):
        self.programs = programs
        self.helps: dict[tuple[str, ...], str] = {}
        self.commands = {False: self.listed_commands(("softgrain",)), True: self.listed_commands(("softgrain-render",))}
        self.keys = self.read_keys()
        self.tables = {key.partition(".")[0] for key in self.keys if "." in key}

    def output(self, words: tuple[str, ...]) -> str:
        if words not in self.helps:
            done = subprocess.run(
                [str(self.programs / words[0]), *words[1:]], stdout=subprocess.PIPE, text=True, check=True
            )
            self.helps[words] = done.stdout
        return self.helps[words]

    def listed_commands(self, words: tuple[str, ...]) -> set[str]:
        return set(re.findall(r"^  ([a-z]+)\s", self.output((*words, "--help")).partition("Subcommands:")[2], re.M))

    def options(self, render: bool, command: str) -> set[str]:
        """Of a command and of those below it."""
        words = ("softgrain-render" if render else "softgrain", command)
        found = set(OPTION.findall(self.output((*words, "--help")))) | {"--help"}
        for below in self.listed_commands(words):
            found |= set(OPTION.findall(self.output((*words, below, "--help"))))
        return found

    def all_options(self) -> set[str]:
        found = set(OPTION.findall(self.output(("softgrain-render", "--help"))))
        for render, commands in self.commands.items():
            for command in commands - {"render"}:
                found |= self.options(render, command)
        return found

    def read_keys(self) -> set[str]:
        keys, table = set(), ""
        for line in self.output(("softgrain", "list", "--keys")).splitlines():
            if begins := re.match(r"\[+(\w+)\]+", line):
                table = begins.group(1) + "."
            elif key := re.match(r"  (\w+) +(text|integer|number|boolean) ", line):
                keys.add(table + key.group(1))
        return keys

    def has_key(self, name: str) -> bool:
        """`table.key` or, of one of several tables, `table.0.key`."""
        return name in PLACEHOLDERS or re.sub(r"^(\w+)\.\d+\.", r"\1.", name) in self.keys


def options_of_others(root: Path) -> set[str]:
    """Of the project's scripts and smaller programs, by their sources."""
    found = set()
    for pattern in ("*.sh", "docs/**/*.sh", "scenarios/**/*.sh", "**/*.py", "tests/reference/**/*.cpp", "bench/**/*.cpp"):
        for source in root.glob(pattern):
            found |= set(OPTION.findall(source.read_text(encoding="utf-8")))
    return found


def command_faults(program: Program, line: str) -> list[str]:
    """Of a line of code that may call softgrain."""
    faults = []
    line = re.sub(r"(^|\s)#.*", "", line)
    found = COMMAND.search(line)
    if found:
        render, command, rest = found.group(1) is not None, found.group(2), found.group(3)
        if not render and command == "render" and rest.split()[:1] and rest.split()[0] in program.commands[True]:
            render, command = True, rest.split()[0]
        if command not in program.commands[render]:
            faults.append(f"softgrain{'-render' if render else ''} has no command '{command}'")
        elif command != "render":
            known = program.options(render, command)
            rest = re.split(r"[|;&>]", rest)[0]
            faults += [f"{command} has no option {o}" for o in OPTION.findall(rest) if o not in known]
    faults += [f"there is no scenario key {key}" for key in SET.findall(line) if not program.has_key(key)]
    return faults


def toml_faults(program: Program, text: str) -> list[str]:
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        return [f"not TOML: {error}"]
    faults = []
    for name, value in document.items():
        tables = value if isinstance(value, list) else [value]
        named = [f"{name}.{key}" for table in tables if isinstance(table, dict) for key in table] or [name]
        faults += [f"there is no scenario key {key}" for key in named if not program.has_key(key)]
    return faults


def span_faults(program: Program, span: str, other_options: set[str]) -> list[str]:
    """Of `code` in running text."""
    faults = command_faults(program, span)
    if span.startswith("--"):
        known = program.all_options()
        option = OPTION.match(span)
        if option and option.group() not in known | other_options:
            faults.append(f"there is no option {option.group()}")
    key = re.fullmatch(r"([a-z_]+)\.([a-z0-9_]+)(\s*=.*)?", span)
    if key and key.group(1) in program.tables and not re.fullmatch(FILE_ENDINGS, key.group(2)):
        if not program.has_key(f"{key.group(1)}.{key.group(2)}"):
            faults.append(f"there is no scenario key {key.group(1)}.{key.group(2)}")
    return faults


def page_faults(program: Program, page: Path, other_options: set[str]) -> list[str]:
    text = page.read_text(encoding="utf-8")
    faults = []
    for block in fenced_blocks(text):
        if block.language == "toml":
            faults += [f"{page}:{block.line}: {f}" for f in toml_faults(program, block.text)]
        elif block.language in ("bash", ""):
            code = block.text.replace("\\\n", " ")
            faults += [f"{page}:{block.line}: {f}" for line in code.splitlines() for f in command_faults(program, line)]
    for number, line in enumerate(without_blocks(text).splitlines(), 1):
        for span in re.findall(r"`([^`]+)`", line):
            faults += [f"{page}:{number}: {f}" for f in span_faults(program, span, other_options)]
        if line.startswith("    "):
            faults += [f"{page}:{number}: {f}" for f in command_faults(program, line)]
    return faults


def column_faults(program: Program, page: Path) -> list[str]:
    listed = program.output(("softgrain", "list")).partition("History columns\n")[2].partition("\n\n")[0]
    real = [tuple(line.split(maxsplit=1)) for line in listed.splitlines()]
    part = page.read_text(encoding="utf-8").partition("<!-- begin columns -->")[2].partition("<!-- end columns -->")[0]
    shown = re.findall(r"^\| `(\w+)` \| (\S+) \|", part, re.M)
    return [f"{page}: the history has the column {name} [{unit}]" for name, unit in real if (name, unit) not in shown] + [
        f"{page}: the history has no column {name} [{unit}]" for name, unit in shown if (name, unit) not in real
    ]


def main() -> int:
    root, program = Path(sys.argv[1]), Program(Path(sys.argv[2]))
    other_options = options_of_others(root)
    pages = [page for page in markdown_pages(root) if page.name != "CHANGELOG.md"]
    faults = [fault for page in pages for fault in page_faults(program, page, other_options)]
    faults += column_faults(program, root / "docs/file_formats.md")
    print("\n".join(faults) if faults else f"{len(pages)} pages name {len(program.keys)} keys and the options rightly")
    return 1 if faults or not program.keys else 0


sys.exit(main())
