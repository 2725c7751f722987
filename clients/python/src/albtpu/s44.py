"""The limits of IHO S-44 edition 6.1.0, tables 1 and 2, at 95 %. The twin of tables/s44.h."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .schema import S44_ORDERS

Doubles = NDArray[np.float64]

# The coefficients c, e, a, b of the limits THU = c + e depth and TVU = sqrt(a^2 + (b depth)^2), in m.
_LIMITS = {
    "exclusive": (1, 0, 0.15, 0.0075),
    "special": (2, 0, 0.25, 0.0075),
    "1a": (5, 0.05, 0.5, 0.013),
    "1b": (5, 0.05, 0.5, 0.013),
    "2": (20, 0.10, 1.0, 0.023),
}


def limits(order: str, depth: Doubles) -> tuple[Doubles, Doubles]:
    """The greatest THU and TVU, in m, that `order` allows at `depth` in m."""
    c, e, a, b = _LIMITS[order]
    with np.errstate(invalid="ignore"):  # At infinite depth no order is met.
        return c + e * depth, np.hypot(a, b * depth)


def best_orders(thu: Doubles, tvu: Doubles, depth: Doubles) -> NDArray[np.uint8]:
    """The number of the strictest order whose limits exceed `thu` and `tvu`; 0 if none does, or if they are NaN."""
    best = np.zeros(thu.shape, np.uint8)
    for number, order in reversed(list(enumerate(S44_ORDERS[1:], 1))):
        thu_limit, tvu_limit = limits(order, depth)
        best[(thu_limit > thu) & (tvu_limit > tvu)] = number
    return best


def remaining(limit: Doubles, ours: Doubles) -> Doubles:
    """The part of `limit` that `ours` leaves for all other, independent sources; NaN if it leaves nothing."""
    with np.errstate(invalid="ignore"):
        return np.sqrt(np.where(ours <= limit, (limit - ours) * (limit + ours), np.nan))
