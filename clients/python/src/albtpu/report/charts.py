"""Charts as HTML images. The colour-blind can distinguish the colours (Okabe and Ito 2008; cividis)."""

from __future__ import annotations

import base64
import html
import io
import math
from typing import Any

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.figure import Figure

from ..s44 import FACTOR_95
from ..schema import S44_ORDERS
from .verdict import CONTRIBUTIONS, COVERAGES, Report

ORDERS = S44_ORDERS[1:]
SIGMAS = {"p95": 2 * FACTOR_95, "2sigma": 2.0, "1sigma": 1.0}  # Of one dimension.
SHARES = ("air", "sea", "water", "datum", "extra")
BLUE, ORANGE, GREEN, RED, PURPLE, GREY = "#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#777777"
SHARE_COLOURS = (ORANGE, BLUE, GREEN, GREY, PURPLE)
MOST_BARS = 50  # Of a histogram.


def image(figure: Figure, words: str) -> str:
    """An <img> with its picture in it. `words` say what it shows to those who cannot see it."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=110, bbox_inches="tight", metadata={"Software": None})
    data = base64.b64encode(buffer.getvalue()).decode()
    return f'<img alt="{html.escape(words)}" src="data:image/png;base64,{data}">'


def shares_of(report: Report) -> tuple[str, ...]:
    """The shares that a report shows: what the surveyor added only where there is something."""
    added = report["all"].get("shares_vertical", {}).get("extra", 0) > 0
    return SHARES if added else SHARES[:-1]


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


def limit_at(limit: dict[str, Any], depth: float) -> float:
    """The largest uncertainty in m that a limit allows at a depth in m."""
    of_depth: float = limit["of_depth"] * depth
    constant: float = limit["constant"]
    return math.hypot(constant, of_depth) if limit["combined"] == "rss" else constant + of_depth


def against_depth(report: Report, quantity: str) -> str:
    """THU or TVU against depth, with the limits of the wanted specification."""
    bins = [each for each in report["by_depth"] if each.get(quantity)]
    if not bins:
        return ""
    name = quantity.upper()
    figure, axes = chart(f"{name} against depth", "depth [m]", f"{name} at {COVERAGES[report['coverage']]} [m]")
    depth = np.array([each["from"] + 0.5 for each in bins])
    for key, style in (("median", "-"), ("p95", "--"), ("greatest", ":")):
        label = {"median": "median", "p95": "95 % of the points are below", "greatest": "maximum"}[key]
        axes.plot(depth, [each[quantity][key] for each in bins], style, color=BLUE, marker=".", label=label)
    ends = np.linspace(0, depth[-1] + 0.5, 60)
    highest = max(each[quantity]["greatest"] for each in bins)
    wanted = report["wanted"]["index"]
    direction = "horizontal" if quantity == "thu" else "vertical"
    for specification in report["specifications"]:
        for entry in specification["classes"]:
            if entry[direction] is None:
                continue
            if entry["index"] != wanted and specification["title"] != report["wanted"]["specification"]:
                continue
            # A vertical limit converts to the coverage of the points; for a horizontal one there is no single factor.
            same = entry["coverage"] == report["coverage"]
            factor = SIGMAS[report["coverage"]] / SIGMAS[entry["coverage"]] if quantity == "tvu" else 1.0
            limits = [factor * limit_at(entry[direction], d) for d in ends]
            if entry["index"] == wanted:
                at = "" if same else (f", at {COVERAGES[report['coverage']]}" if quantity == "tvu" else
                                      f", which is at {COVERAGES[entry['coverage']]}")
                label = f"limit of {specification['title']} {entry['name']}{at}"
                axes.plot(ends, limits, color=RED, linewidth=2, label=label)
            elif limits[-1] < 2.5 * highest:
                axes.plot(ends, limits, color=GREY, linewidth=0.9)
                axes.annotate(entry["name"], (ends[-1], limits[-1]), fontsize=7, color=GREY, va="bottom", ha="right")
    axes.set_ylim(0, None)
    axes.set_xlim(0, ends[-1])
    axes.legend(fontsize=8)
    return image(figure, f"chart: {name} against depth with its limits")


def shares_against_depth(report: Report) -> list[str]:
    """The contributions to the horizontal and to the vertical variance, stacked."""
    bands = report.get("contributions")
    if not bands:
        return []
    names = [f"{band['from']:g}" + (f"–{band['to']:g}" if band["to"] is not None else " +") for band in bands]
    pictures = []
    for direction in ("horizontal", "vertical"):
        figure, axes = chart(f"contributions to the {direction} variance", "depth [m]", "%")
        below = np.zeros(len(bands))
        for share, colour in zip(shares_of(report), SHARE_COLOURS):
            of = [band[f"sigma_{direction}"] for band in bands]
            values = 100 * np.array([each[share] ** 2 / max(each["total"] ** 2, 1e-30) for each in of])
            if not values.any():
                continue
            axes.bar(range(len(bands)), values, width=0.9, bottom=below, color=colour, label=CONTRIBUTIONS[share],
                     edgecolor="white", linewidth=0.3)
            below += values
        axes.set_xticks(range(len(bands)), names, fontsize=8)
        axes.set_ylim(0, 100)
        axes.legend(fontsize=8, ncols=3, loc="upper center", bbox_to_anchor=(0.5, -0.16), frameon=False)
        pictures.append(image(figure, f"chart: contributions to the {direction} variance against depth"))
    return pictures


def histogram(report: Report, quantity: str) -> str:
    """How many points have which THU or TVU."""
    data = report["histograms"][quantity]
    counts = np.array(data["counts"], float)
    if counts.sum() == 0:
        return ""
    name = quantity.upper()
    figure, axes = chart(f"histogram of {name}", f"{name} at {COVERAGES[report['coverage']]} [m]",
                          "% of the points")
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
    figure, axes = chart("sea surface, water column and wind over time", "hours after the first point",
                          "% of the vertical variance")
    for share, colour in (("sea", BLUE), ("water", GREEN)):
        axes.plot(hours, [100 * each["shares_vertical"][share] for each in files], "o-", color=colour,
                  label=CONTRIBUTIONS[share])
    if all(isinstance(each["wind_speed"], (int, float)) for each in files):
        wind = axes.twinx()
        wind.plot(hours, [each["wind_speed"] for each in files], "s--", color=ORANGE)
        wind.set_ylabel("wind [m/s] (squares)")
        wind.set_ylim(0, None)
    axes.set_ylim(0, 100)
    axes.legend(fontsize=8)
    return image(figure, "chart: contributions of sea surface and water column, and wind, over time")
