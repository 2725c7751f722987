"""plan.html: the depth to which each order is met, and the highest wind or waves at which it is."""

from __future__ import annotations

import json
import pathlib
from typing import Any

import numpy as np

from .charts import BLUE, GREEN, GREY, ORANGE, ORDERS, PURPLE, chart, image
from .markup import numbers_table, table, text, verdict_box, write_document

Plan = dict[str, Any]

COLOURS = (PURPLE, GREEN, BLUE, ORANGE, GREY)
ENDS = {"table": "the table of the sea has no greater depths",
        "water": "the table of the water column has no greater depths"}


def write_plan(folder: pathlib.Path) -> None:
    """Makes plan.html in a folder that has plan.json."""
    plan: Plan = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
    pictures = "".join([_by_sea(plan), *(_over(plan, axis) for axis in plan["axes"])])
    write_document(folder / "plan.html", "Plan of a survey", (
        f"<h1>Plan: how deep can S-44 order {text(plan['order'])} be met?</h1>{_answer(plan)}"
        f"<div class='pictures'>{pictures}</div>"
        f"<h2>Highest {text(_words(plan))} for each depth and order</h2>{_highest(plan)}"
        f"<h2>Numbers and assumptions</h2>{numbers_table(plan['numbers'])}"))


def _words(plan: Plan) -> str:
    return "wind speed" if plan["sea"]["name"] == "wind_speed" else "significant wave height"


def _conditions(plan: Plan) -> str:
    return f"{plan['conditions']['altitude']:g} m of altitude and {plan['conditions']['incidence']:g}° of incidence"


def _answer(plan: Plan) -> str:
    unit, order = plan["sea"]["unit"], plan["order"]
    met = [each for each in plan["greatest_sea"] if each[order] is not None]
    items = [f"down to {each['depth']:g} m: up to {each[order]:g} {text(unit)}"
             f"{' (the highest planned)' if each[order] == plan['seas'][-1] else ''}" for each in met]
    none = [each["depth"] for each in plan["greatest_sea"] if each[order] is None]
    calmest = plan["planned"][0]
    end = ENDS.get(calmest["limited_by"][order])
    if none and end:
        items.append(f"deeper than {calmest['depth'][order] or 0:g} m: no answer, {end}")
    elif none:
        items.append(f"down to {none[0]:g} m and deeper: not at {plan['seas'][0]:g} {text(unit)} or more")
    return verdict_box("pass" if met else "fail", f"Order {order} at {_conditions(plan)}", items) + (
        "<p class='soft'>All contributions to the uncertainty count, at 95 %, and the biases. Whether the laser"
        " reaches the bottom at these depths is not considered.</p>")


def _by_sea(plan: Plan) -> str:
    figure, axes = chart(f"at {_conditions(plan)}", _label(plan), "depth down to which the order is met [m]")
    for order, colour in zip(ORDERS, COLOURS):
        width = 2.5 if order == plan["order"] else 1.2
        depths = [each["depth"][order] for each in plan["planned"]]
        axes.plot(plan["seas"], depths, marker=".", color=colour, linewidth=width,
                  linestyle="--" if order == "1b" else "-", label=order)
    axes.set_ylim(0, None)
    axes.invert_yaxis()
    axes.legend(fontsize=8, title="order")
    return image(figure, "chart: depth down to which each order is met, by wind or waves")


def _label(plan: Plan) -> str:
    return f"{plan['sea']['name'].replace('_', ' ')} [{plan['sea']['unit']}]"


def _over(plan: Plan, axis: dict[str, Any]) -> str:
    """Depths of the planned order, over the sea and another condition."""
    depth = np.array(axis["depth"][plan["order"]], float)  # NaN where the beam is outside a table.
    limits = axis["limited_by"][plan["order"]]
    name = "Kd at 532 nm" if axis["name"] == "kd" else axis["name"]
    ends = any(limit not in ("thu", "tvu") for row in limits for limit in row)
    figure, axes = chart(f"order {plan['order']}: depth [m] by {name}{'; +: limited by a table' if ends else ''}",
                         _label(plan), f"{name} [{axis['unit']}]")
    shown = axes.imshow(depth, origin="lower", aspect="auto", cmap="cividis_r", vmin=0)
    axes.grid(False)
    axes.set_xticks(range(len(plan["seas"])), [f"{each:g}" for each in plan["seas"]], fontsize=7)
    axes.set_yticks(range(len(axis["values"])), [f"{each:g}" for each in axis["values"]], fontsize=8)
    middle = np.nanmax(depth, initial=0) / 2
    for row, values in enumerate(depth):
        for column, value in enumerate(values):
            mark = "" if limits[row][column] in ("thu", "tvu") else "+"
            text = "–" if np.isnan(value) else f"{value:.0f}{mark}"
            axes.annotate(text, (column, row), ha="center", va="center", fontsize=6,
                          color="white" if value > middle else "black")
    figure.colorbar(shown, ax=axes, label="depth [m]")
    return image(figure, f"chart: depth down to which order {plan['order']} is met, by {name}")


def _highest(plan: Plan) -> str:
    unit = text(plan["sea"]["unit"])
    rows = [[f"{each['depth']:g}", *(f"{each[order]:g}" if each[order] is not None else "–" for order in ORDERS)]
            for each in plan["greatest_sea"]]
    note = "<p class='soft'>–: not met, or outside a table.</p>"
    return note + table([f"to a depth of [m] ↓ order, {unit} →", *ORDERS], rows)
