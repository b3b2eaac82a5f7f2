"""One run: the folder that `softgrain run` writes, or one method's folder of `softgrain compare`."""
import json
import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from .errors import RunError
from .frames import Frame, Frames, frame_times
from .run_file import RunFile, read_run_file
from .tables import read_table


class Run:
    """A run that is over, goes on, or was broken off, as it was when it was opened."""

    def __init__(self, folder: str | os.PathLike):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise RunError(f"{self.folder}: no such folder; name the folder that softgrain run --out wrote")
        # In this order, because a run that goes on writes them in the opposite one.
        self._report = _read_report(self.folder / "run.json")
        path = self.folder / "run.h5"
        self._run_file: RunFile | None = read_run_file(path) if path.exists() else None
        self._frame_times = frame_times(self.folder)
        #: A row per sample, a column per quantity (`softgrain list`), all floats, nan where a quantity has no value;
        #: `attrs["units"]` is `units`.
        self.history: pd.DataFrame = self._read_history()

    def __repr__(self) -> str:
        return f"Run({self.method}, {len(self.history)} samples, {self.ended})"

    @property
    def is_finished(self) -> bool:
        """Its loading is done, or it left its range of validity; `ended` says which of them."""
        return self._report is not None and self._report["exit_code"] == 0

    @property
    def ended(self) -> str:
        """Why the run is over; of one without a report that it is not."""
        return self._report["ended"] if self._report else "goes on, or was broken off"

    @property
    def method(self) -> str:
        """sdem, bpm, rigid_dem or mpm; of a run before its first checkpoint the folder's name."""
        if self._report:
            return self._report["method"]
        return self._run_file.method if self._run_file else self.folder.name

    @property
    def report(self) -> dict[str, Any]:
        """run.json: version, seed, threads, ended, exit_code, grains, steps, simulated_time, time_step, wall_time,
        cpu_time [s], peak_memory [bytes], samples, frames and more. Raises RunError while there is none."""
        if self._report is None:
            raise RunError(f"{self.folder / 'run.json'}: missing: the run goes on, or was broken off; wait for its "
                           "end, or go on with softgrain run --resume")
        return self._report

    @property
    def committed_rows(self) -> int:
        """Rows of the history that a resumed run keeps: those before the last checkpoint."""
        return self._run_file.rows if self._run_file else 0

    @property
    def units(self) -> dict[str, str]:
        """By column of the history, "" for a pure number; from run.h5, so empty before the first checkpoint."""
        return dict(self._run_file.units) if self._run_file else {}

    @cached_property
    def scenario(self) -> dict[str, Any]:
        """scenario.toml: the scenario with all defaults filled in, as nested dicts."""
        path = self.folder / "scenario.toml"
        try:
            return tomllib.loads(path.read_text())
        except OSError as error:
            raise RunError(f"{path}: cannot be read: {error.strerror}; make the run again") from None
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise RunError(f"{path}: damaged ({error}); make the run again") from None

    @cached_property
    def frames(self) -> Frames:
        """The frames written so far. Raises RunError if files of a finished run are missing."""
        expected = self._report["frames"] if self.is_finished else len(self._frame_times)
        if len(self._frame_times) != expected:
            raise RunError(f"{self.folder / 'grains.pvd'}: {len(self._frame_times)} frames of {expected} are listed by "
                           "it, walls.pvd and contacts.pvd; make the run again")
        rows = self.history.drop_duplicates("time").set_index("time", drop=False)
        try:
            return Frames([Frame(self.folder, k, rows.loc[time]) for k, time in enumerate(self._frame_times)])
        except KeyError as error:
            raise RunError(f"{self.folder / 'history.csv'}: has no row at time {error} of a frame; it is of another "
                           "run than grains.pvd: make the run again") from None

    @cached_property
    def measures(self) -> Mapping[str, "Measure"]:
        """The tables that sampling.measures asked for: a sequence with a DataFrame per frame, by name (forces, chains,
        grains, pair_correlation, tessellation). Empty if none were."""
        found: dict[str, list[Path]] = {}
        for path in sorted((self.folder / "measures").glob("*.csv")):
            named = re.fullmatch(r"(\w+)_(\d{6,})\.csv", path.name)
            # Centres are what the program itself needs for the next frame's strains.
            if not named or named[1] == "centres":
                continue
            paths = found.setdefault(named[1], [])
            if int(named[2]) != len(paths):
                raise RunError(f"{path}: the frame before it is missing; make the run again")
            paths.append(path)
        if self.is_finished:
            for name, paths in found.items():
                if len(paths) != self._report["frames"]:
                    raise RunError(f"{paths[-1]}: is the last of {len(paths)} frames of {self._report['frames']}; make "
                                   "the run again")
        return {name: Measure(paths) for name, paths in found.items()}

    def _read_history(self) -> pd.DataFrame:
        path = self.folder / "history.csv"
        restore = "softgrain run --resume with the same scenario writes it anew from run.h5" if self._run_file else (
            "this is not the folder of a run, or its run made no sample; make the run again")
        history = read_table(path, restore, growing=not self.is_finished).astype(float)
        expected = self._report["samples"] if self.is_finished else self.committed_rows
        if len(history) < expected or (self.is_finished and len(history) > expected):
            source = "run.json" if self.is_finished else "run.h5"
            raise RunError(f"{path}: {len(history)} rows, but {source} says {expected}; {restore}")
        if self._run_file and set(history.columns) != set(self._run_file.units):
            raise RunError(f"{path}: its columns are not those of run.h5; {restore}")
        history.attrs["units"] = self.units
        return history


class Measure(Sequence[pd.DataFrame]):
    """One measure: a table per frame, read when asked for."""

    def __init__(self, paths: list[Path]):
        self._paths = paths

    def __len__(self) -> int:
        return len(self._paths)

    def __getitem__(self, number):
        if isinstance(number, slice):
            return [self[k] for k in range(*number.indices(len(self)))]
        return read_table(self._paths[number], "make the run again")


def open_run(folder: str | os.PathLike) -> Run:
    """Opens a run's folder. Raises RunError, whose message names the file and the cure."""
    return Run(folder)


def _read_report(path: Path) -> dict[str, Any] | None:
    try:
        report = json.loads(path.read_text())
    except FileNotFoundError:
        return None
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: damaged or cut off ({error}); softgrain run --resume writes it anew") from None
    missing = {"method", "ended", "exit_code", "samples", "frames"} - set(report if isinstance(report, dict) else ())
    if missing:
        raise RunError(f"{path}: damaged: {', '.join(sorted(missing))} missing; softgrain run --resume writes it anew")
    return report
