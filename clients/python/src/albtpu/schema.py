"""Names, units and numbers of axes, quantities, outcomes and S-44 orders, as in tables and on the wire."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Doubles = NDArray[np.float64]
Floats = NDArray[np.float32]
Numbers = NDArray[np.uint8]


class Description(NamedTuple):
    """CF units and a one-line description of an axis or a quantity."""

    units: str
    long_name: str


# The axes of a table in the order of its dimensions, slowest first. On the wire, an axis is its position here,
# counted from 1.
AXES: dict[str, Description] = {
    "wind_speed": Description("m s-1", "wind speed at 10 m above the sea"),
    "fetch": Description("m", "fetch; at the last node and beyond, the sea is fully developed"),
    "incidence": Description("degree", "incidence of the beam in air, from the vertical"),
    "azimuth": Description("degree", "azimuth of the beam from downwind, folded into 0 to 90 degrees"),
    "footprint": Description("m", "diameter of the beam at the mean surface, across its axis"),
    "depth": Description("m", "depth below the located surface"),
}


class Kind(NamedTuple):
    """A kind of table."""

    axes: dict[str, Description]
    greatest_azimuth: float  # degrees, after folding
    endless: tuple[str, ...]  # The axes on which any coordinate above the last node counts as the last node.


# A table of one sea folds azimuths into half a turn only, and its wind speed and fetch, of one node each, are of no
# effect: any coordinate counts as the node.
SEA_SURFACE, ONE_SEA = "sea_surface", "one_sea"
KINDS = {
    SEA_SURFACE: Kind(AXES, 90.0, ("fetch",)),
    ONE_SEA: Kind(AXES | {
        "wind_speed": Description("m s-1", "wind speed at 10 m above the sea, of this sea: any other counts as it"),
        "fetch": Description("m", "fetch, of no effect: any counts as the node"),
        "azimuth": Description(
            "degree", "azimuth of the beam from the x axis of the sea, folded into 0 to 180 degrees"),
    }, 180.0, ("wind_speed", "fetch")),
}

# The effects of the sea surface on a pulse. On the wire, a quantity is its position here, counted from 1.
QUANTITIES: dict[str, Description] = {
    "refraction_along_wind": Description("degree", "uncertainty of the direction in water, along the wind"),
    "refraction_cross_wind": Description("degree", "uncertainty of the direction in water, across the wind"),
    "thu": Description("m", "total horizontal uncertainty of the sea surface"),
    "tvu": Description("m", "total vertical uncertainty of the sea surface"),
    "bias_along_beam": Description(
        "m", "horizontal bias, positive if reported too far along the azimuth of the beam"),
    "bias_vertical": Description("m", "vertical bias, positive if reported too shallow"),
}
REFRACTIONS = ("refraction_along_wind", "refraction_cross_wind")  # These do not depend on depth.
BIASES = ("bias_along_beam", "bias_vertical")  # Mean errors, the same at any coverage; may be negative.
STANDARD_ERROR = "_standard_error"  # Suffix of the name of a quantity's standard error.

# Indexed by their numbers on the wire.
OUTCOMES = ("UNSPECIFIED", "INTERPOLATED", "OUT_OF_DOMAIN", "INVALID")
INTERPOLATED, OUT_OF_DOMAIN, INVALID = 1, 2, 3
SCALES = ("", "linear", "log")  # Of interpolation.
COVERAGES = {"2sigma": 1, "p95": 2, "1sigma": 3}
# IHO S-44 edition 6.1.0, strictest first; 0 means none.
S44_ORDERS = ("", "exclusive", "special", "1a", "1b", "2")
