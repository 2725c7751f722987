"""Simulated surveys of which the bottom is known, annotated, and check points on it.

The same flight without errors (tests/flights) has its points on the true ground and bottom: these are the check points,
whose own errors are drawn here.
"""

import json
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "programs/query"))

import programs  # noqa: E402
from las_file import LasFile  # noqa: E402
from programs import query  # noqa: E402
from simulated_survey import SimulatedSurvey  # noqa: E402

FLIGHT = ("--lines", 4, "--cross-lines", 2, "--seconds", 3, "--pulse-rate", 6000, "--altitude", 250,
          "--surface-share", 1, "--column-share", 0, "--divergence", 1, "--file-for-each-line")
SCAN, RANGE, DATUM = 0.02, 0.03, 0.02  # degree, m, m: one sigma of errors that are drawn and declared
ERRORS = ("--trajectory-errors", "--scan-noise", SCAN, "--range-noise", RANGE)
POINT_VERTICAL, POINT_HORIZONTAL = 0.02, 0.03  # m, one sigma; radial
RADIUS = 2.5
# The water is calm, for the simulation draws its slopes anew for each pulse, which neighbours here share; over waves
# that travel, surface_validation_test has the same nodes.
SURVEY = """
[sensor]
name = "riegl-vq-880-g"
lever_arm = [0.3, -0.2, 0.5]
[trajectory]
files = ["{flight}/sbet.out"]
errors = ["{flight}/smrmsg.out"]
[surface]
classes = [41]
located = "pulse"
[sea]
wind_speed = {wind}
wind_from = 250
[water]
column = "none"
[datum]
sigma = {datum}
[sigma]
scan = {scan}
bottom_range = {range}
surface_range = {range}
range_offset = 0
boresight = [0, 0, 0]
lever_arm = 0
time = 0
index = 0
[output]
classes = [40]
coverage = "p95"
details = true
"""


class Flight:
    """A survey with errors, annotated, and points of the true bottom and ground."""

    def __init__(self, folder, seed):
        self.folder = folder / str(seed)
        flags = (*FLIGHT, "--seed", seed)
        right = SimulatedSurvey(self.folder / "right", *flags)
        flown = SimulatedSurvey(self.folder / "flown", *flags, *ERRORS)
        self.random = np.random.default_rng(seed)
        self.annotated = self.folder / "annotated"
        self.annotated.mkdir()
        self.survey = self.folder / "survey.toml"
        self.survey.write_text(SURVEY.format(flight=flown.folder, wind=1, datum=DATUM, scan=SCAN, range=RANGE))
        query("las", flown.folder, "--output-dir", self.annotated, "--survey", self.survey, "--table",
              programs.PATHS["shipped_table"], "--divergence", 1, check=0)
        places, wet = [], []
        for name in right.names:
            las = LasFile(right.folder / f"{name}.las")
            xyz = np.stack([las.field(4 * axis, "<i4") * las.scale[axis] + las.offset[axis] for axis in range(3)], 1)
            kind = right.truth(name)["kind"]
            places.append(xyz[(kind == 0) | (kind == 3)])
            wet.append(kind[(kind == 0) | (kind == 3)] == 0)
        self.true, self.wet = np.concatenate(places), np.concatenate(wet)
        self.datum = DATUM * self.random.standard_normal()  # What all points have in common.

    def check_points(self, count):
        """x, y and elevation of points on the true bottom, each with its own errors."""
        taken = self.true[self.random.choice(np.flatnonzero(self.wet), count, replace=False)]
        along = POINT_HORIZONTAL / math.sqrt(2)  # Of each axis.
        return taken + self.random.standard_normal(taken.shape) * [along, along, POINT_VERTICAL]

    def write(self, points):
        path = self.folder / "points.csv"
        rows = [",".join(f"{value:.4f}" for value in row) for row in points]
        path.write_text("\n".join(["x,y,elevation", *rows]) + "\n")
        return path

    def check(self, points, *flags):
        return query("checkpoints", self.annotated, self.write(points), "--radius", RADIUS, "--point-sigma-vertical",
                     POINT_VERTICAL, "--point-sigma-horizontal", POINT_HORIZONTAL, *flags, check=0)

    def json(self, points, *flags):
        return json.loads(self.check(points, "--json", *flags).stdout)
