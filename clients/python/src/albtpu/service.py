"""Answers from a service."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import grpc
import numpy as np

from .channel import File, open_channel
from .errors import ArgumentError
from .progress import Progress
from .query import Query, check_table
from .retries import Retries, service_error
from .schema import ONE_SEA, SEA_SURFACE
from .sea import Sea
from .source import UncertaintySource
from .stream import ColumnStream
from .tables import Answered, AttributeValue, Axis, Quantity, Table, TableReference, TableSummary
from .uncertainties import AnswerColumns
from .v1 import uncertainty_service_pb2 as wire
from .v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub

if TYPE_CHECKING:
    from .table_file import TableFile

_SCALES = ("", "linear", "log")  # Indexed by their numbers on the wire.


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

    def sea_table(self, sea: Sea) -> Table:
        """The table that the server computes of a sea, as `table` describes one of its own.

        Its attributes say what the sea was taken to be, for example `x_azimuth` and `share_measured`.
        """
        return _table(self._call(self._stub.CompileSea, wire.CompileSeaRequest(sea=sea.message())).table)

    def compile(self, sea: Sea) -> TableFile:
        """The table of a sea with all its values, to be queried without the service. Needs h5py."""
        from .table_file import TableFile
        request = wire.CompileSeaRequest(sea=sea.message(), with_file=True)
        return TableFile("sea", self._call(self._stub.CompileSea, request).file)

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
            table = self.table(query.table) if query.sea is None else self.sea_table(query.sea)
            return Answered(table.reference)
        stream = ColumnStream(self._target, self._stub, query, columns, progress, self._timeout)
        return stream.run(Retries(self._channel, self._patience))

    def _axes(self, query: Query, reference: TableReference) -> Mapping[str, Axis]:
        if reference.digest not in self._known_axes:
            self._known_axes[reference.digest] = (
                super()._axes(query, reference) if query.sea is None else self.sea_table(query.sea).axes)
        return self._known_axes[reference.digest]

    def _call(self, method: Any, request: Any) -> Any:
        retries = Retries(self._channel, self._patience)
        while True:
            try:
                return method(request, timeout=self._timeout)
            except grpc.RpcError as error:
                if not retries.wait_after(error):
                    raise service_error(self._target, error) from error


def _table(table: Any) -> Table:
    return Table(
        TableReference.of(table.reference), table.title,
        {axis.name: Axis(np.array(axis.nodes, np.float32), axis.units, axis.long_name,
                         _SCALES[axis.scale]) for axis in table.axes},
        {quantity.name: Quantity(quantity.units, quantity.long_name, _SCALES[quantity.scale],
                                 quantity.has_standard_error) for quantity in table.quantities},
        table.campaign, {key: _attribute(value) for key, value in sorted(table.attributes.items())},
        ONE_SEA if table.HasField("sea") else SEA_SURFACE)


def _attribute(value: Any) -> AttributeValue:
    kind = value.WhichOneof("value")
    plain: AttributeValue = list(value.numbers.values) if kind == "numbers" else getattr(value, kind)
    return plain
