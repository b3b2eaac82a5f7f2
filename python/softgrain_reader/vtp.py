"""The .vtp files of softgrain (VTK PolyData, appended raw data, zlib), without VTK."""
import zlib
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .errors import RunError

_TYPES = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "UInt8": "u1"}
_CURE = "make the run again"


@dataclass(frozen=True)
class Vtp:
    points: np.ndarray  #: [p, 2] in m
    connectivity: np.ndarray  #: points of all cells, one cell after the other
    offsets: np.ndarray  #: [n] where each cell's points end
    kind: str  #: of all cells: "Verts", "Lines" or "Polys"; "" if there is none
    point_data: dict[str, np.ndarray]  #: [p] or [p, components]
    cell_data: dict[str, np.ndarray]  #: [n] or [n, components]
    field_data: dict[str, np.ndarray]
    units: dict[str, str]  #: by array, where it has one


def read_vtp(path: Path) -> Vtp:
    """Raises RunError if the file is missing or damaged."""
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise RunError(f"{path}: cannot be read: {error.strerror}; {_CURE}") from None
    try:
        return _parse(raw)
    except (ElementTree.ParseError, zlib.error, ValueError, KeyError, TypeError, AttributeError,
            OverflowError) as error:
        raise RunError(f"{path}: damaged or cut off ({error}); {_CURE}") from None


def _parse(raw: bytes) -> Vtp:
    head, found, appended = raw.partition(b'<AppendedData encoding="raw">')
    if not found or not raw.rstrip().endswith(b"</VTKFile>"):
        raise ValueError("not a whole VTK file with raw appended data")
    root = ElementTree.fromstring(head + b"</VTKFile>")
    expected = {"type": "PolyData", "header_type": "UInt64", "compressor": "vtkZLibDataCompressor"}
    if any(root.get(key) != value for key, value in expected.items()):
        raise ValueError(f"expected {expected}")
    order = "<" if root.get("byte_order") == "LittleEndian" else ">"
    data = memoryview(appended)[appended.index(b"_") + 1:]
    units: dict[str, str] = {}

    def arrays(parent: ElementTree.Element | None) -> dict[str, np.ndarray]:
        result = {}
        for array in [] if parent is None else parent.findall("DataArray"):
            name = array.get("Name")
            values = _values(data, int(array.get("offset")), order, _TYPES[array.get("type")])
            components = int(array.get("NumberOfComponents", 1))
            result[name] = values.reshape(-1, components) if components > 1 else values
            for key in array.findall("InformationKey"):
                if key.get("name") == "UNITS_LABEL":
                    units[name] = key.text.strip()
        return result

    poly_data = root.find("PolyData")
    piece = poly_data.find("Piece")
    kind = next((k for k in ("Verts", "Lines", "Polys") if int(piece.get(f"NumberOf{k}")) > 0), "")
    cells = arrays(piece.find(kind)) if kind else {"connectivity": np.empty(0, "i8"), "offsets": np.empty(0, "i8")}
    points = next(iter(arrays(piece.find("Points")).values()), np.empty((0, 3)))
    vtp = Vtp(points[:, :2], cells["connectivity"], cells["offsets"], kind, arrays(piece.find("PointData")),
              arrays(piece.find("CellData")), arrays(poly_data.find("FieldData")), units)
    _check_sizes(vtp, int(piece.get("NumberOfPoints")), int(piece.get(f"NumberOf{kind}")) if kind else 0)
    return vtp


def _values(data: memoryview, at: int, order: str, kind: str) -> np.ndarray:
    """Decodes one array: number of blocks, size of a block and of the last one, compressed sizes, blocks."""
    blocks = int(np.frombuffer(data, order + "u8", 1, at)[0])
    sizes = np.frombuffer(data, order + "u8", blocks, at + 24).tolist() if blocks else []
    start = at + 24 + 8 * blocks
    parts = []
    for size in sizes:
        parts.append(zlib.decompress(data[start:start + size]))
        start += size
    return np.frombuffer(b"".join(parts), order + kind).astype(kind)


def _check_sizes(vtp: Vtp, points: int, cells: int) -> None:
    named = {"points": (len(vtp.points), points), "cells": (len(vtp.offsets), cells)}
    named |= {name: (len(values), points) for name, values in vtp.point_data.items()}
    named |= {name: (len(values), cells) for name, values in vtp.cell_data.items()}
    for name, (found, expected) in named.items():
        if found != expected:
            raise ValueError(f"{name}: {found} values, expected {expected}")
    if cells and (vtp.offsets[-1] != len(vtp.connectivity) or np.any(np.diff(vtp.offsets) < 0)):
        raise ValueError("its cells are not whole")
