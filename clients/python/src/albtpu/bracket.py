"""Locates coordinates between the nodes of an axis. The twin of Axis::Locate in tables/axis.h."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .schema import ENDLESS_AXES, SEA_SURFACE
from .tables import Axis

Doubles = NDArray[np.float64]


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
    if name in ENDLESS_AXES[kind]:
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
