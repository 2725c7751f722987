"""Conversion from 2 sigma, as in tables, to 95 %, as in S-44. The twin of tables/coverage.h."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Doubles = NDArray[np.float64]

FACTOR_95 = 1.959963984540054 / 2  # 97.5 % quantile of the standard normal distribution, divided by 2.


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
    """The factor at equal steps of the axis ratio. Linear interpolation between them errs by less than 1e-7.

    For standard deviations 1 and `ratio`, the probability that a point lies farther out than `radius` is the
    mean over t of exp(-radius^2 / (2 w)), where w = cos^2 t + ratio^2 sin^2 t. Newton's method, started at 2,
    finds the radius at which that probability is 5 %.
    """
    ratio = np.linspace(0, 1, 1025)
    t = (np.arange(64) + 0.5) * np.pi / 128
    w = np.cos(t) ** 2 + np.outer(ratio, np.sin(t)) ** 2
    radius = np.full_like(ratio, 2.0)
    for _ in range(6):
        outside = np.exp(-radius[:, None] ** 2 / (2 * w))
        slope = -(outside * radius[:, None] / w).mean(axis=1)
        radius -= (outside.mean(axis=1) - 0.05) / slope
    return ratio, radius / (2 * np.hypot(1.0, ratio))
