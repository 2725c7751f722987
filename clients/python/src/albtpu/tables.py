"""Descriptions of tables: identity, axes, quantities, provenance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

AttributeValue = Union[str, int, float, list[float]]


class TableReference(NamedTuple):
    """Identifies a table."""

    name: str  # Its name on the server: "survey", "survey/2". Of a file, the file name without ".h5".
    id: str  # Identifier that its maker gave it.
    version: str  # Version that its maker gave it.
    digest: str  # SHA-256 of the content, 64 hexadecimal digits. Tables with the same digest give the same answers.

    @classmethod
    def of(cls, message: Any) -> TableReference:
        """From albtpu.v1.TableReference."""
        return cls(message.name, message.id, message.version, message.digest)


class TableSummary(NamedTuple):
    """An entry in the list of a server's tables."""

    reference: TableReference
    title: str
    is_default: bool  # Whether it answers queries that name no table.


class Axis(NamedTuple):
    """An axis of a table."""

    nodes: NDArray[np.float32]  # Increasing, in `units`. The domain includes the first and the last.
    units: str
    long_name: str
    scale: str  # Scale of interpolation along the axis: "linear" or "log".


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
    axes: dict[str, Axis]  # All six, slowest dimension first.
    quantities: dict[str, Quantity]  # Those that the table has.
    campaign: str  # The campaign file (TOML) that it was made from; empty for tables of published numbers.
    attributes: dict[str, AttributeValue]  # All other attributes of the file.
