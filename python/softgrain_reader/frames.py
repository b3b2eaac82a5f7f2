"""The frames of a run: grains, outlines, contacts and walls at some of its samples."""
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pandas as pd

from .errors import RunError
from .vtp import Vtp, read_vtp

WALLS = ("left", "right", "bottom", "top")
_SUFFIXES = {1: ("",), 3: ("_x", "_y"), 9: ("_xx", "_xy", "_yx", "_yy")}
_PLACES = {1: (0,), 3: (0, 1), 9: (0, 1, 3, 4)}


class Frame:
    """One frame. Files are read when asked for, and kept. Every table has `attrs["units"]`, a unit by column ("" for a
    pure number); vectors are columns name_x and name_y, tensors name_xx, name_xy, name_yx and name_yy."""

    def __init__(self, folder: Path, number: int, row: pd.Series):
        self._folder = folder
        self.number = number
        #: The row of the history at this frame; a Series by column.
        self.history = row
        self.time = float(row["time"])  #: [s]
        self.packing_fraction = float(row["packing_fraction"])

    def __repr__(self) -> str:
        return f"Frame({self.number}, time={self.time:.6g} s, packing_fraction={self.packing_fraction:.4f})"

    @cached_property
    def grains(self) -> pd.DataFrame:
        """A row per grain (index: its number; driven grains come last): x, y [m] of its centroid, velocity, mass,
        areas, stress, mean_stress, deviatoric_stress, shape, and the method's own fields.

        The centroid is that of the outline's area; the centre of mass is up to 1.5 % of a radius away from it with BPM
        (30 discs a grain), 1 % with SDEM and 0.4 % with MPM (at a packing fraction of 0.93), 0 with rigid DEM. Where a
        run has no outlines, and in the measure `grains`, it is the method's own. In a periodic cell grains lie where
        they are drawn: each with its centroid in the cell.
        """
        file = self._grain_file
        table = _table(file.cell_data, file.units).set_index("grain")
        centroids = _area_centroids(file) if file.kind == "Polys" else file.points
        table.insert(0, "x", centroids[:, 0])
        table.insert(1, "y", centroids[:, 1])
        table.attrs["units"] |= {"x": "m", "y": "m"}
        return table

    @cached_property
    def outlines(self) -> list[np.ndarray]:
        """[grains] of [n, 2]: corners of each grain, counter-clockwise, not repeated at the end [m]."""
        file = self._grain_file
        if file.kind == "Verts":
            raise RunError(f"{self._path('grains')}: this run was made with sampling.outlines = false; make it again "
                           "with outlines")
        return np.split(file.points[file.connectivity], file.offsets[:-1])

    @cached_property
    def contacts(self) -> pd.DataFrame:
        """A row per contact: grain_i, grain_j (-1 left, -2 right, -3 bottom, -4 top wall), is_wall, x, y [m] of its
        point, normal_force (compression positive), tangential_force, force (on grain_i) [N], normal (out of grain_i),
        contact_length [m].

        Across a periodic cell the point is the one beside grain_i; at a wall it is the nearest on the wall.
        """
        file = self._read("contacts", "the run was made with sampling.contacts = false; make it again with contacts")
        table = _table(file.cell_data, file.units)
        starts = np.concatenate([[0], file.offsets[:-1]]).astype(int)[:len(file.offsets)]
        points = file.points[file.connectivity[starts + 1]]
        table.insert(0, "x", points[:, 0])
        table.insert(1, "y", points[:, 1])
        table["is_wall"] = table["is_wall"].astype(bool)
        # Across a cell a contact is drawn as two lines of two points, one after the other; at a wall as one.
        is_half = (file.offsets - starts == 2) & ~table["is_wall"]
        is_second = is_half & (np.cumsum(is_half) % 2 == 0)
        units = table.attrs["units"] | {"x": "m", "y": "m"}
        first_columns = ["grain_i", "grain_j", "is_wall"]
        table = table[~is_second].reset_index(drop=True)
        table = table[first_columns + [c for c in table.columns if c not in first_columns]]
        table.attrs["units"] = units
        return table

    @cached_property
    def walls(self) -> pd.DataFrame:
        """Index left, right, bottom, top: x0, y0, x1, y1 [m] of the ends, wall_force (on the wall), normal_force
        (outward) [N], wall_stress [N/m]. `attrs["periodic"]`: these are edges of a periodic cell, without forces."""
        file = self._read("walls", "make the run again")
        table = _table(file.cell_data, file.units).drop(columns="wall")
        ends = file.points[file.connectivity].reshape(-1, 4)
        for k, name in enumerate(("x0", "y0", "x1", "y1")):
            table.insert(k, name, ends[:, k])
            table.attrs["units"][name] = "m"
        table.index = pd.Index([WALLS[wall] for wall in file.cell_data["wall"]], name="wall")
        table.attrs["periodic"] = "periodic" in file.field_data
        return table

    @cached_property
    def parts(self) -> pd.DataFrame:
        """A row per part of the grains (the discs of BPM): x, y [m], grain, radius, displacement, the method's own
        fields. Only of runs with sampling.parts = true."""
        file = self._read("parts", "grains of this method have no parts, or the run was made without "
                          "sampling.parts = true")
        table = _table(file.point_data, file.units)
        table.insert(0, "x", file.points[:, 0])
        table.insert(1, "y", file.points[:, 1])
        table.attrs["units"] |= {"x": "m", "y": "m"}
        return table

    @cached_property
    def _grain_file(self) -> Vtp:
        return self._read("grains", "make the run again")

    def _path(self, name: str) -> Path:
        return self._folder / name / f"{name}_{self.number:06d}.vtp"

    def _read(self, name: str, why_missing: str) -> Vtp:
        if not (self._folder / f"{name}.pvd").exists():
            raise RunError(f"{self._folder / name}.pvd: missing; {why_missing}")
        file = read_vtp(self._path(name))
        if file.field_data.get("TimeValue", [None])[0] != self.time:
            raise RunError(f"{self._path(name)}: is of another time than {self.time} s: it was replaced while it was "
                           "read; open the run again")
        return file


class Frames(Sequence[Frame]):
    """The frames that are complete, in the order of time."""

    def __init__(self, frames: list[Frame]):
        self._frames = frames

    def __len__(self) -> int:
        return len(self._frames)

    def __getitem__(self, number):
        return self._frames[number]

    def nearest(self, packing_fraction: float) -> Frame:
        """The frame whose packing fraction is nearest, the first of equals. Raises RunError if there is no frame."""
        if not self._frames:
            raise RunError("this run has no frame yet; wait for its first one")
        return min(self._frames, key=lambda frame: abs(frame.packing_fraction - packing_fraction))


def frame_times(folder: Path) -> list[float]:
    """Times [s] of the frames that every series of the run has. Raises RunError if a list of frames is damaged."""
    series = []
    for name in ("grains", "walls", "contacts"):
        path = folder / f"{name}.pvd"
        if not path.exists():
            continue
        try:
            series.append([float(frame.get("timestep")) for frame in ElementTree.parse(path).iter("DataSet")])
        except (ElementTree.ParseError, TypeError, ValueError) as error:
            raise RunError(f"{path}: damaged or cut off ({error}); make the run again, or remove it to read the rest "
                           "without frames") from None
    return min(series, key=len, default=[])


def _table(arrays: dict[str, np.ndarray], units: dict[str, str]) -> pd.DataFrame:
    columns, column_units = {}, {}
    for name, values in arrays.items():
        values = values[:, None] if values.ndim == 1 else values
        unit = "" if units.get(name) == "1" else units.get(name, "")
        for suffix, place in zip(_SUFFIXES[values.shape[1]], _PLACES[values.shape[1]]):
            columns[name + suffix] = values[:, place]
            column_units[name + suffix] = unit
    table = pd.DataFrame(columns)
    table.attrs["units"] = column_units
    return table


def _area_centroids(file: Vtp) -> np.ndarray:
    """[n, 2] of the polygons, by the shoelace formula about each one's first corner."""
    cells = len(file.offsets)
    sizes = np.diff(file.offsets, prepend=0)
    starts = file.offsets - sizes
    owner = np.repeat(np.arange(cells), sizes)
    corners = file.points[file.connectivity]
    origin = corners[starts]
    here = corners - origin[owner]
    following = np.arange(len(corners)) + 1
    following[file.offsets - 1] = starts
    there = here[following]
    cross = here[:, 0] * there[:, 1] - there[:, 0] * here[:, 1]
    area = np.bincount(owner, cross, cells) / 2.0
    moment = np.stack([np.bincount(owner, cross * (here[:, a] + there[:, a]), cells) for a in (0, 1)], axis=1)
    return origin + moment / (6.0 * area[:, None])
