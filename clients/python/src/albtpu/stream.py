"""Sends a large query as one stream with several batches in flight, and writes each answer into its place."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Iterator
from typing import Any

import grpc
import numpy as np
from numpy.typing import NDArray

from .errors import ServiceError, TableChangedError, UnreachableError
from .progress import Progress
from .query import Query
from .retries import Retries, service_error
from .schema import COVERAGES, QUANTITIES, S44_ORDERS
from .tables import Answered, SeaSummary, TableReference
from .uncertainties import AnswerColumns
from .v1 import uncertainty_service_pb2 as wire
from .v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub

_BATCH = 32768  # Pulses. A message may hold twice as many, but then client and server wait longer for each other.
_IN_FLIGHT = 8  # Batches that are sent and not yet answered.


class ColumnStream:
    """Sends all pulses of a query to a server.

    After a failure it continues with the first batch that is still unanswered. `timeout` is the time limit of
    one answer, in s.
    """

    def __init__(self, target: str, stub: UncertaintyServiceStub, query: Query, columns: AnswerColumns,
                 progress: Progress, timeout: float) -> None:
        self._target, self._stub, self._query, self._columns = target, stub, query, columns
        self._progress, self._timeout = progress, timeout
        self._answered = 0  # Pulses.
        self._table: TableReference | None = None
        self._sea: SeaSummary | None = None

    def run(self, retries: Retries) -> Answered:
        """Returns what answered. The query must have at least one pulse. Raises ServiceError."""
        while self._answered < self._query.size:
            before = self._answered
            try:
                self._run_once()
            except grpc.RpcError as error:
                if self._answered > before:
                    retries.succeeded()
                if not retries.wait_after(error):
                    raise service_error(self._target, error) from error
        assert self._table is not None
        return Answered(self._table, self._sea)

    def _run_once(self) -> None:
        sender = _Sender(self._query, self._answered, self._timeout)
        call = sender.call = self._stub.StreamColumns(sender.requests())
        try:
            for response in call:
                self._store(response.answer, sender.lengths.popleft() if sender.lengths else 0)
                sender.free.release()
            if self._answered < self._query.size:
                raise self._protocol_error(f"it ended the stream after {self._answered} of {self._query.size} pulses")
        except grpc.RpcError as error:
            if sender.timed_out:
                raise UnreachableError(f"server {self._target}: no answer in {self._timeout:g} s") from error
            raise
        finally:
            sender.stop()
            call.cancel()

    def _store(self, answer: Any, length: int) -> None:
        """Writes the answer to the next batch into its place. The columns of the batch had `length` elements."""
        table = TableReference.of(answer.table)
        self._table = self._table or table
        self._sea = SeaSummary.of(answer.sea) if answer.HasField("sea") else None
        if table.digest != self._table.digest:
            raise TableChangedError(
                f"server {self._target}: table {table.name} changed from digest {self._table.digest} to "
                f"{table.digest} after {self._answered} of {self._query.size} pulses: repeat the query")
        begin, end = self._answered, min(self._answered + _BATCH, self._query.size)
        for column, content in self._columns_and_bytes(answer):
            numbers = np.frombuffer(content, column.dtype.newbyteorder("<")) if content else column[:0]
            if numbers.size != length:
                raise self._protocol_error(f"it answered {length} pulses with a column of {len(content)} bytes")
            column[begin:end] = numbers
        self._answered = end
        self._progress(end - begin)

    def _columns_and_bytes(self, answer: Any) -> Iterator[tuple[NDArray[Any], bytes]]:
        """Each column of the result with its bytes in `answer`."""
        columns = self._columns
        yield columns.outcomes, answer.outcomes
        yield columns.outcome_axes, answer.outcome_axes
        for name, column in columns.values.items():
            yield column, getattr(answer.sea_surface, name)
        for name, column in columns.standard_errors.items():
            yield column, getattr(answer.sea_surface_standard_error, name)
        if columns.best_s44_orders is not None:
            yield columns.best_s44_orders, answer.s44.best_orders
        if columns.remaining_thu is not None and columns.remaining_tvu is not None:
            yield columns.remaining_thu, answer.s44.remaining_thu
            yield columns.remaining_tvu, answer.s44.remaining_tvu

    def _protocol_error(self, what: str) -> ServiceError:
        return ServiceError(f"server {self._target}: {what}: it may be an albtpu-serve of another version")


class _Sender:
    """Yields the batches to gRPC, in gRPC's own thread, at most _IN_FLIGHT ahead of the answers.

    It cancels the call when an answer takes longer than `timeout` s.
    """

    def __init__(self, query: Query, begin: int, timeout: float) -> None:
        self._query, self._begin, self._timeout = query, begin, timeout
        self._stopped = False
        self.free = threading.Semaphore(_IN_FLIGHT)  # The reader releases it once per answer.
        self.lengths: deque[int] = deque()  # Lengths of the columns of the batches in flight.
        self.call: Any = None
        self.timed_out = False

    def requests(self) -> Iterator[Any]:
        """Yields the batches, then waits until all are answered."""
        numbers = list(QUANTITIES)
        options = dict(
            table=self._query.table, coverage=COVERAGES[self._query.coverage],
            standard_errors=self._query.standard_errors, best_s44_order=self._query.best_s44_order,
            s44_order=S44_ORDERS.index(self._query.s44_order or ""))
        quantities = [numbers.index(name) + 1 for name in self._query.quantities]
        sea = self._query.sea.message() if self._query.sea else None
        for begin in range(self._begin, self._query.size, _BATCH):
            if not self._wait():
                return
            columns = self._query.batch(begin, min(begin + _BATCH, self._query.size))
            self.lengths.append(max(column.size for column in columns.values()))
            pulses = {axis: column.tobytes() for axis, column in columns.items()}
            yield wire.StreamColumnsRequest(
                query=dict(options=options, pulses=pulses, quantities=quantities, sea=sea))
        for _ in range(_IN_FLIGHT):
            if not self._wait():
                return

    def stop(self) -> None:
        """Lets gRPC's thread finish, wherever it is waiting."""
        self._stopped = True
        self.free.release(2 * _IN_FLIGHT)

    def _wait(self) -> bool:
        if self.free.acquire(timeout=self._timeout):
            return not self._stopped
        self.timed_out = True
        self.call.cancel()
        return False
