"""The whole uncertainty of pulses, of sensor and trajectory, sea surface and vertical datum: names, query, answer."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arguments import check_name, read_index, read_number, read_optional, read_vector
from .errors import ArgumentError
from .geometry import SEA_WATER_INDEX
from .query import Query, read_query
from .schema import AXES, COVERAGES, Numbers
from .sea import Sea
from .tables import SeaSummary, TableReference, WaterSummary
from .uncertainties import order_names, outcome_words
from .v1.budget_pb2 import AirErrors, BudgetColumns, SurfaceLocation
from .water import Water

# The columns of the aircraft in a query of the whole budget, with their units, in the order of the wire.
AIRCRAFT: dict[str, str] = {
    "altitude": "m", "beam_azimuth": "degree", "roll": "degree", "pitch": "degree", "heading": "degree",
    "velocity_north": "m s-1", "velocity_east": "m s-1", "velocity_down": "m s-1",
    "roll_rate": "degree s-1", "pitch_rate": "degree s-1", "yaw_rate": "degree s-1",
    "position_sigma_north": "m", "position_sigma_east": "m", "position_sigma_down": "m",
    "roll_sigma": "degree", "pitch_sigma": "degree", "heading_sigma": "degree", "wave_height": "m",
    "water_sigma_along": "m", "water_sigma_vertical": "m", "water_correlation": "1", "water_noise": "m",
    "water_bias_along": "m", "water_bias_vertical": "m"}
# How the surface was located, and the quantities of the budget. On the wire, each is its position here, counted from 1.
LOCATIONS = tuple(name.rpartition("_")[2].lower() for name in SurfaceLocation.keys()[1:])
BUDGET_QUANTITIES: tuple[str, ...] = tuple(column.name for column in BudgetColumns.DESCRIPTOR.fields)
COVARIANCES = tuple(name for name in BUDGET_QUANTITIES if name.startswith("covariance_"))

# The sources of error of sensor and trajectory: three numbers of these names, or a single one.
_ERRORS = {source.name: tuple(part.name for part in source.message_type.fields) if source.message_type else ()
           for source in AirErrors.DESCRIPTOR.fields}


@dataclass(frozen=True)
class BudgetQuery:
    """A valid query of the budget."""

    query: Query  # Its columns are those of the table and of the aircraft.
    options: dict[str, Any]  # The fields of albtpu.v1.BudgetOptions.
    water: Water | None  # In place of its columns.

    @property
    def left_out(self) -> tuple[str, ...]:
        """What the totals lack: one sentence each."""
        sentences = []
        if self.options["located"] != LOCATIONS.index("pulse") + 1 and "wave_height" not in self.query.columns:
            sentences.append("wave_height is not given: the waves that the location of the surface does not see are "
                             "left out")
        columns = any(name.startswith("water_") for name in self.query.columns)
        if not columns and (self.water is None or self.water.without_column):
            sentences.append("the contribution of the water column is left out")
        return tuple(sentences)

    def batch(self, begin: int, end: int) -> tuple[dict[str, bytes], dict[str, bytes], int]:
        """The columns of the table and of the aircraft from `begin` to `end`, and the length of the longest."""
        columns = self.query.batch(begin, end)
        return ({name: column.tobytes() for name, column in columns.items() if name in AXES},
                {name: column.tobytes() for name, column in columns.items() if name in AIRCRAFT},
                max(column.size for column in columns.values()))

    def most_pulses(self) -> int:
        """The number of pulses in a message of at most 4 MiB; half of the 65 536 that it may have."""
        asked = 4 * sum(column.size > 1 for column in self.query.columns.values())
        answered = 3 + 4 * sum(6 if name in COVARIANCES else 1 for name in self.query.quantities)
        return int(min(32768, 4_000_000 // max(asked, answered)))


def read_budget_query(pulses: Mapping[str, ArrayLike | None], aircraft: Mapping[str, ArrayLike], *,
                      located: str, errors: Mapping[str, Any] | None, lever_arm: Sequence[float],
                      refractive_index: float | None, datum: float, extra_horizontal: float, extra_vertical: float,
                      sea_axis: float | None,
                      quantities: Iterable[str], coverage: str, table: str | None, sea: Sea | None,
                      water: Water | None) -> BudgetQuery:
    """Checks the arguments of a query of the budget. Raises ArgumentError."""
    for name in aircraft:
        check_name("aircraft", name, AIRCRAFT)
        if water is not None and name.startswith("water_"):
            raise ArgumentError(f"water and aircraft[{name!r}] are both given (the service computes all columns of the "
                                "water): give one of them")
    if water is not None and not isinstance(water, Water):
        raise ArgumentError(f"water is {water!r}: it should be an albtpu.Water")
    query = read_query({**pulses, **aircraft}, quantities=quantities, known=BUDGET_QUANTITIES, units=AIRCRAFT,
                       coverage=coverage, table=table, sea=sea, on_one_sea=sea is not None)
    check_name("located", located, LOCATIONS)
    if refractive_index is None and (water is None or water.temperature is None):
        refractive_index = SEA_WATER_INDEX
    options: dict[str, Any] = dict(
        table=table, coverage=COVERAGES[coverage], errors=_read_errors(errors or {}),
        located=LOCATIONS.index(located) + 1, lever_arm=read_vector("lever_arm", lever_arm, _ERRORS["boresight"]),
        refractive_index=read_index(refractive_index), datum=read_number("datum", datum),
        extra_horizontal=read_number("extra_horizontal", extra_horizontal),
        extra_vertical=read_number("extra_vertical", extra_vertical),
        sea_axis=read_optional("sea_axis", sea_axis))
    if query.size == 0:
        raise ArgumentError("there are no pulses: give at least one")
    return BudgetQuery(query, options, water)


def _read_errors(errors: Mapping[str, Any]) -> dict[str, Any]:
    for name in errors:
        check_name("errors", name, _ERRORS)
    return {name: read_vector(f"errors[{name!r}]", value, _ERRORS[name]) if _ERRORS[name]
            else read_number(f"errors[{name!r}]", value) for name, value in errors.items()}


@dataclass(frozen=True)
class Budget:
    """The answer to a query of the budget. All arrays have the shape of the query; NaN where a pulse has no number.

    total_thu, total_tvu, thu_air, tvu_air, thu_sea, tvu_sea, thu_water, tvu_water, bias_along_beam, bias_vertical:
                     float32, in m. A covariance has six such arrays along a first axis, in m2 at 1 sigma: north-north,
                     east-east, down-down, north-east, north-down, east-down. best_s44_orders: uint8 as in
                     Uncertainties.
                     Those that the query did not request raise AttributeError.
    table, sea, coverage, outcomes: as in Uncertainties.
    outcome_axes:    as in Uncertainties; 0 also if a number of the aircraft made the pulse INVALID.
    values:          the quantities by name.
    water:           what the service computed of the `Water` of the query; None without one.
    left_out:        what the totals lack because it was not given, a sentence each: the waves that "local" and "level"
                     do not see (aircraft=dict(wave_height=...)), and the water column.
    """

    table: TableReference
    sea: SeaSummary | None
    coverage: str
    outcomes: Numbers
    outcome_axes: Numbers
    values: Mapping[str, NDArray[Any]] = field(repr=False)
    water: WaterSummary | None = None
    left_out: tuple[str, ...] = ()

    def __getattr__(self, name: str) -> Any:
        if name != "values" and name in self.values:
            return self.values[name]
        hint = ": name it in 'quantities'" if name in BUDGET_QUANTITIES else ""
        raise AttributeError(f"this answer has no '{name}'{hint}")

    @property
    def outcome(self) -> NDArray[np.object_]:
        """Words: "INTERPOLATED", "OUT_OF_DOMAIN:depth", "INVALID"."""
        return outcome_words(self.outcomes, self.outcome_axes, np.zeros_like(self.outcomes))

    @property
    def best_s44_order(self) -> NDArray[np.object_]:
        """Words: "exclusive", "special", "1a", "1b", "2"; "" for none."""
        return order_names(self.best_s44_orders)
