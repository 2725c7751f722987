"""From 2 sigma, which tables hold, to 95 %, which S-44 compares with. The twin of tables/coverage.h."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Doubles = NDArray[np.float64]

FACTOR_95 = 1.959963984540054 / 2  # 97.5 % quantile of the standard normal distribution, over 2.


def radius_over_thu(along: Doubles, cross: Doubles) -> Doubles:
    """The 95 % radius of a centred normal distribution over its THU of 2 sigma.

    Its axes are in the ratio of the refraction `along` and `cross` wind, their correlation neglected. From
    0.980 (one dimension) to 0.865 (isotropic), correct to 1e-6.
    """
    larger = np.maximum(along, cross)
    ratio = np.divide(np.minimum(along, cross), larger, out=np.zeros_like(larger), where=larger > 0)
    return np.interp(ratio, *_factors())


@lru_cache(maxsize=None)
def _factors() -> tuple[Doubles, Doubles]:
    """The factor at equal steps of the axis ratio; lines between them err by less than 1e-7.

    A point with standard deviations 1 and `ratio` lies farther out than `radius` with the probability that is
    the mean over t of exp(-radius^2 / (2 w)), w = cos^2 t + ratio^2 sin^2 t; Newton's method from 2 finds the
    radius that leaves 5 % outside.
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
