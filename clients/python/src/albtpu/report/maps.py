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
from .markup import line_name
from .verdict import CONTRIBUTIONS, Report

MEANS = ("elevation", "depth", "thu", "tvu")  # Means of cells; the others are counts and codes.
LARGEST_SIDE = 640  # Cells of a picture.
MOST_READ = 1 << 20  # Cells of the grid at a time.
MOST_NAMED_LINES = 60  # On the plan of lines.
# The names and colours of the codes of a layer, from 1.
CODES = {"order_met": ((*ORDERS, "none"), ("#00204d", "#31446b", "#666970", "#958f78", "#cbba69", RED)),
         "dominant_share": (tuple(CONTRIBUTIONS[share] for share in SHARES), SHARE_COLOURS),
         "gap": (("above the water", "outside the tables", "no surface", "no trajectory", "no channel"),
                 (BLUE, ORANGE, GREEN, PURPLE, RED))}


@dataclass
class Overview:
    """Rows from north to south; NaN where a cell has nothing."""

    layers: dict[str, Doubles]
    extent: tuple[float, float, float, float]  # West, east, south, north, in the unit of the coordinates.
    metres_per_unit: float


def read_overview(path: pathlib.Path, metres_per_unit: float) -> Overview:
    """Several cells become one: means weighted by points, sums of counts, and the largest code."""
    with netCDF4.Dataset(path) as grid:
        rows, columns = grid.dimensions["y"].size, grid.dimensions["x"].size
        first, last, top, bottom = _used(grid, rows, columns)
        step = max(1, -(-max(last - first, bottom - top) // LARGEST_SIDE))
        height, width = -(-(bottom - top) // step), -(-(last - first) // step)
        layers: dict[str, Doubles] = {name: np.full((height, width), np.nan) for name in (
            *MEANS, "order_met", "dominant_share", "gap", "without_number")}
        band = max(1, MOST_READ // (width * step**2))
        for row in range(0, height, band):
            rows_of = slice(top + row * step, min(top + (row + band) * step, bottom))
            _read_band(grid, rows_of, slice(first, last), step, slice(row, row + band), layers)
        x, y = grid["x"][:].data, grid["y"][:].data
        cell = abs(float(x[1] - x[0])) if columns > 1 else 1.0
        west, north = float(x[first]) - cell / 2, float(y[top]) + cell / 2
    side = step * cell
    return Overview(layers, (west, west + width * side, north - height * side, north), metres_per_unit)


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


def _read_band(grid: Any, rows: slice, columns: slice, step: int, band: slice, layers: dict[str, Doubles]) -> None:
    """Fills the rows `band` of the picture."""
    def blocks(name: str) -> Doubles:
        """By row and column of the picture, the cells of the grid there."""
        values = np.ma.filled(grid[name][rows, columns].astype(float), np.nan)
        height, width = (-(-size // step) for size in values.shape)
        if step > 1:
            padding = [(0, -size % step) for size in values.shape]
            values = np.pad(values, padding, constant_values=np.nan)
        return values.reshape(height, step, width, step).transpose(0, 2, 1, 3).reshape(height, width, step**2)

    points, without = np.nan_to_num(blocks("points")), np.nan_to_num(blocks("points_without_number"))
    weight = points - without
    known = weight.sum(axis=-1)
    for name in MEANS:
        sums = (np.nan_to_num(blocks(name)) * weight).sum(axis=-1)
        layers[name][band] = np.divide(sums, known, out=np.full(known.shape, np.nan), where=known > 0)
    for name in ("order_met", "gap"):
        layers[name][band] = _largest(blocks(name))
    layers["dominant_share"][band] = _most_points(blocks("dominant_share"), weight)
    count = points.sum(axis=-1)
    layers["without_number"][band] = np.where(count > 0, without.sum(axis=-1) / np.maximum(count, 1), np.nan)


def _largest(values: Doubles) -> Doubles:
    most = np.nan_to_num(values, nan=0).max(axis=-1)
    return np.where(most > 0, most, np.nan)


def _most_points(codes: Doubles, weight: Doubles) -> Doubles:
    """The code that most points have."""
    counts = np.stack([(weight * (codes == code)).sum(axis=-1) for code in range(1, len(SHARES) + 1)])
    return np.where(counts.sum(axis=0) > 0, counts.argmax(axis=0) + 1, np.nan)


def _axes(overview: Overview, title: str) -> tuple[Figure, Any]:
    """A map without anything on it but its graticule, scale and north."""
    west, east, south, north = overview.extent
    aspect = min(max((north - south) / (east - west), 0.35), 1.6)
    figure = Figure(figsize=(5.6, 1.2 + 4.2 * aspect))
    axes = figure.subplots()
    axes.set_title(title, fontsize=11)
    axes.set_xlim(west, east)
    axes.set_ylim(south, north)
    axes.set_aspect("equal")
    step = _round_length(max(east - west, north - south) / 3)
    axes.set_xticks(np.arange(math.ceil(west / step), math.floor(east / step) + 1) * step)
    axes.set_yticks(np.arange(math.ceil(south / step), math.floor(north / step) + 1) * step)
    axes.xaxis.set_major_formatter(_coordinate)
    axes.yaxis.set_major_formatter(_coordinate)
    axes.tick_params(labelsize=7)
    axes.tick_params(axis="y", labelrotation=90)
    for label in axes.get_yticklabels():
        label.set_verticalalignment("center")
    axes.grid(color="#999999", linewidth=0.4, alpha=0.7)
    # Scale and north stand below the map, which may be too flat to hold them.
    length = _round_length((east - west) * overview.metres_per_unit / 4)
    text = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
    points = figure.dpi_scale_trans
    below = axes.get_xaxis_transform() + ScaledTranslation(0, -26 / 72, points)
    corner = axes.transAxes + ScaledTranslation(-5 / 72, -14 / 72, points)
    axes.plot([west, west + length / overview.metres_per_unit], [0, 0], color="black", linewidth=3,
              solid_capstyle="butt", transform=below, clip_on=False)
    axes.annotate(text, (west + length / overview.metres_per_unit, 0), xycoords=below, xytext=(5, 0),
                  textcoords="offset points", va="center", fontsize=8, annotation_clip=False)
    axes.annotate("N", xy=(1, 0), xycoords=corner, xytext=(0, -26), textcoords="offset points", ha="center", fontsize=9,
                  arrowprops={"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0},
                  annotation_clip=False)
    return figure, axes


def _coordinate(value: float, _: float) -> str:
    return f"{value:,.0f}".replace(",", "\u202f") if value == round(value) else f"{value:.2f}"


def _map(overview: Overview, values: Doubles, title: str, **look: Any) -> tuple[Figure, Any, Any]:
    figure, axes = _axes(overview, title)
    shown = axes.imshow(values, extent=overview.extent, interpolation="nearest", aspect="equal", zorder=3, **look)
    return figure, axes, shown


def plan_of_lines(report: Report, overview: Overview) -> str:
    """Where each line was flown, with its number, and the largest void."""
    figure, axes = _axes(overview, "plan of lines")
    covered = np.where(np.isfinite(overview.layers["without_number"]), 1.0, np.nan)
    axes.imshow(covered, extent=overview.extent, interpolation="nearest", aspect="equal", zorder=1,
                cmap=ListedColormap(["#dce8f2"]), vmin=0, vmax=1)
    lines = [each for each in report["lines"] if any(each.get("path") or [])]
    for number, line in enumerate(lines):
        colour = (BLUE, ORANGE, GREEN, RED, PURPLE)[number % 5]
        places = [place or [math.nan, math.nan] for place in line["path"]]
        x, y = zip(*places)
        axes.plot(x, y, "-" if len(places) > 1 else ".", color=colour, linewidth=1.4, zorder=4)
        if len(lines) <= MOST_NAMED_LINES:
            axes.annotate(line_name(line), (x[0], y[0]), fontsize=8, color=colour, zorder=5, ha="center", va="center",
                          bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": colour, "lw": 0.6})
    void = report["bottom"]["largest_void"]
    if void is not None:
        axes.plot([void["x"]], [void["y"]], "x", color="black", zorder=6, markersize=7, label="largest void")
        axes.legend(fontsize=7, loc="upper right")
    return image(figure, f"map: plan of {len(report['lines'])} lines; means of their points")


def _round_length(length: float) -> float:
    power = 10.0 ** math.floor(math.log10(max(length, 1e-6)))
    return max(step * power for step in (1, 2, 5) if step * power <= length * 1.0000001)


def map_of_lengths(overview: Overview, layer: str, title: str) -> str:
    """A map of depth, THU or TVU in m."""
    values = overview.layers[layer]
    known = values[np.isfinite(values)]
    if known.size == 0:
        return "<p>No cell has an uncertainty.</p>"
    low, high = np.quantile(known, [0.01, 0.99])
    reverse = "_r" if layer == "depth" else ""  # Deep is dark.
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
        return ["<p>The uncertainty of every point was computed.</p>"]
    title = "points whose uncertainty was not computed"
    figure, axes, shown = _map(overview, 100 * overview.layers["without_number"], title, cmap="cividis", vmin=0,
                               vmax=100)
    figure.colorbar(shown, ax=axes, shrink=0.8, label="% of the points")
    return [image(figure, f"map: {title}"), map_of_codes(overview, "gap", "why it was not computed")]
