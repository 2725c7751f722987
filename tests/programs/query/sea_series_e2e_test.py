"""albtpu-query las over a sea that changes: the sea of each time, and where there is none."""

import json
import os

import numpy as np

import programs
import sea_states
from las_file import LasFile
from programs import make_flight, query
from sea_states import FLIGHT, FLIGHT_START, uncertainties, utc
from simulated_survey import SimulatedSurvey


class SeaSeriesTest(sea_states.Test):
    def test_each_point_gets_the_sea_of_its_time(self):
        source = make_flight(self.folder / "in.las")
        begin, end = FLIGHT_START - 1, FLIGHT_START + 9
        series = self.sea_csv((begin - 3600, 1, 200), (begin, 0.4, 200), (end, 2.5, 260), (end + 3600, 1, 200))
        flags = ("--sea", series, "--wind-speed", 6, "--wind-from", 250)

        def annotate(name, *more):
            result = query("las", source, self.folder / name, *FLIGHT, *flags, *more, check=0)
            return uncertainties(self.folder / name), result

        (thu, tvu), result = annotate("out.las")
        (first_thu, first_tvu), _ = annotate("first.las", "--sea-time", utc(begin))
        (last_thu, last_tvu), _ = annotate("last.las", "--sea-time", utc(end))
        las = LasFile(source)
        known = las.classes == 40
        times = las.field(22, "<f8") + 1e9 - 18 + 315964800
        weight = (times - begin)[known] / (end - begin)
        for values, first, last in ((thu, first_thu, last_thu), (tvu, first_tvu, last_tvu)):
            expected = np.sqrt((1 - weight) * first[known] ** 2 + weight * last[known] ** 2)
            np.testing.assert_allclose(values[known], expected, rtol=1e-6, atol=1e-9)
            np.testing.assert_array_equal(values[~known], -1)
        self.assertIn("interpolated in time, over 2 records, to", result.stderr)
        summary = json.loads((self.folder / "out.las.json").read_text())
        sea = summary["input"]["sea"]
        self.assertTrue(sea["by_time"])
        self.assertEqual((sea["records"], sea["first"]["time"], sea["last"]["time"]), (2, utc(begin), utc(end)))
        self.assertEqual(summary["parameters"]["sea"]["file"], {"name": "sea.csv", "bytes": series.stat().st_size})
        middle = utc(begin + 4)
        annotate("middle.las", "--sea-time", middle)
        at = np.argmin(np.abs(times[known] - (begin + 4)))
        self.assertAlmostEqual(thu[known][at] / uncertainties(self.folder / "middle.las")[0][known][at], 1, places=3)

    def test_one_and_two_threads_write_the_same_bytes(self):
        source = make_flight(self.folder / "in.las")
        series = self.sea_csv(*((FLIGHT_START - 1 + i, 0.4 + 0.3 * (i % 4), 200 + 9 * i) for i in range(9)))
        flags = (*FLIGHT, "--sea", series, "--wind-speed", 6, "--details")
        query("las", source, self.folder / "two.las", *flags, check=0)
        core = min(os.sched_getaffinity(0))
        query("las", source, self.folder / "one.las", *flags, check=0,
              preexec_fn=lambda: os.sched_setaffinity(0, {core}))
        self.assertEqual((self.folder / "one.las").read_bytes(), (self.folder / "two.las").read_bytes())

    def test_points_without_a_sea_get_no_number(self):
        source = make_flight(self.folder / "in.las")
        flags = (*FLIGHT, "--wind-speed", 6)
        partly = self.sea_csv((FLIGHT_START - 60, 1, 200), (FLIGHT_START + 4, 1, 200))
        result = query("las", source, self.folder / "out.las", *flags, "--sea", partly, check=0)
        self.assertIn("NO_SEA", result.stderr)
        thu, _ = uncertainties(self.folder / "out.las")
        las = LasFile(source)
        late = las.field(22, "<f8") > FLIGHT_START + 4 - 315964800 + 18 - 1e9
        self.assertTrue(np.all((thu[las.classes == 40] > -1) == ~late[las.classes == 40]))
        gap = self.sea_csv(*((FLIGHT_START + 3600 * hour, 1, 200) for hour in (-5, -4, -3, -2, 3, 4, 5)),
                           name="gap.csv")
        result = query("las", source, self.folder / "gap.las", *flags, "--sea", gap)
        self.assert_fails(result, 1, "the file of the sea has no record near their times", "longest_gap")
        bridged = self.toml("[sea]\nfile = 'gap.csv'\nlongest_gap = 5\n")
        query("las", source, self.folder / "gap.las", *flags, "--survey", bridged, "--overwrite", check=0)
        for name, states, *parts in (
                ("early.csv", [(FLIGHT_START - 9000, 1, 200), (FLIGHT_START - 5400, 1, 200)], "measured outside of"),
                ("late.csv", [(FLIGHT_START + 60, 1, 200), (FLIGHT_START + 3600, 1, 200)], "measured outside of",
                 "--sea-time")):
            result = query("las", source, self.folder / "never.las", *flags, "--sea", self.sea_csv(*states, name=name))
            self.assert_fails(result, 1, name, *parts)
            self.assertNotIn("never.las", self.names())
        timeless = make_flight(self.folder / "timeless.las", 2, 0)
        flags += ("--sea", partly, "--classes", 26)
        self.assert_fails(query("las", timeless, self.folder / "never.las", *flags), 1, "its points have no GPS time",
                          "--sea-time")
        query("las", timeless, self.folder / "once.las", *flags, "--sea-time", utc(FLIGHT_START), check=0)

    def test_seconds_of_the_week_need_one_week_of_the_sea(self):
        survey = SimulatedSurvey(self.folder, "--time", "week", "--week", 2109, "--seconds", 4)
        start = 315964800 + 2109 * 604800 + 320000 - 18  # UTC of the first line, s since 1970
        flags = ("las", survey.las, self.folder / "out.las", "--incidence", 20, "--water-level", survey.water_level,
                 "--footprint", 0.6, "--wind-speed", 6)
        hours = self.sea_csv((start - 1800, 1, 200), (start + 1800, 1, 200))
        query(*flags, "--sea", hours, check=0)
        sea = json.loads((self.folder / "out.las.json").read_text())["input"]["sea"]
        self.assertEqual((sea["first"]["time"], sea["last"]["time"]), (utc(start - 1800), utc(start + 1800)))
        weeks = self.sea_csv(*((start - 1800 + 3600 * hour, 1, 200) for hour in range(-200, 200)), name="weeks.csv")
        self.assert_fails(query(*flags, "--overwrite", "--sea", weeks), 1, "more than one week", "--sea-time")


if __name__ == "__main__":
    programs.main()
