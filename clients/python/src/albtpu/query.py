"""A query: pulses as columns of one shape, and the options."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arguments import check_name, common_shape, read_column, read_index, read_quantities
from .errors import ArgumentError
from .schema import AXES, COVERAGES, QUANTITIES, S44_ORDERS, Floats
from .sea import Sea


@dataclass(frozen=True)
class Query:
    """A valid query: all names are known, and the columns are numeric and have one shape."""

    shape: tuple[int, ...]
    pulses: Mapping[str, NDArray[Any]]  # As given, broadcast to `shape`; without `fetch` or `azimuth` if omitted.
    columns: Mapping[str, NDArray[Any]]  # The same, flat, or with one element if it holds for all pulses.
    quantities: tuple[str, ...]
    coverage: str
    standard_errors: bool = False
    s44_order: str | None = None
    best_s44_order: bool = False
    table: str | None = None
    sea: Sea | None = None  # In place of a table.
    refractive_index: float | None = None

    @property
    def size(self) -> int:
        """The number of pulses."""
        return int(np.prod(self.shape, dtype=np.int64))

    def batch(self, begin: int, end: int) -> dict[str, Floats]:
        """The pulses from `begin` to `end` in single precision; one element per column if all are equal.

        A number too large for single precision becomes infinite: the pulse is INVALID, or, if it is the
        fetch, the sea is fully developed.
        """
        return {axis: _single(column if column.size == 1 else column[begin:end])
                for axis, column in self.columns.items()}


def _single(column: NDArray[Any]) -> Floats:
    with np.errstate(over="ignore"):
        numbers = np.ascontiguousarray(column, "<f4")
    if numbers.size > 1 and numbers[0] == numbers[-1] and (numbers == numbers[0]).all():
        return numbers[:1]
    return numbers


def read_query(pulses: Mapping[str, ArrayLike | None], *, quantities: Iterable[str] | None, coverage: str,
               known: Iterable[str] = tuple(QUANTITIES), units: Mapping[str, str] = MappingProxyType({}),
               standard_errors: bool = False, s44_order: str | None = None, best_s44_order: bool = False,
               table: str | None = None, sea: Sea | None = None, refractive_index: float | None = None,
               on_one_sea: bool = False) -> Query:
    """Checks the arguments of a query. Raises ArgumentError.

    known: the names of quantities. units: of columns that are no axes of tables. on_one_sea: the table is that of one
    sea, which needs neither wind speed nor fetch.
    """
    optional = ("wind_speed", "fetch", "azimuth") if on_one_sea else ("fetch", "azimuth")
    if "wind_speed" not in optional and pulses["wind_speed"] is None:
        raise ArgumentError("wind_speed is missing: give it in m/s, or the sea")
    arrays = {name: read_column(name, values, AXES[name].units if name in AXES else units[name])
              for name, values in pulses.items() if values is not None or name not in optional}
    shape = common_shape(arrays, pulses)
    # reshape(-1) copies a broadcast array, which takes the least memory in single precision.
    with np.errstate(over="ignore"):
        flat = {axis: array.reshape(-1) if array.size == 1 or array.shape == shape
                else np.broadcast_to(array.astype("<f4"), shape).reshape(-1) for axis, array in arrays.items()
                if not (sea is not None and axis in ("wind_speed", "fetch"))}
    check_table(table)
    _check_sea(sea, table)
    check_name("coverage", coverage, COVERAGES)
    if s44_order is not None:
        check_name("s44_order", s44_order, S44_ORDERS[1:])
    return Query(shape=shape, pulses={axis: np.broadcast_to(array, shape) for axis, array in arrays.items()},
                 columns=flat, quantities=read_quantities(quantities, known), coverage=coverage,
                 standard_errors=bool(standard_errors), s44_order=s44_order,
                 best_s44_order=bool(best_s44_order), table=table, sea=sea,
                 refractive_index=read_index(refractive_index))


def check_table(name: str | None) -> None:
    """Raises ArgumentError unless `name` is text or None."""
    if not isinstance(name, (str, type(None))):
        raise ArgumentError(f"table is {name!r}: it should be a name, or omitted")


def _check_sea(sea: object, table: str | None) -> None:
    if not isinstance(sea, (Sea, type(None))):
        raise ArgumentError(f"sea is {sea!r}: it should be an albtpu.Sea, or omitted")
    if sea is not None and table is not None:
        raise ArgumentError(f"both sea and table='{table}' are given: a sea has a table of its own; omit one of them")
