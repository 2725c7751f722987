"""The whole uncertainty budget of pulses: a query of air side, sea surface and vertical datum, and its answer."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError
from .names import check_name
from .query import Query, read_query
from .schema import AIRCRAFT, AXES, BUDGET_QUANTITIES, COVARIANCES, LOCATIONS, OUTCOMES, S44_ORDERS
from .sea import Sea
from .tables import SeaSummary, TableReference

# The sources of error of the air side: three numbers of these names, or a single one.
_ERRORS: dict[str, tuple[str, ...]] = {
    "position": ("north", "east", "down"), "attitude": ("roll", "pitch", "heading"),
    "boresight": ("forward", "right", "down"), "lever_arm": (), "scan": (), "time": (), "range_offset": (),
    "bottom_range": (), "surface_height": (), "index": ()}


@dataclass(frozen=True)
class BudgetQuery:
    """A valid query of the budget."""

    query: Query  # Its columns are those of the table and of the aircraft.
    options: dict[str, Any]  # The fields of albtpu.v1.BudgetOptions.
    quantities: tuple[str, ...]

    def batch(self, begin: int, end: int) -> tuple[dict[str, bytes], dict[str, bytes], int]:
        """The columns of the table and of the aircraft from `begin` to `end`, and the length of the longest."""
        columns = self.query.batch(begin, end)
        return ({name: column.tobytes() for name, column in columns.items() if name in AXES},
                {name: column.tobytes() for name, column in columns.items() if name in AIRCRAFT},
                max(column.size for column in columns.values()))

    def most_pulses(self) -> int:
        """The number of pulses in a message of at most 4 MiB; half of the 65 536 that it may have."""
        asked = 4 * sum(column.size > 1 for column in self.query.columns.values())
        answered = 3 + 4 * sum(6 if name in COVARIANCES else 1 for name in self.quantities)
        return int(min(32768, 4_000_000 // max(asked, answered)))


def read_budget_query(pulses: Mapping[str, ArrayLike | None], aircraft: Mapping[str, ArrayLike], *,
                      located: str, errors: Mapping[str, Any] | None, lever_arm: Sequence[float],
                      refractive_index: float, datum: float, sea_axis: float | None,
                      quantities: Iterable[str], coverage: str, table: str | None, sea: Sea | None) -> BudgetQuery:
    """Checks the arguments of a query of the budget. Raises ArgumentError."""
    query = read_query({**pulses, **aircraft}, quantities=None, coverage=coverage, standard_errors=False,
                       s44_order=None, best_s44_order=False, table=table, sea=sea, on_one_sea=sea is not None)
    check_name("located", located, LOCATIONS)
    wanted = {quantities} if isinstance(quantities, str) else set(quantities)
    for name in wanted:
        check_name("quantities", name, BUDGET_QUANTITIES)
    if not wanted:
        raise ArgumentError("quantities is empty: name at least one")
    options: dict[str, Any] = dict(
        table=table, errors=_read_errors(errors or {}), located=LOCATIONS.index(located) + 1,
        lever_arm=_three("lever_arm", lever_arm, _ERRORS["boresight"]),
        refractive_index=_number("refractive_index", refractive_index), datum=_number("datum", datum),
        sea_axis=None if sea_axis is None else _number("sea_axis", sea_axis))
    return BudgetQuery(query, options, tuple(name for name in BUDGET_QUANTITIES if name in wanted))


def _read_errors(errors: Mapping[str, Any]) -> dict[str, Any]:
    for name in errors:
        check_name("errors", name, _ERRORS)
    return {name: _three(f"errors[{name!r}]", value, _ERRORS[name]) if _ERRORS[name]
            else _number(f"errors[{name!r}]", value) for name, value in errors.items()}


def _three(name: str, values: Sequence[float], axes: tuple[str, ...]) -> dict[str, float]:
    try:
        first, second, third = values
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {values!r}: it should be three numbers: {', '.join(axes)}") from None
    return {axis: _number(name, value) for axis, value in zip(axes, (first, second, third))}


def _number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {value!r}: it should be a number") from None


@dataclass(frozen=True)
class Budget:
    """The answer to a query of the budget. All arrays have the shape of the query; NaN where a pulse has no number.

    total_thu, total_tvu, thu_air, tvu_air, thu_sea, tvu_sea, bias_along_beam, bias_vertical: float32, in m. A
                     covariance has six such arrays along a first axis, in m2 at 1 sigma: north-north, east-east,
                     down-down, north-east, north-down, east-down. best_s44_orders: uint8 as in Uncertainties. Those
                     that the query did not request raise AttributeError.
    table, sea, coverage, outcomes: as in Uncertainties.
    outcome_axes:    as in Uncertainties; 0 also if a number of the aircraft made the pulse INVALID.
    values:          the quantities by name.
    """

    table: TableReference
    sea: SeaSummary | None
    coverage: str
    outcomes: NDArray[np.uint8]
    outcome_axes: NDArray[np.uint8]
    values: Mapping[str, NDArray[Any]] = field(repr=False)

    def __getattr__(self, name: str) -> Any:
        if name != "values" and name in self.values:
            return self.values[name]
        hint = ": name it in 'quantities'" if name in BUDGET_QUANTITIES else ""
        raise AttributeError(f"this answer has no '{name}'{hint}")

    @property
    def outcome(self) -> NDArray[np.object_]:
        """Words: "INTERPOLATED", "OUT_OF_DOMAIN:depth", "INVALID"."""
        return np.asarray(_WORDS[self.outcomes, self.outcome_axes * (self.outcomes == 2)], object)

    @property
    def best_s44_order(self) -> NDArray[np.object_]:
        """Words: "exclusive", "special", "1a", "1b", "2"; "" for none."""
        return np.asarray(np.array(S44_ORDERS, object)[self.best_s44_orders], object)


_WORDS = np.array([[outcome + (f":{axis}" if axis else "") for axis in ("", *AXES)] for outcome in OUTCOMES], object)
