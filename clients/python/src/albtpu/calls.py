"""The calls that answer large queries: batches in flight, whose answers are written into their places."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Iterator
from typing import Any

import grpc
import numpy as np
from numpy.typing import NDArray

from .budget import BUDGET_QUANTITIES, COVARIANCES, Budget, BudgetQuery
from .connection import Retries
from .errors import ServiceError, TableChangedError, UnreachableError
from .progress import Progress
from .query import Query
from .schema import COVERAGES, QUANTITIES, S44_ORDERS
from .tables import Answered, SeaSummary, TableReference, WaterSummary
from .uncertainties import AnswerColumns
from .v1 import uncertainty_service_pb2 as wire
from .v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub

_BATCH = 32768  # Pulses. A message may hold twice as many, but then client and server wait longer for each other.
_IN_FLIGHT = 8  # Batches of a stream that are sent and not yet answered.
_BUDGETS_IN_FLIGHT = 4


class _Calls(ABC):
    """Sends all pulses of a query to a server.

    After a failure it continues with the first pulse that is still unanswered. `timeout` is the time limit of
    one answer, in s.
    """

    def __init__(self, target: str, stub: UncertaintyServiceStub, query: Query, progress: Progress,
                 timeout: float) -> None:
        self._target, self._stub, self._query = target, stub, query
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
                retries.wait_after(error)
        assert self._table is not None
        return Answered(self._table, self._sea)

    @abstractmethod
    def _run_once(self) -> None:
        """Calls `_store` with the answers to all pulses, unless a call fails."""

    @abstractmethod
    def _columns_and_bytes(self, answer: Any) -> Iterator[tuple[NDArray[Any], bytes]]:
        """Each column of the result, whose last axis is that of the pulses, with its bytes in `answer`."""

    def _store(self, answer: Any, end: int, length: int) -> None:
        """Writes the answer to the batch until `end` into its place. The columns of the batch had `length` elements."""
        table = TableReference.of(answer.table)
        self._table = self._table or table
        self._sea = SeaSummary.of(answer.sea) if answer.HasField("sea") else None
        if table.digest != self._table.digest:
            raise TableChangedError(
                f"server {self._target}: table {table.name} changed from digest {self._table.digest} to "
                f"{table.digest} after {self._answered} of {self._query.size} pulses: repeat the query")
        for column, content in self._columns_and_bytes(answer):
            numbers = np.frombuffer(content, column.dtype.newbyteorder("<")) if content else column[..., :0]
            rows = column.shape[:-1]
            if numbers.size != int(np.prod(rows)) * length:
                raise self._protocol_error(f"it answered {length} pulses with a column of {len(content)} bytes")
            column[..., self._answered:end] = numbers.reshape(*rows, length)
        self._progress(end - self._answered)
        self._answered = end

    def _protocol_error(self, what: str) -> ServiceError:
        return ServiceError(f"server {self._target}: {what}: it may be an albtpu-serve of another version")


class ColumnStream(_Calls):
    """Asks for the effects of the sea surface by one stream."""

    def __init__(self, target: str, stub: UncertaintyServiceStub, query: Query, columns: AnswerColumns,
                 progress: Progress, timeout: float) -> None:
        super().__init__(target, stub, query, progress, timeout)
        self._columns = columns

    def _run_once(self) -> None:
        sender = _Sender(self._query, self._answered, self._timeout)
        call = sender.call = self._stub.StreamColumns(sender.requests())
        try:
            for response in call:
                end = min(self._answered + _BATCH, self._query.size)
                self._store(response.answer, end, sender.lengths.popleft() if sender.lengths else 0)
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

    def _columns_and_bytes(self, answer: Any) -> Iterator[tuple[NDArray[Any], bytes]]:
        columns = self._columns
        yield columns.outcomes, answer.outcomes
        yield columns.outcome_axes, answer.outcome_axes
        for name, column in columns.values.items():
            yield column, getattr(answer.sea_surface, name)
        for name, column in columns.standard_errors.items():
            yield column, getattr(answer.sea_surface_standard_error, name)
        if columns.best_s44_orders is not None:
            yield columns.best_s44_orders, answer.s44.best_orders
        if columns.remaining is not None:
            yield from zip(columns.remaining, (answer.s44.remaining_thu, answer.s44.remaining_tvu))


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
        options = dict(
            table=self._query.table, coverage=COVERAGES[self._query.coverage],
            standard_errors=self._query.standard_errors, best_s44_order=self._query.best_s44_order,
            s44_order=S44_ORDERS.index(self._query.s44_order or ""), refractive_index=self._query.refractive_index)
        quantities = _wire_numbers(self._query.quantities, tuple(QUANTITIES))
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


class BudgetCalls(_Calls):
    """Asks for the whole budget by several calls at a time."""

    def __init__(self, target: str, stub: UncertaintyServiceStub, asked: BudgetQuery, progress: Progress,
                 timeout: float) -> None:
        super().__init__(target, stub, asked.query, progress, timeout)
        self._asked = asked
        self._water: WaterSummary | None = None
        size = asked.query.size
        self._outcomes, self._axes = np.empty(size, np.uint8), np.empty(size, np.uint8)
        self._values: dict[str, NDArray[Any]] = {
            name: np.empty((6, size) if name in COVARIANCES else size,
                           np.uint8 if name == "best_s44_orders" else np.float32) for name in asked.query.quantities}

    def budget(self, retries: Retries) -> Budget:
        """As `run`, with the answer."""
        table, sea = self.run(retries)
        shape = self._query.shape
        return Budget(table, sea, self._query.coverage, self._outcomes.reshape(shape), self._axes.reshape(shape),
                      {name: column.reshape(column.shape[:-1] + shape) for name, column in self._values.items()},
                      self._water, self._asked.left_out)

    def _store(self, answer: Any, end: int, length: int) -> None:
        if self._asked.water is not None and not answer.HasField("water"):
            raise ServiceError(f"server {self._target} computes no water: it is an albtpu-serve of an earlier version")
        super()._store(answer, end, length)
        self._water = WaterSummary.of(answer.water) if answer.HasField("water") else None

    def _run_once(self) -> None:
        calls: deque[tuple[Any, int, int]] = deque()  # Each with the end of its pulses, and the length of its columns.
        sent, most = self._answered, self._asked.most_pulses()
        sea = self._query.sea.message() if self._query.sea else None
        water = self._asked.water.message() if self._asked.water else None
        quantities: list[Any] = _wire_numbers(self._query.quantities, BUDGET_QUANTITIES)
        try:
            while self._answered < self._query.size:
                while sent < self._query.size and len(calls) < _BUDGETS_IN_FLIGHT:
                    end = min(sent + most, self._query.size)
                    pulses, aircraft, length = self._asked.batch(sent, end)
                    request = wire.QueryBudgetRequest(options=self._asked.options, pulses=pulses, aircraft=aircraft,
                                                      quantities=quantities, sea=sea, water=water)
                    calls.append((self._stub.QueryBudget.future(request, timeout=self._timeout), end, length))
                    sent = end
                call, end, length = calls[0]
                self._store(call.result(), end, length)
                calls.popleft()
        finally:
            for call, _, _ in calls:
                call.cancel()

    def _columns_and_bytes(self, answer: Any) -> Iterator[tuple[NDArray[Any], bytes]]:
        yield self._outcomes, answer.outcomes
        yield self._axes, answer.outcome_axes
        for name, column in self._values.items():
            yield column, getattr(answer.budget, name)


def _wire_numbers(names: tuple[str, ...], known: tuple[str, ...]) -> list[int]:
    return [known.index(name) + 1 for name in names]
