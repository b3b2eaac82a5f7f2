"""CSV tables as the program writes them."""
import io
from pathlib import Path

import pandas as pd

from .errors import RunError

_WHOLE_NUMBERS = ("grain", "chain", "driven", "class")
_TEXTS = ("method",)


def read_table(path: Path, cure: str, growing: bool = False) -> pd.DataFrame:
    """Comment lines that start with '#', a line of names, rows of equal length; every bit of a number is kept.

    Numbers are floats, but for ids. `cure` ends the message if the file is missing or cut off. `growing`: the file is
    being written, so a last line without its end is left out; otherwise that is an error.
    Raises RunError, also for a row of another length and for what is not a number.
    """
    try:
        lines = path.read_bytes().decode().split("\n")
    except FileNotFoundError:
        raise RunError(f"{path}: missing; {cure}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise RunError(f"{path}: cannot be read: {error}; {cure}") from None
    if lines.pop() and not growing:
        raise RunError(f"{path}: its last line is cut off; {cure}")
    first = next((k for k, line in enumerate(lines) if not line.startswith("#")), None)
    if first is None:
        raise RunError(f"{path}: it has no line of column names; {cure}")
    commas = lines[first].count(",")
    for number, line in enumerate(lines[first:], first + 1):
        if line.count(",") != commas or not line:
            found = line.count(",") + 1 if line else 0
            raise RunError(f"{path}:{number}: {found} values, expected {commas + 1}; {cure}")
    table = pd.read_csv(io.StringIO("\n".join(lines[first:])), float_precision="round_trip", low_memory=False,
                        index_col=False, keep_default_na=False, na_values=["nan", "-nan"])
    for name in table.columns.difference(_TEXTS):
        try:
            table[name] = table[name].astype(int if name in _WHOLE_NUMBERS else float)
        except ValueError as error:
            raise RunError(f"{path}: column {name}: {error}; {cure}") from None
    return table


def read_comments(path: Path) -> list[str]:
    """The lines that start with '#', without it. The file is there."""
    return [line[1:].strip() for line in path.read_text().splitlines() if line.startswith("#")]
