"""Do the totals of dry points hold 95 % of the errors? Flights over a beach whose points have errors, against the same
flights without: tests/flights puts the points where processing would, with the errors of trajectory, scan and ranges.

Points of a line share the errors of its trajectory. The standard error of a share therefore comes from the lines, whose
errors are independent, and the effective number is that of independent points with the same standard error.
ALBTPU_EVERY_CASE flies more.
"""

import os

import numpy as np

import programs
from las_file import LasFile
from programs import query
from simulated_survey import LAND, SimulatedSurvey

FLIGHTS = 80 if os.environ.get("ALBTPU_EVERY_CASE") else 14
LINES, SCAN, RANGE = 40, 0.02, 0.06  # A flight; degree, m.
SURVEY = f"""
[sensor]
name = "riegl-vq-880-g"
lever_arm = [0.3, -0.2, 0.5]
[trajectory]
files = ["{{flight}}/sbet.out"]
errors = ["{{flight}}/smrmsg.out"]
[surface]
level = {{level}}
located = "level"
[sea]
wind_speed = 5
[water]
column = "none"
[datum]
sigma = 0
[sigma]
scan = {SCAN}
bottom_range = {RANGE}
boresight = [0, 0, 0]
lever_arm = 0
time = 0
range_offset = 0
[output]
coverage = "p95"
details = true
"""


def places(las):
    return np.stack([las.field(4 * i, "<i4") * las.scale[i] + las.offset[i] for i in range(3)], axis=1)


class Share:
    """Of the points that lie within, over lines of unequal numbers of points."""

    def __init__(self, within, lines):
        points, found = (np.bincount(lines, weights)[np.bincount(lines) > 0] for weights in (None, within))
        self.value = found.sum() / points.sum()
        # Of a ratio of sums over independent lines.
        residuals = found - self.value * points
        self.error = np.sqrt((residuals**2).sum() * len(points) / (len(points) - 1)) / points.sum()
        self.effective = self.value * (1 - self.value) / self.error**2

    def __str__(self):
        return f"{100 * self.value:.2f} % (standard error {100 * self.error:.2f} %, as {self.effective:.0f} points)"


class Beach(programs.Test):
    def fly(self, seed):
        """THU, TVU, horizontal and vertical errors of the dry points, and their lines."""
        flags = ("--seed", seed, "--lines", LINES, "--seconds", 1, "--pulse-rate", 250, "--surface-share", 0,
                 "--column-share", 0, "--scale", 0.001, "--sbet-rate", 50)
        true = SimulatedSurvey(self.folder / "true", *flags)
        reported = SimulatedSurvey(self.folder / "reported", *flags, "--trajectory-errors", "--scan-noise", SCAN,
                                   "--range-noise", RANGE)
        truth = true.truth()
        np.testing.assert_array_equal(truth["time"], reported.truth()["time"])
        survey, annotated = self.folder / "survey.toml", self.folder / "annotated.las"
        survey.write_text(SURVEY.format(flight=reported.folder, level=reported.water_level))
        query("las", reported.las, annotated, "--survey", survey, "--table", self.table, "--overwrite", check=0)
        columns, land = LasFile(annotated).columns(), truth["kind"] == LAND
        self.assertTrue((columns["share_of"][land] == 1).all())
        errors = (places(LasFile(reported.las)) - places(LasFile(true.las)))[land]
        return np.stack([columns["total_thu"][land], columns["total_tvu"][land], np.hypot(*errors[:, :2].T),
                         abs(errors[:, 2]), truth["line"][land] + LINES * seed])

    def test_of_the_dry_points_95_percent_lie_within_thu_and_tvu(self):
        thu, tvu, horizontal, vertical, lines = np.concatenate([self.fly(seed) for seed in range(1, FLIGHTS + 1)],
                                                               axis=1)
        for name, within in (("THU", horizontal <= thu), ("TVU", vertical <= tvu)):
            share = Share(within, lines.astype(int))
            print(f"{name}: {share} of {len(thu)} dry points of {FLIGHTS * LINES} lines")
            self.assertLess(share.error, 0.0025)
            self.assertLess(abs(share.value - 0.95), max(0.005, 3 * share.error))
            if FLIGHTS > 50:
                self.assertLess(share.error, 0.0015)
                self.assertLess(abs(share.value - 0.95), 0.005)


if __name__ == "__main__":
    programs.main()
