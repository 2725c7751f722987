"""The one question, whoever answers it: a service or a table file."""

from __future__ import annotations

import inspect
from abc import ABC, abstractmethod
from collections.abc import Iterable
from types import TracebackType
from typing import NoReturn, TypeVar

from numpy.typing import ArrayLike

from .progress import Progress, show_progress
from .query import Query, read_query, refuse_unknown
from .tables import Table, TableReference
from .uncertainties import AnswerColumns, Uncertainties

Self = TypeVar("Self", bound="UncertaintySource")


class UncertaintySource(ABC):
    """Answers queries. A context manager that closes it."""

    def query(self, *, wind_speed: ArrayLike, incidence: ArrayLike, footprint: ArrayLike, depth: ArrayLike,
              fetch: ArrayLike | None = None, azimuth: ArrayLike | None = None, table: str | None = None,
              coverage: str = "2sigma", quantities: Iterable[str] | None = None,
              standard_errors: bool = False, s44_order: str | None = None, best_s44_order: bool = False,
              progress: bool = False, **unknown: NoReturn) -> Uncertainties:
        """The uncertainty of pulses that the sea surface causes.

        Pulses are numbers or arrays, of integers or floats, that broadcast to one shape; the answer has that
        shape. They are taken in single precision, as the nodes of tables are. What is masked, NaN or
        infinite makes its pulse INVALID and raises nothing; so does what no table reaches: OUT_OF_DOMAIN.

        wind_speed:  m/s at 10 m above the sea.
        incidence:   degrees, angle of the beam in air from the vertical.
        footprint:   m, diameter of the beam at the mean water surface, across the beam.
        depth:       m below the located water surface.
        fetch:       m over which the wind has blown. Left out or infinite: a fully developed sea.
        azimuth:     degrees, horizontal direction of the beam from downwind. Left out: each value is the
                     larger in magnitude of those at 0 and 90 degrees.
        table:       which table of a service, NAME or NAME/VERSION. Left out: its default.
        coverage:    "2sigma", or "p95" for 95 %; THU then is the radius that holds 95 %.
        quantities:  which of albtpu.QUANTITIES to answer. Left out: all.
        standard_errors: also the Monte Carlo standard error of each quantity.
        s44_order:   "exclusive", "special", "1a", "1b" or "2": also what the sea surface leaves of its
                     limits.
        best_s44_order: also the strictest order of S-44 that the sea surface alone leaves open.
        progress:    a bar on standard error (with tqdm if it is installed), for large queries.

        Raises ArgumentError for arguments that are no query; from a service also the kinds of ServiceError.

        >>> import albtpu
        >>> answer = albtpu.open_table("survey.h5").query(
        ...     wind_speed=7, incidence=12, azimuth=30, footprint=0.5, depth=[8, 20, 100])
        >>> answer.thu.round(3)
        array([0.538, 1.346,   nan], dtype=float32)
        >>> list(answer.outcome)
        ['INTERPOLATED', 'INTERPOLATED', 'OUT_OF_DOMAIN:depth']
        """
        known = inspect.signature(self.query).parameters
        refuse_unknown(unknown, [name for name in known if name != "unknown"])
        query = read_query(
            dict(wind_speed=wind_speed, fetch=fetch, incidence=incidence, azimuth=azimuth,
                 footprint=footprint, depth=depth),
            quantities=quantities, coverage=coverage, standard_errors=standard_errors, s44_order=s44_order,
            best_s44_order=best_s44_order, table=table)
        columns = AnswerColumns.for_query(query)
        with show_progress(query.size if progress else 0) as shown:
            reference = self._answer(query, columns, shown)
        return Uncertainties(query, columns, reference)

    @abstractmethod
    def table(self, name: str | None = None) -> Table:
        """Axes, quantities and provenance of a table; without a name, of the one that answers by default."""

    def close(self) -> None:
        """Gives back what it holds; it cannot be asked any more."""

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 traceback: TracebackType | None) -> None:
        self.close()

    @abstractmethod
    def _answer(self, query: Query, columns: AnswerColumns, progress: Progress) -> TableReference:
        """Fills all of `columns`; returns the table that answered."""
