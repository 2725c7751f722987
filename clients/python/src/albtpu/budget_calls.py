"""Sends a large query of the budget as calls, several at a time, and writes each answer into its place."""

from __future__ import annotations

from collections import deque
from typing import Any

import grpc
import numpy as np
from numpy.typing import NDArray

from .budget import Budget, BudgetQuery
from .errors import ServiceError, TableChangedError
from .progress import Progress
from .retries import Retries, service_error
from .schema import BUDGET_QUANTITIES, COVARIANCES, COVERAGES
from .tables import SeaSummary, TableReference
from .v1 import uncertainty_service_pb2 as wire
from .v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub

_AT_A_TIME = 4  # Calls that are not yet answered.


class BudgetCalls:
    """Asks a server for the budget of all pulses of a query.

    After a failure it continues with the first pulse that is still unanswered. `timeout` is the time limit of
    one answer, in s.
    """

    def __init__(self, target: str, stub: UncertaintyServiceStub, asked: BudgetQuery, progress: Progress,
                 timeout: float) -> None:
        self._target, self._stub, self._asked = target, stub, asked
        self._progress, self._timeout = progress, timeout
        self._size, self._answered = asked.query.size, 0  # Pulses.
        self._table: TableReference | None = None
        self._summary: SeaSummary | None = None
        self._sea = asked.query.sea.message() if asked.query.sea else None
        self._options = dict(asked.options, coverage=COVERAGES[asked.query.coverage])
        self._numbers: list[Any] = [BUDGET_QUANTITIES.index(name) + 1 for name in asked.quantities]
        self._outcomes, self._axes = (np.empty(self._size, np.uint8) for _ in range(2))
        self._columns = {name: _column(name, self._size) for name in asked.quantities}

    def run(self, retries: Retries) -> Budget:
        """Returns the answer. The query must have at least one pulse. Raises ServiceError."""
        while self._answered < self._size:
            before = self._answered
            try:
                self._run_once()
            except grpc.RpcError as error:
                if self._answered > before:
                    retries.succeeded()
                if not retries.wait_after(error):
                    raise service_error(self._target, error) from error
        query = self._asked.query
        assert self._table is not None
        return Budget(self._table, self._summary, query.coverage, self._outcomes.reshape(query.shape),
                      self._axes.reshape(query.shape),
                      {name: column.reshape(column.shape[:-1] + query.shape) for name, column in self._columns.items()})

    def _run_once(self) -> None:
        calls: deque[tuple[Any, int, int]] = deque()  # Each with the end of its pulses, and the length of its columns.
        sent, most = self._answered, self._asked.most_pulses()
        try:
            while self._answered < self._size:
                while sent < self._size and len(calls) < _AT_A_TIME:
                    end = min(sent + most, self._size)
                    pulses, aircraft, length = self._asked.batch(sent, end)
                    request = wire.QueryBudgetRequest(options=self._options, pulses=pulses, aircraft=aircraft,
                                                      quantities=self._numbers, sea=self._sea)
                    calls.append((self._stub.QueryBudget.future(request, timeout=self._timeout), end, length))
                    sent = end
                call, end, length = calls[0]
                self._store(call.result(), end, length)
                calls.popleft()
        finally:
            for call, _, _ in calls:
                call.cancel()

    def _store(self, answer: Any, end: int, length: int) -> None:
        """Writes an answer into its place. The columns of its batch had `length` elements."""
        table = TableReference.of(answer.table)
        self._table = self._table or table
        self._summary = SeaSummary.of(answer.sea) if answer.HasField("sea") else None
        if table.digest != self._table.digest:
            raise TableChangedError(
                f"server {self._target}: table {table.name} changed from digest {self._table.digest} to "
                f"{table.digest} after {self._answered} of {self._size} pulses: repeat the query")
        place = slice(self._answered, end)
        self._fill(self._outcomes[place], answer.outcomes, length)
        self._fill(self._axes[place], answer.outcome_axes, length)
        for name, column in self._columns.items():
            self._fill(column[..., place], getattr(answer.budget, name), length)
        self._progress(end - self._answered)
        self._answered = end

    def _fill(self, column: NDArray[Any], content: bytes, length: int) -> None:
        numbers = np.frombuffer(content, column.dtype.newbyteorder("<")) if content else column[..., :0]
        rows = column.size // max(column.shape[-1], 1)
        if numbers.size != rows * length:
            raise ServiceError(f"server {self._target}: it answered {length} pulses with a column of {len(content)} "
                               "bytes: it may be an albtpu-serve of another version")
        column[...] = numbers.reshape(column.shape[:-1] + (length,))


def _column(name: str, size: int) -> NDArray[Any]:
    if name == "best_s44_orders":
        return np.empty(size, np.uint8)
    return np.empty((6, size) if name in COVARIANCES else size, np.float32)
