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
    # SHA-256 of the content, 64 hexadecimal digits. Tables with the same digest give the same answers if their
    # attributes refractive_index and x_azimuth are the same, too.
    digest: str

    @classmethod
    def of(cls, message: Any) -> TableReference:
        """From albtpu.v1.TableReference."""
        return cls(message.name, message.id, message.version, message.digest)


class SeaSummary(NamedTuple):
    """A sea as the service computed it, with what it assumed."""

    x_azimuth: float  # degrees of the compass, where azimuths are 0: albtpu.geometry.azimuth_on_sea
    significant_wave_height: float  # m, 4 sqrt(m0) of the whole sea
    wind_speed: float  # m/s at 10 m, given or taken from the waves
    water_depth: float  # m; infinity for deep water
    tail_from: float  # Hz, from where the waves of the wind are joined; 0 without known waves
    share_measured: float  # of the known waves in the variance of slope at a footprint of 0.6 m, 0 to 1
    assumptions: tuple[str, ...]  # What was assumed: one sentence each.

    @classmethod
    def of(cls, message: Any) -> SeaSummary:
        """From albtpu.v1.SeaSummary."""
        return cls(message.x_azimuth, message.significant_wave_height, message.wind_speed, message.water_depth,
                   message.tail_from, message.share_measured, tuple(message.assumptions))

    @classmethod
    def of_attributes(cls, attributes: dict[str, AttributeValue]) -> SeaSummary:
        """From the attributes of the table of a sea."""
        def number(name: str, absent: float = 0.0) -> float:
            value: Any = attributes.get(name, absent)
            return float(value[0] if isinstance(value, list) and len(value) == 1 else value)

        return cls(number("x_azimuth"), number("significant_wave_height"), number("wind_speed_10m"),
                   number("water_depth", float("inf")), number("tail_from"), number("share_measured"),
                   tuple(str(attributes.get("assumptions", "")).split("\n")) if "assumptions" in attributes else ())


class WaterSummary(NamedTuple):
    """A water as the service computed it, with what it assumed."""

    table: TableReference | None  # The table of the water column; None if its contribution was left out.
    attenuation: float  # 1/m, of the lidar's light: the median; 0 if no optics were needed
    attenuation_log_sigma: float  # Standard deviation of its logarithm.
    derivation: str  # What was given, and how the attenuation follows from it.
    greatest_depth: float  # m: pulses beyond are out of domain; so are those beyond the next two.
    greatest_incidence: float  # degrees
    greatest_footprint: float  # m
    green_surface_range: float  # m, the range in air by which the surface is found too far
    assumptions: tuple[str, ...]  # What was assumed: one sentence each.

    @classmethod
    def of(cls, message: Any) -> WaterSummary:
        """From albtpu.v1.WaterSummary."""
        return cls(TableReference.of(message.table) if message.HasField("table") else None, message.attenuation,
                   message.attenuation_log_sigma, message.derivation, message.greatest_depth,
                   message.greatest_incidence, message.greatest_footprint, message.green_surface_range,
                   tuple(message.assumptions))


class Answered(NamedTuple):
    """What answered a query."""

    table: TableReference
    sea: SeaSummary | None = None  # If the table is that of one sea.


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
    kind: str = "sea_surface"  # Of winds and fetches; "one_sea": of one sea, whose azimuths span half a turn.
