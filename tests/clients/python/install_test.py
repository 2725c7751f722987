"""pip installs the package from its folder, and it runs from where it was installed.

Usage: install_test.py PACKAGE_FOLDER TABLE.h5
"""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PACKAGE, TABLE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
ASK = """import albtpu, sys, albtpu.v1.uncertainty_service_pb2_grpc
print(albtpu.__file__)
print(albtpu.open_table(sys.argv[1]).query(wind_speed=5, incidence=10, footprint=0.5, depth=8).outcome)
"""
LIGHT = """import albtpu, sys
albtpu.open_table(sys.argv[1]).query(wind_speed=5, incidence=10, footprint=0.5, depth=8)
print("grpc" in sys.modules)
"""


@unittest.skipUnless(importlib.util.find_spec("pip") and importlib.util.find_spec("setuptools"),
                     "there is no pip, or no setuptools")
class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        source = cls.folder / "source"  # Building leaves files behind.
        shutil.copytree(PACKAGE, source, ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        result = subprocess.run(
            [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index",
             "--target", cls.folder / "site", source], capture_output=True, text=True, env=environment)
        assert result.returncode == 0, result.stdout + result.stderr
        cls.environment = {**environment, "PYTHONPATH": str(cls.folder / "site")}

    def run_python(self, program):
        return subprocess.run([sys.executable, "-c", program, TABLE.resolve()], check=True,
                              capture_output=True, text=True, cwd="/", env=self.environment).stdout

    def test_answers_from_there(self):
        where, outcome = self.run_python(ASK).splitlines()
        self.assertTrue(pathlib.Path(where).is_relative_to(self.folder / "site"), where)
        self.assertEqual(outcome, "INTERPOLATED")

    def test_reads_files_without_grpc(self):
        self.assertEqual(self.run_python(LIGHT), "False\n")

    def test_brings_type_hints_and_its_version(self):
        package = self.folder / "site/albtpu"
        self.assertTrue((package / "py.typed").is_file())
        self.assertTrue((package / "v1/uncertainty_pb2.pyi").is_file())
        metadata = next((self.folder / "site").glob("albtpu-*.dist-info/METADATA")).read_text()
        self.assertIn("\nVersion: 0.1.0\n", metadata)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
