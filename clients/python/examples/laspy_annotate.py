"""Adds `sea_thu` and `sea_tvu`, the contribution of the sea surface in THU and TVU, to a LAS or LAZ file, with laspy 2.

    python3 laspy_annotate.py line.laz annotated.laz --server localhost:50051 \\
        --trajectory track.csv --water-level -23.09 --wind-speed 5 --divergence 1.5

The trajectory is text with a header and the columns GpsTime, X, Y, Z: GPS seconds of the week, and the sensor in the
coordinates of the points, in m. PDAL makes it of an SBET, whose heights are ellipsoidal:

    pdal translate line.sbet track.csv reprojection --filters.reprojection.in_srs=EPSG:4979 \\
        --filters.reprojection.out_srs=EPSG:26917 \\
        --writers.text.order=GpsTime,X,Y,Z --writers.text.keep_unspecified=false

For a scanner that keeps one incidence, --incidence and --altitude do instead of --trajectory.
"""

import argparse
import os
import pathlib

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


def annotate(source, points, classification, sensor, *, water_level, wind_speed, divergence, classes=(40,)):
    """The sea's THU and TVU of all points (float32, m, 2 sigma), and the answer for the bathymetric points.

    `points` and `sensor` are X, Y and Z, `water_level` a height, in m; `divergence` in mrad, full angle. Instead of the
    sensor, `sensor` may be a pair: the one incidence of a cone in degrees, and the altitude above the water in m. The
    azimuth is omitted: each value is the larger of those along and across the wind.
    """
    bathymetric = np.isin(classification, classes)
    x, y, z = (np.asarray(column, float)[bathymetric] for column in points)
    depth = water_level - z
    if len(sensor) == 2:
        incidence, slant_range = sensor[0], sensor[1] / np.cos(np.radians(sensor[0]))
    else:
        sensor_x, sensor_y, sensor_z = (column[bathymetric] for column in sensor)
        beams = albtpu.geometry.beams(east=x - sensor_x, north=y - sensor_y, height=sensor_z - water_level, depth=depth)
        incidence, slant_range = beams.incidence, beams.slant_range
    answer = source.query(wind_speed=wind_speed, incidence=incidence, footprint=slant_range * divergence / 1000,
                          depth=depth, quantities=("thu", "tvu"), progress=True)
    columns = []
    for values in (answer.thu, answer.tvu):
        column = np.full(len(bathymetric), NO_DATA, np.float32)
        column[bathymetric] = np.where(answer.interpolated, values, NO_DATA)
        columns.append(column)
    return *columns, answer


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("input", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--server", help="HOST:PORT")
    where.add_argument("--table", type=pathlib.Path, help="a table file, without a server")
    beam = parser.add_mutually_exclusive_group(required=True)
    beam.add_argument("--trajectory", type=pathlib.Path, help="text with GpsTime, X, Y, Z")
    beam.add_argument("--incidence", type=float, help="degrees, the same for all points; with --altitude")
    parser.add_argument("--altitude", type=float, help="m above the water")
    for flag, unit in (("water-level", "m"), ("wind-speed", "m/s at 10 m"), ("divergence", "mrad, full angle")):
        parser.add_argument(f"--{flag}", type=float, required=True, help=unit)
    parser.add_argument("--classes", type=int, nargs="+", default=[40], help="classes of bathymetric points")
    flags = parser.parse_args()
    if (flags.incidence is None) != (flags.altitude is None):
        parser.error("--incidence and --altitude go together")

    import laspy

    las = laspy.read(flags.input)
    sensor = (flags.incidence, flags.altitude)
    if flags.trajectory:
        track = np.loadtxt(flags.trajectory, delimiter=",", skiprows=1, ndmin=2)
        sensor = sensor_at(np.asarray(las.gps_time), track)
    with albtpu.open_table(flags.table) if flags.table else albtpu.connect(flags.server) as source:
        thu, tvu, answer = annotate(
            source, (las.x, las.y, las.z), np.asarray(las.classification), sensor, water_level=flags.water_level,
            wind_speed=flags.wind_speed, divergence=flags.divergence, classes=flags.classes)
    for name, column in (("sea_thu", thu), ("sea_tvu", tvu)):
        las.add_extra_dim(laspy.ExtraBytesParams(name, "f4", description="sea surface only, 2 sigma, m"))
        las[name] = column
    unfinished = flags.output.with_stem(flags.output.stem + ".unfinished")
    las.write(unfinished)
    os.replace(unfinished, flags.output)
    print(answer)


if __name__ == "__main__":
    main()
