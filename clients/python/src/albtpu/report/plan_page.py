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
    if "hours" in plan:
        answer, table_of_all = _answer_of_hours(plan), _table_of_hours(plan)
        title = "Share of hours in which each order is met, by depth"
        pictures = "".join([_by_depth(plan), *(_hours_over(plan, axis) for axis in plan["axes"])])
    else:
        answer, table_of_all = _answer(plan), _highest(plan)
        title = f"Highest {text(_words(plan))} for each depth and order"
        pictures = "".join([_by_sea(plan), *(_over(plan, axis) for axis in plan["axes"])])
    write_document(folder / "plan.html", "Plan of a survey", (
        f"<h1>Plan: how deep can S-44 order {text(plan['order'])} be met?</h1>{answer}"
        f"<div class='pictures'>{pictures}</div><h2>{title}</h2>{table_of_all}"
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


def _span(plan: Plan) -> str:
    hours = plan["hours"]
    return f"{hours['count']} hours from {hours['first']} to {hours['last']}"


def _answer_of_hours(plan: Plan) -> str:
    order, hours = plan["order"], plan["hours"]
    items = [f"down to {each['depth']:g} m: in {100 * each['share'][order]:.1f} % of the hours"
             f"{' (in some no table answers so deep)' if each['no_answer'][order] > 0 else ''}"
             for each in hours["by_depth"]]
    if hours["without_sea"]:
        items.append(f"{hours['without_sea']} hours more have no sea, in gaps of its file")
    met = hours["by_depth"][0]["share"][order] > 0
    return verdict_box("pass" if met else "fail", f"Order {order} at {_conditions(plan)}, {_span(plan)}", items) + (
        "<p class='soft'>All contributions to the uncertainty count, at 95 %, and the biases. Tides are not considered,"
        " nor whether the laser reaches the bottom at these depths.</p>")


def _by_depth(plan: Plan) -> str:
    figure, axes = chart(f"at {_conditions(plan)}", "depth [m]", "share of hours in which the order is met [%]")
    depths = [each["depth"] for each in plan["hours"]["by_depth"]]
    for order, colour in zip(ORDERS, COLOURS):
        shares = [100 * each["share"][order] for each in plan["hours"]["by_depth"]]
        axes.plot(depths, shares, marker=".", color=colour, linewidth=2.5 if order == plan["order"] else 1.2,
                  linestyle="--" if order == "1b" else "-", label=order)
    axes.set_ylim(0, 102)
    axes.legend(fontsize=8, title="order")
    return image(figure, "chart: share of hours in which each order is met, by depth")


def _hours_over(plan: Plan, axis: dict[str, Any]) -> str:
    """Shares of the planned order, over depth and another condition."""
    share = 100 * np.array(axis["share"][plan["order"]], float)
    name = "Kd at 532 nm" if axis["name"] == "kd" else axis["name"]
    figure, axes = chart(f"order {plan['order']}: share of hours [%] by {name}", "down to a depth of [m]",
                         f"{name} [{axis['unit']}]")
    shown = axes.imshow(share, origin="lower", aspect="auto", cmap="cividis", vmin=0, vmax=100)
    axes.grid(False)
    depths = [each["depth"] for each in plan["hours"]["by_depth"]]
    axes.set_xticks(range(len(depths)), [f"{each:g}" for each in depths], fontsize=7)
    axes.set_yticks(range(len(axis["values"])), [f"{each:g}" for each in axis["values"]], fontsize=8)
    for row, values in enumerate(share):
        for column, value in enumerate(values):
            axes.annotate(f"{value:.0f}", (column, row), ha="center", va="center", fontsize=6,
                          color="black" if value > 50 else "white")
    figure.colorbar(shown, ax=axes, label="share of hours [%]")
    return image(figure, f"chart: share of hours in which order {plan['order']} is met, by {name}")


def _table_of_hours(plan: Plan) -> str:
    rows = [[f"{each['depth']:g}", *(f"{100 * each['share'][order]:.1f}" for order in ORDERS)]
            for each in plan["hours"]["by_depth"]]
    return table(["down to a depth of [m] ↓ order, % of hours →", *ORDERS], rows)
