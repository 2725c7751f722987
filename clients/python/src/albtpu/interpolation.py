"""Multilinear interpolation of a table, each axis on its own scale.

The twin of tables/query/interpolation.h, and of Axis::Locate in tables/axis.h.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .s44 import radius_over_thu
from .schema import (AXES, INTERPOLATED, INVALID, KINDS, OUT_OF_DOMAIN, REFRACTIONS, SEA_SURFACE, Doubles, Floats,
                     Numbers)
from .table_reader import TableContent
from .tables import Axis

Columns = Mapping[str, Floats]


class Brackets(NamedTuple):
    """Arrays with one element per pulse, or a single element for all pulses."""

    valid: NDArray[np.bool_]  # The coordinate is finite; a fetch may also be +infinity.
    inside: NDArray[np.bool_]  # The coordinate is in the domain of the axis.
    lower: NDArray[np.intp]  # Index of the node below; 0 on an axis of one node.
    fraction: Doubles  # Of the distance to the next node, on the scale of the axis, 0 to 1; undefined where not inside.


def locate(kind: str, name: str, axis: Axis, coordinate: Doubles) -> Brackets:
    """The domain of an axis of a table of this kind includes its first and last node.

    Azimuths are folded. On an endless axis, coordinates above the last node are set to it; with a single node,
    it covers any coordinate above zero, and zero unless its scale is logarithmic.
    """
    nodes = axis.nodes.astype(np.float64)
    valid = np.isfinite(coordinate)
    if name == "azimuth":
        coordinate = _fold(kind, coordinate)
    if name in KINDS[kind].endless:
        valid = valid | (coordinate == np.inf)
        if nodes.size == 1:
            held = coordinate > 0 if axis.scale == "log" else coordinate >= 0
            coordinate = np.where(held, nodes[0], coordinate)
        coordinate = np.minimum(coordinate, nodes[-1])
    inside = (coordinate >= nodes[0]) & (coordinate <= nodes[-1])
    if nodes.size == 1:
        return Brackets(valid, inside, np.zeros(coordinate.shape, np.intp), np.zeros(coordinate.shape))
    lower = np.clip(np.searchsorted(nodes, coordinate, side="right") - 1, 0, nodes.size - 2)
    if axis.scale == "log":
        nodes, coordinate = np.log(nodes), np.log(coordinate)
    return Brackets(valid, inside, lower, (coordinate - nodes[lower]) / (nodes[lower + 1] - nodes[lower]))


def _fold(kind: str, azimuth: Doubles) -> Doubles:
    """As FoldAzimuth in tables/axis.h, where half a turn is added in single precision."""
    rest = np.fmod(np.abs(azimuth), 180.0)
    if kind == SEA_SURFACE:
        return np.minimum(rest, 180.0 - rest)
    return np.where((azimuth < 0) & (rest > 0), (180.0 - rest).astype(np.float32), rest)


class PulseNumbers(NamedTuple):
    """Outcomes, and numbers at 2 sigma, which are valid only where the outcome is INTERPOLATED."""

    outcomes: Numbers
    outcome_axes: Numbers
    values: dict[str, Doubles]  # Rounded to single precision, as in a service.
    standard_errors: dict[str, Doubles]
    radius_over_thu: Doubles  # The 95 % radius of the horizontal error, divided by the THU.


class Interpolator:
    """Interpolates a table for pulses that share the `constant` coordinates, columns of one element.

    The constructor interpolates once along the constant axes, which leaves a smaller table. `values` and
    `standard_errors` name the quantities to interpolate; the table must have them.
    """

    def __init__(self, content: TableContent, values: Sequence[str], standard_errors: Sequence[str],
                 constant: Columns) -> None:
        self._kind, self._axes = content.table.kind, content.table.axes
        self._constant = self._locate(constant)
        self._log = [name for name in values if content.table.quantities[name].scale == "log"]
        self._grids: list[tuple[list[tuple[str, bool]], _Grid]] = []
        for over_depth, axes in ((True, list(AXES)), (False, list(AXES)[:-1])):
            variables = {(name, False): content.values[name]
                         for name in values if (name not in REFRACTIONS) == over_depth}
            variables.update({(name, True): content.standard_errors[name]
                              for name in standard_errors if (name not in REFRACTIONS) == over_depth})
            if variables:
                stacked = np.stack([np.log(array, dtype=np.float64) if name in self._log and not is_error
                                    else array for (name, is_error), array in variables.items()], axis=-1)
                self._grids.append((list(variables), _Grid(stacked, axes, self._constant)))

    def __call__(self, columns: Columns, count: int) -> PulseNumbers:
        """The uncertainty of `count` pulses. `columns` must contain all axes that are not constant."""
        located = self._locate({axis: column for axis, column in columns.items()
                                if axis not in self._constant})
        outcomes, outcome_axes = _outcomes(located | self._constant, count)
        values: dict[str, Doubles] = {}
        standard_errors: dict[str, Doubles] = {}
        for names, grid in self._grids:
            found = grid.at(located, count)
            for column, (name, is_error) in enumerate(names):
                numbers = found[:, column]
                if is_error:
                    standard_errors[name] = numbers
                else:
                    values[name] = np.exp(numbers) if name in self._log else numbers
                    values[name] = values[name].astype(np.float32).astype(np.float64)
        radius: Doubles = np.ones(count)
        if all(name in values for name in REFRACTIONS):
            radius = radius_over_thu(*(values[name] for name in REFRACTIONS))
        return PulseNumbers(outcomes, outcome_axes, values, standard_errors, radius)

    def _locate(self, columns: Columns) -> dict[str, Brackets]:
        return {axis: locate(self._kind, axis, self._axes[axis], column.astype(np.float64))
                for axis, column in columns.items()}


def larger_of(a: PulseNumbers, b: PulseNumbers) -> PulseNumbers:
    """The numbers for pulses without azimuth, from those at two azimuths.

    Each value is the larger in magnitude, with its standard error. A pulse without a number at either azimuth
    has none: INVALID takes precedence over OUT_OF_DOMAIN, then the first axis.
    """
    worse = (b.outcomes > a.outcomes) | ((b.outcomes == a.outcomes) & (b.outcome_axes < a.outcome_axes))
    b_is_larger = {name: np.abs(b.values[name]) > np.abs(value) for name, value in a.values.items()}

    def chosen(of_a: dict[str, Doubles], of_b: dict[str, Doubles]) -> dict[str, Doubles]:
        return {name: np.where(b_is_larger[name], of_b[name], of_a[name]) for name in of_a}

    radius = a.radius_over_thu
    if "thu" in a.values:
        thu_a, thu_b = a.values["thu"], b.values["thu"]
        radius_a, radius_b = thu_a * a.radius_over_thu, thu_b * b.radius_over_thu
        radius = np.where(thu_a >= thu_b,
                          np.where(radius_a >= radius_b, a.radius_over_thu, radius_b / thu_a),
                          np.where(radius_b >= radius_a, b.radius_over_thu, radius_a / thu_b))
    return PulseNumbers(np.maximum(a.outcomes, b.outcomes), np.where(worse, b.outcome_axes, a.outcome_axes),
                        chosen(a.values, b.values), chosen(a.standard_errors, b.standard_errors), radius)


class _Grid:
    """Variables over the same axes, interpolated together; along constant axes only once."""

    def __init__(self, variables: NDArray[Any], axes: Sequence[str],
                 constant: dict[str, Brackets]) -> None:
        grid = variables.astype(np.float64)
        self._axes: list[str] = []
        for axis in axes:
            along = len(self._axes)
            if axis not in constant:
                self._axes.append(axis)
                continue
            lower, fraction = constant[axis].lower[0], constant[axis].fraction[0]
            upper = min(lower + 1, grid.shape[along] - 1)
            grid = grid.take(lower, along) * (1 - fraction) + grid.take(upper, along) * fraction
        self._sizes = grid.shape[:-1]
        self._strides = [int(np.prod(self._sizes[i + 1:])) for i in range(len(self._axes))]
        self._values = grid.reshape(-1, grid.shape[-1])

    def at(self, located: dict[str, Brackets], count: int) -> Doubles:
        """The variables of `count` pulses, an array of shape (count, variables)."""
        total = np.zeros((count, self._values.shape[1]))
        for corner in product(*((0, 1) if size > 1 else (0,) for size in self._sizes)):
            index, weight = np.zeros(count, np.intp), np.ones(count)
            for axis, stride, upper in zip(self._axes, self._strides, corner):
                index += stride * (located[axis].lower + upper)
                weight *= located[axis].fraction if upper else 1 - located[axis].fraction
            total += weight[:, None] * self._values[index]
        return total


def _outcomes(located: dict[str, Brackets], count: int) -> tuple[Numbers, Numbers]:
    """Each pulse's outcome and the first axis that caused it. INVALID takes precedence over OUT_OF_DOMAIN."""
    outcomes, outcome_axes = np.full(count, INTERPOLATED, np.uint8), np.zeros(count, np.uint8)
    for number, axis in reversed(list(enumerate(AXES, 1))):
        outside = np.broadcast_to(~located[axis].inside, count)
        outcomes[outside], outcome_axes[outside] = OUT_OF_DOMAIN, number
    for number, axis in reversed(list(enumerate(AXES, 1))):
        invalid = np.broadcast_to(~located[axis].valid, count)
        outcomes[invalid], outcome_axes[invalid] = INVALID, number
    return outcomes, outcome_axes
