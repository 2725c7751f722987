"""What tables say about themselves: which one it is, its axes, what it holds, where it comes from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

AttributeValue = Union[str, int, float, list[float]]


class TableReference(NamedTuple):
    """Names one table among all."""

    name: str  # What to ask a server for to get it: "survey", "survey/2". Of a file, its name without ".h5".
    id: str  # What it is, by its maker.
    version: str  # Which making of it, by its maker.
    digest: str  # SHA-256 of the content, 64 hexadecimal digits: tables of one digest answer alike.

    @classmethod
    def of(cls, message: Any) -> TableReference:
        """From albtpu.v1.TableReference."""
        return cls(message.name, message.id, message.version, message.digest)


class TableSummary(NamedTuple):
    """A table in a list."""

    reference: TableReference
    title: str
    is_default: bool  # It answers queries that name no table.


class Axis(NamedTuple):
    """An axis of a table."""

    nodes: NDArray[np.float32]  # Increasing, in `units`; the first and the last belong to the domain.
    units: str
    long_name: str
    scale: str  # How values are interpolated along it: "linear" or "log".


class Quantity(NamedTuple):
    """A quantity that a table holds."""

    units: str
    long_name: str
    scale: str  # "linear" or "log".
    has_standard_error: bool


@dataclass(frozen=True)
class Table:
    """A table without its values."""

    reference: TableReference
    title: str
    axes: dict[str, Axis]  # All six, slowest first.
    quantities: dict[str, Quantity]  # Those that it holds.
    campaign: str  # The TOML text that made it; empty for tables of published numbers.
    attributes: dict[str, AttributeValue]  # All else that it says about itself.
