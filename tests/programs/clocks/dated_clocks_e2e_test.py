"""Times of points of every clock, beside water levels and seas of dates: right numbers, or one refusal."""

import datetime
import struct

import numpy as np

import programs
import sea_states
from clocked_survey import UNIX_EPOCH, WEEK, ClockedSurvey
from las_file import LasFile


class DatedClocksTest(ClockedSurvey):
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

    def set_creation(self, las, date):
        data = bytearray(las.read_bytes())
        struct.pack_into("<2H", data, 90, *((date.timetuple().tm_yday, date.year) if date else (0, 0)))
        las.write_bytes(data)

    def write_levels_around(self, instant):
        lines = [f"{sea_states.utc(instant + 3600 * hour)},{self.survey.water_level}" for hour in (-1, 0, 1)]
        return self.write("tide.csv", "\n".join(["time,water_level", *lines]) + "\n")

    def write_sea(self, begin, *hours):
        """Spectra at these hours [h] from an instant [s since 1970]."""
        lines = [f"{sea_states.utc(begin + 3600 * hour)},{0.05 * i:.2f},{0.4 / i:.6g}"
                 for hour in hours for i in range(1, 11)]
        return self.write("sea.csv", "\n".join(["time,f,E", *lines]) + "\n")

    def test_a_right_header_is_not_read_otherwise_for_files_of_another_day(self):
        """The day of the points is that of the trajectory: levels and seas of other days are refused."""
        flight = round(self.unix_times().min())
        of_day = self.with_times("day.las", lambda _, t: self.gps(t) % 86400, 0)
        of_sunday = flight - 3 * 86400  # As the header says.
        for source in (self.survey.las, of_day):
            for begin in (flight + 86400, of_sunday):
                result = self.las(source, level=self.write_levels_around(begin))
                self.assertNotEqual(result.returncode, 0, result.stderr)
                self.assertIn("tide.csv: has no level at the times of the points", result.stderr)
        # Nobody names the week but the creation of the file.
        self.set_creation(of_day, datetime.datetime.fromtimestamp(flight, datetime.timezone.utc))
        result = self.las(of_day, level=self.write_levels_around(flight + 7 * 86400))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, "measured at .* by .*tide.csv, after their file was created on ")
        tide = self.write_tide(-1, 1)
        self.assertEqual(self.las(of_day, level=tide).returncode, 0)
        sea = self.write_sea(flight + 2 * 86400, -1, 0, 1)
        for source in (self.survey.las, of_day):
            result = self.las(source, None, "--sea", sea, level=tide)
            self.assert_fails(result, 1, "were measured outside of ", "sea.csv")

    def test_sources_of_different_days_are_refused(self):
        """Without a trajectory, levels and sea say what seconds of the day mean, and must say the same."""
        flight = round(self.unix_times().min())
        of_day = self.with_times("day.las", lambda _, t: self.gps(t) % 86400, 0)
        tide = self.write_tide(-1, 1)
        for days, agrees in ((0, True), (1, False)):
            sea = self.write_sea(flight + days * 86400, -1, 0, 1)
            result = self.without_trajectory(of_day, "--water-level", tide, "--sea", sea, "--wind-speed", 6)
            if agrees:
                self.assertEqual(result.returncode, 0, result.stderr)
            else:
                self.assert_fails(result, 1, "day.las: its first point is at ", "tide.csv, but at ", "sea.csv; give")

    def test_the_only_record_of_a_sea_is_of_the_time_of_the_points(self):
        flight = round(self.unix_times().min())
        for hours, fits in ((2, True), (-2, True), (24, False), (-24 * 365, False)):
            at = sea_states.utc(flight + 3600 * hours)
            sea = self.write_sea(flight, hours)
            flags = ("--water-level", self.survey.water_level, "--sea", sea, "--wind-speed", 6)
            result = self.without_trajectory(self.survey.las, *flags)
            if fits:
                self.assertEqual(result.returncode, 0, result.stderr)
                continue
            self.assert_fails(result, 1, "not all measured within 3 h of ", "the only record of", "by --sea-time")
            self.assertEqual(self.without_trajectory(self.survey.las, *flags, "--sea-time", at).returncode, 0)

    def test_the_only_record_of_a_sea_is_of_all_points(self):
        """But for a few whose times are far from all others."""
        flight = round(self.unix_times().min())
        middle = np.median(self.unix_times()) - UNIX_EPOCH + 18  # GPS seconds since 1980
        year = 365 * 86400
        for name, change, bit, at, fits in (
                ("half", lambda i, t: self.gps(t) - 1e9 - year * (i % 2), 1, flight, False),
                ("stray", lambda i, t: self.gps(t) - 1e9 - year * (i == 7), 1, flight, True),
                ("stray_of_week", lambda i, t: 3e8 if i == 7 else self.gps(t) % WEEK, 0, flight, True),
                # Over the end of the week in which seconds begin again.
                ("again", lambda i, t: (self.gps(t) - middle) % WEEK, 0, flight - middle % WEEK + WEEK, True)):
            with self.subTest(name):
                sea = self.write_sea(at, 0)
                result = self.without_trajectory(self.with_times(f"{name}.las", change, bit), "--water-level",
                                                 self.survey.water_level, "--sea", sea, "--wind-speed", 6)
                if fits:
                    self.assertEqual(result.returncode, 0, result.stderr)
                else:
                    self.assert_fails(result, 1, "not all measured within 3 h of ")

    def test_seconds_of_the_week_are_not_taken_for_milliseconds(self):
        """Of which a thousandth is some minutes after any midnight."""
        midnight = self.unix_times().min() // 86400 * 86400
        las = self.with_times("week.las", lambda _, t: self.gps(t) % WEEK, 0)
        result = self.without_trajectory(las, "--water-level", self.write_levels_around(midnight), "--wind-speed", 6,
                                         "--table", self.table)
        self.assertEqual(result.returncode, 1)
        self.assertIn("tide.csv: has no level at the times of the points", result.stderr)

    def test_the_creation_of_the_file_is_evidence_for_its_day(self):
        """Levels of a month, points of seconds of the week."""
        tide = self.write_tide(*range(-24 * 15, 24 * 15))
        flags = ("--water-level", tide, "--wind-speed", 6, "--table", self.table)
        las = self.with_times("other.las", lambda _, t: self.gps(t) % WEEK, 0)
        day = datetime.datetime.fromtimestamp(self.unix_times().min(), datetime.timezone.utc)
        for created, decides in ((day, True), (day + datetime.timedelta(days=500), False), (None, False)):
            self.set_creation(las, created)
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


if __name__ == "__main__":
    programs.main()
