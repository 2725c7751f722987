"""Answers a query from a table: interpolation, coverage, S-44."""

from __future__ import annotations

from functools import reduce

import numpy as np
from numpy.typing import NDArray

from .coverage import FACTOR_95
from .interpolation import Interpolator, PulseNumbers, larger_of
from .query import Query
from .s44 import best_orders, limits, remaining
from .schema import BIASES, ENDLESS_AXES, INTERPOLATED, QUANTITIES, REFRACTIONS, SEA_SURFACE
from .table_reader import TableContent
from .uncertainties import AnswerColumns

Doubles = NDArray[np.float64]


class TableAnswers:
    """Answers a query block by block."""

    def __init__(self, content: TableContent, query: Query) -> None:
        self._query = query
        self._s44 = query.best_s44_order or query.s44_order is not None
        wanted = set(query.quantities)
        if self._s44 or query.coverage == "p95":
            wanted.update(("thu", "tvu", *REFRACTIONS))
        values = [name for name in QUANTITIES if name in wanted and name in content.values]
        errors = [name for name in values if query.standard_errors and name in content.standard_errors]
        columns = {axis: np.array([np.inf]) for axis in ENDLESS_AXES[content.table.kind]} | dict(query.columns)
        azimuths: list[dict[str, NDArray[np.float32]]] = [{}]
        if "azimuth" not in columns:
            azimuths = [{"azimuth": np.array([azimuth], np.float32)} for azimuth in _azimuths(content)]
        with np.errstate(all="ignore"):  # Values for a constant out of domain are never used.
            constant = {axis: column.astype(np.float32) for axis, column in columns.items() if column.size == 1}
            self._interpolators = [Interpolator(content, values, errors, constant | azimuth)
                                   for azimuth in azimuths]

    def fill(self, columns: AnswerColumns, begin: int, end: int) -> None:
        """Writes the answers for the pulses from `begin` to `end`."""
        block, count = slice(begin, end), end - begin
        pulses = self._query.batch(begin, end)
        with np.errstate(all="ignore"):  # Values for pulses out of domain are discarded below.
            two_sigma = [interpolate(pulses, count) for interpolate in self._interpolators]
            numbers = reduce(larger_of, two_sigma)
            columns.outcomes[block], columns.outcome_axes[block] = numbers.outcomes, numbers.outcome_axes
            without_number = numbers.outcomes != INTERPOLATED
            for target, source in ((columns.values, numbers.values),
                                   (columns.standard_errors, numbers.standard_errors)):
                for name, column in target.items():
                    column[block] = source[name] * self._factor(name, numbers) if name in source else np.nan
                    column[block][without_number] = np.nan
            if self._s44:
                self._fill_s44(columns, block, numbers, without_number, pulses["depth"].astype(np.float64))

    def _factor(self, name: str, numbers: PulseNumbers) -> Doubles | float:
        if self._query.coverage == "2sigma" or name in BIASES:
            return 1.0
        if self._query.coverage == "1sigma":
            return 0.5
        return numbers.radius_over_thu if name == "thu" else FACTOR_95

    def _fill_s44(self, columns: AnswerColumns, block: slice, numbers: PulseNumbers, without_number: NDArray[np.bool_],
                  depth: Doubles) -> None:
        thu = (numbers.values["thu"] * numbers.radius_over_thu).astype(np.float32).astype(np.float64)
        tvu = (numbers.values["tvu"] * FACTOR_95).astype(np.float32).astype(np.float64)
        thu[without_number] = tvu[without_number] = np.nan
        if columns.best_s44_orders is not None:
            columns.best_s44_orders[block] = best_orders(thu, tvu, depth)
        if columns.remaining_thu is not None and columns.remaining_tvu is not None:
            thu_limit, tvu_limit = limits(str(self._query.s44_order), depth)
            columns.remaining_thu[block] = remaining(thu_limit, thu)
            columns.remaining_tvu[block] = remaining(tvu_limit, tvu)


def _azimuths(content: TableContent) -> list[float]:
    """The azimuths of which a pulse without azimuth takes the worst."""
    nodes: list[float] = content.table.axes["azimuth"].nodes.tolist()
    return [0, 90] if content.table.kind == SEA_SURFACE else nodes
