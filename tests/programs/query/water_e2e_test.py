"""The contribution of the water column from outside: one pulse, LAS, CSV, points beyond it, and what is refused."""

import json
import math

import numpy as np

import programs
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

SENSOR = "[sensor]\nname = 'riegl-vq-880-g'\nlever_arm = [0.3, -0.2, 0.5]\n[datum]\nsigma = 0.08\n"
WIND = "[sea]\nwind_speed = 6.5\nwind_from = 100\n"
OPTICS = "[water]\nkd = 0.15\nkd_kind = 'diffuse532'\n"
RECEIVER = "detector = 'peak'\nfield_of_view = 6\npulse_length = 1.5\n"
WATER = OPTICS + RECEIVER + "bias = 'none'\n"


class WaterTest(programs.Test):
    def pulse(self, water, *flags, depth=10, **options):
        return query("pulse", "--survey", self.toml(SENSOR + WIND + "[surface]\nlocated = 'local'\n" + water),
                     "--table", self.table, "--incidence", 15, "--beam-azimuth", 90, "--altitude", 400,
                     "--depth", depth, "--footprint", 0.5, "--coverage", "2sigma", "--json", *flags, **options)

    def total(self, water, *flags, **options):
        result = self.pulse(water, *flags, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_pulse_adds_a_covariance_and_keeps_the_bias_apart(self):
        left_out, none = self.total("[water]\ncolumn = 'none'\n"), self.total(WATER)
        self.assertIsNone(left_out["covariance_water"])
        self.assertIsNone(left_out["tvu_water"])
        for entry, value in none["covariance_total"].items():
            parts = left_out["covariance_total"][entry] + none["covariance_water"][entry]
            self.assertAlmostEqual(value, parts, delta=1e-7)
            groups = sum(group[entry] for group in none["groups"].values())
            self.assertAlmostEqual(value, groups, delta=1e-7)
        water = none["water"]
        self.assertLess(water["water_bias_vertical"], -0.02)
        self.assertAlmostEqual(none["bias_vertical"], left_out["bias_vertical"] + water["water_bias_vertical"],
                               delta=1e-5)
        self.assertAlmostEqual(none["bias_along_beam"], left_out["bias_along_beam"] + water["water_bias_along_beam"],
                               delta=1e-5)
        low, high = water["water_bias_vertical_interval"]
        self.assertTrue(low < water["water_bias_vertical"] < high)
        self.assertAlmostEqual(none["tvu_water"], 2 * water["water_bias_vertical_sigma"], delta=1e-5)
        self.assertIn("water_albedo 0.8 (assumed: coastal water, 0.8 +- 0.1)", none["assumed"])

    def test_text_has_what_was_entered_and_what_it_became(self):
        for water, text in ((OPTICS, "water: Kd = 0.15 1/m of kind diffuse532; attenuation 0.1275 1/m ([water] kd of "
                                     "kind diffuse532: K = 0.85 Kd, "),
                            ("[water]\nsecchi = 8\n", "water: Secchi depth Z = 8 m; attenuation ")):
            survey = SENSOR + WIND + "[surface]\nlocated = 'local'\n" + water + RECEIVER + "bias = 'none'\n"
            total = ("--survey", self.toml(survey), "--table", self.table)
            pulse = query("pulse", *total, "--incidence", 15, "--beam-azimuth", 90, "--altitude", 400, "--depth", 10,
                          "--footprint", 0.5, check=0)
            self.assertIn(f"\n{text}", pulse.stdout)
            (self.folder / "in.csv").write_text("incidence,beam_azimuth,altitude,depth,footprint\n15,90,400,10,0.5\n")
            csv = query("csv", self.folder / "in.csv", self.folder / "out.csv", *total, "--overwrite", check=0)
            self.assertIn(f"\n  {text}", csv.stderr)
        self.assertNotIn("\nwater: ", query("pulse", "--survey", self.toml(
            SENSOR + WIND + "[surface]\nlocated = 'local'\n[water]\ncolumn = 'none'\n"), "--table", self.table,
            "--incidence", 15, "--beam-azimuth", 90, "--altitude", 400, "--depth", 10, "--footprint", 0.5,
            check=0).stdout)

    def test_centimetres_in_place_of_metres_are_doubted(self):
        for more, text in (("[sigma]\nposition = [2, 2, 17]\n", "[sigma] position is 2, 2, 17 m, more than 1 m: is it "
                            "a standard deviation in m, not in cm or mm?"), ("", None)):
            result = self.pulse(WATER + more)
            self.assertEqual(result.returncode, 0, result.stderr)
            if text:
                self.assertIn(text, result.stderr)
            else:
                self.assertNotIn("standard deviation", result.stderr)

    def test_each_treatment_leaves_what_it_says(self):
        none, correct = self.total(WATER), self.total(WATER.replace("'none'", "'correct'"))
        left_out = self.total("[water]\ncolumn = 'none'\n")
        self.assertAlmostEqual(correct["bias_vertical"], left_out["bias_vertical"], delta=1e-6)
        self.assertAlmostEqual(correct["tvu_water"], none["tvu_water"], delta=1e-6)
        vendor = self.total(WATER.replace("'none'", "'vendor'\nresidual_fraction = 0.1"))
        water = none["water"]
        self.assertAlmostEqual(vendor["tvu_water"], 0.2 * math.hypot(water["water_bias_vertical"],
                                                                     water["water_bias_vertical_sigma"]), delta=1e-5)
        calibrated = self.total(WATER.replace(
            "'none'", "'calibrated'\ncalibration = {depth = 5, offset = -0.03, sigma = 0.005}"))
        self.assertLess(calibrated["tvu_water"], 0.7 * none["tvu_water"])
        photons = self.total(WATER + "photons = 100\n")
        self.assertGreater(photons["tvu_water"], none["tvu_water"])
        self.assertEqual(photons["sources"]["photons"]["group"], "pulse")

    def test_the_index_of_the_processing_is_a_bias(self):
        state = "temperature = 15\nsalinity = 35\n"
        right = self.total("[water]\ncolumn = 'none'\n" + state)
        wrong = self.total("[water]\ncolumn = 'none'\nprocessed_with = 1.33\n" + state)
        self.assertAlmostEqual(wrong["bias_vertical"] - right["bias_vertical"], -0.248, delta=0.003)
        self.assertAlmostEqual(wrong["tvu"], right["tvu"], delta=1e-6)

    def test_las_and_csv_have_the_share(self):
        flight = SimulatedSurvey(self.folder / "flight").folder
        text = (SENSOR + f"[trajectory]\nfiles = ['{flight}/sbet.out']\n[surface]\nclasses = [41]\n" + WIND + WATER +
                "[output]\nclasses = [40]\ncoverage = '2sigma'\ndetails = true\n")
        out = self.folder / "out.las"
        said = query("las", "--survey", self.toml(text), "--table", self.table, flight / "flight.las", out, check=0)
        self.assertIn("\n  water: Kd = 0.15 1/m of kind diffuse532; attenuation 0.1275 1/m ", said.stderr)
        number = LasFile(out).columns()
        answered = number["total_thu"] >= 0
        self.assertGreater(answered.sum(), 1000)
        of = {name: values[answered] for name, values in number.items()}
        np.testing.assert_allclose(of["thu_air"]**2 + of["thu_sea"]**2 + of["thu_water"]**2, of["total_thu"]**2,
                                   rtol=1e-4)
        np.testing.assert_allclose(of["tvu_air"]**2 + of["tvu_sea"]**2 + of["tvu_water"]**2 + 0.16**2,
                                   of["total_tvu"]**2, rtol=1e-4)
        # Deeper water biases more.
        deep = of["water_depth"] > np.quantile(of["water_depth"], 0.9)
        self.assertLess(of["bias_vertical"][deep].mean(), 2 * of["bias_vertical"].mean())
        total = json.loads((self.folder / "out.las.json").read_text())["answers"]["total"]["all"]
        self.assertGreater(total["shares_vertical"]["water"], 0.01)
        self.assertAlmostEqual(sum(total["shares_vertical"].values()), 1, delta=1e-6)

        csv = self.folder / "pulses.csv"
        csv.write_text("incidence,beam_azimuth,depth,altitude,footprint\n15,90,10,400,0.5\n15,90,19,400,0.5\n")
        survey = self.toml(SENSOR + WIND + "[surface]\nlocated = 'local'\n" + WATER)
        result = query("csv", csv, self.folder / "out.csv", "--survey", survey, "--table", self.table, "--details",
                       "--coverage", "2sigma")
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = [line.split(",") for line in (self.folder / "out.csv").read_text().splitlines()]
        first = dict(zip(lines[0], lines[1]))
        answer = self.total(WATER)
        for cell, name in (("total_thu", "thu"), ("total_tvu", "tvu"), ("thu_water", "thu_water"),
                           ("tvu_water", "tvu_water"), ("bias_vertical", "bias_vertical"),
                           ("bias_along_beam", "bias_along_beam")):
            self.assertEqual(np.float32(first[cell]), np.float32(answer[name]), cell)

    def test_a_pulse_beyond_the_water_has_no_total(self):
        murky = WATER.replace("0.15", "0.9")
        answer = self.total(murky, depth=15)
        self.assertEqual(answer["outcome"], "NO_WATER")
        self.assertEqual((answer["bias_along_beam"], answer["bias_vertical"]), (None, None))
        self.assertIsNone(answer["thu"])
        self.assertLess(answer["water"]["greatest_depth"], 15)
        pulses = self.write("deep.csv", "incidence,beam_azimuth,depth,altitude,footprint\n" +
                            2 * "15,90,1,400,0.5\n" + "15,90,15,400,0.5\n")
        survey = self.toml(SENSOR + WIND + "[surface]\nlocated = 'local'\n" + murky)
        query("csv", pulses, self.folder / "deep.out.csv", "--survey", survey, "--table", self.table, check=0)
        last = (self.folder / "deep.out.csv").read_text().splitlines()[-1]
        self.assertTrue(last.endswith(",,,,,NO_WATER"), last)
        wide = self.total(WATER.replace("field_of_view = 6", "field_of_view = 1"), depth=5)
        self.assertEqual(wide["outcome"], "NO_WATER")  # Of 2.5 footprints are 0.8 seen.

    def test_refuses_what_is_no_water(self):
        # tests/annotate/totals/water_column_test.cc has what is missing or contradicts itself.
        for water, code, *parts in ((WATER.replace("0.15", "0.05"), 2, "pure water"),
                                    (WATER + "secchi = 5\n", 2, "several ways"),
                                    (OPTICS + "bias = 'none'\n", 2, "detector, field_of_view (m), pulse_length (ns)")):
            self.assert_refused(self.pulse(water), code, *parts)
        nowhere = {"ALBTPU_WATER_TABLE": str(self.folder / "none.h5")}
        self.assert_fails(self.pulse(WATER, environment=nowhere), 1, "none.h5", "ALBTPU_WATER_TABLE")


if __name__ == "__main__":
    programs.main()
