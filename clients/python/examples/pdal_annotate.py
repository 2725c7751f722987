"""Adds `sea_thu` and `sea_tvu`, the contribution of the sea surface in THU and TVU, to points in a PDAL pipeline.

    pdal pipeline pdal_pipeline.json --readers.las.filename=line.laz --writers.las.filename=annotated.laz

PDAL calls `annotate` with NumPy arrays by dimension, and defines `pdalargs` in this module. Its options:

service or table  "HOST:PORT" of a service, or a table file
trajectory        text with a header and the columns GpsTime, X, Y, Z: GPS seconds of the week, and the sensor in the
                  coordinates of the points, in m (laspy_annotate.py says how PDAL makes it of an SBET)
  or incidence    degrees, for a scanner that keeps one incidence,
  and altitude    m above the water
water_level       m, in the datum of Z
wind_speed        m/s at 10 m
divergence        mrad, full angle of the beam
classes           classes of bathymetric points; default 40
fetch             m; optional
wind_from         degrees, where the wind comes from; optional, with a trajectory. X and Y are taken as east and north.
"""

import albtpu
import albtpu.geometry
import numpy as np

NO_DATA = -1.0  # For points of other classes, and those without a number.
LONGEST_GAP = 0.2  # s between two positions; points in a longer gap get no number.


def sensor_at(times, track):
    """X, Y and Z of the sensor at GPS times, NaN where the track (rows of GpsTime, X, Y, Z) has no position."""
    seconds = np.where(times < 604800, times, (times + 1e9) % 604800)  # The second form of LAS is GPS - 1e9 s.
    after = np.clip(np.searchsorted(track[:, 0], seconds), 1, len(track) - 1)
    known = ((seconds >= track[0, 0]) & (seconds <= track[-1, 0])
             & (track[after, 0] - track[after - 1, 0] <= LONGEST_GAP))
    return [np.where(known, np.interp(seconds, track[:, 0], column), np.nan) for column in track[:, 1:4].T]


def pulses_of(points, options):
    """Incidence, footprint, depth and, if the wind direction is given, azimuth of bathymetric points."""
    depth = options["water_level"] - points["Z"]
    if "trajectory" not in options:
        slant_range = options["altitude"] / np.cos(np.radians(options["incidence"]))
        return dict(incidence=options["incidence"], footprint=slant_range * options["divergence"] / 1000, depth=depth)
    x, y, z = sensor_at(points["GpsTime"], np.loadtxt(options["trajectory"], delimiter=",", skiprows=1, ndmin=2))
    beams = albtpu.geometry.beams(east=points["X"] - x, north=points["Y"] - y, height=z - options["water_level"],
                                  depth=depth)
    pulses = dict(incidence=beams.incidence, footprint=beams.slant_range * options["divergence"] / 1000, depth=depth)
    if "wind_from" in options:
        pulses["azimuth"] = albtpu.geometry.azimuth_from_downwind(beams.beam_azimuth, options["wind_from"])
    return pulses


def annotate(ins, outs):
    options = pdalargs  # noqa: F821, defined by PDAL
    bathymetric = np.isin(ins["Classification"], options.get("classes", [40]))
    points = {name: ins[name][bathymetric] for name in ("X", "Y", "Z", "GpsTime")}
    optional = {"fetch": options["fetch"]} if "fetch" in options else {}
    source = albtpu.open_table(options["table"]) if "table" in options else albtpu.connect(options["service"])
    with source:
        answer = source.query(wind_speed=options["wind_speed"], quantities=("thu", "tvu"),
                              **pulses_of(points, options), **optional)
    for name, values in (("sea_thu", answer.thu), ("sea_tvu", answer.tvu)):
        outs[name] = np.full(bathymetric.shape, NO_DATA)
        outs[name][bathymetric] = np.where(answer.interpolated, values, NO_DATA)
    print(f"albtpu: table {answer.table.id} {answer.table.version}, digest {answer.table.digest}, "
          f"{answer.outcome_counts()}")
    return True
