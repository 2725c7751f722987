"""Answers from a service."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import grpc
import numpy as np
from numpy.typing import ArrayLike

from .arguments import read_doubles, read_index, read_number, refuse_unknown_keywords
from .budget import Budget, read_budget_query
from .calls import BudgetCalls, ColumnStream
from .connection import File, Retries, open_channel
from .errors import ArgumentError
from .progress import Progress, show_progress
from .query import Query, check_table
from .schema import ONE_SEA, SCALES, SEA_SURFACE
from .sea import Correlation, Sea
from .source import UncertaintySource
from .tables import Answered, AttributeValue, Axis, Quantity, Table, TableReference, TableSummary
from .uncertainties import AnswerColumns
from .v1 import sea_pb2 as sea_wire
from .v1 import uncertainty_service_pb2 as wire
from .v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from .water import Water

if TYPE_CHECKING:
    from .table_file import TableFile

def connect(target: str, *, tls: bool = False, ca: File | None = None, cert: File | None = None,
            key: File | None = None, token: str | None = None, timeout: float = 60.0,
            patience: float = 10.0) -> Service:
    """Connects to a service (`albtpu-serve`) at "HOST:PORT", "dns:///NAME:PORT" or "unix:PATH".

    tls:       use TLS instead of plain text; each of the next four arguments implies it.
    ca:        PEM file of the certificate authorities to trust; by default, gRPC's own list.
    cert, key: PEM files of the client's certificate and of its private key.
    token:     sent with every call as `authorization: Bearer TOKEN`.
    timeout:   time limit of one answer, in s.
    patience:  how long to retry while the server is unavailable, in s; the pauses grow.

    Nothing is sent before the first query. Raises ArgumentError for an invalid target or file.

        with albtpu.connect("localhost:50051") as service:
            answer = service.query(wind_speed=5, incidence=theta, footprint=0.5, depth=d)
    """
    channel = open_channel(target, tls=tls, ca=ca, cert=cert, key=key, token=token)
    return Service(target, channel, timeout, patience)


class Service(UncertaintySource):
    """A service at the other end of a channel. Several threads may use it at a time."""

    def __init__(self, target: str, channel: grpc.Channel, timeout: float, patience: float) -> None:
        self._target, self._channel, self._timeout, self._patience = target, channel, timeout, patience
        self._open_stub: UncertaintyServiceStub | None = UncertaintyServiceStub(channel)
        self._known_axes: dict[str, Mapping[str, Axis]] = {}  # By digest of the table.

    def tables(self) -> list[TableSummary]:
        """All tables of the server, sorted by name; of one name, the newest version first."""
        listed = self._call(self._stub.ListTables, wire.ListTablesRequest())
        return [TableSummary(TableReference.of(table.reference), table.title,
                             is_default=table.reference.name == listed.default_table)
                for table in listed.tables]

    def table(self, name: str | None = None) -> Table:
        """As in UncertaintySource. Raises TableNotFoundError, which lists the existing names."""
        check_table(name)
        return _table(self._call(self._stub.GetTable, wire.GetTableRequest(table=name)).table)

    def sea_table(self, sea: Sea, refractive_index: float | None = None) -> Table:
        """The table that the server computes of a sea, as `table` describes one of its own.

        refractive_index: of the water. Omitted: 1.34, sea water.

        Its attributes describe the sea with the assumptions made, for example `x_azimuth` and `share_measured`.
        """
        request = wire.CompileSeaRequest(sea=sea.message(),
                                         refractive_index=read_index(refractive_index))
        return _table(self._call(self._stub.CompileSea, request).table)

    def compile(self, sea: Sea, refractive_index: float | None = None) -> TableFile:
        """The table of a sea with all its values, to be queried without the service. Needs h5py.

        refractive_index: of the water. Omitted: 1.34, sea water.
        """
        from .table_file import TableFile
        request = wire.CompileSeaRequest(sea=sea.message(), with_file=True,
                                         refractive_index=read_index(refractive_index))
        return TableFile("sea", self._call(self._stub.CompileSea, request).file)

    @refuse_unknown_keywords
    def correlation(self, sea: Sea, *, dx: ArrayLike | None = None, dt: ArrayLike = 0.0, cell: ArrayLike | None = None,
                    orientation: float = 0.0, footprint: float, incidence: float = 0.0, azimuth: float = 0.0,
                    gaussian: bool = False, refractive_index: float | None = None,
                    both_ways: bool = False) -> Correlation:
        """What pulses of one beam share of a sea: of pairs of pulses by `dx` and `dt`, or of the mean over cells.

        dx, dt:       as in `Sea.correlation`; up to 256 pairs, 60 m and 60 s apart at most.
        cell:         m, in place of dx and dt: the sides of square cells, up to 64. The answer is R of each: the
                      variance of the mean of n pulses of one pass is R + (1 - R) / n times that of one.
        orientation:  degrees from x, of one side of the cells.
        footprint:    m, diameter of the beam across its axis; of a gaussian beam at 1/e2 of the irradiance.
        incidence:    degrees from the vertical, in air, 0 to 30.
        azimuth:      degrees counter-clockwise from x, in which the beam travels.
        both_ways:    half of the waves travel each way; otherwise towards x.

        Raises ArgumentError for invalid arguments, and ServiceError.
        """
        question = sea_wire.CorrelationQuery(
            incidence=read_number("incidence", incidence), azimuth=read_number("azimuth", azimuth),
            footprint=read_number("footprint", footprint), gaussian=gaussian,
            refractive_index=read_index(refractive_index), waves_travel_both_ways=both_ways)
        if (dx is None) == (cell is None):
            raise ArgumentError("dx and cell are both given or both missing (pairs of pulses, or the means over "
                                "cells): give one of them")
        turn, later = read_number("orientation", orientation), read_doubles("dt", dt).ravel()
        if cell is not None:
            if np.any(later != 0):
                raise ArgumentError("dt has no effect with cell (the mean over a cell has no time): omit it")
            for side in read_doubles("cell", cell).ravel():
                question.cells.add(side=side, orientation=turn)
        else:
            if turn != 0:
                raise ArgumentError("orientation has no effect with dx (it is that of cells): omit it")
            apart = read_doubles("dx", dx)
            if apart.shape[-1:] != (2,) or apart.ndim > 2 or apart.size == 0:
                raise ArgumentError(f"dx has the shape {apart.shape} (expected two numbers, or an array of such "
                                    "pairs): give x and y of each")
            pairs = np.atleast_2d(apart)
            if later.size == 0 or (later.size not in (1, len(pairs)) and len(pairs) != 1):
                raise ArgumentError(f"dt has {later.size} numbers (expected 1 or {len(pairs)}, as dx has): give one "
                                    "for each pair")
            count = max(later.size, len(pairs))
            for x, y, seconds in zip(*(np.broadcast_to(each, count) for each in (pairs[:, 0], pairs[:, 1], later))):
                question.separations.add(x=x, y=y, seconds=seconds)
        answer = self._call(self._stub.CompileSea,
                            wire.CompileSeaRequest(sea=sea.message(), correlation=question)).correlation
        found = answer.separations if cell is None else answer.cells
        return Correlation(**{name: np.array([getattr(one, name) for one in found])
                              for name in ("slope_x", "slope_y", "horizontal", "vertical", "height")})

    @refuse_unknown_keywords
    def query_budget(self, *, incidence: ArrayLike, footprint: ArrayLike, depth: ArrayLike, altitude: ArrayLike,
                     beam_azimuth: ArrayLike, located: str, wind_speed: ArrayLike | None = None,
                     fetch: ArrayLike | None = None, azimuth: ArrayLike | None = None, sea: Sea | None = None,
                     aircraft: Mapping[str, ArrayLike] | None = None, errors: Mapping[str, Any] | None = None,
                     lever_arm: Sequence[float] = (0.0, 0.0, 0.0), refractive_index: float | None = None,
                     datum: float = 0.0, extra_horizontal: float = 0.0, extra_vertical: float = 0.0,
                     sea_axis: float | None = None, water: Water | None = None, table: str | None = None,
                     coverage: str = "2sigma", quantities: Iterable[str] = ("total_thu", "total_tvu"),
                     progress: bool = False) -> Budget:
        """The whole uncertainty of each pulse: of sensor and trajectory, sea surface, water column and vertical datum.

        wind_speed, fetch, incidence, azimuth, footprint, depth, sea, table, progress: as in `query`.
        altitude:     m, of the sensor above the water.
        beam_azimuth: degrees clockwise from true north, where the beam travels to.
        located:      how the processing located the surface: "pulse" by the pulse's own return, "local" by a model of
                      the survey's own returns, "level" by a water level.
        aircraft:     further columns by name: roll, pitch, heading in degrees; velocity_north, velocity_east,
                      velocity_down in m/s; roll_rate, pitch_rate, yaw_rate in degrees per s; the standard deviations
                      position_sigma_north, position_sigma_east, position_sigma_down in m and roll_sigma, pitch_sigma,
                      heading_sigma in degrees (omitted: those of `errors`); wave_height in m, the standard deviation
                      of the elevation that the location of the surface does not see: with "local" and "level" a
                      quarter of the significant wave height (omitted: 0, and `left_out` says so); and the contribution
                      of the water column in place of `water`: water_sigma_along, water_sigma_vertical and water_noise
                      in m, water_correlation, water_bias_along and water_bias_vertical in m (omitted: left out).
        errors:       standard deviations by source, three numbers or one: position=(north, east, down) in m, scan in
                      degrees; docs/budget.md lists all sources with their units. Omitted ones are 0.
        lever_arm:    m, forward, right, down, from the trajectory's point to the sensor.
        refractive_index: of the water, for sensor and trajectory and the contribution of the sea. Omitted: by
                      temperature and salinity of `water`, or 1.34, sea water.
        datum:        m, standard deviation of the height of the vertical datum.
        extra_horizontal, extra_vertical: m, standard deviations that are added to all points, the horizontal one
                      radial: the root of the sum of the variances along north and east.
        sea_axis:     degrees clockwise from true north, where the wind blows to. Omitted: not known. Not used with the
                      table of a sea, which has its own axis.
        water:        the water in words, of which the service computes the contribution of the water column.
        coverage:     "2sigma", "1sigma" or "p95".
        quantities:   names from albtpu.BUDGET_QUANTITIES.

        Raises ArgumentError for invalid arguments, and ServiceError.

        >>> budget = service.query_budget(
        ...     wind_speed=5, incidence=20, footprint=0.5, depth=[4, 8], altitude=400, beam_azimuth=90, located="local",
        ...     errors=dict(position=(0.03, 0.03, 0.05), scan=0.001))   # doctest: +SKIP
        >>> budget.total_thu, budget.outcome                            # doctest: +SKIP
        """
        for name in ("altitude", "beam_azimuth"):
            if name in (aircraft or {}):
                raise ArgumentError(f"{name} and aircraft[{name!r}] are both given: give one")
        asked = read_budget_query(
            dict(wind_speed=wind_speed, fetch=fetch, incidence=incidence, azimuth=azimuth, footprint=footprint,
                 depth=depth), {**(aircraft or {}), "altitude": altitude, "beam_azimuth": beam_azimuth},
            located=located, errors=errors, lever_arm=lever_arm, refractive_index=refractive_index, datum=datum,
            extra_horizontal=extra_horizontal, extra_vertical=extra_vertical, sea_axis=sea_axis, quantities=quantities,
            coverage=coverage, table=table, sea=sea, water=water)
        with show_progress(asked.query.size if progress else 0) as shown:
            calls = BudgetCalls(self._target, self._stub, asked, shown, self._timeout)
            return calls.budget(self._retries())

    def close(self) -> None:
        self._open_stub = None
        self._channel.close()

    @property
    def _stub(self) -> UncertaintyServiceStub:
        if self._open_stub is None:
            raise ArgumentError(f"the service at {self._target} is closed: connect again")
        return self._open_stub

    def _answer(self, query: Query, columns: AnswerColumns, progress: Progress) -> Answered:
        if query.size == 0:
            table = (self.table(query.table) if query.sea is None
                     else self.sea_table(query.sea, query.refractive_index))
            return Answered(table.reference)
        stream = ColumnStream(self._target, self._stub, query, columns, progress, self._timeout)
        return stream.run(self._retries())

    def _axes(self, query: Query, reference: TableReference) -> Mapping[str, Axis]:
        if reference.digest not in self._known_axes:
            self._known_axes[reference.digest] = (
                super()._axes(query, reference) if query.sea is None
                else self.sea_table(query.sea, query.refractive_index).axes)
        return self._known_axes[reference.digest]

    def _call(self, method: Any, request: Any) -> Any:
        retries = self._retries()
        while True:
            try:
                return method(request, timeout=self._timeout)
            except grpc.RpcError as error:
                retries.wait_after(error)

    def _retries(self) -> Retries:
        return Retries(self._target, self._channel, self._patience)


def _table(table: Any) -> Table:
    return Table(
        TableReference.of(table.reference), table.title,
        {axis.name: Axis(np.array(axis.nodes, np.float32), axis.units, axis.long_name, SCALES[axis.scale])
         for axis in table.axes},
        {quantity.name: Quantity(quantity.units, quantity.long_name, SCALES[quantity.scale],
                                 quantity.has_standard_error) for quantity in table.quantities},
        table.campaign, {key: _attribute(value) for key, value in sorted(table.attributes.items())},
        ONE_SEA if table.HasField("sea") else SEA_SURFACE)


def _attribute(value: Any) -> AttributeValue:
    kind = value.WhichOneof("value")
    plain: AttributeValue = list(value.numbers.values) if kind == "numbers" else getattr(value, kind)
    return plain
