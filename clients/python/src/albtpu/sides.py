"""On which side of the nodes of an axis a pulse out of domain is. The twin of SideOf in tables/pulse.h."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .schema import AXES, OUT_OF_DOMAIN
from .tables import Axis


def fill_sides(sides: NDArray[np.uint8], outcomes: NDArray[np.uint8], outcome_axes: NDArray[np.uint8],
               columns: Mapping[str, NDArray[Any]], axes_of_table: Callable[[], Mapping[str, Axis]]) -> None:
    """Sets `sides`, zeros, to 1 below the first node and to 2 above the last.

    A folded azimuth is on no side. `axes_of_table` is called only if a pulse is out of domain.
    """
    outside = np.flatnonzero(outcomes == OUT_OF_DOMAIN)
    axes = axes_of_table() if outside.size else {}
    for number, name in enumerate(AXES, 1):
        if name == "azimuth" or name not in axes or name not in columns:
            continue
        pulses = outside[outcome_axes[outside] == number]
        column = columns[name]
        coordinates = (column if column.size == 1 else column[pulses]).astype(np.float32)
        sides[pulses] = np.where(coordinates > axes[name].nodes[-1], np.uint8(2), np.uint8(1))
