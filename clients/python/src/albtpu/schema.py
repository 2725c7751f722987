"""Names, units and numbers of axes, quantities, outcomes and S-44 orders, as in tables and on the wire."""

from typing import NamedTuple


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

# The kinds of tables that are read, and their axes. A table of one sea folds azimuths into half a turn only, and its
# wind speed and fetch, of one node each, are of no effect: any coordinate counts as the node.
SEA_SURFACE, ONE_SEA = "sea_surface", "one_sea"
AXES_OF_KIND: dict[str, dict[str, Description]] = {
    SEA_SURFACE: AXES,
    ONE_SEA: AXES | {
        "wind_speed": Description("m s-1", "wind speed at 10 m above the sea, of this sea: any other counts as it"),
        "fetch": Description("m", "fetch, of no effect: any counts as the node"),
        "azimuth": Description(
            "degree", "azimuth of the beam from the x axis of the sea, folded into 0 to 180 degrees"),
    },
}
GREATEST_AZIMUTH = {SEA_SURFACE: 90.0, ONE_SEA: 180.0}  # degrees, after folding
# The axes on which any coordinate above the last node counts as the last node.
ENDLESS_AXES = {SEA_SURFACE: ("fetch",), ONE_SEA: ("wind_speed", "fetch")}

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
COVERAGES = {"2sigma": 1, "p95": 2, "1sigma": 3}
# IHO S-44 edition 6.1.0, strictest first; 0 means none.
S44_ORDERS = ("", "exclusive", "special", "1a", "1b", "2")

# The columns of the aircraft in a query of the whole budget, with their units, in the order of the wire.
AIRCRAFT: dict[str, str] = {
    "altitude": "m", "beam_azimuth": "degree", "roll": "degree", "pitch": "degree", "heading": "degree",
    "velocity_north": "m s-1", "velocity_east": "m s-1", "velocity_down": "m s-1",
    "roll_rate": "degree s-1", "pitch_rate": "degree s-1", "yaw_rate": "degree s-1",
    "position_sigma_north": "m", "position_sigma_east": "m", "position_sigma_down": "m",
    "roll_sigma": "degree", "pitch_sigma": "degree", "heading_sigma": "degree", "wave_height": "m",
    "water_sigma_along": "m", "water_sigma_vertical": "m", "water_correlation": "1", "water_noise": "m",
    "water_bias_along": "m", "water_bias_vertical": "m"}
# How the surface was located, and the quantities of the budget. On the wire, each is its position here, counted from 1.
LOCATIONS = ("pulse", "local", "level")
COVARIANCES = ("covariance_total", "covariance_air", "covariance_sea", "covariance_pulse", "covariance_line",
               "covariance_survey")
BUDGET_QUANTITIES = ("total_thu", "total_tvu", "thu_air", "tvu_air", "thu_sea", "tvu_sea", "bias_along_beam",
                     "bias_vertical", *COVARIANCES, "best_s44_orders", "thu_water", "tvu_water")
