"""run.h5: the history up to the last checkpoint, and the units of its columns."""
from dataclasses import dataclass
from pathlib import Path

import h5py

from .errors import RunError


@dataclass(frozen=True)
class RunFile:
    version: str  #: of softgrain
    method: str
    rows: int  #: of the history at the last checkpoint
    units: dict[str, str]  #: by column of the history; "" for a pure number


def read_run_file(path: Path) -> RunFile:
    """Reads every column, so that its checksum is tested. Raises RunError if the file is damaged."""
    try:
        with h5py.File(path, "r") as file:
            columns = file["history"]
            rows = {len(column[()]) for column in columns.values()}
            in_checkpoint = len(file["checkpoint/loop/history"][()])
            if len(rows) != 1 or in_checkpoint != len(columns) * max(rows):
                raise ValueError("the columns of its history differ in length")
            units = {name: _text(column.attrs.get("unit", b"")) for name, column in columns.items()}
            return RunFile(_text(file["version"][()]), _text(file["method"][()]), max(rows), units)
    except (OSError, KeyError, ValueError, RuntimeError, TypeError, AttributeError) as error:
        raise RunError(f"{path}: damaged or cut off ({error}); make the run again, or remove this file to read the "
                       "rest without units") from None


def _text(value: bytes | str) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)
