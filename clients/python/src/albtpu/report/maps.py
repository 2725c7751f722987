"""Maps of the grid of a report, coarse enough for a picture."""

from __future__ import annotations

import math
import pathlib
from dataclasses import dataclass
from typing import Any

import netCDF4
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.transforms import ScaledTranslation

from ..schema import Doubles
from .charts import BLUE, GREEN, ORANGE, ORDERS, PURPLE, RED, SHARE_COLOURS, SHARES, image

MEANS = ("depth", "thu", "tvu")  # Means of cells; the others are counts and codes.
LARGEST_SIDE = 640  # Cells of a picture.
# The names and colours of the codes of a layer, from 1.
CODES = {"order_met": ((*ORDERS, "none"), ("#00204d", "#31446b", "#666970", "#958f78", "#cbba69", RED)),
         "dominant_share": (SHARES, SHARE_COLOURS),
         "gap": (("above water", "no answer", "no surface", "no trajectory", "no channel"),
                 (BLUE, ORANGE, GREEN, PURPLE, RED))}


@dataclass
class Overview:
    """Rows from north to south; NaN where a cell has nothing."""

    layers: dict[str, Doubles]
    extent: tuple[float, float, float, float]  # West, east, south, north, from the least point of the survey; m


def read_overview(path: pathlib.Path, metres_per_unit: float) -> Overview:
    """Several cells become one: means weighted by points, sums of counts, and the largest code."""
    with netCDF4.Dataset(path) as grid:
        rows, columns = grid.dimensions["y"].size, grid.dimensions["x"].size
        first, last, top, bottom = _used(grid, rows, columns)
        step = max(1, -(-max(last - first, bottom - top) // LARGEST_SIDE))
        height, width = -(-(bottom - top) // step), -(-(last - first) // step)
        layers: dict[str, Doubles] = {name: np.full((height, width), np.nan) for name in (
            *MEANS, "order_met", "dominant_share", "gap", "without_number")}
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


def _read_row(grid: Any, rows: slice, columns: slice, step: int, row: int, layers: dict[str, Doubles]) -> None:
    def blocks(name: str) -> Doubles:
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


def _largest(values: Doubles) -> Doubles:
    most = np.nan_to_num(values, nan=0).max(axis=1)
    return np.where(most > 0, most, np.nan)


def _most_points(codes: Doubles, weight: Doubles) -> Doubles:
    """The code that most points have."""
    counts = np.stack([(weight * (codes == code)).sum(axis=1) for code in range(1, 5)])
    return np.where(counts.sum(axis=0) > 0, counts.argmax(axis=0) + 1, np.nan)


def _map(overview: Overview, values: Doubles, title: str, **look: Any) -> tuple[Figure, Any, Any]:
    west, east, south, north = overview.extent
    aspect = min(max((north - south) / (east - west), 0.35), 1.6)
    figure = Figure(figsize=(5.6, 0.9 + 4.2 * aspect))
    axes = figure.subplots()
    shown = axes.imshow(values, extent=overview.extent, interpolation="nearest", aspect="equal", **look)
    axes.set_title(title, fontsize=11)
    axes.set_xticks([])
    axes.set_yticks([])
    # Scale and north stand below the map, which may be too flat to hold them.
    length = _round_length((east - west) / 4)
    text = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
    points = figure.dpi_scale_trans
    below = axes.get_xaxis_transform() + ScaledTranslation(0, -10 / 72, points)
    corner = axes.transAxes + ScaledTranslation(-5 / 72, -2 / 72, points)
    axes.plot([west, west + length], [0, 0], color="black", linewidth=3, solid_capstyle="butt", transform=below,
              clip_on=False)
    axes.annotate(text, (west + length, 0), xycoords=below, xytext=(5, 0), textcoords="offset points", va="center",
                  fontsize=8, annotation_clip=False)
    axes.annotate("N", xy=(1, 0), xycoords=corner, xytext=(0, -26), textcoords="offset points", ha="center", fontsize=9,
                  arrowprops={"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0},
                  annotation_clip=False)
    return figure, axes, shown


def _round_length(length: float) -> float:
    power = 10.0 ** math.floor(math.log10(max(length, 1e-6)))
    return max(step * power for step in (1, 2, 5) if step * power <= length * 1.0000001)


def map_of_lengths(overview: Overview, layer: str, title: str) -> str:
    """A map of depth, THU or TVU in m."""
    values = overview.layers[layer]
    known = values[np.isfinite(values)]
    if known.size == 0:
        return "<p>No cell has a number.</p>"
    low, high = np.quantile(known, [0.01, 0.99])
    reverse = "_r" if layer == "depth" else ""
    figure, axes, shown = _map(overview, values, title, cmap=f"cividis{reverse}", vmin=low, vmax=max(high, low + 1e-3))
    figure.colorbar(shown, ax=axes, shrink=0.8, label="m", extend="both")
    return image(figure, f"map: {title}, {low:.2f} to {high:.2f} m")


def map_of_codes(overview: Overview, layer: str, title: str) -> str:
    """A map of the order that is met, of the share that dominates, or of why points have no number."""
    names, colours = CODES[layer]
    norm = BoundaryNorm(np.arange(0.5, len(names) + 1), len(names))
    figure, axes, shown = _map(overview, overview.layers[layer], title, cmap=ListedColormap(colours), norm=norm)
    bar = figure.colorbar(shown, ax=axes, shrink=0.8, ticks=range(1, len(names) + 1))
    bar.ax.set_yticklabels(names)
    return image(figure, f"map: {title}")


def maps_of_gaps(overview: Overview) -> list[str]:
    """Where points have no number, and why."""
    if not np.nanmax(overview.layers["without_number"]) > 0:
        return ["<p>Every point has a number.</p>"]
    title = "points without a number"
    figure, axes, shown = _map(overview, 100 * overview.layers["without_number"], title, cmap="cividis", vmin=0,
                               vmax=100)
    figure.colorbar(shown, ax=axes, shrink=0.8, label="% of the points")
    return [image(figure, f"map: {title}"), map_of_codes(overview, "gap", "why points have no number")]
