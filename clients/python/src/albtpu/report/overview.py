"""The grid of a report, coarse enough for a picture."""

from __future__ import annotations

import pathlib
from dataclasses import dataclass
from typing import Any

import netCDF4
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

MEANS = ("depth", "thu", "tvu")  # Means of cells; the others are counts and codes.
LARGEST_SIDE = 640  # Cells of a picture.


@dataclass
class Overview:
    """Rows from north to south; NaN where a cell has nothing."""

    layers: dict[str, Array]
    extent: tuple[float, float, float, float]  # West, east, south, north, from the least point of the survey; m


def read_overview(path: pathlib.Path, metres_per_unit: float) -> Overview:
    """Several cells become one: means weighted by points, sums of counts, and the largest code."""
    with netCDF4.Dataset(path) as grid:
        rows, columns = grid.dimensions["y"].size, grid.dimensions["x"].size
        first, last, top, bottom = _used(grid, rows, columns)
        step = max(1, -(-max(last - first, bottom - top) // LARGEST_SIDE))
        height, width = -(-(bottom - top) // step), -(-(last - first) // step)
        layers = {name: np.full((height, width), np.nan)
                  for name in (*MEANS, "order_met", "dominant_share", "gap", "without_number")}
        for row in range(height):
            rows_of = slice(top + row * step, min(top + (row + 1) * step, bottom))
            _read_row(grid, rows_of, slice(first, last), step, row, layers)
        x, y = grid["x"][:].data, grid["y"][:].data
        cell = abs(float(x[1] - x[0])) if columns > 1 else 1.0
    side = cell * metres_per_unit
    return Overview(layers, (0.0, width * step * side, 0.0, height * step * side))


def _used(grid: Any, rows: int, columns: int) -> tuple[int, int, int, int]:
    """The columns and rows around all points: first, last + 1, top, bottom + 1."""
    any_column = np.zeros(columns, bool)
    any_row = np.zeros(rows, bool)
    for begin in range(0, rows, 256):
        block = np.ma.filled(grid["points"][begin:begin + 256], 0) > 0
        any_column |= block.any(axis=0)
        any_row[begin:begin + 256] = block.any(axis=1)
    column, row = np.flatnonzero(any_column), np.flatnonzero(any_row)
    return int(column[0]), int(column[-1]) + 1, int(row[0]), int(row[-1]) + 1


def _read_row(grid: Any, rows: slice, columns: slice, step: int, row: int, layers: dict[str, Array]) -> None:
    def blocks(name: str) -> Array:
        values = np.ma.filled(grid[name][rows, columns].astype(float), np.nan)
        padding = -values.shape[1] % step
        values = np.pad(values, ((0, 0), (0, padding)), constant_values=np.nan)
        return values.reshape(values.shape[0], -1, step).transpose(1, 0, 2).reshape(-1, values.shape[0] * step)

    points, without = np.nan_to_num(blocks("points")), np.nan_to_num(blocks("points_without_number"))
    weight = points - without
    known = weight.sum(axis=1)
    for name in MEANS:
        sums = (np.nan_to_num(blocks(name)) * weight).sum(axis=1)
        layers[name][row] = np.divide(sums, known, out=np.full(known.shape, np.nan), where=known > 0)
    for name in ("order_met", "gap"):
        layers[name][row] = _largest(blocks(name))
    layers["dominant_share"][row] = _most_points(blocks("dominant_share"), weight)
    some = points.sum(axis=1) > 0
    layers["without_number"][row] = np.where(some, without.sum(axis=1) / np.maximum(points.sum(axis=1), 1), np.nan)


def _largest(values: Array) -> Array:
    most = np.nan_to_num(values, nan=0).max(axis=1)
    return np.where(most > 0, most, np.nan)


def _most_points(codes: Array, weight: Array) -> Array:
    """The code that most points have."""
    counts = np.stack([(weight * (codes == code)).sum(axis=1) for code in range(1, 5)])
    return np.where(counts.sum(axis=0) > 0, counts.argmax(axis=0) + 1, np.nan)
