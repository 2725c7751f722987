"""Adds `total_thu` and `total_tvu` of the sea surface to points in a PDAL pipeline.

    pdal pipeline pdal_pipeline.json --readers.las.filename=line.laz --writers.las.filename=annotated.laz

PDAL calls `annotate` with NumPy arrays by dimension, and defines `pdalargs` in this module. Its options:

service or table  "HOST:PORT" of a service, or a table file
water_level       m, in the datum of Z
wind_speed        m/s at 10 m
altitude          m above the water
divergence        mrad, full angle of the beam
classes           classes of bathymetric points; default 40
fetch, azimuth    m, degrees from downwind; optional
"""

import albtpu
import numpy as np

NO_DATA = -1.0  # For points of other classes, and those out of the domain of the table.


def annotate(ins, outs):
    options = pdalargs  # noqa: F821, defined by PDAL
    bathymetric = np.isin(ins["Classification"], options.get("classes", [40]))
    incidence = np.abs(ins["ScanAngleRank"][bathymetric]).astype(float)  # Degrees in every point format.
    slant_range = options["altitude"] / np.cos(np.radians(incidence))
    optional = {axis: options[axis] for axis in ("fetch", "azimuth") if axis in options}
    source = albtpu.open_table(options["table"]) if "table" in options else albtpu.connect(options["service"])
    with source:
        answer = source.query(wind_speed=options["wind_speed"], incidence=incidence,
                              footprint=slant_range * options["divergence"] / 1000,
                              depth=options["water_level"] - ins["Z"][bathymetric], quantities=("thu", "tvu"),
                              **optional)
    for name, values in (("total_thu", answer.thu), ("total_tvu", answer.tvu)):
        outs[name] = np.full(bathymetric.shape, NO_DATA)
        outs[name][bathymetric] = np.where(answer.interpolated, values, NO_DATA)
    print(f"albtpu: table {answer.table.id} {answer.table.version}, digest {answer.table.digest}, "
          f"{answer.outcome_counts()}")
    return True
