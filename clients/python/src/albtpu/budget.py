"""The whole uncertainty budget of pulses: a query of air side, sea surface and vertical datum, its calls and answer."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import grpc
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError, ServiceError, TableChangedError
from .names import check_name
from .progress import Progress
from .query import Query, read_query
from .retries import Retries, service_error
from .schema import AIRCRAFT, AXES, BUDGET_QUANTITIES, COVARIANCES, COVERAGES, LOCATIONS, OUTCOMES, S44_ORDERS
from .sea import Sea
from .tables import SeaSummary, TableReference
from .v1 import uncertainty_service_pb2 as wire
from .v1.budget_pb2 import AirErrors
from .v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub

_AT_A_TIME = 4  # Calls that are not yet answered.

# The sources of error of the air side: three numbers of these names, or a single one.
_ERRORS = {source.name: tuple(part.name for part in source.message_type.fields) if source.message_type else ()
           for source in AirErrors.DESCRIPTOR.fields}


@dataclass(frozen=True)
class BudgetQuery:
    """A valid query of the budget."""

    query: Query  # Its columns are those of the table and of the aircraft.
    options: dict[str, Any]  # The fields of albtpu.v1.BudgetOptions.
    quantities: tuple[str, ...]

    def batch(self, begin: int, end: int) -> tuple[dict[str, bytes], dict[str, bytes], int]:
        """The columns of the table and of the aircraft from `begin` to `end`, and the length of the longest."""
        columns = self.query.batch(begin, end)
        return ({name: column.tobytes() for name, column in columns.items() if name in AXES},
                {name: column.tobytes() for name, column in columns.items() if name in AIRCRAFT},
                max(column.size for column in columns.values()))

    def most_pulses(self) -> int:
        """The number of pulses in a message of at most 4 MiB; half of the 65 536 that it may have."""
        asked = 4 * sum(column.size > 1 for column in self.query.columns.values())
        answered = 3 + 4 * sum(6 if name in COVARIANCES else 1 for name in self.quantities)
        return int(min(32768, 4_000_000 // max(asked, answered)))


def read_budget_query(pulses: Mapping[str, ArrayLike | None], aircraft: Mapping[str, ArrayLike], *,
                      located: str, errors: Mapping[str, Any] | None, lever_arm: Sequence[float],
                      refractive_index: float, datum: float, sea_axis: float | None,
                      quantities: Iterable[str], coverage: str, table: str | None, sea: Sea | None) -> BudgetQuery:
    """Checks the arguments of a query of the budget. Raises ArgumentError."""
    query = read_query({**pulses, **aircraft}, quantities=None, coverage=coverage, standard_errors=False,
                       s44_order=None, best_s44_order=False, table=table, sea=sea, on_one_sea=sea is not None)
    check_name("located", located, LOCATIONS)
    wanted = {quantities} if isinstance(quantities, str) else set(quantities)
    for name in wanted:
        check_name("quantities", name, BUDGET_QUANTITIES)
    if not wanted:
        raise ArgumentError("quantities is empty: name at least one")
    options: dict[str, Any] = dict(
        table=table, errors=_read_errors(errors or {}), located=LOCATIONS.index(located) + 1,
        lever_arm=_three("lever_arm", lever_arm, _ERRORS["boresight"]),
        refractive_index=_number("refractive_index", refractive_index), datum=_number("datum", datum),
        sea_axis=None if sea_axis is None else _number("sea_axis", sea_axis))
    return BudgetQuery(query, options, tuple(name for name in BUDGET_QUANTITIES if name in wanted))


def _read_errors(errors: Mapping[str, Any]) -> dict[str, Any]:
    for name in errors:
        check_name("errors", name, _ERRORS)
    return {name: _three(f"errors[{name!r}]", value, _ERRORS[name]) if _ERRORS[name]
            else _number(f"errors[{name!r}]", value) for name, value in errors.items()}


def _three(name: str, values: Sequence[float], axes: tuple[str, ...]) -> dict[str, float]:
    try:
        first, second, third = values
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {values!r}: it should be three numbers: {', '.join(axes)}") from None
    return {axis: _number(name, value) for axis, value in zip(axes, (first, second, third))}


def _number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {value!r}: it should be a number") from None


@dataclass(frozen=True)
class Budget:
    """The answer to a query of the budget. All arrays have the shape of the query; NaN where a pulse has no number.

    total_thu, total_tvu, thu_air, tvu_air, thu_sea, tvu_sea, thu_water, tvu_water, bias_along_beam, bias_vertical:
                     float32, in m. A covariance has six such arrays along a first axis, in m2 at 1 sigma: north-north,
                     east-east, down-down, north-east, north-down, east-down. best_s44_orders: uint8 as in
                     Uncertainties.
                     Those that the query did not request raise AttributeError.
    table, sea, coverage, outcomes: as in Uncertainties.
    outcome_axes:    as in Uncertainties; 0 also if a number of the aircraft made the pulse INVALID.
    values:          the quantities by name.
    """

    table: TableReference
    sea: SeaSummary | None
    coverage: str
    outcomes: NDArray[np.uint8]
    outcome_axes: NDArray[np.uint8]
    values: Mapping[str, NDArray[Any]] = field(repr=False)

    def __getattr__(self, name: str) -> Any:
        if name != "values" and name in self.values:
            return self.values[name]
        hint = ": name it in 'quantities'" if name in BUDGET_QUANTITIES else ""
        raise AttributeError(f"this answer has no '{name}'{hint}")

    @property
    def outcome(self) -> NDArray[np.object_]:
        """Words: "INTERPOLATED", "OUT_OF_DOMAIN:depth", "INVALID"."""
        return np.asarray(_WORDS[self.outcomes, self.outcome_axes * (self.outcomes == 2)], object)

    @property
    def best_s44_order(self) -> NDArray[np.object_]:
        """Words: "exclusive", "special", "1a", "1b", "2"; "" for none."""
        return np.asarray(np.array(S44_ORDERS, object)[self.best_s44_orders], object)


_WORDS = np.array([[outcome + (f":{axis}" if axis else "") for axis in ("", *AXES)] for outcome in OUTCOMES], object)


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
