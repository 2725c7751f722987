"""The answer to a query: named arrays with units, and an outcome for every pulse."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .errors import ArgumentError
from .query import Query
from .schema import (AXES, BIASES, INTERPOLATED, OUT_OF_DOMAIN, OUTCOMES, QUANTITIES, S44_ORDERS, STANDARD_ERROR,
                     Floats, Numbers)
from .tables import Answered, Axis

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class AnswerColumns:
    """The flat arrays of an answer, one element per pulse. What the query does not request is None or absent."""

    outcomes: Numbers
    outcome_axes: Numbers
    outcome_sides: Numbers
    values: dict[str, Floats]
    standard_errors: dict[str, Floats]
    best_s44_orders: Numbers | None
    remaining: tuple[Floats, Floats] | None  # Of THU and TVU.

    @classmethod
    def for_query(cls, query: Query) -> AnswerColumns:
        """Uninitialized arrays for the answer to `query`."""
        size = query.size

        def floats() -> Floats:
            return np.empty(size, np.float32)

        return cls(outcomes=np.empty(size, np.uint8), outcome_axes=np.empty(size, np.uint8),
                   outcome_sides=np.zeros(size, np.uint8),
                   values={name: floats() for name in query.quantities},
                   standard_errors={name: floats() for name in query.quantities if query.standard_errors},
                   best_s44_orders=np.empty(size, np.uint8) if query.best_s44_order else None,
                   remaining=(floats(), floats()) if query.s44_order else None)

    def fill_sides(self, pulses: Mapping[str, NDArray[Any]], axes_of_table: Callable[[], Mapping[str, Axis]]) -> None:
        """Sets `outcome_sides`: where a pulse out of domain is. The twin of SideOf in tables/pulse.h.

        A folded azimuth is on no side. `axes_of_table` is called only if a pulse is out of domain.
        """
        outside = np.flatnonzero(self.outcomes == OUT_OF_DOMAIN)
        axes = axes_of_table() if outside.size else {}
        for number, name in enumerate(AXES, 1):
            if name == "azimuth" or name not in axes or name not in pulses:
                continue
            found = outside[self.outcome_axes[outside] == number]
            column = pulses[name]
            coordinates = (column if column.size == 1 else column[found]).astype(np.float32)
            self.outcome_sides[found] = np.where(coordinates > axes[name].nodes[-1], np.uint8(2), np.uint8(1))


class Uncertainties:
    """The answer to a query. All arrays have the shape of the query; NaN where a pulse has no number.

    thu, tvu, refraction_along_wind, refraction_cross_wind, bias_along_beam, bias_vertical: arrays of float32,
    in `units`. Those that the query did not request raise AttributeError.

    table:            the table that answered: name, id, version, digest.
    sea:              the sea with what was assumed (albtpu.SeaSummary); None if the table is not of one sea.
    coverage:         "2sigma", "1sigma" or "p95", of all quantities except the biases and S-44.
    azimuth_absent:   whether each value is the larger in magnitude of those at 0 and 90 degrees.
    pulses:           the coordinates of the query by axis, as arrays of its shape: views of those that were given.
    values:           the quantities by name.
    standard_errors:  their standard errors by name, of the Monte Carlo or of a sea; empty if not requested.
    outcomes:         1 INTERPOLATED, 2 OUT_OF_DOMAIN, 3 INVALID (uint8); `outcome` has the words.
    outcome_axes:     the axis that caused it, its position in albtpu.AXES from 1; 0 if interpolated.
    outcome_sides:    where a pulse out of domain is on that axis: 1 below the first node, 2 above the last; 0 for
                      any other pulse, and on the azimuth.
    best_s44_orders:  1 exclusive, 2 special, 3 1a, 4 1b, 5 2, 0 none (uint8); None if not requested.
    remaining_thu, remaining_tvu: the part of the S-44 order's limits that the sea surface leaves for all other
                      sources, in m at 95 %, NaN if nothing remains; None if not requested.
    """

    refraction_along_wind: Floats
    refraction_cross_wind: Floats
    thu: Floats
    tvu: Floats
    bias_along_beam: Floats
    bias_vertical: Floats

    def __init__(self, query: Query, columns: AnswerColumns, answered: Answered) -> None:
        def shaped(column: NDArray[Any] | None) -> Any:
            return None if column is None else column.reshape(query.shape)

        self.table, self.sea = answered
        self.coverage = query.coverage
        self.azimuth_absent = "azimuth" not in query.pulses
        self.pulses = query.pulses
        self.outcomes: Numbers = shaped(columns.outcomes)
        self.outcome_axes: Numbers = shaped(columns.outcome_axes)
        self.outcome_sides: Numbers = shaped(columns.outcome_sides)
        self.values: Mapping[str, Floats] = {name: shaped(column) for name, column in columns.values.items()}
        self.standard_errors: Mapping[str, Floats] = {
            name: shaped(column) for name, column in columns.standard_errors.items()}
        self.best_s44_orders: Numbers | None = shaped(columns.best_s44_orders)
        self.remaining_thu: Floats | None
        self.remaining_tvu: Floats | None
        self.remaining_thu, self.remaining_tvu = map(shaped, columns.remaining or (None, None))
        self.__dict__.update(self.values)

    def __getattr__(self, name: str) -> Any:
        hint = ": name it in 'quantities'" if name in QUANTITIES else ""
        raise AttributeError(f"this answer has no '{name}'{hint}")

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {name}" for name, count in self.outcome_counts().items())
        return (f"<albtpu.Uncertainties {', '.join(self.values)} of shape {self.outcomes.shape}, "
                f"{self.coverage}, table {self.table.id} {self.table.version}: {counts or 'no pulse'}>")

    @property
    def outcome(self) -> NDArray[np.object_]:
        """Words: "INTERPOLATED", "OUT_OF_DOMAIN:depth:above", "INVALID"."""
        return outcome_words(self.outcomes, self.outcome_axes, self.outcome_sides)

    @property
    def interpolated(self) -> NDArray[np.bool_]:
        """Whether each pulse has numbers."""
        return self.outcomes == INTERPOLATED

    def outcome_counts(self) -> dict[str, int]:
        """The number of pulses by outcome: {"INTERPOLATED": 9, "OUT_OF_DOMAIN:depth:above": 1}."""
        counts = np.bincount(_outcome_numbers(self.outcomes, self.outcome_axes, self.outcome_sides).reshape(-1))
        return {_OUTCOME_WORDS[number]: int(count) for number, count in enumerate(counts) if count}

    @property
    def best_s44_order(self) -> NDArray[np.object_] | None:
        """Names: "exclusive", "special", "1a", "1b", "2", or "" for none; None if not requested."""
        return None if self.best_s44_orders is None else order_names(self.best_s44_orders)

    @property
    def units(self) -> dict[str, str]:
        """Units of the arrays of `to_dict`, by name: "m" or "degree", or "" for outcomes and orders."""
        return {name: _units(name) for name in self.to_dict()}

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """All arrays by name: quantities, standard errors such as `thu_standard_error`, outcomes, S-44."""
        arrays: dict[str, NDArray[Any]] = dict(self.values)
        arrays.update((name + STANDARD_ERROR, errors) for name, errors in self.standard_errors.items())
        arrays.update(outcomes=self.outcomes, outcome_axes=self.outcome_axes)
        s44 = dict(best_s44_orders=self.best_s44_orders, remaining_thu=self.remaining_thu,
                   remaining_tvu=self.remaining_tvu)
        return arrays | {name: array for name, array in s44.items() if array is not None}

    def to_xarray(self, dims: Sequence[str] | None = None) -> xarray.Dataset:
        """The answer as an xarray.Dataset with CF attributes and the pulses as coordinates. Needs xarray.

        `dims` names the dimensions; by default, a single one is "pulse", several are "dim_0", "dim_1", ...
        A dimension that has the name of an axis is indexed by it, and the axis must vary along it alone.
        """
        import xarray

        shape = self.outcomes.shape
        if dims is None:
            dims = ("pulse",) if len(shape) == 1 else tuple(f"dim_{i}" for i in range(len(shape)))
        if len(dims) != len(shape):
            raise ArgumentError(f"dims has {len(dims)} names: the answer has {len(shape)} dimensions")
        coordinates = {axis: _coordinate(axis, array, dims) for axis, array in self.pulses.items()}
        variables = {name: (dims, array, self._attributes(name)) for name, array in self.to_dict().items()}
        return xarray.Dataset(variables, coordinates, {
            "table": self.table.id, "table_version": self.table.version, "table_digest": self.table.digest,
            "coverage": self.coverage, "azimuth_absent": int(self.azimuth_absent)})

    def _attributes(self, name: str) -> dict[str, Any]:
        flags = {"outcomes": OUTCOMES, "outcome_axes": ("none", *AXES),
                 "best_s44_orders": ("none", *S44_ORDERS[1:])}
        if name in flags:
            return {"flag_values": np.arange(len(flags[name]), dtype=np.uint8),
                    "flag_meanings": " ".join(flags[name])}
        attributes: dict[str, Any] = {"units": _units(name)}
        if name in QUANTITIES:
            suffix = "" if name in BIASES else f", {self.coverage}"
            attributes["long_name"] = QUANTITIES[name].long_name + suffix
            if name in self.standard_errors:
                attributes["ancillary_variables"] = name + STANDARD_ERROR
        elif name.endswith(STANDARD_ERROR):
            attributes["long_name"] = f"standard error of {name[:-len(STANDARD_ERROR)]}"
        else:
            total = name[-3:].upper()
            attributes["long_name"] = f"{total} that the sea surface leaves to all other sources, 95 %"
        return attributes


# By outcome; out of domain by axis, from none, and side.
_OUTCOME_WORDS = np.array(
    [*OUTCOMES[:OUT_OF_DOMAIN],
     *(OUTCOMES[OUT_OF_DOMAIN] + axis + side for axis in ("", *(f":{name}" for name in AXES))
       for side in ("", ":below", ":above")),
     *OUTCOMES[OUT_OF_DOMAIN + 1:]], object)
_FIRST_NUMBERS = np.array([*range(OUT_OF_DOMAIN + 1),
                           *range(OUT_OF_DOMAIN + 3 * (len(AXES) + 1), len(_OUTCOME_WORDS))], np.uint8)


def _outcome_numbers(outcomes: Numbers, axes: Numbers, sides: Numbers) -> Numbers:
    """Indices of _OUTCOME_WORDS."""
    within = np.where(outcomes == OUT_OF_DOMAIN, axes * np.uint8(3) + sides, np.uint8(0))
    return np.asarray(_FIRST_NUMBERS[outcomes] + within, np.uint8)


def outcome_words(outcomes: Numbers, axes: Numbers, sides: Numbers) -> NDArray[np.object_]:
    return np.asarray(_OUTCOME_WORDS[_outcome_numbers(outcomes, axes, sides)], object)


def order_names(orders: Numbers) -> NDArray[np.object_]:
    """The names of S-44 orders by their numbers; "" for none."""
    return np.asarray(np.array(S44_ORDERS, object)[orders], object)


def _coordinate(axis: str, array: NDArray[Any], dims: Sequence[str]) -> tuple[Any, ...]:
    """The coordinate `axis` over the dimensions along which it is not merely broadcast."""
    # NumPy gives an axis of one element the stride 0, too.
    varies = [stride != 0 or array.size == 0 or (length == 1 and dim == axis)
              for dim, length, stride in zip(dims, array.shape, array.strides)]
    over = tuple(dim for dim, along in zip(dims, varies) if along)
    if axis in dims and over != (axis,):
        raise ArgumentError(f"{axis} varies along {', '.join(over) or 'no dimension'}: it cannot index the "
                            f"dimension '{axis}'")
    index: tuple[Any, ...] = tuple(slice(None) if along else 0 for along in varies)
    return over, array[index], AXES[axis]._asdict()


def _units(name: str) -> str:
    quantity = name[:-len(STANDARD_ERROR)] if name.endswith(STANDARD_ERROR) else name
    if quantity in QUANTITIES:
        return QUANTITIES[quantity].units
    return "m" if name.startswith("remaining") else ""
