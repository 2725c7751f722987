"""Locates coordinates between the nodes of an axis. The twin of Axis::Locate in tables/axis.h."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .tables import Axis

Doubles = NDArray[np.float64]


class Brackets(NamedTuple):
    """Arrays with one element per pulse, or a single element for all pulses."""

    valid: NDArray[np.bool_]  # The coordinate is finite; a fetch may also be +infinity.
    inside: NDArray[np.bool_]  # The coordinate is in the domain of the axis.
    lower: NDArray[np.intp]  # Index of the node below; 0 on an axis of one node.
    fraction: Doubles  # Of the distance to the next node, on the scale of the axis, 0 to 1; undefined where not inside.


def locate(name: str, axis: Axis, coordinate: Doubles) -> Brackets:
    """The domain of an axis includes its first and last node.

    Azimuths are folded into 0 to 90 degrees. Fetches above the last node are set to it, and an axis with a
    single fetch covers any fetch above zero.
    """
    nodes = axis.nodes.astype(np.float64)
    valid = np.isfinite(coordinate)
    if name == "azimuth":
        half_turn = np.fmod(np.abs(coordinate), 180.0)
        coordinate = np.minimum(half_turn, 180.0 - half_turn)
    if name == "fetch":
        valid = valid | (coordinate == np.inf)
        if nodes.size == 1:
            coordinate = np.where(coordinate > 0, nodes[0], coordinate)
        coordinate = np.minimum(coordinate, nodes[-1])
    inside = (coordinate >= nodes[0]) & (coordinate <= nodes[-1])
    if nodes.size == 1:
        return Brackets(valid, inside, np.zeros(coordinate.shape, np.intp), np.zeros(coordinate.shape))
    lower = np.clip(np.searchsorted(nodes, coordinate, side="right") - 1, 0, nodes.size - 2)
    if axis.scale == "log":
        nodes, coordinate = np.log(nodes), np.log(coordinate)
    return Brackets(valid, inside, lower, (coordinate - nodes[lower]) / (nodes[lower + 1] - nodes[lower]))
