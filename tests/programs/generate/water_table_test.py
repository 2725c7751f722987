"""A table of the water column from outside: threads, shards, ranks, and a run that was interrupted give the same bytes.

Usage: water_table_test.py ALBTPU_GENERATE [MPIRUN]
"""

import functools
import json
import os
import pathlib
import resource
import shutil
import sys
import unittest

from commands import FolderTest, run
from serving import ALLOWANCE

GENERATE = sys.argv[1]
MPIRUN = shutil.which(sys.argv[2]) if sys.argv[2:] else None
SHIPPED = pathlib.Path(__file__).resolve().parents[3] / "generator/campaigns/water.toml"
CAMPAIGN = """
id = "few_waters"
kind = "water_column"
version = "1"
title = "Few waters"
[axes]
backscatter_fraction = [0.0183]
scattering_over_absorption = [2, 6]
incidence = [0, 15]
optical_depth = [0.1, 0.5, 1.5]
field_of_view = [0.1, 0.5, 3]
pulse_length = [0.01, 0.05, 0.3]
[effort]
photons = 4000
[interpolation]
checked_pulses = 3
"""
generate = functools.partial(run, GENERATE, environment={"SOURCE_DATE_EPOCH": "1700000000"})


class WaterTableTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.campaign = self.write("few.toml", CAMPAIGN)

    def make(self, *flags):
        return self.assert_succeeds(generate("table", "--campaign", self.campaign, *flags))

    def table(self, name, *flags):
        said = self.make("--output", self.folder / name, *flags)
        return (self.folder / name).read_bytes(), said

    def test_is_the_same_however_it_is_made(self):
        whole, answer = self.table("whole.h5", "--threads", 1)
        self.assertIn("interpolation_error_bias_vertical_peak", answer)
        self.assertEqual(self.table("threads.h5", "--threads", 2)[0], whole)
        work = self.folder / "work"
        for shard in (0, 1, 2):
            self.make("--work", work, "--shard", f"{shard}/3")
        self.assert_succeeds(generate("merge", "--work", work, "--output", self.folder / "merged.h5"))
        self.assertEqual((self.folder / "merged.h5").read_bytes(), whole)
        for unit in sorted(work.glob("*.unit"))[::2]:
            unit.unlink()
        self.assertEqual(self.table("resumed.h5", "--work", work, "--resume")[0], whole)
        names = {unit.name.split("-")[0] for unit in work.glob("*.unit")}
        self.assertEqual(names, {"water", "pulse"})

    @unittest.skipUnless(MPIRUN, "built without MPI (libopenmpi-dev), or there is no mpirun (openmpi-bin)")
    def test_is_the_same_by_ranks(self):
        # Open MPI leaks memory in libraries that it unloads before AddressSanitizer checks.
        environment = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                       "SOURCE_DATE_EPOCH": "1700000000",
                       "ASAN_OPTIONS": f"{os.environ.get('ASAN_OPTIONS', '')}:detect_leaks=0"}
        self.assert_succeeds(run(MPIRUN, "--oversubscribe", "-n", 2, GENERATE, "table", "--campaign", self.campaign,
                                 "--output", self.folder / "ranks.h5", "--threads", 1, environment=environment))
        self.assertEqual((self.folder / "ranks.h5").read_bytes(), self.table("whole.h5")[0])

    def test_plan_counts_its_cells(self):
        plan = self.assert_succeeds(generate("plan", "--campaign", self.campaign))
        self.assertRegex(plan, r"waters and incidences +4\n")
        self.assertRegex(plan, r"cells +108\n")

    def test_plan_of_many_cases_takes_seconds(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        plan = self.assert_succeeds(generate("plan", "--campaign", SHIPPED))
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 5 * ALLOWANCE)
        self.assertRegex(plan, r"time of one core +\d{3,5} s|time of one core +\d+\.\d h")

    def test_refuses_what_is_no_water(self):
        for old, new, *parts in (
                ("kind = \"water_column\"", "kind = \"water\"", "'kind'", "water_column"),
                ("[0.1, 0.5, 1.5]", "[0, 1]", "axes.optical_depth", "0.01"),
                ("[0.1, 0.5, 1.5]", "[0.1, 50]", "axes.optical_depth", "above 8"),
                ("[0, 15]", "[0, 80]", "axes.incidence", "above 50"),
                ("[0, 15]", "[5, 15]", "axes.incidence", "is 5 degrees", "begins at 0"),
                ("[0.01, 0.05, 0.3]", "[0]", "axes.pulse_length"),
                ("[2, 6]", "[6, 2]", "scattering_over_absorption"),
                ("photons = 4000", "photons = 1", "effort.photons"),
                ("[effort]", "[beam]\nprofile = \"gaussian\"\n[effort]", "'beam' is no key")):
            self.campaign.write_text(CAMPAIGN.replace(old, new))
            self.assert_refused(generate("table", "--campaign", self.campaign, "--output", self.folder / "no.h5"), 1,
                                *parts)
            self.assertFalse((self.folder / "no.h5").exists())

    def test_point_takes_an_attenuation_and_an_albedo(self):
        beam = ("--depth", 7.3, "--incidence", 15, "--field-of-view", 5, "--pulse-length", 2.2, "--footprint", 0.6,
                "--backscatter-fraction", 0.02, "--photons", 16000, "--json")
        # K = sqrt(a^2 + 6 B a b), an albedo of 0.72.
        a, b = 0.108717, 0.279559
        by_kd = generate("water-point", *beam, "--kd", (a * a + 0.12 * a * b)**0.5, "--omega0", b / (a + b))
        direct = generate("water-point", *beam, "--absorption", a, "--scattering", b)
        of_kd = json.loads(self.assert_succeeds(by_kd))
        for name, value in json.loads(direct.stdout).items():
            self.assertAlmostEqual(of_kd[name], value, delta=1e-4 + 1e-3 * abs(value))
        for flags in (("--kd", 0.1), ("--absorption", 0.1), ("--kd", 0.1, "--omega0", 0.8, "--absorption", 0.1), ()):
            self.assert_refused(generate("water-point", *beam, *flags), 2, "two numbers")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
