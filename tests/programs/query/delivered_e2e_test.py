"""Inputs as others deliver them: water levels of CO-OPS, winds of coastal stations, tables of spreadsheets with decimal
commas, a trajectory for each day."""

import datetime
import json

import numpy as np

import programs
from las_file import LasFile
from programs import query
from sea_states import utc
from simulated_survey import SimulatedSurvey

UNIX_EPOCH = 315964800  # 1980-01-06 in s since 1970
WEEK = 604800
STEP = 360  # s, of levels


class LevelsTest(programs.Test):
    def setUp(self):
        super().setUp()
        self.survey = SimulatedSurvey(self.folder, "--seconds", 4, "--seed", 3)
        las = LasFile(self.survey.las)
        adjusted = las.bytes[6] & 1
        self.begin = las.field(22, "<f8").min() + (1e9 if adjusted else 1900 * WEEK) + UNIX_EPOCH - 18
        self.assertTrue(adjusted)
        start = self.begin // STEP * STEP
        # 0.1 m in six minutes.
        self.levels = [(start + STEP * i, self.survey.water_level + 0.1 * i) for i in range(-20, 21)]
        self.right = self.depths(self.write("tide.csv", "time,water_level\n" + "".join(
            f"{utc(time)},{level:.4f}\n" for time, level in self.levels)))

    def las(self, level, *flags):
        (self.folder / "out.las").unlink(missing_ok=True)
        return query("las", self.survey.las, self.folder / "out.las", "--incidence", 15, "--altitude", 400,
                     "--footprint", 0.5, "--classes", 40, "--table", self.table, "--wind-speed", 6, "--water-level",
                     level, "--details", *flags)

    def depths(self, level, *flags):
        self.result = self.las(level, *flags)
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        return LasFile(self.folder / "out.las").columns()["water_depth"]

    def text(self, time, form):
        return datetime.datetime.fromtimestamp(time, datetime.timezone.utc).strftime(form)

    def coops(self, form, levels):
        def quality(i):
            return "p" if i % 2 else "v"
        if form == "csv":
            return " Date Time, Water Level, Sigma, O or I (for verified), F, R, L, Quality \n" + "".join(
                f"{self.text(time, '%Y-%m-%d %H:%M')},{level:.4f},0.003,0,0,0,0,{quality(i)}\n"
                for i, (time, level) in enumerate(levels))
        if form == "json":
            return json.dumps({"metadata": {"id": "8723214", "name": "Virginia Key", "lat": "25.7", "lon": "-80.2"},
                               "data": [{"t": self.text(time, "%Y-%m-%d %H:%M"), "v": f"{level:.4f}", "s": "0.003",
                                         "f": "0,0,0,0", "q": quality(i)} for i, (time, level) in enumerate(levels)]})
        if form == "xml":
            return ('<?xml version="1.0" encoding="UTF-8" ?>\n<data>\n<metadata id="8723214" name="Virginia Key" '
                    'lat="25.7" lon="-80.2"/>\n<observations>\n' + "".join(
                        f'<wl t="{self.text(time, "%Y-%m-%d %H:%M")}" v="{level:.4f}" s="0.003" f="0,0,0,0" '
                        f'q="{quality(i)}"/>\n' for i, (time, level) in enumerate(levels)) +
                    "</observations>\n</data>\n")
        return '"Date","Time (GMT)","Predicted (ft)","Preliminary (ft)","Verified (ft)"\n' + "".join(
            f'"{self.text(time, "%Y/%m/%d")}","{self.text(time, "%H:%M")}","0",' +
            (f'"{level / 0.3048:.5f}","-"\n' if i % 2 else f'"9","{level / 0.3048:.5f}"\n')
            for i, (time, level) in enumerate(levels))

    def test_levels_of_coops_are_those_of_their_datum(self):
        levels = [(time, level + 26.5) for time, level in self.levels]
        for form in ("csv", "json", "xml", "table"):
            with self.subTest(form):
                path = self.write(f"coops.{form}", self.coops(form, levels))
                depths = self.depths(path, "--level-datum", "MLLW", "--level-offset", -26.5)
                # Levels have 0.1 mm, feet 0.003 mm, depths of 20 m in single precision 0.001 mm.
                np.testing.assert_allclose(depths, self.right, atol=2e-4)
                self.assertIn("relative to MLLW; -26.5 is added for the datum of the points' heights",
                              self.result.stderr)
                self.assertIn("20 of 41 preliminary", self.result.stderr)
                if form in ("json", "xml"):
                    self.assertIn("of CO-OPS at 8723214 Virginia Key", self.result.stderr)
                parameters = json.loads((self.folder / "out.las.json").read_text())["parameters"]
                self.assertEqual((parameters["level_datum"], parameters["level_offset"]), ("MLLW", -26.5))
                self.assert_fails(self.las(path), 1, "does not state the datum", "--level-datum")

    def test_levels_of_local_time_are_moved(self):
        levels = [(time - 4 * 3600, level) for time, level in self.levels]
        path = self.write("coops.csv", self.coops("csv", levels))
        depths = self.depths(path, "--level-datum", "NAVD", "--level-hours-from-utc", -4)
        np.testing.assert_allclose(depths, self.right, atol=2e-4)
        survey = self.toml("[surface]\nlevel = 'coops.csv'\nlevel_datum = 'NAVD'\nlevel_hours_from_utc = -4\n")
        result = query("las", self.survey.las, self.folder / "survey.las", "--incidence", 15, "--altitude", 400,
                       "--footprint", 0.5, "--classes", 40, "--table", self.table, "--wind-speed", 6, "--details",
                       "--survey", survey, check=0)
        self.assertIn("relative to NAVD (taken as the datum of the points' heights", result.stderr)
        np.testing.assert_array_equal(LasFile(self.folder / "survey.las").columns()["water_depth"], depths)

    def test_what_coops_answers_in_place_of_levels_is_named(self):
        path = self.write("coops.json", '{"error": {"message":"No data was found. This product may not be offered."}}')
        self.assert_fails(self.las(path, "--level-datum", "MLLW"), 1, "coops.json", "No data was found")
        result = self.las(-23.5, "--level-datum", "MLLW")
        self.assert_fails(result, 2, "no effect without a file of water levels")

    def test_levels_of_spreadsheets_have_decimal_commas(self):
        for separator in (";", "\t"):
            path = self.write("tide.txt", separator.join(("time", "water_level")) + "\n" + "".join(
                f"{utc(time)}{separator}{level:.4f}\n".replace(".", ",") for time, level in self.levels))
            np.testing.assert_array_equal(self.depths(path), self.right)
        path = self.write("tide.txt", "time;water_level\n" + "".join(
            f"{utc(time)};{level:.4f}\n".replace(".", "," if i % 2 else ".")
            for i, (time, level) in enumerate(self.levels)))
        self.assert_fails(self.las(path), 1, "has a number with a comma in line 3 and one with a point in line 2")


class TablesTest(programs.Test):
    def test_pulses_of_spreadsheets_get_answers_in_their_dialect(self):
        lines = ["depth,wind_speed,incidence,footprint"] + [f"{depth},{wind},12.5,0.6" for depth in (1, 2.5, 10.25)
                                                            for wind in (3.5, 6)]
        plain = "\n".join(lines) + "\n"
        out = self.folder / "out.csv"
        query("csv", self.write("in.csv", plain), out, "--table", self.table, check=0)
        right = out.read_text()
        for separator, decimal, words in ((";", ",", "semicolons, decimal commas"), ("\t", ",", "tabs, decimal commas"),
                                          (";", ".", "semicolons, decimal points")):
            def written(text, separator=separator, decimal=decimal):
                return text.translate({ord(","): separator, ord("."): decimal})
            result = query("csv", self.write("in.csv", written(plain)), out, "--table", self.table, "--overwrite",
                           check=0)
            self.assertEqual(out.read_text(), written(right))
            self.assertIn(f"columns separated by {words}, in the output as well", result.stderr)
        for text, part in (("depth;wind_speed\n1,5;2\n2.5;2\n", "a comma in line 2 and one with a point in line 3"),
                           ("depth,wind_speed\n1,5,2\n", "3 cells, but the header has 2 (columns separated by commas"),
                           ("depth,wind_speed\n1.5;2\n", "1 cells, but the header has 2"),
                           ("depth;wind_speed,incidence\n1,5;2\n", "as many commas as semicolons")):
            result = query("csv", self.write("in.csv", text), self.folder / "no.csv", "--table", self.table,
                           "--incidence", 10, "--footprint", 1)
            self.assert_fails(result, 1, "in.csv", part)
            self.assertNotIn("no.csv", self.names())

    def test_winds_of_a_coastal_station_stand_for_their_sea(self):
        winds = self.write("fwyf1.txt", "#YY  MM DD hh mm WDIR WSPD GST  WVHT   DPD   APD MWD   PRES\n"
                           "#yr  mo dy hr mn degT m/s  m/s     m   sec   sec degT   hPa\n"
                           "2016 05 17 14 00  90  8.0  9.0    MM    MM    MM  MM 1021.2\n")
        pulse = ("pulse", "--incidence", 15, "--footprint", 0.6, "--depth", 8, "--beam-azimuth", 20, "--json")
        answer = json.loads(query(*pulse, "--sea", winds, check=0).stdout)
        self.assertGreater(answer["tvu"], 0)
        half = self.write("half.txt", winds.read_text().replace(" 8.0 ", " 4.0 "))
        self.assertLess(json.loads(query(*pulse, "--sea", half, check=0).stdout)["tvu"], answer["tvu"])
        shown = query("sea", winds, check=0)
        self.assertIn("it has no waves: the sea of each record is that of its wind", shown.stdout + shown.stderr)
        calm = self.write("none.txt", winds.read_text().replace("8.0  9.0", " MM   MM"))
        self.assert_fails(query(*pulse, "--sea", calm), 1, "none of its 1 records has waves", "its speed is missing",
                          "--hs, --tp and --waves-from")


class DaysTest(programs.Test):
    """An SBET for each day states seconds of a week that it does not name."""

    def annotate(self, survey, source, trajectories, *flags):
        target = self.folder / "out.las"
        target.unlink(missing_ok=True)
        result = query("las", source, target, "--trajectory", *trajectories, "--lever-arm", "0.3,-0.2,0.5",
                       "--water-level", survey.water_level, "--classes", 40, "--divergence", 1, "--wind-speed", 6,
                       "--table", self.table, "--details", *flags)
        self.assertEqual(result.returncode, 0, result.stderr)
        return LasFile(target).columns(), result.stderr

    def assert_same(self, columns, right):
        for name in ("incidence", "beam_azimuth", "water_depth", "slant_range"):
            # The parts of a trajectory have their own rounding of map coordinates between two records.
            np.testing.assert_allclose(columns[name], right[name], rtol=1e-6, atol=1e-6, err_msg=name)

    def test_each_point_finds_its_day(self):
        survey = SimulatedSurvey(self.folder, "--seconds", 20, "--pulse-rate", 500, "--seed", 3)
        right, _ = self.annotate(survey, survey.las, [survey.sbet])
        days = self.folder / "days"
        days.mkdir()
        records = survey.records()
        of_week = records[:, 0] % WEEK
        for day in range(7):
            moved = records.copy()
            moved[:, 0] = (of_week + day * 86400) % WEEK if day else of_week
            moved[:, 1] += 1e-4 * day  # Other lines.
            if np.all(np.diff(moved[:, 0]) > 0):
                moved.tofile(days / f"sbet_{day}.out")
        columns, _ = self.annotate(survey, survey.las, [days])
        self.assert_same(columns, right)

    def test_the_same_hours_of_another_week_are_left_out_where_they_are_elsewhere(self):
        survey = SimulatedSurvey(self.folder, "--seconds", 20, "--pulse-rate", 500, "--seed", 3)
        right, _ = self.annotate(survey, survey.las, [survey.sbet])
        weeks = self.folder / "weeks"
        weeks.mkdir()
        records = survey.records()
        records.tofile(weeks / "b.out")
        records[:, 1] += 0.01  # rad, 64 km
        records.tofile(weeks / "a.out")
        columns, said = self.annotate(survey, survey.las, [weeks])
        self.assert_same(columns, right)
        self.assertIn("a.out is not of this flight and left out", said)

    def test_saturday_midnight_lies_between_two_files(self):
        for time in ("week", "adjusted"):
            survey = SimulatedSurvey(self.folder, "--seconds", 20, "--pulse-rate", 500, "--seed", 3, "--time", time,
                                     "--start", WEEK - 10)
            whole, _ = self.annotate(survey, survey.las, [survey.sbet])
            days = self.folder / f"days_{time}"
            days.mkdir()
            records = survey.records()
            times = np.where(records[:, 0] >= WEEK, records[:, 0] - WEEK, records[:, 0])
            records[:, 0] = times
            begins = int(np.flatnonzero(np.diff(times) < 0)[0]) + 1
            records[:begins + 1][:begins].tofile(days / "saturday.out")
            records[begins:].tofile(days / "sunday.out")
            columns, _ = self.annotate(survey, survey.las, [days])
            known = columns["incidence"] >= 0
            # Between the last record of Saturday and the first of Sunday there is no position: one step.
            self.assertGreater(known.sum(), 0.99 * (whole["incidence"] >= 0).sum())
            self.assert_same({name: values[known] for name, values in columns.items()},
                             {name: values[known] for name, values in whole.items()})


if __name__ == "__main__":
    programs.main()
