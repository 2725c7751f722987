"""Totals from outside: one pulse against known covariances, LAS and LAZ with a survey file, and what is refused."""

import json
import math
import struct

import numpy as np

import programs
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

# Computed apart from this code, by automatic differentiation: NN EE DD NE ND ED, 1e-6 m^2.
KNOWN = {"pulse": (2011.89, 1837.13, 3551.88, 17.96, -6.91, 86.27),
         "level": (2011.89, 1954.50, 2303.08, 19.06, -5.32, -263.03)}
SIGMA = """
[sigma]
position = [0.03, 0.03, 0.05]
attitude = [0.0025, 0.0025, 0.005]
boresight = [0.001, 0.001, 0.004]
lever_arm = 0.02
scan = 0.001
time = 1e-5
range_offset = 0.01
bottom_range = 0.025
surface_height = 0.05
index = 0.001
"""
DECIDED = "[datum]\nsigma = 0.08\n[water]\nindex = 1.34\ncolumn = 'none'\n"
SENSOR = "[sensor]\nname = 'riegl-vq-880-g'\nlever_arm = [0.3, -0.2, 0.5]\n"
WIND = "[sea]\nwind_speed = 6.5\nwind_from = 100\n"


def with_doubles(path):
    """The bytes of a LAS file whose only extra bytes are two floats, as doubles."""
    data = bytearray(path.read_bytes())
    points, = struct.unpack_from("<I", data, 96)
    length, = struct.unpack_from("<H", data, 105)
    for name in (b"total_thu", b"total_tvu"):
        data[data.index(name) - 2] = 10
    struct.pack_into("<H", data, 105, length + 8)
    records = [bytes(data[at:at + length]) for at in range(points, len(data), length)]
    return bytes(data[:points]) + b"".join(
        record[:-8] + struct.pack("<2d", *struct.unpack("<2f", record[-8:])) for record in records)


class TotalsTest(programs.Test):
    def pulse(self, text, *flags):
        turn = math.radians(30)
        velocity = f"{70 * math.cos(turn) - 2 * math.sin(turn)},{70 * math.sin(turn) + 2 * math.cos(turn)},0"
        rates = ",".join(str(math.degrees(rate)) for rate in (0.01, 0.02, 0.03))
        return query("pulse", "--survey", self.toml(text), "--table", self.table, "--incidence", 20,
                     "--beam-azimuth", 90, "--altitude", 400, "--depth", 10, "--attitude", "3,4,30", "--velocity",
                     velocity, "--rates", rates, "--coverage", "2sigma", "--json", *flags)

    def test_pulse_has_the_known_covariance_of_the_air_side(self):
        for located, known in KNOWN.items():
            answer = self.pulse(SENSOR + DECIDED + WIND + SIGMA + f"[surface]\nlocated = '{located}'\n")
            self.assertEqual(answer.returncode, 0, answer.stderr)
            total = json.loads(answer.stdout)
            for entry, value in zip(("NN", "EE", "DD", "NE", "ND", "ED"), known):
                self.assertAlmostEqual(1e6 * total["covariance_air"][entry], value, delta=0.0051, msg=located + entry)
                parts = total["covariance_air"][entry] + total["covariance_sea"][entry]
                datum = 0.08 ** 2 if entry == "DD" else 0
                self.assertAlmostEqual(total["covariance_total"][entry], parts + datum, delta=1e-7)
                groups = sum(group[entry] for group in total["groups"].values())
                self.assertAlmostEqual(total["covariance_total"][entry], groups, delta=1e-7)
            covariance = total["covariance_total"]
            self.assertAlmostEqual(total["thu"], 2 * math.sqrt(covariance["NN"] + covariance["EE"]), delta=1e-6)
            self.assertAlmostEqual(total["tvu"], 2 * math.sqrt(covariance["DD"]), delta=1e-6)
            self.assertAlmostEqual(total["semi_major"] ** 2 + total["semi_minor"] ** 2,
                                   covariance["NN"] + covariance["EE"], delta=1e-7)
            on_it = ["returns from the surface lie on it (assumed: [surface] channel is not given)"]
            self.assertEqual(total["assumed"], ["divergence 1 mrad (assumed: the default of the sensor)",
                                                *(on_it if located != "level" else [])])

    def test_a_sensor_says_which_laser_can_locate_the_surface(self):
        answers = {}
        for laser in ("none", "green", "infrared"):
            sensor = self.folder / f"{laser}.toml"
            sensor.write_text("title = 'Scanner 3'\n" + ("" if laser == "none" else f"""
[surface_channel]
value = '{laser}'
source = 'its data sheet'
"""))
            text = f"[sensor]\nname = '{sensor}'\n[surface]\nlocated = 'pulse'\n" + DECIDED + WIND + SIGMA
            answers[laser] = json.loads(query("pulse", "--survey", self.toml(text), "--table", self.table,
                                              "--incidence", 20, "--depth", 10, "--footprint", 0.6, "--altitude", 400,
                                              "--beam-azimuth", 90, "--json", check=0).stdout)
        said = {laser: [line for line in answer["assumed"] if line.startswith("returns from the surface")]
                for laser, answer in answers.items()}
        begin = "returns from the surface lie on it (assumed: [surface] channel is not given"
        self.assertEqual(said, {
            "none": [begin + ")"],
            "green": [begin + "; Scanner 3 has no infrared laser, and a green one finds the surface too low: where the "
                      "processing did not correct this, give [surface] channel = \"green\")"],
            "infrared": [begin + ", Scanner 3 has an infrared laser)"]})
        # What is assumed is said, and changes no number.
        for laser in ("green", "infrared"):
            self.assertEqual(answers[laser]["covariance_total"], answers["none"]["covariance_total"])
            self.assertEqual(answers[laser]["bias_vertical"], answers["none"]["bias_vertical"])
        shown = json.loads(query("sensors", self.folder / "green.toml", "--json", check=0).stdout)
        self.assertEqual(shown["surface_channel"], {"value": "green", "source": "its data sheet"})
        shown = query("sensors", self.folder / "green.toml", check=0).stdout
        self.assertIn("surface_channel green laser, its data sheet", shown)

    def test_las_has_the_total_its_shares_and_its_covariance(self):
        flight = SimulatedSurvey(self.folder / "flight").folder
        text = (SENSOR + f"[trajectory]\nfiles = ['{flight}/sbet.out']\nerrors = ['{flight}/smrmsg.out']\n"
                "[surface]\nclasses = [41]\n" + WIND + DECIDED +
                "[output]\nclasses = [40]\ncoverage = '2sigma'\ndetails = true\ns44_order = '1a'\n")
        out = self.folder / "out.las"
        arguments = ("las", "--survey", self.toml(text), "--table", self.table, flight / "flight.las")
        query(*arguments, out, check=0)
        number = LasFile(out).columns()
        self.assertEqual(list(number)[:2], ["total_thu", "total_tvu"])
        answered = number["total_thu"] >= 0
        self.assertGreater(answered.sum(), 1000)
        self.assertTrue((number["thu_water"] == -1).all())
        of = {name: values[answered] for name, values in number.items()}
        np.testing.assert_allclose(2 * np.sqrt(of["VarianceX"] + of["VarianceY"]), of["total_thu"], rtol=1e-5)
        np.testing.assert_allclose(2 * np.sqrt(of["VarianceZ"]), of["total_tvu"], rtol=1e-5)
        np.testing.assert_allclose(np.hypot(of["thu_air"], of["thu_sea"]), of["total_thu"], rtol=1e-5)
        np.testing.assert_allclose(np.sqrt(of["tvu_air"]**2 + of["tvu_sea"]**2 + (2 * 0.08)**2), of["total_tvu"],
                                   rtol=1e-5)
        # What neither pulses nor lines draw anew is of the survey: the datum is in it.
        of_survey = of["total_tvu"]**2 - of["tvu_pulse"]**2 - of["tvu_line"]**2
        self.assertGreater(of_survey.min(), (2 * 0.08)**2)
        np.testing.assert_array_less(of["tvu_sea"], of["tvu_pulse"])
        self.assertTrue((of["CovarianceXY"]**2 <= of["VarianceX"] * of["VarianceY"]).all())
        summary = json.loads((self.folder / "out.las.json").read_text())
        total = summary["answers"]["total"]
        wet = number["water_depth"][answered] >= 0
        self.assertEqual(total["pulses"], wet.sum())
        self.assertEqual(summary["answers"]["dry"]["points"], (~wet).sum())
        self.assertEqual(total["coverage"], "2sigma")
        self.assertTrue(any("boresight" in line for line in total["assumed"]))
        self.assertFalse(any("position" in line for line in total["assumed"]))
        self.assertEqual(sum(line["pulses"] for line in total["lines"].values()), wet.sum())
        # The same from LAS to LAZ and back, and through a server.
        laz, again = self.folder / "out.laz", self.folder / "again.las"
        query(*arguments, laz, check=0)
        with programs.server(self.folder) as address:
            query(*arguments[:3], *arguments[5:], again, "--server", address, check=0)
        self.assertEqual(again.read_bytes(), out.read_bytes())

    def test_las_and_csv_name_what_the_surveyor_adds(self):
        flight = SimulatedSurvey(self.folder / "flight").folder
        text = (SENSOR + f"[trajectory]\nfiles = ['{flight}/sbet.out']\n[surface]\nclasses = [41]\n" + WIND + DECIDED +
                "[output]\nclasses = [40]\ncoverage = '2sigma'\ndetails = true\n")
        extra = "[extra]\nhorizontal = 0.3\nvertical = 0.05\n"

        def annotate(name, text):
            query("las", flight / "flight.las", self.folder / name, "--survey", self.toml(text), "--table", self.table,
                  check=0)
            summary = json.loads((self.folder / f"{name}.json").read_text())
            return LasFile(self.folder / name).columns(), summary

        plain, _ = annotate("plain.las", text)
        added, summary = annotate("added.las", text + extra)
        self.assertEqual(sorted(set(added) - set(plain)), ["thu_extra", "tvu_extra"])
        has = plain["total_thu"] >= 0
        self.assertTrue((added["thu_extra"][~has] == -1).all())
        np.testing.assert_allclose(added["thu_extra"][has], 0.6, rtol=1e-6)
        np.testing.assert_allclose(added["tvu_extra"][has], 0.1, rtol=1e-6)
        np.testing.assert_allclose(added["total_thu"][has], np.hypot(plain["total_thu"][has], 0.6), rtol=1e-5)
        np.testing.assert_allclose(added["total_tvu"][has], np.hypot(plain["total_tvu"][has], 0.1), rtol=1e-5)
        numbers = summary["parameters"]["total"]["numbers"]
        self.assertEqual(numbers["extra_horizontal"], {"value": "0.3 m", "source": "[extra], radial", "assumed": False})
        shares = summary["answers"]["total"]["all"]["shares_vertical"]
        wet = has & (plain["water_depth"] >= 0)
        expected = 0.05**2 * wet.sum() / added["VarianceZ"][wet].sum(dtype=float)
        self.assertAlmostEqual(shares["extra"], expected, delta=1e-5)
        self.assertAlmostEqual(sum(shares.values()), 1, delta=1e-6)
        # One pulse names it among its sources, a CSV file as a contribution.
        answer = query("pulse", "--survey", self.toml(text + extra), "--table", self.table, "--json", "--incidence", 20,
                       "--beam-azimuth", 90, "--depth", 10, "--altitude", 400, check=0)
        self.assertEqual(json.loads(answer.stdout)["sources"]["extra"],
                         {"horizontal": 0.09, "vertical": 0.0025000000000000005, "group": "survey"})
        _, lines = self.csv("incidence,beam_azimuth,depth,altitude\n20,90,10,400\n", "--details", text=text + extra)
        of_csv = dict(zip(*lines))
        for name, value in (("thu_extra", 0.6), ("tvu_extra", 0.1)):
            self.assertEqual(np.float32(of_csv[name]), np.float32(value))

    def test_replaces_the_numbers_of_an_earlier_run(self):
        flight = SimulatedSurvey(self.folder / "flight").folder
        text = (SENSOR + f"[trajectory]\nfiles = ['{flight}/sbet.out']\n[surface]\nclasses = [41]\n" + DECIDED +
                "[sea]\nwind_speed = {wind}\nwind_from = 100\n[output]\nclasses = [40]\n")

        def annotate(source, name, wind, *flags, code=0):
            survey = self.toml(text.format(wind=wind), f"wind_{wind}.toml")
            result = query("las", "--survey", survey, "--table", self.table, source, self.folder / name, *flags)
            self.assertEqual(result.returncode, code, result.stderr)
            return result.stderr if code else self.folder / name

        first = annotate(flight / "flight.las", "first.las", 4)
        other = annotate(flight / "flight.las", "other.las", 6.5)
        self.assertNotEqual(first.read_bytes(), other.read_bytes())
        self.assertIn("--replace", annotate(first, "again.las", 6.5, code=1))
        self.assertFalse((self.folder / "again.las").exists())
        self.assertEqual(annotate(first, "again.las", 6.5, "--replace").read_bytes(), other.read_bytes())
        # Compressed, and with details, of which two are there already.
        packed = annotate(flight / "flight.las", "packed.laz", 4)
        self.assertEqual(annotate(packed, "unpacked.las", 6.5, "--replace").read_bytes(), other.read_bytes())
        detailed = LasFile(annotate(first, "detailed.las", 6.5, "--replace", "--details")).columns()
        expected = LasFile(annotate(flight / "flight.las", "expected.las", 6.5, "--details")).columns()
        self.assertEqual(list(detailed), list(expected))
        for name, values in expected.items():
            np.testing.assert_array_equal(detailed[name], values, name)
        # Doubles of another tool.
        doubles = self.folder / "doubles.las"
        doubles.write_bytes(with_doubles(first))
        replaced = LasFile(annotate(doubles, "replaced.las", 6.5, "--replace"))
        plain = LasFile(other)
        for i, name in enumerate(("total_thu", "total_tvu")):
            begin = plain.extra_dimensions()["total_thu"][0]
            np.testing.assert_array_equal(replaced.field(begin + 8 * i, "<f8"),
                                          plain.field(begin + 4 * i, "<f4").astype(float), name)

    def csv(self, rows, *flags, text=SENSOR + DECIDED + WIND + SIGMA + "[surface]\nlocated = 'level'\n", table=True):
        path, out = self.folder / "pulses.csv", self.folder / "totals.csv"
        path.write_text(rows)
        source = ("--table", self.table) if table else ()
        result = query("csv", path, out, "--survey", self.toml(text), *source, "--overwrite", *flags)
        return result, [line.split(",") for line in out.read_text().splitlines()] if out.exists() else None

    def test_csv_takes_the_divergence_of_the_sensor(self):
        result, lines = self.csv("incidence,beam_azimuth,depth,altitude\n20,90,10,400\n")
        self.assertEqual(result.returncode, 0, result.stderr)
        assumed = "divergence 1 mrad (assumed: the default of the sensor)"
        self.assertIn(assumed, result.stderr)
        self.assertIn(assumed, json.loads((self.folder / "totals.csv.json").read_text())["answers"]["total"]["assumed"])
        plain, with_flag = self.csv("incidence,beam_azimuth,depth,altitude\n20,90,10,400\n", "--divergence", 1)
        self.assertEqual(with_flag, lines)
        self.assertNotIn(assumed, plain.stderr)

    def test_csv_without_a_direction_states_lengths_alone(self):
        result, lines = self.csv("incidence,beam_azimuth,depth\n20,,10\n20,90,10\n", "--altitude", 400, "--details")
        self.assertEqual(result.returncode, 0, result.stderr)
        first, second = (dict(zip(lines[0], line)) for line in lines[1:])
        self.assertEqual([first["covariance_NN"], first["covariance_NE"]], ["", ""])
        self.assertGreater(float(first["total_thu"]), 0)
        # A beam straight ahead stands for it: roll and pitch are equally uncertain, so that heights hardly change.
        np.testing.assert_allclose(float(first["tvu_air"]), float(second["tvu_air"]), rtol=1e-4)
        self.assertNotEqual(second["covariance_NE"], "")

    def test_csv_without_a_direction_knows_none_of_the_sea(self):
        rows = "incidence,beam_azimuth,depth,altitude\n20,,10,400\n"
        text = SENSOR + DECIDED + SIGMA + "[surface]\nlocated = 'level'\n"
        for given in (rows, rows.replace("20,,", "20,").replace("beam_azimuth,", "")):
            over_waves, by_wind = set(), set()
            for direction in (0, 45, 90):
                waves = ("--hs", 0.6, "--tp", 3.2, "--waves-from", direction)
                _, lines = self.csv(given, *waves, text=text, table=False)
                over_waves.add(tuple(lines[1][-5:-3]))
                _, lines = self.csv(given, "--wind-speed", 6.5, "--wind-from", direction, text=text)
                by_wind.add(tuple(lines[1][-5:-3]))
            self.assertEqual((len(over_waves), len(by_wind)), (1, 1), (over_waves, by_wind))

    def test_csv_says_which_pulses_have_numbers_of_the_aircraft_that_are_none(self):
        rows = ("nan,0,1", "0,0,1", "-5,0,1", "1e9,0,1", "400,nan,1", "400,-2e6,1", "400,1,inf", "400,1,1")
        result, lines = self.csv("depth,incidence,footprint,beam_azimuth,altitude,roll,velocity_north\n" +
                                 "".join(f"10,20,0.5,90,{row}\n" for row in rows), "--details")
        self.assertEqual(result.returncode, 1)
        self.assertIn("7 INVALID", result.stderr)
        for line in lines[1:-1]:
            self.assertEqual(line[-1], "INVALID")
            self.assertEqual(set(line[7:-1]), {""})
        self.assertEqual(lines[-1][-1], "INTERPOLATED")

    def test_no_aircraft_flies_on_the_water(self):
        for command in (("las", "a.las", "b.las"), ("csv", "a.csv", "b.csv"), ("pulse",)):
            self.assert_fails(query(*command, "--altitude", 0), 2, "--altitude: 0 is 0; give a number above 0")

    def test_csv_has_a_flag_or_a_column(self):
        by_wind = SENSOR + DECIDED + SIGMA + "[sea]\nwind_speed = 6.5\n[surface]\nlocated = 'level'\n"
        for flag, number, column, text in (("--altitude", 500, "altitude", by_wind),
                                           ("--beam-azimuth", 180, "beam_azimuth", by_wind)):
            columns = {"incidence": 20, "footprint": 0.5, "depth": 10, "altitude": 400, column: number}
            rows = ",".join(columns) + "\n" + ",".join(map(str, columns.values())) + "\n"
            result, _ = self.csv(rows, flag, number, text=text)
            self.assert_fails(result, 2, f"{flag}: ", f"pulses.csv also has the column '{column}'; leave out one")

    def test_csv_needs_an_altitude(self):
        text = SENSOR + DECIDED + SIGMA + "[sea]\nwind_speed = 6.5\n[surface]\nlocated = 'level'\n"
        result, _ = self.csv("incidence,footprint,depth\n20,0.5,10\n", text=text)
        self.assert_fails(result, 1, "no column 'altitude'", "--altitude")
        result, _ = self.csv("incidence,footprint,depth,altitude\n20,0.5,10,high\n", text=text)
        self.assert_fails(result, 1, "line 2, column 'altitude': 'high' is not a number")

    def test_las_needs_a_sensor_and_returns_of_the_surface_where_it_uses_them(self):
        las, out = programs.make_flight(self.folder / "line.las"), self.folder / "out.las"
        for text, part, *flags in (
                ("", "--datum-sigma has no effect without --sensor", "--datum-sigma", 0.1),
                (SENSOR + DECIDED + "[surface]\nlocated = 'pulse'\n", "needs returns from the surface")):
            result = query("las", las, out, "--survey", self.toml(text), "--table", self.table, "--water-level", -23,
                           "--incidence", 20, "--altitude", 400, "--divergence", 1, "--wind-speed", 5, *flags)
            self.assert_fails(result, 2, part)
            self.assertFalse(out.exists())


if __name__ == "__main__":
    programs.main()
