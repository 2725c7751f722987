"""albtpu-generate as a program: equal bytes, other readers of its tables, and messages for bad input."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import netCDF4
import numpy

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
"""
POINT = ["point", "--wind-speed", "7", "--incidence", "12", "--azimuth", "45", "--footprint", "0.6",
         "--depth", "1,5", "--relative-error", "0.2"]


def generate(*arguments, **environment):
    return subprocess.run([GENERATE, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, **environment}, stdin=subprocess.DEVNULL)


class Table(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.campaign = self.path("small.toml", CAMPAIGN)

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w") as file:
                file.write(text)
        return path

    def make(self, name, *flags, **environment):
        result = generate("table", "--campaign", self.campaign, "--output", self.path(name), *flags, **environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.path(name)

    def refused(self, code, *arguments):
        result = generate(*arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"^albtpu-generate: ")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        return result.stderr

    def test_knows_what_the_water_column_does_to_one_beam(self):
        beam = ("water-point", "--incidence", "15", "--absorption", "0.108717", "--scattering", "0.279559",
                "--backscatter-fraction", "0.02", "--depth", "7.3", "--pulse-length", "2.2", "--footprint", "0.6",
                "--photons", "400000")
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
        with h5py.File(self.make("table.h5")) as data:
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
        sea = self.path("sea.csv", "f,E,r2,alpha2\n0.1,0.2,0.9,290\n0.25,0.3,0.8,225\n0.4,0.05,0.6,225\n")
        beam = ("--incidence", "15", "--footprint", "0.6", "--depth", "10", "--relative-error", "0.05", "--json")
        of_sea = ("point", "--sea", sea, "--wind-speed", "6", "--wind-from", "225")

        def answer(*arguments):
            result = generate(*arguments, *beam)
            self.assertEqual(result.returncode, 0, result.stderr)
            return json.loads(result.stdout)

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
        hourly = self.path("hourly.csv", "time,f,E\n" + "".join(f"2020-06-08T0{hour}:50Z,{f},0.2\n"
                                                                for hour in (3, 4) for f in (0.1, 0.2)))
        for time, answer_of_time in (((), "has 2 states of the sea"), (("--sea-time", "yesterday"), "is not a time"),
                                     (("--sea-time", "2020-06-08T04:00Z"), "nearest is that of 2020-06-08T03:50Z")):
            self.assertIn(answer_of_time, self.refused(1, "point", "--sea", hourly, *time, *beam))
        self.refused(1, "point", "--sea", self.path("absent.csv"), *beam)
        self.refused(2, *of_sea, "--fetch", "1000", *beam)
        self.refused(2, "point", "--wind-speed", "5", "--tail", "wind", *beam)
        self.refused(2, *of_sea, "--azimuth", "0", "--beam-azimuth", "45", *beam)

    def test_states_the_spectrum_in_the_table(self):
        self.campaign = self.path("other.toml", CAMPAIGN +
                                  '[sea]\nspectrum = "elfouhaily"\ncorrected_above = 30\n')
        with netCDF4.Dataset(self.make("other.h5")) as data:
            self.assertIn("Elfouhaily", data.spectrum)
            self.assertIn("longer than 30 m", data.spectrum)
            self.assertIn("Cox and Munk", data.spectrum_departures)

    def test_keeps_an_existing_table_without_overwrite(self):
        path = self.path("there.h5", "precious")
        error = self.refused(1, "table", "--campaign", self.campaign, "--output", path)
        self.assertIn("--overwrite", error)
        with open(path) as file:
            self.assertEqual(file.read(), "precious")
        self.make("there.h5", "--overwrite")

    def test_refuses_an_output_in_an_absent_folder_before_computing(self):
        self.assertIn("no folder", self.refused(1, "table", "--campaign", self.campaign, "--output",
                                                self.path("absent/table.h5")))
        self.assertEqual(os.listdir(self.folder), ["small.toml"])

    def test_refuses_an_output_folder_that_is_not_writable_before_computing(self):
        self.assertIn("not writable", self.refused(1, "table", "--campaign", self.campaign, "--output",
                                                   "/proc/self/table.h5"))

    def test_refuses_a_folder_as_output_even_with_overwrite(self):
        self.assertIn("not a regular file", self.refused(1, "table", "--campaign", self.campaign, "--output",
                                                         self.folder, "--overwrite"))

    def test_refuses_bad_campaigns(self):
        for text, expected in ((CAMPAIGN.replace("[0, 20]", "[20, 0]"), "nodes must increase"),
                               (CAMPAIGN.replace("wind_speed", "wind"), "axes.wind"),
                               (CAMPAIGN.replace('"small"', '"My Bay"'), "My Bay"),
                               (CAMPAIGN.replace('version = "1"', 'version = ""'), "version"),
                               ("\x00\xff", "not TOML"), ("", "missing")):
            path = self.path("bad.toml", text)
            self.assertIn(expected, self.refused(1, "table", "--campaign", path, "--output", self.path("x.h5")))
        self.assertIn("does not exist", self.refused(1, "table", "--campaign", self.path("absent.toml"), "--output",
                                              self.path("x.h5")))
        self.assertNotIn("x.h5", os.listdir(self.folder))

    def test_suggests_a_near_key(self):
        path = self.path("bad.toml", CAMPAIGN.replace("realizations", "realisations"))
        self.assertIn("did you mean realizations?", self.refused(1, "plan", "--campaign", path))

    def test_prints_the_reference_of_keys_that_the_documents_have(self):
        printed = generate("keys")
        self.assertEqual((printed.returncode, printed.stderr), (0, ""))
        page = pathlib.Path(__file__).resolve().parents[3] / "docs/campaign.md"
        self.assertEqual(printed.stdout, page.read_text(), "docs/campaign.md is the output of `albtpu-generate keys`")

    def test_prints_the_interpolation_error_and_warns_of_a_large_one(self):
        result = generate("table", "--campaign", self.campaign, "--output", self.path("coarse.h5"))
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.path("coarse.h5")) as data:
            for name in ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu"):
                rms, _, _, _, pulses = data.attrs[f"interpolation_error_{name}"]
                self.assertRegex(result.stdout, rf"(?m)^interpolation_error_{name} [\d.]+ % rms, [\d.]+ % at the 99th "
                                                rf"percentile of {pulses:.0f} pulses$")
                self.assertEqual(rms > 0.02, name in result.stderr.partition("the table is coarse")[2])
            self.assertGreater(data.attrs["interpolation_error_thu"][0], 0.02)
        self.assertIn("give its axes more nodes", result.stderr)

    def test_does_not_warn_of_a_fine_table(self):
        text = CAMPAIGN
        for coarse, one in (("[3, 6]", "[5]"), ("[5000, inf]", "[inf]"), ("[0, 20]", "[10]"), ("[0, 90]", "[0]"),
                            ("[0.25, 1]", "[0.5]")):
            text = text.replace(coarse, one)
        result = generate("table", "--campaign", self.path("fine.toml", text), "--output", self.path("fine.h5"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("coarse", result.stderr)

    def test_plans_a_campaign(self):
        result = generate("plan", "--campaign", self.campaign)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"cells +64\n")
        self.assertRegex(result.stdout, r"time of one core +\d+ s")
        self.assertNotIn("so many cores", result.stdout)

    def test_plans_for_a_given_number_of_cores(self):
        result = generate("plan", "--campaign", self.campaign, "--cores", "1000")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"on so many cores +1000: 0 s")
        self.assertIn("--cores", self.refused(2, "plan", "--campaign", self.campaign, "--cores", "0"))


class Point(unittest.TestCase):
    def test_prints_one_json_object(self):
        result = generate(*POINT, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        answer = json.loads(result.stdout)
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
                            ("--footprint", "0"), ("--depth", "1,-2"), ("--depth", "deep"), ("--fetch", "nan"),
                            ("--fetch", "0"), ("--azimuth", "inf"), ("--profile", "square"),
                            ("--spectrum", "phillips"), ("--corrected-above", "0"), ("--corrected-above", "nan"),
                            ("--relative-error", "0"), ("--seed", "-1"), ("--seed", "18446744073709551616"),
                            ("--refractive-index", "nan"), ("--speed", "3")):
            arguments = list(POINT)
            if flag in arguments:
                at = arguments.index(flag)
                del arguments[at:at + 2]
            result = generate(*arguments, f"{flag}={value}")
            self.assertEqual(result.returncode, 2, (flag, value, result.stderr))
            self.assertEqual(result.stdout, "")
            self.assertRegex(result.stderr, r"^albtpu-generate: ")

    def test_fails_if_standard_output_cannot_be_written(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([GENERATE, *POINT, "--json"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)

    def test_names_what_is_missing(self):
        result = generate("point", "--wind-speed", "5")
        self.assertEqual(result.returncode, 2)
        self.assertIn("required", result.stderr)

    def test_suggests_near_commands_options_and_values(self):
        for arguments, expected in ((["tabel"], "'tabel' is not a command (commands: table, merge, plan, keys, point, "
                                                "water-point, validate); did you mean table?"),
                                    ([*POINT, "--wind-sped", "3"], "did you mean --wind-speed?"),
                                    (["point", "--wind-sped", "3"], "did you mean --wind-speed?"),
                                    ([*POINT, "--profile", "unifrom"], "did you mean uniform?"),
                                    (["--campaign", "a.toml", "plan"], "put it after the command"),
                                    (["merge", "--work", "a", "--output", "b", "--threads", "2"],
                                     "--threads is not an option of albtpu-generate merge")):
            result = generate(*arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertRegex(result.stderr, r"\Aalbtpu-generate: [^\n]+\n\Z")
            self.assertIn(expected, result.stderr)


if __name__ == "__main__":
    unittest.main()
