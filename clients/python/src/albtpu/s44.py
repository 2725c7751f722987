"""IHO S-44 edition 6.1.0, whose limits are at 95 %, and the conversion to 95 % from the 2 sigma of tables.

The twin of tables/s44.h and tables/coverage.h.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .schema import S44_ORDERS, Doubles, Numbers

FACTOR_95 = 1.959963984540054 / 2  # 97.5 % quantile of the standard normal distribution, divided by 2.

# Tables 1 and 2: the coefficients c, e, a, b of the limits THU = c + e depth and TVU = sqrt(a^2 + (b depth)^2), in m.
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


def best_orders(thu: Doubles, tvu: Doubles, depth: Doubles) -> Numbers:
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


def radius_over_thu(along: Doubles, cross: Doubles) -> Doubles:
    """The 95 % radius of a centred bivariate normal distribution, divided by its THU at 2 sigma.

    The standard deviations along its axes are in the ratio of the refraction `along` and `cross` wind; their
    correlation is neglected. The result is between 0.865 (isotropic) and 0.980 (one dimension), correct to 1e-6.
    """
    larger = np.maximum(along, cross)
    ratio = np.divide(np.minimum(along, cross), larger, out=np.zeros_like(larger), where=larger > 0)
    return np.interp(ratio, *_factors())


@lru_cache(maxsize=None)
def _factors() -> tuple[Doubles, Doubles]:
    """The factor at equal steps of the axis ratio. The error of linear interpolation between them is below 1e-7.

    For standard deviations 1 and `ratio`, the probability that a point lies farther out than `radius` is the
    mean over t of exp(-radius^2 / (2 w)), where w = cos^2 t + ratio^2 sin^2 t. Newton's method, started at 2,
    finds the radius at which that probability is 5 %.
    """
    ratio = np.linspace(0, 1, 1025, dtype=np.float64)
    t = (np.arange(64) + 0.5) * np.pi / 128
    w = np.cos(t) ** 2 + np.outer(ratio, np.sin(t)) ** 2
    radius = np.full_like(ratio, 2.0)
    for _ in range(6):
        outside = np.exp(-radius[:, None] ** 2 / (2 * w))
        slope = -(outside * radius[:, None] / w).mean(axis=1)
        radius -= (outside.mean(axis=1) - 0.05) / slope
    return ratio, radius / (2 * np.hypot(1.0, ratio))
