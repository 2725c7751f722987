"""The limits of a class of a specification."""

from __future__ import annotations

import math
from typing import Any

COVERAGES = {"p95": "95 %", "2sigma": "2σ", "1sigma": "1σ"}
SIGMAS = {"p95": 1.959963984540054, "2sigma": 2.0, "1sigma": 1.0}  # Of one dimension.


def limit_at(limit: dict[str, Any], depth: float) -> float:
    """The greatest uncertainty in m at a depth in m."""
    of_depth: float = limit["of_depth"] * depth
    constant: float = limit["constant"]
    return math.hypot(constant, of_depth) if limit["combined"] == "rss" else constant + of_depth


def limit_text(limit: dict[str, Any] | None) -> str:
    """ "√(0.5² + (0.013 d)²) m" """
    if limit is None:
        return "–"
    if limit["of_depth"] == 0:
        return f"{limit['constant']:g} m"
    if limit["combined"] == "rss":
        return f"√({limit['constant']:g}² + ({limit['of_depth']:g} d)²) m"
    return f"{limit['constant']:g} m + {100 * limit['of_depth']:g} % d"
