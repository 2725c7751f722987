"""Times of points of every clock, trajectories of other makers and folders of them: right numbers, or one refusal.

Each file is made from the right one of a simulated survey. What the right one gives is compared bit by bit where times
are exact, and to the rounding of the other clock where they are not.
"""

import datetime
import json
import pathlib
import shutil
import sqlite3
import struct

import numpy as np

import programs
import sea_states
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

WEEK = 604800
UNIX_EPOCH = 315964800  # 1980-01-06 in s since 1970


class ClocksTest(programs.Test):
    right = None  # The answers for the right files, which are those of all tests.

    def setUp(self):
        super().setUp()
        self.survey = SimulatedSurvey(self.folder, "--seconds", 20, "--pulse-rate", 500, "--seed", 3)
        if ClocksTest.right is None:
            ClocksTest.right = self.annotated(self.survey.las)

    def las(self, source, trajectory=None, *flags, output="out.las"):
        target = self.folder / output
        target.unlink(missing_ok=True)
        return query("las", source, target, "--trajectory", trajectory or self.survey.sbet, "--lever-arm",
                     "0.3,-0.2,0.5", "--water-level", self.survey.water_level, "--classes", 40, "--divergence", 1,
                     "--wind-speed", 6, "--table", self.table, "--details", *flags)

    def annotated(self, source, trajectory=None, *flags):
        result = self.las(source, trajectory, *flags)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.stderr = result.stderr
        return LasFile(self.folder / "out.las").columns()

    def assert_same(self, columns, rows=slice(None), tolerance=0.0):
        for name in ("incidence", "beam_azimuth", "water_depth", "slant_range", "sea_thu", "sea_tvu"):
            np.testing.assert_allclose(columns[name][rows], self.right[name][rows], rtol=tolerance, atol=tolerance,
                                       err_msg=name)

    def with_times(self, name, change, bit=None, version=None):
        """A copy of the points with changed times, global encoding and version."""
        data = bytearray(self.survey.las.read_bytes())
        encoding, = struct.unpack_from("<H", data, 6)
        self.adjusted = bool(encoding & 1)
        if bit is not None:
            struct.pack_into("<H", data, 6, encoding & ~1 | bit)
        if version is not None:
            data[25] = version
        offset, = struct.unpack_from("<I", data, 96)
        length, = struct.unpack_from("<H", data, 105)
        at = 22 if data[104] & 63 >= 6 else 20
        count = (len(data) - offset) // length
        for i in range(count):
            place = offset + i * length + at
            struct.pack_into("<d", data, place, change(i, struct.unpack_from("<d", data, place)[0]))
        path = self.folder / name
        path.write_bytes(data)
        return path

    def gps(self, stated):
        """GPS seconds since 1980 of a time as the right file states it."""
        return stated + 1e9 if self.adjusted else stated + 1900 * WEEK

    def clocks(self):
        """Each way to write the times, and the bit of the header that is wrong for it."""
        return {
            "week": (lambda t: self.gps(t) % WEEK, 1),
            "adjusted": (lambda t: self.gps(t) - 1e9, 0),
            "gps": (lambda t: self.gps(t), 1),
            "unix": (lambda t: self.gps(t) + UNIX_EPOCH - 18, 0),
            "milliseconds": (lambda t: self.gps(t) % WEEK * 1e3, 0),
            "day": (lambda t: self.gps(t) % 86400, 0),
        }

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

    def without_trajectory(self, source, *flags, output="level.las"):
        target = self.folder / output
        target.unlink(missing_ok=True)
        return query("las", source, target, "--incidence", 15, "--altitude", 400, "--footprint", 0.5, "--classes", 40,
                     "--details", *flags)

    def unix_times(self):
        """Of the points of the right file."""
        self.with_times("same.las", lambda _, t: t)
        return np.array([self.gps(t) + UNIX_EPOCH - 18 for t in LasFile(self.survey.las).field(22, "<f8")])

    def write_tide(self, *hours, name="tide.csv"):
        """Levels around the flight that rise by 1 m in an hour, at these hours from its beginning."""
        begin = self.unix_times().min()
        lines = ["time,water_level"]
        for hour in hours:
            lines.append(f"{sea_states.utc(round(begin) + 3600 * hour)},{self.survey.water_level + hour}")
        return self.write(name, "\n".join(lines) + "\n")

    def test_levels_are_read_by_the_clock_that_fits(self):
        tide = self.write_tide(-1, 1)
        flags = ("--water-level", tide, "--wind-speed", 6, "--table", self.table)
        self.assertEqual(self.without_trajectory(self.survey.las, *flags).returncode, 0)
        right = LasFile(self.folder / "level.las").columns()["water_depth"]
        self.assertGreater(right.max(), 0)
        for name, (change, bit) in self.clocks().items():
            with self.subTest(name):
                las = self.with_times("other.las", lambda _, t, change=change: change(t), bit)
                for chosen in ((), ("--time-format", name)):
                    result = self.without_trajectory(las, *flags, *chosen)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    depth = LasFile(self.folder / "level.las").columns()["water_depth"]
                    np.testing.assert_allclose(depth, right, atol=1e-5)  # m; float32 at 20 m, levels rise 0.3 mm in 1 s
                    said = f"tide.csv lie at the points; --time-format {name} says so"
                    self.assertEqual(said in result.stderr, not chosen)
                result = self.without_trajectory(las, *flags, "--time-format", "unix" if name != "unix" else "week")
                self.assert_fails(result, 1, "tide.csv")

    def test_seas_are_read_by_the_clock_that_fits(self):
        begin = self.unix_times().min()
        lines = ["time,f,E"]
        for hour, energy in ((-1, 0.2), (0, 0.4), (1, 2)):
            for i in range(1, 11):
                lines.append(f"{sea_states.utc(round(begin) + 3600 * hour)},{0.05 * i:.2f},{energy / i:.6g}")
        sea = self.write("sea.csv", "\n".join(lines) + "\n")
        flags = ("--water-level", self.survey.water_level, "--sea", sea, "--wind-speed", 6)
        self.assertEqual(self.without_trajectory(self.survey.las, *flags).returncode, 0)
        right = LasFile(self.folder / "level.las").columns()["sea_tvu"]
        for name, (change, bit) in self.clocks().items():
            with self.subTest(name):
                las = self.with_times("other.las", lambda _, t, change=change: change(t), bit)
                result = self.without_trajectory(las, *flags)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(f"sea.csv lie at the points; --time-format {name} says so", result.stderr)
                np.testing.assert_allclose(LasFile(self.folder / "level.las").columns()["sea_tvu"], right, rtol=1e-5)

    def test_the_creation_of_the_file_is_evidence_for_its_day(self):
        """Levels of a month, points of seconds of the week."""
        tide = self.write_tide(*range(-24 * 15, 24 * 15))
        flags = ("--water-level", tide, "--wind-speed", 6, "--table", self.table)
        las = self.with_times("other.las", lambda _, t: self.gps(t) % WEEK, 0)
        day = datetime.datetime.fromtimestamp(self.unix_times().min(), datetime.timezone.utc)
        data = bytearray(las.read_bytes())
        for created, decides in ((day, True), (day + datetime.timedelta(days=500), False), (None, False)):
            stated = (created.timetuple().tm_yday, created.year) if created else (0, 0)
            struct.pack_into("<2H", data, 90, *stated)
            las.write_bytes(data)
            result = self.without_trajectory(las, *flags)
            if decides:
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(f"{day:%Y-%m-%d} is taken because of the creation of the file", result.stderr)
                depth = LasFile(self.folder / "level.las").columns()["water_depth"]
                self.without_trajectory(self.survey.las, *flags)
                right = LasFile(self.folder / "level.las").columns()["water_depth"]
                np.testing.assert_allclose(depth, right, atol=1e-5)
            else:
                self.assert_fails(result, 1, "tide.csv", f"seconds of the GPS week ({day:%Y-%m-%d})")

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

    def test_two_clocks_in_one_file_are_refused(self):
        """Whatever the header says, and whatever the times are needed for."""
        tide = self.write_tide(-1, 1)
        levels = ("--water-level", tide, "--wind-speed", 6, "--table", self.table)
        for bit in (0, 1):
            las = self.with_times("two.las", lambda i, t: self.gps(t) % WEEK if i % 5 else self.gps(t) - 1e9, bit)
            said = ("two.las: its GPS times are of two clocks: ", "seconds of the GPS week (",
                    "adjusted standard GPS times or GPS seconds since 1980 (")
            self.assert_fails(self.las(las), 1, *said)
            self.assert_fails(self.without_trajectory(las, *levels), 1, *said)
        one_level = ("--water-level", self.survey.water_level, *levels[2:])
        self.assertEqual(self.without_trajectory(las, *one_level).returncode, 0)

    def test_levels_at_numbers_of_another_clock_are_read_or_named(self):
        begin = round(self.unix_times().min())
        flags = ("--wind-speed", 6, "--table", self.table)
        self.without_trajectory(self.survey.las, "--water-level", self.write_tide(-1, 1), *flags)
        right = LasFile(self.folder / "level.las").columns()["water_depth"]
        for name, first in (("Unix seconds", begin), ("GPS seconds since 1980", begin - UNIX_EPOCH + 18)):
            tide = self.write("numbers.csv", "time,water_level\n" + "".join(
                f"{first + 3600 * hour},{self.survey.water_level + hour}\n" for hour in (-1, 1)))
            result = self.without_trajectory(self.survey.las, "--water-level", tide, *flags)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"numbers.csv are {name} (", result.stderr)
            np.testing.assert_allclose(LasFile(self.folder / "level.las").columns()["water_depth"], right, atol=1e-5)
        late = self.write("late.csv", f"time,water_level\n{begin + 9e5},1\n{begin + 9e5 + 3600},1\n")
        result = self.without_trajectory(self.survey.las, "--water-level", late, *flags)
        self.assertNotEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"late.csv: has no level at the times of the points: .*, as Unix seconds 20")

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
