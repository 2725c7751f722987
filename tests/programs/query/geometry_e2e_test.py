"""Compares where albtpu-query says that each beam went with simulated surveys of which the truth is known.

The limits are those that the program promises (docs/geometry.md). What a plane Earth leaves out is 0.001 degree of
incidence at 400 m and 0.002 at 600 m, and the points are rounded to 1 mm: 0.5 mm of depth.
"""

import json

import numpy as np

import programs
from programs import query
from simulated_survey import BOTTOM, DIVERGENCE, Details, SimulatedSurvey, degrees_apart, rms

WORST_FLOAT = 2e-6  # Relative to numbers near 20: half a step of a float32, in m.

# Flags of the simulation, flags of albtpu-query. Each has its own scanner, place in the zone, course, height and form.
SURVEYS = {
    "palmer": (["--seed", 1], []),
    "palmer, old format": (["--seed", 2, "--las-version", 2, "--point-format", 1, "--time", "week", "--course", 120,
                            "--altitude", 300, "--geoid-separation", 12], ["--classes", 26]),
    "raster at the edge of the zone": (["--scanner", "raster", "--seed", 3, "--time", "week", "--origin", "27,-78.2",
                                        "--course", 190, "--altitude", 600, "--speed", 80], []),
    "ellipse in feet": (["--scanner", "ellipse", "--seed", 4, "--grid", "florida-east-ft", "--geoid-separation", -28,
                         "--course", 271], ["--units", "us-ft"]),
    "raster in feet": (["--scanner", "raster", "--seed", 5, "--grid", "florida-east-ft", "--time", "week",
                        "--origin", "25.2,-80.4", "--altitude", 500], ["--units", "us-ft"]),
    "palmer in degrees": (["--seed", 7, "--grid", "geographic", "--geoid-separation", -28, "--course", 75], []),
    "palmer in degrees to 360": (["--seed", 8, "--grid", "geographic-360", "--course", 260], []),
    # Two seconds before 180 degrees of longitude.
    "palmer over the antimeridian": (["--seed", 9, "--grid", "geographic", "--origin", "-16.8,179.999", "--course", 80],
                                     []),
    # Grid north is 15 degrees off, and the axes are 2.4 degrees off perpendicular.
    "ellipse on a map of equal areas": (["--scanner", "ellipse", "--seed", 10, "--grid", "laea-europe", "--origin",
                                         "34.6,33.1", "--course", 140], []),
    "ellipse, shuffled": (["--scanner", "ellipse", "--seed", 6, "--point-format", 7, "--shuffle", "--course", 359.9,
                           "--lines", 2, "--seconds", 15, "--no-source-id", "--lever-arm", "-2,1.5,3",
                           "--geoid-separation", -28], ["--lever-arm", "-2,1.5,3"]),
}
LEVER_ARM = ("--lever-arm", "0.3,-0.2,0.5")


class GeometryTest(programs.Test):
    def survey(self, *flags):
        folder = self.folder / "survey"
        folder.mkdir(exist_ok=True)
        return SimulatedSurvey(folder, *flags)

    def query(self, survey, *flags, files=None, output=None, water=None, check=0):
        """Runs albtpu-query las; returns what it wrote for each point, and the result of the run."""
        output = output or ("--output-dir", self.folder / "out")
        (self.folder / "out").mkdir(exist_ok=True)
        water = water or ("--water-level", survey.water_level)
        flags = [*map(str, flags)]
        for name, value in (("--lever-arm", LEVER_ARM[1]), ("--classes", 40)):
            if name not in flags and (name != "--lever-arm" or "--trajectory" in flags):
                flags += [name, value]
        files = files or [survey.folder / f"{name}.las" for name in survey.names]
        result = query("las", *files, *output, "--table", self.table, *water, "--wind-speed", 6, "--fetch", 30000,
                       "--wind-from", 250, "--divergence", DIVERGENCE, "--details", "--overwrite", *flags,
                       check=check)
        return {file.stem: Details(self.folder / "out" / file.name) for file in files}, result

    def geoid(self, flags):
        return ["--geoid-separation", flags[flags.index("--geoid-separation") + 1]] if (
            "--geoid-separation" in flags) else []

    def assert_true(self, details, truth, known=None):
        """The values of bottom points are the truth; where `known` is false, and for other points, there are none."""
        chosen = truth["kind"] == BOTTOM
        known = chosen if known is None else chosen & known
        incidence = (details.incidence - truth["incidence"])[known]
        self.assertTrue(np.all(np.isfinite(incidence)))
        self.assertLess(rms(incidence), 0.005)
        self.assertLess(np.max(np.abs(incidence)), 0.015)
        azimuth = degrees_apart(details.beam_azimuth, truth["beam_azimuth"])[known & (truth["incidence"] > 3)]
        self.assertLess(rms(azimuth), 0.005)
        self.assertLess(np.max(np.abs(details.footprint - truth["footprint"])[known]), 0.05e-3)
        self.assertLess(np.max(np.abs(details.slant_range - truth["slant_range"])[known]), 0.05)
        self.assertLess(np.max(np.abs(details.water_depth - truth["water_depth"])[known]), 1e-3 + WORST_FLOAT)
        for name in ("incidence", "beam_azimuth"):
            self.assertTrue(np.all(np.isnan(getattr(details, name)[~known])), name)
        for name in ("footprint", "slant_range"):
            np.testing.assert_array_equal(getattr(details, name)[~known], -1, name)
        # The synthetic table ends at 25 degrees and 20 m, beyond which no pulse of these surveys goes.
        for values in (details.sea_thu, details.sea_tvu):
            self.assertTrue(np.all(values[known & (truth["incidence"] < 24.99)] > 0))
            np.testing.assert_array_equal(values[~known], -1)

    def test_a_trajectory_gives_the_truth(self):
        for name, (simulated, asked) in SURVEYS.items():
            survey = self.survey(*simulated)
            truth = survey.truth()
            for trajectory in (survey.sbet, survey.ascii):
                with self.subTest(survey=name, trajectory=trajectory.name):
                    flags = [*asked, *self.geoid(simulated), "--trajectory", trajectory]
                    if trajectory == survey.sbet:
                        flags += ["--trajectory-errors", survey.errors]
                    details, _ = self.query(survey, *flags)
                    self.assert_true(details["flight"], truth)

    def test_an_ascii_trajectory_states_its_errors(self):
        """1.5 m down in place of 0.04: below a level that is known, 1/n of it. With [sigma] it does not count."""
        survey, worse = self.survey("--seed", 21), self.folder / "worse.txt"
        lines = [line.split() for line in survey.ascii.read_text().splitlines()]
        worse.write_text("".join(" ".join([*line[:11], "1.5", *line[12:]]) + "\n" for line in lines))
        given = self.toml("[sigma]\nposition = [0.02, 0.02, 0.04]\n")
        tvus = []
        positions = self.folder / "positions.txt"
        positions.write_text("".join(" ".join([*line[:12], "0", "0", "0"]) + "\n" for line in lines))
        attitudes = []
        for trajectory, more in ((survey.ascii, ()), (worse, ()), (worse, ("--survey", given)), (positions, ())):
            query("las", survey.las, self.folder / "out.las", "--table", self.table, "--trajectory", trajectory,
                  *LEVER_ARM, "--water-level", survey.water_level, "--wind-speed", 6, "--fetch", 30000, "--classes", 40,
                  "--divergence", DIVERGENCE, "--sensor", "riegl-vq-880-g", "--datum-sigma", 0, "--water-column",
                  "none", "--overwrite", *more, check=0)
            summary = json.loads((self.folder / "out.las.json").read_text())
            tvus.append(summary["answers"]["total"]["all"]["total_tvu"]["mean"])
            attitudes.append(summary["parameters"]["total"]["numbers"]["attitude"])
        self.assertEqual([each["source"] for each in attitudes[:3]], ["the trajectory"] * 3)
        self.assertTrue(attitudes[3]["assumed"], attitudes[3])
        self.assertNotIn("nan", query("trajectory", positions, check=0).stdout)
        self.assertGreater(tvus[1], 1.96 * 1.5 / 1.34)
        self.assertLess(tvus[0], 0.6)
        self.assertAlmostEqual(tvus[2], tvus[0], delta=0.01)

    def test_surface_returns_give_the_depth(self):
        dense = ("--pulse-rate", 8000, "--seconds", 5)  # Some returns of the surface within 10 m of each point.
        with self.subTest("surface returns alone"):
            survey = self.survey("--seed", 11, "--surface-share", 0.6, *dense)
            details, _ = self.query(survey, "--trajectory", survey.sbet, water=("--water-classes", 41))
            self.assert_true(details["flight"], survey.truth())
        with self.subTest("few surface returns, and a level where there are none"):
            survey = self.survey("--seed", 12, "--scanner", "raster", "--surface-share", 0.05, "--shuffle", *dense)
            details, _ = self.query(survey, "--trajectory", survey.sbet,
                                    water=("--water-classes", 41, "--water-level", survey.water_level))
            self.assert_true(details["flight"], survey.truth())

    def test_water_levels_by_time_give_the_depth(self):
        for form, zero in (("adjusted", 2200 * 604800 - 1e9), ("week", 0)):
            survey = self.survey("--seed", 13, "--time", form)
            levels = self.folder / "levels.csv"
            start = zero + 320000  # albtpu_simulated_survey's own; a level every 6 minutes, as gauges report.
            rows = [f"{start - 100 + 360 * i},{survey.water_level}" for i in range(2)]
            levels.write_text("\n".join(["time,water_level", *rows]) + "\n")
            details, _ = self.query(survey, "--trajectory", survey.sbet, water=("--water-level", levels))
            self.assert_true(details["flight"], survey.truth())

    def test_a_gap_leaves_its_own_pulses_without_a_number(self):
        # Records every 5 ms from 0, pulses every 1/997 s: none on the edge of the gap, 10.300 s to 13.305 s.
        survey = self.survey("--seed", 21, "--gap-start", 10.3025, "--gap", 3, "--pulse-rate", 997)
        truth, records = survey.truth(), survey.records()[:, 0]
        widest = np.argmax(np.diff(records))
        before, after = records[widest:widest + 2]
        self.assertGreater(after - before, 3)
        inside = (truth["time"] > before) & (truth["time"] < after)
        self.assertGreater(np.sum(inside & (truth["kind"] == BOTTOM)), 1000)
        self.assertGreater(np.min(np.abs(np.subtract.outer(truth["time"], (before, after)))), 1e-6)
        details, result = self.query(survey, "--trajectory", survey.sbet)
        self.assert_true(details["flight"], truth, ~inside)
        self.assertRegex(result.stderr, str(int(np.sum(inside & (truth["kind"] == BOTTOM)))))

    def test_nothing_is_extrapolated(self):
        survey = self.survey("--seed", 22, "--margin", -2.3, "--pulse-rate", 997)
        truth, records = survey.truth(), survey.records()[:, 0]
        inside = (truth["time"] >= records[0]) & (truth["time"] <= records[-1])
        self.assertGreater(np.min(np.abs(np.subtract.outer(truth["time"], records[[0, -1]]))), 1e-6)
        self.assertEqual(len(np.unique(np.sign(np.diff(inside.astype(int))))), 3)  # Pulses before and after.
        details, _ = self.query(survey, "--trajectory", survey.sbet)
        self.assert_true(details["flight"], truth, inside)

    def test_lines_of_many_files_and_trajectories_find_each_other(self):
        survey = self.survey("--seed", 31, "--lines", 3, "--seconds", 12, "--files", 2, "--shuffle")
        records = survey.records()
        folder = survey.folder / "sbet"
        folder.mkdir()
        ends = np.flatnonzero(np.diff(records[:, 0]) > 10) + 1
        for line, part in enumerate(np.split(records, ends)):
            part.tofile(folder / f"sbet_{line}.out")
        self.assertEqual(len(list(folder.iterdir())), 3)
        for trajectory in (survey.sbet, folder):
            details, _ = self.query(survey, "--trajectory", trajectory)
            for name in survey.names:
                self.assert_true(details[name], survey.truth(name))

    def test_a_line_over_the_end_of_the_week(self):
        for time in ("adjusted", "week"):
            survey = self.survey("--seed", 41, "--start", 604785, "--time", time)
            again_from_0 = survey.write_sbet("again_from_0.out", time=lambda t: t % 604800)
            for trajectory in (survey.sbet, again_from_0):
                with self.subTest(time=time, trajectory=trajectory.name):
                    details, _ = self.query(survey, "--trajectory", trajectory)
                    self.assert_true(details["flight"], survey.truth())

    def test_utc_is_known_when_it_is_said(self):
        survey = self.survey("--seed", 51, "--clock", -18)
        details, _ = self.query(survey, "--trajectory", survey.sbet, "--trajectory-time", "utc")
        self.assert_true(details["flight"], survey.truth())

    def test_returns_alone_tell_the_incidence(self):
        for flags, most, worst in ((["--seed", 61], 0.03, 0.3), (["--seed", 62, "--scanner", "ellipse"], 0.03, 0.3),
                                   (["--seed", 63, "--scanner", "raster"], 0.03, 0.3),
                                   (["--seed", 64, "--wave-height", 0.3], 0.25, None),
                                   (["--seed", 65, "--wave-height", 0.3, "--scanner", "ellipse"], 0.25, None)):
            with self.subTest(flags=flags):
                survey = self.survey("--range-noise", 0.02, *flags)
                details, _ = self.query(survey, "--trajectory-from-returns")
                truth = survey.truth()
                error = (details["flight"].incidence - truth["incidence"])[truth["kind"] == BOTTOM]
                error = error[np.isfinite(error)]
                self.assertGreater(error.size, 0.5 * np.sum(truth["kind"] == BOTTOM))
                self.assertLess(rms(error), most)
                if worst:
                    self.assertLess(np.max(np.abs(error)), worst)


if __name__ == "__main__":
    programs.main()
