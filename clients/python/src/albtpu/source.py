"""The query interface that services and table files share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from types import TracebackType
from typing import TypeVar

from numpy.typing import ArrayLike

from .arguments import refuse_unknown_keywords
from .progress import Progress, show_progress
from .query import Query, read_query
from .sea import Sea
from .tables import Answered, Axis, Table, TableReference
from .uncertainties import AnswerColumns, Uncertainties

Self = TypeVar("Self", bound="UncertaintySource")


class UncertaintySource(ABC):
    """Answers queries. As a context manager, it is closed at the end of the block."""

    @refuse_unknown_keywords
    def query(self, *, wind_speed: ArrayLike | None = None, incidence: ArrayLike, footprint: ArrayLike,
              depth: ArrayLike, fetch: ArrayLike | None = None, azimuth: ArrayLike | None = None,
              sea: Sea | None = None, table: str | None = None, refractive_index: float | None = None,
              coverage: str = "2sigma", quantities: Iterable[str] | None = None,
              standard_errors: bool = False, s44_order: str | None = None, best_s44_order: bool = False,
              progress: bool = False) -> Uncertainties:
        """The uncertainty of each pulse that the sea surface causes.

        Coordinates are numbers or arrays, of integers or floats, that broadcast to one shape; the answer has
        that shape. They are rounded to single precision, like the nodes of tables. A bad pulse raises nothing:
        a masked, NaN or infinite coordinate makes it INVALID, one outside the table OUT_OF_DOMAIN.

        wind_speed:  m/s at 10 m above the sea. Required, except with `sea` and by a file of one sea.
        incidence:   degrees, angle between the beam in air and the vertical.
        footprint:   m, diameter of the beam at the mean water surface, across the beam.
        depth:       m below the located water surface.
        fetch:       m, distance over which the wind has blown. Omitted or infinite: a fully developed sea.
        azimuth:     degrees, horizontal direction of the beam from downwind. Omitted: each value is the
                     larger in magnitude of those at 0 and 90 degrees.
        sea:         an albtpu.Sea, of which a service computes a table. wind_speed and fetch are then not used. The
                     azimuth counts from the x axis of the sea (albtpu.geometry.azimuth_on_sea), with a period of
                     180 degrees; omitted, each value is the largest in magnitude over all azimuths.
        table:       the table of a service, NAME or NAME/VERSION. Omitted: its default table.
        refractive_index: of the water, 1 to 2. Omitted: 1.34, sea water. Tables that were made at another are scaled.
        coverage:    "2sigma", "1sigma", or "p95" for 95 %; THU is then the radius that contains 95 %.
        quantities:  names from albtpu.QUANTITIES. Omitted: all of them.
        standard_errors: also return the standard error of each quantity: of the Monte Carlo simulation, or with a
                     sea, of its measurement and of the short waves.
        s44_order:   "exclusive", "special", "1a", "1b" or "2": also return the part of its limits that the sea
                     surface leaves for other sources.
        best_s44_order: also return the strictest S-44 order that the sea surface alone does not exceed.
        progress:    show a progress bar on standard error, with tqdm if it is installed.

        Raises ArgumentError for invalid arguments; a service also raises subclasses of ServiceError.

        >>> import albtpu
        >>> answer = albtpu.open_table("survey.h5").query(
        ...     wind_speed=7, incidence=12, azimuth=30, footprint=0.5, depth=[8, 20, 100])
        >>> answer.thu.round(3)
        array([0.552, 1.379,   nan], dtype=float32)
        >>> list(answer.outcome)
        ['INTERPOLATED', 'INTERPOLATED', 'OUT_OF_DOMAIN:depth:above']
        """
        query = read_query(
            dict(wind_speed=wind_speed, fetch=fetch, incidence=incidence, azimuth=azimuth,
                 footprint=footprint, depth=depth),
            quantities=quantities, coverage=coverage, standard_errors=standard_errors, s44_order=s44_order,
            best_s44_order=best_s44_order, table=table, sea=sea, refractive_index=refractive_index,
            on_one_sea=sea is not None or self._has_one_sea())
        columns = AnswerColumns.for_query(query)
        with show_progress(query.size if progress else 0) as shown:
            answered = self._answer(query, columns, shown)
        columns.fill_sides(query.columns, lambda: self._axes(query, answered.table))
        return Uncertainties(query, columns, answered)

    @abstractmethod
    def table(self, name: str | None = None) -> Table:
        """Axes, quantities and provenance of a table; without a name, of the default table."""

    def close(self) -> None:
        """Releases its resources. A service accepts no further queries; a table file is in memory and answers on."""

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 traceback: TracebackType | None) -> None:
        self.close()

    def _has_one_sea(self) -> bool:
        """Whether its only table is that of one sea."""
        return False

    def _axes(self, query: Query, reference: TableReference) -> Mapping[str, Axis]:
        """The axes of the table that answered; none if it was replaced meanwhile."""
        table = self.table(reference.name)
        return table.axes if table.reference.digest == reference.digest else {}

    @abstractmethod
    def _answer(self, query: Query, columns: AnswerColumns, progress: Progress) -> Answered:
        """Fills all of `columns` and returns what answered."""
