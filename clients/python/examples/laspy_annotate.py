"""Adds `total_thu` and `total_tvu` of the sea surface to a LAS or LAZ file, with laspy 2.

    python3 laspy_annotate.py line.laz annotated.laz --server localhost:50051 \\
        --water-level -23.09 --wind-speed 5 --altitude 400 --divergence 1.5
"""

import argparse
import os
import pathlib

import albtpu
import numpy as np

NO_DATA = -1.0  # For points of other classes, and those out of the domain of the table.


def annotate(source, z, scan_angle, classification, *, water_level, wind_speed, altitude, divergence,
             classes=(40,)):
    """THU and TVU of all points (float32, m, 2 sigma), and the answer for the bathymetric points.

    `z` and `water_level` are in m, `scan_angle` in degrees, `altitude` in m above the water, `divergence` in
    mrad, full angle. The azimuth is omitted: each value is the larger of those along and across the wind.
    """
    bathymetric = np.isin(classification, classes)
    incidence = np.abs(scan_angle[bathymetric])
    answer = source.query(wind_speed=wind_speed, incidence=incidence,
                          footprint=altitude / np.cos(np.radians(incidence)) * divergence / 1000,
                          depth=water_level - z[bathymetric], quantities=("thu", "tvu"), progress=True)
    columns = []
    for values in (answer.thu, answer.tvu):
        column = np.full(len(z), NO_DATA, np.float32)
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
    for flag, unit in (("water-level", "m"), ("wind-speed", "m/s at 10 m"), ("altitude", "m above the water"),
                       ("divergence", "mrad, full angle")):
        parser.add_argument(f"--{flag}", type=float, required=True, help=unit)
    parser.add_argument("--classes", type=int, nargs="+", default=[40], help="classes of bathymetric points")
    flags = parser.parse_args()

    import laspy

    las = laspy.read(flags.input)
    degrees = 0.006 * las.scan_angle if las.point_format.id >= 6 else las.scan_angle_rank.astype(float)
    with albtpu.open_table(flags.table) if flags.table else albtpu.connect(flags.server) as source:
        thu, tvu, answer = annotate(
            source, np.asarray(las.z), np.asarray(degrees), np.asarray(las.classification),
            water_level=flags.water_level, wind_speed=flags.wind_speed, altitude=flags.altitude,
            divergence=flags.divergence, classes=flags.classes)
    for name, column in (("total_thu", thu), ("total_tvu", tvu)):
        las.add_extra_dim(laspy.ExtraBytesParams(name, "f4", description="sea surface only, 2 sigma, m"))
        las[name] = column
    unfinished = flags.output.with_stem(flags.output.stem + ".unfinished")
    las.write(unfinished)
    os.replace(unfinished, flags.output)
    print(answer)


if __name__ == "__main__":
    main()
