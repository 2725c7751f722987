"""Incidence, azimuth and paths of beams, from the position of each point relative to the sensor.

    beams = albtpu.geometry.beams(east=x - sensor_x, north=y - sensor_y, height=sensor_z - water_z, depth=water_z - z)
    footprint = albtpu.geometry.footprint(beams.slant_range, divergence_mrad=1)
    service.query(wind_speed=5, incidence=beams.incidence, footprint=footprint, depth=water_z - z,
                  azimuth=albtpu.geometry.azimuth_from_downwind(beams.beam_azimuth, wind_from=270))

The twin of budget/beams/beam_columns.h, with the same bits: only +, -, *, /, square roots and comparisons are used, in
the same order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .arguments import common_shape, read_doubles
from .errors import ArgumentError
from .schema import Doubles

__all__ = ["Beams", "SEA_WATER_INDEX", "azimuth_from_downwind", "azimuth_on_sea", "beams", "footprint"]

SEA_WATER_INDEX = 1.34
"""The refractive index of sea water at 532 nm, Quan and Fry (1995): 1.3415 at 20 degrees C and a salinity of 35."""

_STEPS = 5  # kRefractionSteps
_BLOCK = 8192  # Pulses whose columns fit into the cache together.


@dataclass(frozen=True)
class Beams:
    """Beams in double precision, in the shape of the points.

    The incidence is in air, where the beam meets the water. The azimuth is where the beam travels to, clockwise from
    true north, in [0, 360). The slant range is in air, from the sensor to the water; the path in water is from the
    surface to the point. A point that is not under water is reached in a straight line: then the slant range is the
    distance to it, and the path in water is 0. Where the sensor is not above the water, or a number is NaN that they
    depend on, incidence and slant range are NaN.
    """

    incidence: Doubles  # degree
    beam_azimuth: Doubles  # degree
    slant_range: Doubles  # m
    water_path: Doubles  # m


def beams(*, east: ArrayLike, north: ArrayLike, height: ArrayLike, depth: ArrayLike, index: float = SEA_WATER_INDEX,
          convergence: ArrayLike = 0) -> Beams:
    """The beams to points. Numbers and arrays broadcast to one shape. Raises ArgumentError.

    `east` and `north` are the true horizontal metres from the sensor to the point along the axes of the grid: divide
    the scale of a map projection out. `height` is that of the sensor above the water and `depth` that of the point
    below it, in m. `index` is the refractive index of the water. `convergence`, from -180 to 180 degrees, is the true
    azimuth of grid north: true azimuth = grid azimuth + convergence.

    >>> import albtpu.geometry
    >>> beams = albtpu.geometry.beams(east=0, north=-150, height=400, depth=[0, 10, 20])
    >>> beams.incidence.round(2), beams.beam_azimuth
    (array([20.56, 20.22, 19.89]), array([180., 180., 180.]))
    """
    if not isinstance(index, (int, float, np.number)) or not 1 <= float(index) < math.inf:
        raise ArgumentError(f"index is {index!r}: it should be a number from 1, such as {SEA_WATER_INDEX}")
    given = {"east": east, "north": north, "height": height, "depth": depth, "convergence": convergence}
    arrays = {name: read_doubles(name, values) for name, values in given.items()}
    if np.any(np.abs(arrays["convergence"]) > 180):
        raise ArgumentError("convergence is beyond 180 degrees: it should be that of the grid, in degrees")
    shape = common_shape(arrays, given)
    x, y, above, below, grid = (np.broadcast_to(array, shape).reshape(-1) for array in arrays.values())
    found = beams_in_radians(x, y, above, below, grid * np.pi / 180, float(index))
    incidence, azimuth, slant_range, water_path = (column.reshape(shape) for column in found)
    return Beams(np.divide(incidence * 180, np.pi), np.divide(azimuth * 180, np.pi), slant_range, water_path)


def footprint(slant_range: ArrayLike, divergence_mrad: ArrayLike, aperture: ArrayLike = 0) -> Doubles:
    """The diameter [m], across its axis, of a beam after `slant_range` [m].

    `divergence_mrad` is the full angle, in mrad; `aperture` is the diameter where the beam leaves the sensor, in m.

    >>> footprint(400, divergence_mrad=1, aperture=0.05)
    array(0.45)
    """
    distance, divergence, diameter = _together(slant_range=slant_range, divergence_mrad=divergence_mrad,
                                               aperture=aperture)
    return np.asarray(distance * (divergence * 1e-3) + diameter)


def azimuth_from_downwind(beam_azimuth: ArrayLike, wind_from: ArrayLike) -> Doubles:
    """The azimuth of a beam from downwind, in [0, 360) degrees, as queries take it.

    `beam_azimuth` is where the beam travels to, `wind_from` where the wind comes from: both in degrees clockwise from
    true north.

    >>> azimuth_from_downwind([0, 90, 180], wind_from=270)
    array([270.,   0.,  90.])
    """
    beam, wind = _together(beam_azimuth=beam_azimuth, wind_from=wind_from)
    return _full_turn(beam - (wind + 180))


def azimuth_on_sea(beam_azimuth: ArrayLike, x_azimuth: ArrayLike) -> Doubles:
    """The azimuth of a beam from the x axis of a sea, in [0, 360) degrees, as queries with a sea take it.

    `beam_azimuth` is where the beam travels to, `x_azimuth` that of the sea (albtpu.SeaSummary, or an attribute of its
    table): both in degrees clockwise from true north. Azimuths on a sea turn the other way.

    >>> azimuth_on_sea([0, 90, 180], x_azimuth=45)
    array([ 45., 315., 225.])
    """
    x, beam = _together(x_azimuth=x_azimuth, beam_azimuth=beam_azimuth)
    return _full_turn(x - beam)


def _together(**given: ArrayLike) -> list[Doubles]:
    """Columns that broadcast to one shape."""
    arrays = {name: read_doubles(name, values) for name, values in given.items()}
    common_shape(arrays, given)
    return list(arrays.values())


def _full_turn(angle: Doubles) -> Doubles:
    turned = np.asarray(np.mod(angle, 360))
    return np.where(turned >= 360, 0.0, turned)  # A tiny negative number modulo 360 is 360.


def beams_in_radians(east: Doubles, north: Doubles, height: Doubles, depth: Doubles, convergence: Doubles,
                     index: float) -> tuple[Doubles, Doubles, Doubles, Doubles]:
    """Incidence, azimuth, slant range and path in water as ComputeBeams of budget/beams/beam_columns.h has them.

    All are columns of one length, in rad and m.
    """
    found = (np.empty_like(east), np.empty_like(east), np.empty_like(east), np.empty_like(east))
    with np.errstate(all="ignore"):  # The branches that are not selected may be NaN.
        for begin in range(0, east.size, _BLOCK):
            rows = slice(begin, begin + _BLOCK)
            block = _block(east[rows], north[rows], height[rows], depth[rows], convergence[rows], index)
            for column, values in zip(found, block):
                column[rows] = values
    return found


def _block(east: Doubles, north: Doubles, height: Doubles, depth: Doubles, convergence: Doubles,
           index: float) -> tuple[Doubles, Doubles, Doubles, Doubles]:
    distance = np.sqrt(east * east + north * north)
    height = np.where(height > 0, height, np.nan)
    dry = depth <= 0
    in_air = np.where(dry, height + depth, height)  # Vertically, from the sensor to where the path in air ends.
    depth = np.where(dry, 0.0, depth)
    r = np.where(dry, distance, _distance_to_water(distance, height, depth, index))
    rest = distance - r
    return (_arctangent(r, in_air), _true_azimuth(_arctangent(east, north), convergence),
            np.sqrt(r * r + in_air * in_air), np.sqrt(rest * rest + depth * depth))


def _true_azimuth(turn: Doubles, convergence: Doubles) -> Doubles:
    azimuth = turn + convergence
    positive = np.where(azimuth < 0, azimuth + 2 * np.pi, azimuth)
    return np.where(positive >= 2 * np.pi, positive - 2 * np.pi, positive)


def _distance_to_water(distance: Doubles, height: Doubles, depth: Doubles, index: float) -> Doubles:
    """The horizontal distance from the sensor at which a beam meets the water: budget/beams/refracted_path.h."""
    square, excess = index * index, (index - 1) * (index + 1)
    gentlest, flattest = 1 / index, 1 / math.sqrt(excess) if excess > 0 else math.inf
    all_gentle = height + depth * gentlest
    in_air = distance - depth * flattest
    flat = in_air * all_gentle > distance * height
    least = np.where(flat, in_air, distance) / np.where(flat, height, all_gentle)
    t = least
    for _ in range(_STEPS):
        t = _next_tangent(t, least, distance, height, depth, square, excess)
    r = height * t
    return np.where(r > distance, distance, r)


def _next_tangent(t: Doubles, least: Doubles, distance: Doubles, height: Doubles, depth: Doubles,
                  index_square: float, index_excess: float) -> Doubles:
    inverse = 1 / np.sqrt(index_square + index_excess * (t * t))
    square = inverse * inverse
    excess = height * t + depth * (t * inverse) - distance
    bend = depth * (index_square * (inverse * square))
    slope = height + bend
    curvature = bend * (index_excess * t) * square
    newton = slope * slope
    halley = newton + 1.5 * (excess * curvature)
    longest = 0.5 * newton
    shorter = np.where(halley < newton, halley, newton)
    divisor = np.where(shorter > longest, shorter, longest)
    following = t - excess * slope / divisor
    return np.where(following > least, following, least)


# Q of budget/beams/arctangent.h.
_ARCTANGENT = (0.020660413422554418, -0.04305973833246121, 0.05672436898369194, -0.06636885171566724,
               0.07689524976703539, -0.09090738891781402, 0.11111104507599112, -0.14285714133696484,
               0.1999999999818374, -0.33333333333325194)


def _arctangent(y: Doubles, x: Doubles) -> Doubles:
    """The angle of the vector (x, y) from the x axis: budget/beams/arctangent.h."""
    along, across = np.abs(x), np.abs(y)
    steep = along < across
    longer, shorter = np.where(steep, across, along), np.where(steep, along, across)
    turned = shorter > 0.41421356237309503 * longer
    numerator = np.where(turned, shorter - longer, shorter)
    denominator = np.where(turned, shorter + longer, longer)
    v = numerator / np.where(denominator == 0, 1.0, denominator)
    z = v * v
    q: Any = _ARCTANGENT[0]
    for coefficient in _ARCTANGENT[1:]:
        q = q * z + coefficient
    small = v + v * z * q
    in_octant = np.where(turned, np.pi / 4 + small, small)
    in_quadrant = np.where(steep, np.pi / 2 - in_octant, in_octant)
    above = np.where(x < 0, np.pi - in_quadrant, in_quadrant)
    return np.where(y < 0, -above, above)
