"""A comparison: the folder that `softgrain compare` writes, with one run per method."""
import os
import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

import numpy as np
import pandas as pd

from .errors import RunError
from .run import Run, open_run
from .tables import read_comments, read_table

_POINTS = 201  # of the grid that errors are taken on


class Comparison(Mapping[str, Run]):
    """The runs of a comparison by the name of their method. A method that refused the scenario has none."""

    def __init__(self, folder: str | os.PathLike):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise RunError(f"{self.folder}: no such folder; name the folder that softgrain compare --out wrote")
        if (self.folder / "history.csv").exists():
            raise RunError(f"{self.folder}: is one run, not a comparison; open it with open_run")
        self._runs = {path.parent.name: open_run(path.parent) for path in sorted(self.folder.glob("*/history.csv"))}
        if not self._runs:
            raise RunError(f"{self.folder}: holds no run; name the folder that softgrain compare --out wrote")

    def __getitem__(self, method: str) -> Run:
        return self._runs[method]

    def __iter__(self) -> Iterator[str]:
        return iter(self._runs)

    def __len__(self) -> int:
        return len(self._runs)

    def __repr__(self) -> str:
        return f"Comparison({', '.join(self)})"

    @cached_property
    def table(self) -> pd.DataFrame:
        """comparison.csv: mean_stress [N/m] and coordination numbers by method and packing fraction."""
        return read_table(self.folder / "comparison.csv",
                          "the comparison goes on, or was broken off: go on with softgrain compare --resume")

    @cached_property
    def initial_packing(self) -> pd.DataFrame:
        """A row per grain, before the loading: x, y, r [m], and class, aspect_ratio, angle [rad] where there are any.
        `attrs`: "units", and "box" with width and height [m]."""
        path = self.folder / "initial_packing.csv"
        cure = "make the comparison again"
        table = read_table(path, cure)
        box = re.search(r"box\.width = (\S+), box\.height = ([^\s,]+)", " ".join(read_comments(path)))
        if not box:
            raise RunError(f"{path}: its first line does not name the box; {cure}")
        table.attrs["box"] = (float(box[1]), float(box[2]))
        table.attrs["units"] = {name: {"x": "m", "y": "m", "r": "m", "angle": "rad"}.get(name, "") for name in table}
        return table

    def at(self, packing_fraction, column: str = "mean_stress") -> pd.DataFrame:
        """A row per packing fraction, a column per method: the value of a history column where the run first reaches
        that packing fraction, linear between samples; nan where it does not. Raises RunError for an unknown column.
        """
        phi = np.atleast_1d(np.asarray(packing_fraction, dtype=float))
        table = pd.DataFrame({method: _at(run.history, column, phi, str(run.folder)) for method, run in self.items()},
                             index=pd.Index(phi, name="packing_fraction"))
        table.attrs["units"] = next(iter(self.values())).units.get(column, "")
        return table

    def error(self, reference: str | pd.DataFrame, column: str = "mean_stress") -> pd.DataFrame:
        """A row per method: `error`, its relative L2 distance from the reference, and the packing fractions `from` and
        `to` that it is taken over:

            error = sqrt( integral (y - y_ref)^2 dphi / integral y_ref^2 dphi )

        over the packing fractions that both reach, with y(phi) as in `at` on 201 even points by the trapezoidal rule.
        Points where one of them has no value are left out; nan if none is left or the reference is 0 all over. Methods
        that end early are compared over a shorter range, so look at `to` before ranking them.

        `reference`: a method's name, or a table with the columns packing_fraction and `column`.
        """
        if isinstance(reference, str):
            if reference not in self:
                raise RunError(f"{self.folder}: holds no run of '{reference}'; there are {', '.join(self)}")
            truth, name = self[reference].history, str(self[reference].folder)
        else:
            truth, name = reference, "the reference"
        rows = {method: _distance(run.history, truth, column, str(run.folder), name)
                for method, run in self.items() if run.history is not truth}
        return pd.DataFrame.from_dict(rows, orient="index", columns=["error", "from", "to"]).rename_axis("method")


def open_comparison(folder: str | os.PathLike) -> Comparison:
    """Opens a comparison's folder. Raises RunError, whose message names the file and the cure."""
    return Comparison(folder)


def _column(table: pd.DataFrame, column: str, name: str) -> np.ndarray:
    if column not in table:
        raise RunError(f"{name}: has no column '{column}'; there are {', '.join(map(str, table))}")
    return table[column].to_numpy(dtype=float)


def _at(table: pd.DataFrame, column: str, packing_fractions: np.ndarray, name: str) -> np.ndarray:
    x, y = _column(table, "packing_fraction", name), _column(table, column, name)
    values = np.full(len(packing_fractions), np.nan)
    for k, phi in enumerate(packing_fractions):
        passed = np.flatnonzero((x[:-1] <= phi) & (phi <= x[1:]))
        if len(passed):
            i = passed[0]
            share = (phi - x[i]) / (x[i + 1] - x[i]) if x[i + 1] > x[i] else 0.0
            values[k] = y[i] + share * (y[i + 1] - y[i])
    return values


def _distance(table: pd.DataFrame, truth: pd.DataFrame, column: str, name: str,
              truth_name: str) -> tuple[float, float, float]:
    loadings = [_column(table, "packing_fraction", name), _column(truth, "packing_fraction", truth_name)]
    if not all(map(len, loadings)):
        return np.nan, np.nan, np.nan
    low, high = max(x[0] for x in loadings), min(np.nanmax(x) for x in loadings)
    if not high > low:
        return np.nan, np.nan, np.nan
    phi = np.linspace(low, high, _POINTS)
    expected = _at(truth, column, phi, truth_name)
    difference = _at(table, column, phi, name) - expected
    weight = np.isfinite(difference).astype(float)
    weight[[0, -1]] *= 0.5
    scale = np.sum(weight * np.nan_to_num(expected) ** 2)
    error = np.sqrt(np.sum(weight * np.nan_to_num(difference) ** 2) / scale) if scale > 0 else np.nan
    return float(error), float(low), float(high)
