"""albtpu-query checkpoints, from outside: simulated surveys of which the bottom is known, and the statistics again.

ALBTPU_EVERY_CASE=1 flies 20 surveys instead of one.
"""

import csv
import io
import json
import math
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

import numpy as np
from scipy.stats import chi2

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "programs/query"))

import programs  # noqa: E402
from checked_flight import DATUM, POINT_HORIZONTAL, POINT_VERTICAL, RADIUS, Flight  # noqa: E402
from las_file import LasFile  # noqa: E402
from programs import query  # noqa: E402

SEEDS = 20 if os.environ.get("ALBTPU_EVERY_CASE") else 1
POINTS = 60


def setUpModule():
    global flights
    folder = pathlib.Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, folder)
    flights = [Flight(folder, seed) for seed in range(1, SEEDS + 1)]


class Truth(programs.Test):
    def test_differences_are_as_large_as_predicted(self):
        squares, degrees, held, offsets, found = [], [], 0, 0, 0
        for flight in flights:
            points, drawn = flight.check_points(POINTS), flight.datum
            everything = flight.json(points - [0, 0, drawn])["all"]
            self.assertGreater(everything["points"], 0.5 * POINTS)
            squares.append(everything["z_squared"]["value"])
            degrees.append(everything["z_squared_degrees_of_freedom"])
            # Of the survey: its offset as it was drawn, and the variances of what else errs.
            listed = list(csv.DictReader(io.StringIO(self.listed(flight, points - [0, 0, drawn]))))
            variance = np.mean([float(row["sigma_pulse_sea"])**2 + float(row["sigma_lines"])**2 +
                                float(row["sigma_check_point"])**2 for row in listed if row["sigma"]])
            truth = math.sqrt(drawn**2 + variance)
            held += everything["rmse"]["low"] <= truth <= everything["rmse"]["high"]
            # Without an offset of the datum, and with one of 0.1 m.
            without = flight.json(points)
            offsets += without["offset"]["found"]
            self.assertIs(without["offset"]["found"], "offset common to all" in without["conclusion"])
            shifted = flight.json(points - [0, 0, 0.1])
            found += shifted["offset"]["found"]
            if shifted["offset"]["found"]:
                self.assertRegex(shifted["conclusion"], r"lies 0\.\d{3} m above the check points .*an offset common to "
                                                        r"all, not scatter")
        # The seeds are independent.
        mean, error = np.mean(squares), math.sqrt(sum(2 / each for each in degrees)) / len(degrees)
        print(f"{SEEDS} surveys: mean z^2 {mean:.3f} +- {error:.3f}; the interval of RMSE holds the truth in {held};"
              f" an offset of 0.1 m is named in {found}, one that is not there in {offsets}")
        self.assertAlmostEqual(mean, 1, delta=3 * error)
        self.assertGreaterEqual(held, SEEDS - max(1, 0.2 * SEEDS))
        self.assertGreaterEqual(found, 0.95 * SEEDS)
        self.assertLessEqual(offsets, 0.05 * SEEDS)

    @staticmethod
    def listed(flight, points):
        path = flight.folder / "differences.csv"
        flight.check(points, "--points", path, "--overwrite")
        return path.read_text()


class Twin(programs.Test):
    """Surfaces and statistics once more, from the annotated points alone."""

    def setUp(self):
        super().setUp()
        self.flight = flights[0]
        self.points = self.flight.check_points(POINTS)
        self.points[:, 2] -= 0.05
        path = self.folder / "differences.csv"
        self.check = self.flight.json(self.points, "--points", path)
        self.rows = list(csv.DictReader(io.StringIO(path.read_text())))
        columns = {}
        for file in sorted(self.flight.annotated.glob("*.las")):
            las = LasFile(file)
            bottom = las.classes == 40
            for axis, name in enumerate("xyz"):
                columns.setdefault(name, []).append((las.field(4 * axis, "<i4") * las.scale[axis] +
                                                     las.offset[axis])[bottom])
            columns.setdefault("line", []).append(las.field(20, "<u2")[bottom])
            for name, values in las.columns().items():
                columns.setdefault(name, []).append(values[bottom])
        lidar = {name: np.concatenate(parts) for name, parts in columns.items()}
        self.lidar = {name: values[lidar["total_tvu"] >= 0] for name, values in lidar.items()}

    def surfaces(self):
        """At each check point that has them: height, bias, mean TVU and the sigma that each line shares."""
        for x, y, _ in self.points:
            near = np.flatnonzero(np.hypot(self.lidar["x"] - x, self.lidar["y"] - y) <= RADIUS)
            if len(near) < 4:
                yield None
                continue
            of = {name: values[near] for name, values in self.lidar.items()}
            design = np.stack([np.ones(len(near)), of["x"] - x, of["y"] - y], 1)
            height, *slope = np.linalg.lstsq(design, of["z"], rcond=None)[0]
            lines = {line: np.sum(of["tvu_line"][of["line"] == line]) / 1.959964 / len(near)
                     for line in np.unique(of["line"])}
            azimuth = np.radians(of["beam_azimuth"])
            ahead = slope[0] * np.sin(azimuth) + slope[1] * np.cos(azimuth)  # Rise of the bottom along the beam.
            bias = np.mean(of["bias_vertical"] - ahead * of["bias_along_beam"])
            yield height, bias, of["total_tvu"].mean(), lines, math.hypot(*slope)

    def test_finds_the_same_surfaces_and_statistics(self):
        made = list(self.surfaces())
        kept = [i for i, each in enumerate(made) if each is not None and self.rows[i]["surface"]]
        self.assertGreaterEqual(len(kept), sum(each is not None for each in made) - 2)  # Points on a line.
        differences, own, survey, biases = [], [], [], []
        lines = sorted({line for i in kept for line in made[i][3]})
        shares = np.zeros((len(kept), len(lines)))
        for row, i in enumerate(kept):
            height, bias, tvu, of_lines, slope = made[i]
            listed = {name: float(value) for name, value in self.rows[i].items()
                      if name not in ("id", "class", "water")}
            self.assertAlmostEqual(listed["surface"], height, delta=1e-4)
            self.assertAlmostEqual(listed["difference"], height - self.points[i][2], delta=2e-4)
            self.assertAlmostEqual(listed["predicted_bias"], bias, delta=1e-4)
            self.assertAlmostEqual(listed["tvu_95"], tvu, delta=0.01 * tvu)
            # A slope of the bottom adds horizontal errors.
            self.assertAlmostEqual(listed["sigma_lines"], math.hypot(*of_lines.values()),
                                   delta=0.003 + 0.05 * slope)
            self.assertAlmostEqual(listed["sigma_check_point"],
                                   math.hypot(POINT_VERTICAL, slope * POINT_HORIZONTAL / math.sqrt(2)), delta=1e-4)
            differences.append(listed["difference"])
            biases.append(listed["predicted_bias"])
            own.append(listed["sigma_pulse_sea"]**2 + listed["sigma_check_point"]**2)
            survey.append(listed["sigma_survey"])
            scale = listed["sigma_lines"] / math.hypot(*of_lines.values())
            for line, sigma in of_lines.items():
                shares[row, lines.index(line)] = scale * sigma
        d, b, survey = np.array(differences), np.array(biases), np.array(survey)
        n, everything = len(d), self.check["all"]
        self.assertEqual(everything["points"], n)
        within = np.diag(own) + shares @ shares.T
        whole = within + np.outer(survey, survey)
        self.assertAlmostEqual(everything["mean"]["value"], d.mean(), delta=1e-4)
        self.assertAlmostEqual(everything["standard_deviation"], d.std(ddof=1), delta=1e-4)
        self.assertAlmostEqual(everything["rmse"]["value"], math.sqrt(np.mean(d**2)), delta=1e-4)
        self.assertAlmostEqual(everything["rmse_total"], math.sqrt(np.mean(d**2) + POINT_VERTICAL**2), delta=1e-4)
        self.assertAlmostEqual(everything["percentile_95"], np.percentile(np.abs(d), 95), delta=1e-4)
        z = (d - b) / np.sqrt(np.diag(whole))
        self.assertAlmostEqual(everything["z_squared"]["value"], np.mean(z**2), delta=0.01 * np.mean(z**2) + 0.005)
        # Check points close together share points here and there, which is not done again: 2 %.
        correlation = whole / np.sqrt(np.outer(np.diag(whole), np.diag(whole)))
        degrees = n**2 / np.sum(correlation**2)
        self.assertAlmostEqual(everything["z_squared_degrees_of_freedom"], degrees, delta=0.02 * degrees)
        for end, below in (("low", 0.975), ("high", 0.025)):
            self.assertAlmostEqual(
                everything["z_squared"][end],
                np.mean(z**2) * degrees / chi2.ppf(below, degrees), delta=0.03 * everything["z_squared"][end])
        projection = np.eye(n) - np.ones((n, n)) / n
        centred = projection @ within @ projection
        residual = projection @ (d - b)
        ratio = residual @ residual / np.trace(centred)
        self.assertAlmostEqual(everything["scatter_factor"]["value"], math.sqrt(ratio), delta=0.01)
        error = math.sqrt(max(ratio, 1) * within.sum()) / n
        self.assertAlmostEqual(everything["standard_error"], error, delta=0.02 * error)
        squared = max(d.mean()**2 - error**2, 0)
        scale = (d @ d - n * squared) / np.trace(within)
        degrees = 2 * (d @ d)**2 / (2 * scale**2 * np.sum(within**2) + 4 * scale * squared * within.sum())
        self.assertAlmostEqual(everything["rmse_degrees_of_freedom"], degrees, delta=0.03 * degrees)
        self.assertAlmostEqual(everything["rmse"]["low"],
                               math.sqrt(d @ d / n * degrees / chi2.ppf(0.975, degrees)), delta=5e-4)


class Command(programs.Test):
    def setUp(self):
        super().setUp()
        self.flight = flights[0]
        self.points = self.flight.check_points(40)

    def csv(self, text):
        return self.write("points.csv", text)

    def test_begins_with_the_conclusion(self):
        text = self.flight.check(self.points).stdout
        self.assertRegex(text, r"\A(prediction and check points agree|check points contradict the prediction): ")
        self.assertRegex(text, r"ASPRS edition 2: RMSE_V = sqrt\(0\.\d{3}\^2 \+ 0\.020\^2\) = 0\.\d{3} m")
        self.assertIn("of the 30 check points that it asks for", text)
        self.assertNotIn("taken as 0", text)
        self.assertLess(max(map(len, text.splitlines()[1:])), 160)

    def test_says_that_errors_of_check_points_were_not_given(self):
        text = query("checkpoints", self.flight.annotated, self.flight.write(self.points), check=0).stdout
        self.assertIn("taken as 0: give --point-sigma-vertical", text)

    def test_reads_other_dialects_alike(self):
        rows = [f"{x:.3f};{y:.3f};{z:.3f}".replace(".", ",") for x, y, z in self.points]
        comma = self.csv("\n".join(["easting;northing;z", *rows]) + "\n")
        usual = self.flight.write(np.round(self.points, 3))
        results = [json.loads(query("checkpoints", self.flight.annotated, path, "--json", check=0).stdout)
                   for path in (comma, usual)]
        self.assertEqual(*results)

    def test_keeps_dry_and_wet_points_and_classes_apart(self):
        dry = self.flight.true[~self.flight.wet]
        self.assertGreater(len(dry), 100)
        rows = [*((*row, "hard") for row in dry[:: len(dry) // 20][:15]), *((*row, "sand") for row in self.points[:20]),
                *((*row, "weed") for row in self.points[20:])]
        path = self.csv("\n".join(["x,y,z,class", *(f"{x:.3f},{y:.3f},{z:.3f},{c}" for x, y, z, c in rows)]) + "\n")
        check = json.loads(query("checkpoints", self.flight.annotated, path, "--radius", RADIUS, "--json",
                                 check=0).stdout)
        groups = {(each["of"], each["class"]): each["points"] for each in check["by_class"]}
        self.assertEqual(sum(groups.values()), check["all"]["points"])
        self.assertGreater(groups["dry", "hard"], 5)
        self.assertGreater(groups["wet", "sand"], 10)
        self.assertEqual(sum(each["points"] for each in check["by_depth"]),
                         sum(count for (of, _), count in groups.items() if of == "wet"))

    def test_on_a_slope_of_the_terrain_the_slope_counts_once(self):
        """--terrain-slope states the height at a fixed place; a surface has its own slope, and the same parts."""
        flight, sloping = self.flight, self.folder / "sloping"
        sloping.mkdir()
        query("las", flight.folder / "flown", "--output-dir", sloping, "--survey", flight.survey, "--table",
              programs.PATHS["shipped_table"], "--divergence", 1, "--terrain-slope", check=0)
        dry = flight.true[~flight.wet]
        path = flight.write(dry[:: len(dry) // 60])
        listed = []
        for annotated in (flight.annotated, sloping):
            csv_path = self.folder / f"{annotated.name}.csv"
            query("checkpoints", annotated, path, "--radius", RADIUS, "--points", csv_path, check=0)
            rows = csv.DictReader(io.StringIO(csv_path.read_text()))
            listed.append([row for row in rows if row["water"] == "dry"])
        self.assertGreater(len(listed[0]), 20)
        for before, after in zip(*listed, strict=True):
            self.assertEqual(after["depth"], "")
            self.assertGreater(float(after["sigma_survey"]), 0.99 * DATUM)
            for part in ("sigma", "sigma_survey", "sigma_lines"):
                self.assertAlmostEqual(float(after[part]) / float(before[part]), 1, delta=0.05, msg=part)
        # The TVU is that of the points, with the slope.
        columns = {}
        for file in sorted(sloping.glob("*.las")):
            las = LasFile(file)
            ground = (las.classes == 2) & (las.columns()["share_of"] == 1)
            of_file = {"x": las.field(0, "<i4") * las.scale[0] + las.offset[0],
                       "y": las.field(4, "<i4") * las.scale[1] + las.offset[1], "tvu": las.columns()["total_tvu"]}
            for name, values in of_file.items():
                columns.setdefault(name, []).append(values[ground])
        ground = {name: np.concatenate(parts) for name, parts in columns.items()}
        for row in listed[1]:
            near = np.hypot(ground["x"] - float(row["x"]), ground["y"] - float(row["y"])) <= RADIUS
            self.assertAlmostEqual(float(row["tvu_95"]), ground["tvu"][near].mean(), delta=2e-4)

    def test_takes_files_in_place_of_a_folder(self):
        files = sorted(self.flight.annotated.glob("*.las"))
        path = self.flight.write(self.points)
        results = [query("checkpoints", *given, path, "--json", check=0).stdout
                   for given in ((self.flight.annotated,), files, reversed(files))]
        self.assertEqual(len(set(results)), 1)

    def test_lists_check_points_without_points_there(self):
        far = np.vstack([self.points, [[0, 0, 0]]])
        listed = self.folder / "listed.csv"
        check = self.flight.json(far, "--points", listed)
        self.assertEqual(check["check_points"], 41)
        self.assertEqual(check["without_points"], 41 - check["all"]["points"])
        rows = listed.read_text().splitlines()
        self.assertEqual(len(rows), 42)
        self.assertEqual({row.count(",") for row in rows}, {18})
        path = self.flight.write(far)
        self.assert_fails(query("checkpoints", self.flight.annotated, path, "--points", listed), 1, "listed.csv")
        self.assert_fails(query("checkpoints", self.flight.annotated, path, "--points", path, "--overwrite"), 1,
                          "points.csv")

    def test_refuses_what_cannot_be_compared(self):
        annotated, feet = self.flight.annotated, self.points / 0.3048
        metres_and_feet = np.column_stack([self.points[:, :2], feet[:, 2]])
        cases = [(self.points[:, [1, 0, 2]], "x and y seem to be exchanged"), (feet, "seem to be in feet"),
                 (self.points + [5e4, 0, 0], "lie outside of the survey (x from "),
                 (metres_and_feet, "its elevations seem to be feet"),
                 (self.points * [1, 1, -1], "its elevations seem to count downwards")]
        for points, why in cases:
            with self.subTest(why):
                self.assert_fails(query("checkpoints", annotated, self.flight.write(points)), 1, "points.csv", why)
        for text, why in (("y,elevation\n1,2\n", "no column 'x'"), ("x,y,z\n1,2,a\n", "line 2, column 'z'")):
            self.assert_fails(query("checkpoints", annotated, self.csv(text)), 1, "points.csv", why)
        path = self.flight.write(self.points)
        self.assert_fails(query("checkpoints", annotated), 2, "check points")
        self.assert_fails(query("checkpoints", annotated, path, "--radius", 0), 2, "--radius")
        plain = self.flight.folder / "right" / "flight_1.las"
        self.assert_fails(query("checkpoints", plain, path), 1, "flight_1.las", "annotate")
        self.assert_fails(query("checkpoints", annotated, self.folder / "none.csv"), 1, "none.csv")


if __name__ == "__main__":
    programs.main()
