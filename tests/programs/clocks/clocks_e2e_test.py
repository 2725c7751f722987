"""Times of points of every clock, trajectories of other makers and folders of them: right numbers, or one refusal.

Each file is made from the right one of a simulated survey. What the right one gives is compared bit by bit where times
are exact, and to the rounding of the other clock where they are not.
"""

import json
import pathlib
import shutil
import sqlite3

import numpy as np

import programs
from clocked_survey import WEEK, ClockedSurvey
from las_file import LasFile
from programs import query


class ClocksTest(ClockedSurvey):
    def test_every_clock_is_read_by_what_fits(self):
        for name, (change, bit) in self.clocks().items():
            with self.subTest(name):
                las = self.with_times("other.las", lambda _, t, change=change: change(t), bit)
                # 60 m/s for the 2.4e-7 s to which Unix times are rounded are 1.4e-5 m, of 400 m 2e-6 degrees.
                self.assert_same(self.annotated(las), tolerance=2e-4)
                self.assertIn(f"--time-format {name} says so", self.stderr)
                self.assert_same(self.annotated(las, None, "--time-format", name), tolerance=2e-4)
                self.assertNotIn("says so", self.stderr)
                other = "unix" if name != "unix" else "week"
                self.assert_fails(self.las(las, None, "--time-format", other), 1, "other.las")

    def test_milliseconds_are_no_seconds_for_the_local_surface(self):
        """Returns of the surface within a minute and not a second's thousandth part make its height."""
        flags = ("--water-classes", 41)
        right = self.annotated(self.survey.las, None, *flags)
        for header in (0, 1):
            las = self.with_times("other.las", lambda _, t: self.gps(t) % WEEK * 1e3, header)
            for chosen in ((), ("--time-format", "milliseconds")):
                columns = self.annotated(las, None, *flags, *chosen)
                summary = json.loads((self.folder / "out.las.json").read_text())
                self.assertEqual(summary["input"]["geometry"]["seconds_per_time_unit"], 1e-3)
                for name in ("water_depth", "incidence"):
                    np.testing.assert_allclose(columns[name], right[name], rtol=2e-4, atol=2e-4, err_msg=name)

    def test_init_names_the_clocks_that_are_possible(self):
        said = {
            "week": "may be seconds of a week", "adjusted": "adjusted standard GPS times (20",
            "gps": "but this is in the future", "unix": "Unix seconds (20",
            "milliseconds": "milliseconds of the GPS week", "day": "whose date is not known",
        }
        for name, (change, bit) in self.clocks().items():
            las = self.with_times("other.las", lambda _, t, change=change: change(t), bit)
            text = query("init", las, check=0).stdout
            times, = (line for line in text.splitlines() if "GPS times: " in line)
            self.assertIn(said[name], times)
            if name in ("adjusted", "unix", "milliseconds", "gps"):
                self.assertIn(f"--time-format {name}", times)

    def test_utc_of_the_day_is_told_from_gps_time_by_the_returns(self):
        for bit in (0, 1):
            las = self.with_times("other.las", lambda _, t: (self.gps(t) - 18) % 86400, bit)
            # The times of the week lie 18 s and 4 days before: they are rounded 16 times as coarsely.
            self.assert_same(self.annotated(las), tolerance=2e-4)
            self.assertIn("are UTC seconds of the day, a Wednesday, not ", self.stderr)
            self.assertIn("--time-format utc-day says so; by its header, the file was created on ", self.stderr)
            self.assert_same(self.annotated(las, None, "--time-format", "utc-day"), tolerance=2e-4)
        self.assert_fails(self.las(las, None, "--time-format", "day"), 1, "by --time-format utc-day; give that")

    def test_a_trajectory_of_another_day_is_still_refused(self):
        later = self.survey.write_sbet("later.out", time=lambda t: t + 2 * 86400 + 7200)
        self.assert_fails(self.las(self.survey.las, later), 1, "no record at the times of the points")

    def test_zeros_of_velocity_are_said(self):
        zeros = {f"velocity_{axis}": np.zeros_like for axis in "xyz"}
        trajectory = self.survey.write_sbet("zero.out", **zeros)
        self.assert_same(self.annotated(self.survey.las, trajectory))
        self.assertIn("zero.out: its velocities are all 0 while its positions move", self.stderr)

    def test_velocities_of_the_body_are_turned(self):
        records = self.survey.records()
        velocity = np.stack([records[:, 4] * np.cos(records[:, 10]) - records[:, 5] * np.sin(records[:, 10]),
                             -records[:, 4] * np.sin(records[:, 10]) - records[:, 5] * np.cos(records[:, 10])])
        heading = records[:, 9] - records[:, 10]
        records[:, 4] = velocity[0] * np.cos(heading) + velocity[1] * np.sin(heading)
        records[:, 5] = velocity[0] * np.sin(heading) - velocity[1] * np.cos(heading)  # To the left, up stays.
        trajectory = self.survey.write_sbet("body.out", records)
        for flags in ((), ("--velocity-axes", "body")):
            self.assert_same(self.annotated(self.survey.las, trajectory, *flags))
            self.assertIn("body.out: its velocities are along the axes of the body", self.stderr)
        self.assert_fails(self.las(self.survey.las, trajectory, "--velocity-axes", "wander"), 1, "body.out")
        shown, = json.loads(query("trajectory", trajectory, "--json", check=0).stdout)["files"]
        self.assertIn("axes of the body", shown["remark"])

    def test_names_of_trajectories_do_not_decide(self):
        folder = self.folder / "trajectories"
        folder.mkdir()
        records = self.survey.records()
        half = len(records) // 2
        records[:half].tofile(folder / "day1.sbet")
        records[half - 1:].tofile(folder / "day2_Storms.sbet")
        shutil.copy(self.survey.errors, folder / "smrmsg_day1.out")
        (folder / "notes.txt").write_text("Flown on Wednesday.\n")
        # The half of a trajectory has its own rounding of map coordinates between two records.
        self.assert_same(self.annotated(self.survey.las, folder), tolerance=1e-6)
        self.assertRegex(self.stderr, r"trajectories: skipped smrmsg_day1.out \(error files \(SMRMSG\)")
        self.assertRegex(self.stderr, r"trajectories: skipped notes.txt \(text without the 15 or 20 columns")

    def test_a_database_of_another_proj_is_named(self):
        database = pathlib.Path("/usr/share/proj/proj.db")
        if not database.is_file():
            self.skipTest("PROJ's database is not in /usr/share/proj")
        shutil.copy(database, self.folder / "proj.db")
        with sqlite3.connect(self.folder / "proj.db") as connection:
            connection.execute("UPDATE metadata SET value = 0 WHERE key = 'DATABASE.LAYOUT.VERSION.MAJOR'")
        connection.close()
        flags = ("--water-level", self.survey.water_level, "--classes", 40, "--divergence", 1, "--wind-speed", 6,
                 "--table", self.table)
        named = f"cannot read its database {self.folder}/proj.db"
        target = self.folder / "out.las"
        for variable in ("PROJ_DATA", "PROJ_LIB"):
            for crs in ((), ("--crs", "EPSG:26917"), ("--crs", "EPSG:32617")):
                target.unlink(missing_ok=True)
                result = query("las", self.survey.las, target, "--trajectory", self.survey.sbet, *crs, *flags,
                               environment={variable: self.folder})
                self.assert_fails(result, 1, named, f"{variable} is {self.folder}")
            result = query("las", self.survey.las, target, "--trajectory-from-returns", *flags,
                           environment={variable: self.folder})
            self.assertIn(named, result.stderr)

    def test_many_trajectories_change_nothing(self):
        """They change no number, and a summary names them together."""
        folder, points, out = self.folder / "many", self.folder / "points", self.folder / "out"
        for each in (folder, points, out):
            each.mkdir()
        records = self.survey.records()
        for i in range(300):
            moved = records[::40].copy() if i else records.copy()
            moved[:, 0] += 60 * i
            moved.tofile(folder / f"{i:05}.out")
        shutil.copy(self.survey.las, points / "a.las")
        query("las", points, "--output-dir", out, "--trajectory", folder, "--lever-arm", "0.3,-0.2,0.5",
              "--water-level", self.survey.water_level, "--classes", 40, "--divergence", 1, "--wind-speed", 6,
              "--table", self.table, "--details", check=0)
        self.assert_same(LasFile(out / "a.las").columns())
        summary = json.loads((out / "a.las.json").read_text())
        named, = summary["parameters"]["trajectory"]
        self.assertEqual(named["name"], "300 files, 00000.out to 00299.out")
        self.assertEqual(named["bytes"], sum(path.stat().st_size for path in folder.iterdir()))


if __name__ == "__main__":
    programs.main()
