"""Maps and charts as HTML images. Colours can be told apart by the colour-blind (Okabe and Ito 2008; cividis)."""

from __future__ import annotations

import base64
import html
import io
import math
from typing import Any

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.transforms import ScaledTranslation

from .limits import COVERAGES, SIGMAS, limit_at
from .overview import Array, Overview

Report = dict[str, Any]

ORDERS = ("exclusive", "special", "1a", "1b", "2", "none")
SHARES = ("air", "sea", "water", "datum")
BLUE, ORANGE, GREEN, RED, PURPLE, GREY = "#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#777777"
SHARE_COLOURS = (ORANGE, BLUE, GREEN, GREY)
MOST_BARS = 50  # Of a histogram.
GAPS = ("above water", "no answer", "no surface", "no trajectory")
GAP_COLOURS = (BLUE, ORANGE, GREEN, PURPLE)
ORDER_COLOURS = ("#00204d", "#31446b", "#666970", "#958f78", "#cbba69", RED)


def image(figure: Figure, words: str) -> str:
    """An <img> with its picture in it. `words` say what it shows to those who cannot see it."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=110, bbox_inches="tight", metadata={"Software": None})
    data = base64.b64encode(buffer.getvalue()).decode()
    return f'<img alt="{html.escape(words)}" src="data:image/png;base64,{data}">'


def _map(overview: Overview, values: Array, title: str, **look: Any) -> tuple[Figure, Any, Any]:
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


CODES = {"order_met": (ORDERS, ORDER_COLOURS), "dominant_share": (SHARES, SHARE_COLOURS), "gap": (GAPS, GAP_COLOURS)}


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


def chart(title: str, x: str, y: str) -> tuple[Figure, Any]:
    """An empty chart and its axes."""
    figure = Figure(figsize=(5.6, 3.7))
    axes = figure.subplots()
    axes.set_title(title, fontsize=11)
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    return figure, axes


def against_depth(report: Report, quantity: str) -> str:
    """THU or TVU against depth, with the limits of the wanted specification."""
    bins = [each for each in report["by_depth"] if each.get(quantity)]
    if not bins:
        return ""
    name = quantity.upper()
    figure, axes = chart(f"{name} against depth", "depth [m]", f"{name} at {COVERAGES[report['coverage']]} [m]")
    depth = np.array([each["from"] + 0.5 for each in bins])
    for key, style in (("median", "-"), ("p95", "--"), ("greatest", ":")):
        label = {"median": "median", "p95": "95 % of the points are below", "greatest": "greatest"}[key]
        axes.plot(depth, [each[quantity][key] for each in bins], style, color=BLUE, marker=".", label=label)
    ends = np.linspace(0, depth[-1] + 0.5, 60)
    highest = max(each[quantity]["greatest"] for each in bins)
    wanted = report["wanted"]["index"]
    direction = "horizontal" if quantity == "thu" else "vertical"
    for specification in report["specifications"]:
        for of in specification["classes"]:
            if of[direction] is None:
                continue
            if of["index"] != wanted and specification["title"] != report["wanted"]["specification"]:
                continue
            # A vertical limit can be stated at the coverage of the points; a horizontal one has no one factor.
            same = of["coverage"] == report["coverage"]
            factor = SIGMAS[report["coverage"]] / SIGMAS[of["coverage"]] if quantity == "tvu" else 1.0
            limits = [factor * limit_at(of[direction], d) for d in ends]
            if of["index"] == wanted:
                at = "" if same else (f", at {COVERAGES[report['coverage']]}" if quantity == "tvu" else
                                      f", which is at {COVERAGES[of['coverage']]}")
                label = f"limit of {specification['title']} {of['name']}{at}"
                axes.plot(ends, limits, color=RED, linewidth=2, label=label)
            elif limits[-1] < 2.5 * highest:
                axes.plot(ends, limits, color=GREY, linewidth=0.9)
                axes.annotate(of["name"], (ends[-1], limits[-1]), fontsize=7, color=GREY, va="bottom", ha="right")
    axes.set_ylim(0, None)
    axes.set_xlim(0, ends[-1])
    axes.legend(fontsize=8)
    return image(figure, f"chart: {name} against depth with its limits")


def shares_against_depth(report: Report) -> str:
    """The shares of the vertical variance, stacked."""
    bins = [each for each in report["by_depth"] if each.get("shares_vertical")]
    if not bins:
        return ""
    figure, axes = chart("shares of the vertical variance", "depth [m]", "%")
    depth = [each["from"] + 0.5 for each in bins]
    below = np.zeros(len(bins))
    for share, colour in zip(SHARES, SHARE_COLOURS):
        values = 100 * np.array([each["shares_vertical"][share] for each in bins])
        axes.bar(depth, values, width=1, bottom=below, color=colour, label=share, edgecolor="white", linewidth=0.3)
        below += values
    axes.set_ylim(0, 100)
    axes.legend(fontsize=8, ncols=4, loc="upper center", bbox_to_anchor=(0.5, -0.16), frameon=False)
    return image(figure, "chart: shares of the vertical variance against depth")


def histogram(report: Report, quantity: str) -> str:
    """How many points have which THU or TVU."""
    data = report["histograms"][quantity]
    counts = np.array(data["counts"], float)
    if counts.sum() == 0:
        return ""
    name = quantity.upper()
    figure, axes = chart(f"histogram of {name}", f"{name} at {COVERAGES[report['coverage']]} [m]",
                          "% of the points with a number")
    first, end = int(np.flatnonzero(counts)[0]), int(np.flatnonzero(counts)[-1]) + 1
    group = -(-(end - first) // MOST_BARS)
    counts = np.pad(counts[first:end], (0, -(end - first) % group)).reshape(-1, group).sum(axis=1)
    edges = data["step"] * (first + group * np.arange(len(counts)))
    axes.bar(edges, 100 * counts / counts.sum(), width=group * data["step"], align="edge", color=BLUE)
    return image(figure, f"chart: histogram of {name}")


def chi_squares(check: Report) -> str:
    """Reduced chi-square by depth and by incidence."""
    figure = Figure(figsize=(5.6, 3.7))
    for axes, (key, label) in zip(figure.subplots(1, 2, sharey=True),
                                  (("by_depth", "depth [m]"), ("by_incidence", "incidence [°]"))):
        bands = check[key]
        names = [f"{b['from']:g}–{b['to']:g}" if b["to"] is not None else f"≥ {b['from']:g}" for b in bands]
        axes.bar(range(len(bands)), [band["chi_square"] for band in bands], color=BLUE)
        axes.axhline(1, color=RED)
        axes.set_xticks(range(len(bands)), names, rotation=60, fontsize=7)
        axes.set_xlabel(label)
    figure.axes[0].set_ylabel("reduced chi-square")
    return image(figure, "chart: reduced chi-square by depth and by incidence; 1 where the prediction is right")


def over_time(report: Report) -> str:
    """Wind and the share of the sea by file, in the order of their times."""
    files = [each for each in report["files"] if each["first_time"] is not None and each.get("shares_vertical")]
    if len(files) < 2:
        return ""
    files.sort(key=lambda each: each["first_time"])
    start = files[0]["first_time"]
    hours = [(each["first_time"] - start) / 3600 for each in files]
    figure, axes = chart("sea, water and wind over time", "hours after the first point", "% of the vertical variance")
    for share, colour in (("sea", BLUE), ("water", GREEN)):
        axes.plot(hours, [100 * each["shares_vertical"][share] for each in files], "o-", color=colour, label=share)
    if all(isinstance(each["wind_speed"], (int, float)) for each in files):
        wind = axes.twinx()
        wind.plot(hours, [each["wind_speed"] for each in files], "s--", color=ORANGE)
        wind.set_ylabel("wind [m/s] (squares)")
        wind.set_ylim(0, None)
    axes.set_ylim(0, 100)
    axes.legend(fontsize=8)
    return image(figure, "chart: shares of sea and water, and wind, over time")
