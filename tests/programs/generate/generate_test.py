"""albtpu-generate as a program: equal bytes, other readers of its tables, and messages for bad input."""

import functools
import json
import math
import pathlib
import sys
import unittest

import h5py
import netCDF4
import numpy

from commands import FolderTest, make_folder, run

GENERATE = sys.argv.pop(1)

CAMPAIGN = """id = "small"
version = "1"
title = "Two seas"
[axes]
wind_speed = [3, 6]
fetch = [5000, inf]
incidence = [0, 20]
azimuth = [0, 90]
footprint = [0.25, 1]
depth = [0, 10]
[effort]
realizations = 40
[interpolation]
checked_pulses = 16
"""
ONE_BEAM = CAMPAIGN  # One cell, where a test asks for any table.
for several, one in (("[3, 6]", "[5]"), ("[5000, inf]", "[inf]"), ("[0, 20]", "[10]"), ("[0, 90]", "[0]"),
                     ("[0.25, 1]", "[0.5]")):
    ONE_BEAM = ONE_BEAM.replace(several, one)
POINT = ["point", "--wind-speed", "7", "--incidence", "12", "--azimuth", "45", "--footprint", "0.6",
         "--depth", "1,5", "--relative-error", "0.2"]


generate = functools.partial(run, GENERATE)


class GenerateTest(FolderTest):
    def refused(self, code, *arguments):
        """The line on standard error."""
        result = generate(*arguments)
        self.assert_refused(result, code)
        return result.stderr


class Table(GenerateTest):
    @classmethod
    def setUpClass(cls):
        """Makes the table of the campaign once."""
        cls.made = make_folder(cls.addClassCleanup) / "small.h5"
        cls.made.with_suffix(".toml").write_text(CAMPAIGN)
        cls.said = generate("table", "--campaign", cls.made.with_suffix(".toml"), "--output", cls.made)
        assert cls.said.returncode == 0, cls.said.stderr

    def setUp(self):
        super().setUp()
        self.campaign = self.write("small.toml", CAMPAIGN)

    def test_knows_what_the_water_column_does_to_one_beam(self):
        beam = ("water-point", "--incidence", "15", "--absorption", "0.108717", "--scattering", "0.279559",
                "--backscatter-fraction", "0.02", "--depth", "7.3", "--pulse-length", "2.2", "--footprint", "0.6",
                "--photons", "100000")
        answers = [json.loads(generate(*beam, "--field-of-view", "5", "--seed", seed, "--json").stdout)
                   for seed in (1, 2)]
        for name, value in answers[0].items():
            if name.endswith("_standard_error"):
                continue
            errors = [answer[name + "_standard_error"] for answer in answers]
            self.assertGreater(min(errors), 0, name)
            self.assertLess(abs(value - answers[1][name]), 4.5 * math.hypot(*errors), name)
        self.assertLess(answers[0]["bias_vertical_centroid"], answers[0]["bias_vertical_peak"])
        self.assertLess(answers[0]["bias_vertical_peak"], 0)
        text = generate(*beam, "--field-of-view", "inf", "--threads", "1")
        self.assertIn("reported minus true", text.stdout)
        self.assertIn("2.5 footprints", self.refused(2, *beam, "--field-of-view", "1.4"))
        deep = [text.replace("7.3", "300") for text in beam]
        self.assertIn("no echo", self.refused(1, *deep, "--field-of-view", "5"))
        long_pulse = [text.replace("2.2", "99.9") for text in beam]
        self.assertIn("no echo to read at 7.3 m", self.refused(2, *long_pulse, "--field-of-view", "5"))
        clear = [text.replace("0.279559", "0") for text in beam]
        self.assertIn("--scattering", self.refused(2, *clear, "--field-of-view", "5"))

    def test_states_its_origin_in_the_table(self):
        with h5py.File(self.made) as data:
            self.assertTrue(numpy.isfinite(data["thu"][...]).all())
            for name in ("id", "version", "title", "source", "references", "campaign", "seed", "realizations", "rays",
                         "program_version", "commit", "instruction_set", "date_created", "coverage",
                         "refractive_index", "beam_profile", "spectrum", "spectrum_departures", "domain", "spacing",
                         "footprint_slope_variance_fraction", "resolved_slope_variance_fraction",
                         "interpolation_error", "content_digest"):
                self.assertIn(name, data.attrs)
            campaign = data.attrs["campaign"]
            self.assertEqual(campaign.decode() if isinstance(campaign, bytes) else campaign, CAMPAIGN)
            low, high = data.attrs["footprint_slope_variance_fraction"]
            self.assertGreater(low, 0.99)
            self.assertLess(high, 1.01)

    def test_traces_the_sea_of_a_file(self):
        sea = self.write("sea.csv", "f,E,r2,alpha2\n0.1,0.2,0.9,290\n0.25,0.3,0.8,225\n0.4,0.05,0.6,225\n")
        beam = ("--incidence", "15", "--footprint", "0.6", "--depth", "10", "--relative-error", "0.05", "--json")
        of_sea = ("point", "--sea", sea, "--wind-speed", "6", "--wind-from", "225")

        def answer(*arguments):
            return json.loads(self.assert_succeeds(generate(*arguments, *beam)))

        along = answer(*of_sea, "--beam-azimuth", "45")
        self.assertAlmostEqual(along["x_azimuth"], 45, 9)
        same = answer(*of_sea, "--azimuth", "0")
        self.assertEqual({**along, "seconds": 0}, {**same, "seconds": 0})
        # The swell crosses: what lies to the right of the wind differs from what lies to its left.
        self.assertNotAlmostEqual(answer(*of_sea, "--azimuth", "60")["tvu"][0],
                                  answer(*of_sea, "--azimuth", "-60")["tvu"][0], 4)
        self.assertLess(answer(*of_sea, "--tail", "none", "--azimuth", "0")["thu"][0], along["thu"][0])
        self.assertEqual(answer("point", "--wind-speed", "0")["thu"], [0])

        self.refused(1, *of_sea, "--sea-time", "2020-06-08T03:50Z", *beam)
        hourly = self.write("hourly.csv", "time,f,E\n" + "".join(f"2020-06-08T0{hour}:50Z,{f},0.2\n"
                                                                for hour in (3, 4) for f in (0.1, 0.2)))
        for time, answer_of_time in (((), "has 2 states of the sea"), (("--sea-time", "yesterday"), "is not a time"),
                                     (("--sea-time", "2020-06-08T04:00Z"), "nearest is that of 2020-06-08T03:50Z")):
            self.assertIn(answer_of_time, self.refused(1, "point", "--sea", hourly, *time, *beam))
        self.refused(1, "point", "--sea", self.folder / "absent.csv", *beam)
        self.refused(2, *of_sea, "--fetch", "1000", *beam)
        self.refused(2, "point", "--wind-speed", "5", "--tail", "wind", *beam)
        self.refused(2, *of_sea, "--azimuth", "0", "--beam-azimuth", "45", *beam)

    def test_replaces_a_file_by_a_fine_table_that_states_its_spectrum(self):
        campaign = self.write("other.toml", ONE_BEAM + '[sea]\nspectrum = "elfouhaily"\ncorrected_above = 30\n')
        there = self.write("there.h5", "precious")
        result = generate("table", "--campaign", campaign, "--output", there, "--overwrite")
        self.assert_succeeds(result)
        self.assertNotIn("coarse", result.stderr)
        with netCDF4.Dataset(there) as data:
            self.assertIn("Elfouhaily", data.spectrum)
            self.assertIn("longer than 30 m", data.spectrum)
            self.assertIn("Cox and Munk", data.spectrum_departures)

    def test_refuses_an_output_that_it_cannot_write_before_computing(self):
        there = self.write("there.h5", "precious")
        for problem, output, *flags in (("--overwrite", there), ("no folder", self.folder / "absent/table.h5"),
                                        ("not writable", "/proc/self/table.h5"),
                                        ("not a regular file", self.folder, "--overwrite")):
            self.assertIn(problem, self.refused(1, "table", "--campaign", self.campaign, "--output", output, *flags))
        self.assertEqual(there.read_text(), "precious")
        self.assertEqual(self.names(), ["small.toml", "there.h5"])

    def test_refuses_bad_campaigns(self):
        for text, expected in ((CAMPAIGN.replace("[0, 20]", "[20, 0]"), "nodes must increase"),
                               (CAMPAIGN.replace("wind_speed", "wind"), "axes.wind"),
                               (CAMPAIGN.replace('"small"', '"My Bay"'), "My Bay"),
                               (CAMPAIGN.replace('version = "1"', 'version = ""'), "version"),
                               (CAMPAIGN.replace("realizations", "realisations"), "did you mean realizations?"),
                               (CAMPAIGN.replace("0.25", "0.0009"), "'axes.footprint' must be at least 0.001"),
                               (CAMPAIGN.replace("[0, 20]", "[0, nan]"), "node 1 of 'axes.incidence' is not a number"),
                               ("\x00\xff", "not TOML"), ("", "missing")):
            self.campaign = self.write("bad.toml", text)
            for command in (("plan",), ("table", "--output", self.folder / "x.h5")):
                self.assertIn(expected, self.refused(1, *command, "--campaign", self.campaign))
        self.assertIn("does not exist", self.refused(1, "plan", "--campaign", self.folder / "absent.toml"))
        self.assertNotIn("x.h5", self.names())

    def test_prints_the_reference_of_keys_that_the_documents_have(self):
        printed = generate("keys")
        self.assertEqual((printed.returncode, printed.stderr), (0, ""))
        page = pathlib.Path(__file__).resolve().parents[3] / "docs/campaign.md"
        self.assertEqual(printed.stdout, page.read_text(), "docs/campaign.md is the output of `albtpu-generate keys`")

    def test_prints_the_interpolation_error_and_warns_of_a_large_one(self):
        with h5py.File(self.made) as data:
            for name in ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu"):
                rms, _, _, _, pulses = data.attrs[f"interpolation_error_{name}"]
                self.assertRegex(self.said.stdout, rf"(?m)^interpolation_error_{name} [\d.]+ % rms, "
                                                   rf"[\d.]+ % at the 99th percentile of {pulses:.0f} pulses$")
                self.assertEqual(rms > 0.02, name in self.said.stderr.partition("the table is coarse")[2])
            self.assertGreater(data.attrs["interpolation_error_thu"][0], 0.02)
        self.assertIn("give its axes more nodes", self.said.stderr)

    def test_plans_a_campaign_for_any_number_of_cores(self):
        plan = self.assert_succeeds(generate("plan", "--campaign", self.campaign))
        self.assertRegex(plan, r"cells +64\n")
        self.assertRegex(plan, r"time of one core +\d+ s")
        self.assertNotIn("so many cores", plan)
        plan = self.assert_succeeds(generate("plan", "--campaign", self.campaign, "--cores", "1000"))
        self.assertRegex(plan, r"on so many cores +1000: 0 s")
        self.assertIn("--cores", self.refused(2, "plan", "--campaign", self.campaign, "--cores", "0"))


class Point(GenerateTest):
    def test_prints_one_json_object(self):
        answer = json.loads(self.assert_succeeds(generate(*POINT, "--json")))
        self.assertEqual(answer["depth"], [1, 5])
        for name in ("thu", "tvu", "bias_along_beam", "bias_vertical"):
            self.assertEqual(len(answer[name]), 2)
            self.assertEqual(len(answer[name + "_standard_error"]), 2)
        for name in ("refraction_along_wind", "refraction_cross_wind"):
            self.assertGreater(answer[name], 0)
            self.assertLessEqual(answer[name + "_standard_error"], 0.2 * answer[name])
        self.assertTrue(math.isclose(answer["thu"][1] / answer["thu"][0], 5, rel_tol=0.05))
        self.assertGreaterEqual(answer["realizations"], 1000)
        self.assertGreater(answer["seconds"], 0)

    def test_takes_infinity_as_the_fully_developed_sea(self):
        absent, infinite = generate(*POINT), generate(*POINT, "--fetch", "inf")
        self.assertEqual(absent.stdout, infinite.stdout)
        self.assertEqual(absent.returncode, 0)

    def test_takes_another_spectrum_and_leaves_out_corrected_waves(self):
        def thu(*flags):
            return json.loads(generate(*POINT, "--json", *flags).stdout)["thu"][0]
        self.assertNotEqual(thu(), thu("--spectrum", "elfouhaily"))
        self.assertEqual(thu(), thu("--spectrum", "apel"))
        self.assertLess(thu("--corrected-above", "1"), 0.5 * thu())

    def test_bad_flags_are_bad_usage(self):
        for flag, value in (("--wind-speed", "nan"), ("--wind-speed", "-1"),
                            ("--incidence", "inf"), ("--incidence", "-3"), ("--incidence", "89"),
                            ("--footprint", "0"), ("--footprint", "0.0009"), ("--depth", "1,-2"), ("--depth", "deep"),
                            ("--fetch", "nan"),
                            ("--fetch", "0"), ("--azimuth", "inf"), ("--profile", "square"),
                            ("--spectrum", "phillips"), ("--corrected-above", "0"), ("--corrected-above", "nan"),
                            ("--relative-error", "0"), ("--seed", "-1"), ("--seed", "18446744073709551616"),
                            ("--refractive-index", "nan"), ("--speed", "3")):
            arguments = list(POINT)
            if flag in arguments:
                at = arguments.index(flag)
                del arguments[at:at + 2]
            self.assertIn(flag, self.refused(2, *arguments, f"{flag}={value}"))

    def test_refuses_beams_at_which_waves_hide_each_other(self):
        beam = ("point", "--wind-speed", "15", "--footprint", "0.6", "--depth", "10", "--incidence")
        said = self.refused(1, *beam, "60")
        for expected in ("60 degrees", "standard deviation of 0.352", "give at most 43.4 degrees"):
            self.assertIn(expected, said)
        self.assert_succeeds(generate(*beam, "43.4", "--relative-error", "0.5"))

    def test_fails_if_standard_output_cannot_be_written(self):
        with open("/dev/full", "w") as full:
            result = generate(*POINT, "--json", stdout=full)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)

    def test_says_what_is_missing_or_misspelt(self):
        for arguments, expected in ((["point", "--wind-speed", "5"], "required"),
                                    (["tabel"], "'tabel' is not a command (commands: table, merge, plan, keys, point, "
                                                "water-point, validate); did you mean table?"),
                                    (["point", "--wind-sped", "3"], "did you mean --wind-speed?"),
                                    ([*POINT, "--profile", "unifrom"], "did you mean uniform?")):
            self.assertIn(expected, self.refused(2, *arguments))


if __name__ == "__main__":
    unittest.main()
