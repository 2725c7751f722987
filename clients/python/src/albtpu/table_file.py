"""Answers from a table file, without a service."""

from __future__ import annotations

import os
import pathlib
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from .errors import ArgumentError
from .geometry import SEA_WATER_INDEX
from .interpolation import Interpolator, PulseNumbers, larger_of
from .progress import Progress
from .query import Query
from .s44 import FACTOR_95, best_orders, limits, remaining
from .schema import BIASES, INTERPOLATED, KINDS, ONE_SEA, QUANTITIES, REFRACTIONS, SEA_SURFACE, Doubles, Floats
from .source import UncertaintySource
from .table_index import at_index
from .table_reader import TableContent, errors_naming, read_table
from .tables import Answered, SeaSummary, Table
from .uncertainties import AnswerColumns

_BLOCK = 16384  # Pulses. The intermediate results of one block fit in the processor's cache.


def open_table(path: str | os.PathLike[str]) -> TableFile:
    """Reads a table file into memory and checks its seal.

    Raises TableFileError, which says what is wrong with the file.

    >>> with open_table("survey.h5") as table:
    ...     float(table.table().axes["depth"].nodes[-1])
    60.0
    """
    path = pathlib.Path(path)
    with errors_naming(path):
        return TableFile(path.stem, path.read_bytes())


class TableFile(UncertaintySource):
    """A table in memory. Outcomes are those of a service, values agree within 1e-5. The table is restated once for each
    index of the water that is asked, which takes a second for the largest; at the index that it was made at (its
    attribute `refractive_index`) its own numbers answer.

    Interpolates in double precision, some hundred thousand pulses per second, more if few axes vary. A service
    answers millions per second.
    """

    def __init__(self, name: str, file: bytes) -> None:
        self._file, self._content = file, read_table(name, file)
        self._scaled: tuple[float, TableContent] | None = None

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file of the table, for `open_table`, albtpu-query and albtpu-serve. Never overwrites a file,
        and leaves none that is not whole."""
        path = pathlib.Path(path)
        with errors_naming(path):
            file = path.open("xb")
            try:
                with file:
                    file.write(self._file)
            except BaseException:
                path.unlink(missing_ok=True)
                raise

    def table(self, name: str | None = None) -> Table:
        self._check_name(name)
        return self._content.table

    def _answer(self, query: Query, columns: AnswerColumns, progress: Progress) -> Answered:
        self._check_name(query.table)
        if query.sea is not None:
            raise ArgumentError("a table file cannot compute the table of a sea: query a service with 'sea', or make a "
                                "table of it with sea.compile(service)")
        answers = _Answers(self._at(query.refractive_index), query)
        for begin in range(0, query.size, _BLOCK):
            end = min(begin + _BLOCK, query.size)
            answers.fill(columns, begin, end)
            progress(end - begin)
        table = self._content.table
        return Answered(table.reference, SeaSummary.of_attributes(table.attributes) if self._has_one_sea() else None)

    def _has_one_sea(self) -> bool:
        return self._content.table.kind == ONE_SEA

    def _at(self, index: float | None) -> TableContent:
        """The table in water of this index, or of sea water. The last one is kept."""
        wanted = SEA_WATER_INDEX if index is None else index
        last = self._scaled
        if last is None or last[0] != wanted:
            self._scaled = last = (wanted, at_index(self._content, wanted))
        return last[1]

    def _check_name(self, name: str | None) -> None:
        if name not in (None, reference := self._content.table.reference.name):
            raise ArgumentError(f"the file contains only the table '{reference}': omit table='{name}'")


class _Answers:
    """Answers a query from a table block by block: interpolation, coverage, S-44."""

    def __init__(self, content: TableContent, query: Query) -> None:
        self._query = query
        self._s44 = query.best_s44_order or query.s44_order is not None
        wanted = set(query.quantities)
        if self._s44 or query.coverage == "p95":
            wanted.update(("thu", "tvu", *REFRACTIONS))
        values = [name for name in QUANTITIES if name in wanted and name in content.values]
        errors = [name for name in values if query.standard_errors and name in content.standard_errors]
        unused = ("wind_speed", "fetch") if content.table.kind == ONE_SEA else ()
        columns = {axis: np.array([np.inf]) for axis in KINDS[content.table.kind].endless}
        columns |= {axis: column for axis, column in query.columns.items() if axis not in unused}
        azimuths: list[dict[str, Floats]] = [{}]
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
        if columns.remaining is not None:
            for column, limit, ours in zip(columns.remaining, limits(str(self._query.s44_order), depth), (thu, tvu)):
                column[block] = remaining(limit, ours)


def _azimuths(content: TableContent) -> list[float]:
    """A pulse without azimuth has the largest values over these azimuths."""
    return [0, 90] if content.table.kind == SEA_SURFACE else list(map(float, content.table.axes["azimuth"].nodes))
