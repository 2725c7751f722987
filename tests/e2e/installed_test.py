"""The programs that `cmake --install` puts under a prefix run from there and find their tables there.

Usage: installed_test.py CMAKE BUILD_FOLDER
"""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import unittest

from commands import make_folder
from serving import Server

CMAKE, BUILD = sys.argv[1:3]
PROGRAMS = ("albtpu-generate", "albtpu-serve", "albtpu-query")
PULSE = ("--wind-speed", "6", "--incidence", "12.5", "--azimuth", "0", "--footprint", "0.7", "--depth", "5")
# The environment of the test must not help the programs to find their files.
CLEAN = {name: value for name, value in os.environ.items()
         if name not in ("LD_LIBRARY_PATH", "ALBTPU_SENSORS", "ALBTPU_TABLES")}


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.prefix = make_folder(cls.addClassCleanup, "albtpu installed ")
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", cls.prefix], check=True, capture_output=True)

    def run_program(self, name, *arguments):
        result = subprocess.run([self.prefix / "bin" / name, *arguments], env=CLEAN, capture_output=True,
                                text=True, cwd="/")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_programs_print_their_version(self):
        for name in PROGRAMS:
            stated = self.run_program(name, "--version")
            self.assertRegex(stated, rf"\A{name} \d+\.\d+\.\d+\S*\ncommit \S+\n")
            if name != "albtpu-generate":
                self.assertRegex(stated, r"\ntable survey [0-9a-f]{64}\n")

    def test_programs_do_not_refer_to_the_build_folder(self):
        for name in PROGRAMS:
            dynamic = subprocess.run(["readelf", "-d", self.prefix / "bin" / name], check=True,
                                     capture_output=True, text=True).stdout
            self.assertNotRegex(dynamic, r"\((RPATH|RUNPATH)\)")

    def test_published_numbers_answer_by_name_and_are_not_the_default(self):
        published = ("--table-name", "birkebak2018_measured", "--wind-speed", "5.25", "--incidence", "20",
                     "--azimuth", "0", "--footprint", "0.25", "--depth", "10", "--water-index", "1.33", "--coverage",
                     "2sigma", "--json")
        pulse = json.loads(self.run_program("albtpu-query", "pulse", *published))
        self.assertEqual(pulse["outcome"], "INTERPOLATED")
        self.assertAlmostEqual(pulse["refraction_along_wind"], 4.58, places=5)  # Table 4 of the paper
        self.assertAlmostEqual(pulse["thu"], 1.05, delta=0.01)  # Table 5 of the paper
        self.assertAlmostEqual(pulse["tvu"], 0.27, delta=0.01)
        self.assertIsNone(pulse["bias_vertical"])  # The paper gives none.
        unnamed = json.loads(self.run_program("albtpu-query", "pulse", *PULSE, "--json"))
        self.assertNotIn("birkebak2018", unnamed["table"])

    def test_the_client_knows_the_installed_sensors(self):
        sensors = json.loads(self.run_program("albtpu-query", "sensors", "--json"))["sensors"]
        shipped = pathlib.Path(__file__).resolve().parents[2] / "config/sensors/shipped"
        self.assertEqual([sensor["name"] for sensor in sensors], sorted(path.stem for path in shipped.glob("*.toml")))

    def test_the_client_finds_the_installed_table_of_the_water_column(self):
        survey = make_folder(self.addCleanup) / "survey.toml"
        survey.write_text("[sensor]\nname = 'riegl-vq-880-g'\n[surface]\nlocated = 'local'\n"
                          "[water]\njerlov = '1C'\ndetector = 'half'\nfield_of_view = 3\n"
                          "pulse_length = 1.5\nbias = 'correct'\n[datum]\nsigma = 0\n")
        pulse = json.loads(self.run_program("albtpu-query", "pulse", *PULSE, "--survey", survey, "--altitude", "400",
                                            "--json"))
        self.assertGreater(pulse["tvu_water"], 0)

    def test_the_service_serves_the_installed_tables(self):
        inside = json.loads(self.run_program("albtpu-query", "pulse", *PULSE, "--json"))
        self.assertEqual(inside["outcome"], "INTERPOLATED")
        server = Server(self.prefix / "bin/albtpu-serve", environment={"ALBTPU_TABLES": ""})
        with server:
            asked = self.run_program("albtpu-query", "pulse", *PULSE, "--json", "--server", server.address)
            self.assertEqual(json.loads(asked), inside)
            self.assertEqual(server.stop(signal.SIGTERM), 0)

    def test_the_generator_plans_an_installed_campaign(self):
        campaigns = sorted((self.prefix / "share/albtpu/campaigns").glob("*.toml"))
        self.assertEqual([path.stem for path in campaigns], ["paper", "quick", "survey", "survey_apel", "water"])
        self.assertTrue(self.run_program("albtpu-generate", "plan", "--campaign", campaigns[1]))

    def test_licence_documents_and_protos_are_installed(self):
        for name in ("doc/albtpu/LICENSE", "doc/albtpu/README.md", "doc/albtpu/docs/beam_and_sea.svg",
                     "doc/albtpu/tables/FORMAT.md", "albtpu/proto/albtpu/v1/uncertainty_service.proto"):
            self.assertTrue((self.prefix / "share" / name).is_file(), name)

    def test_documents_link_only_to_installed_files(self):
        documents = self.prefix / "share/doc/albtpu"
        for page in documents.rglob("*.md"):
            for link in re.findall(r"\]\(([\w./-]+)\)", page.read_text()):
                if link.endswith((".md", ".svg")) or link == "LICENSE":
                    self.assertTrue((page.parent / link).exists(), f"{page.relative_to(documents)}: {link}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
