"""pip installs the package from its folder, and the installed package works.

Usage: install_test.py PACKAGE_FOLDER TABLE.h5 VERSION
"""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from commands import make_folder

PACKAGE, TABLE, VERSION = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
QUERY = """import albtpu, sys, albtpu.v1.uncertainty_service_pb2_grpc
print(albtpu.__file__)
print(albtpu.open_table(sys.argv[1]).query(wind_speed=5, incidence=10, footprint=0.5, depth=8).outcome)
"""
OPEN = """import albtpu, sys
albtpu.open_table(sys.argv[1]).query(wind_speed=5, incidence=10, footprint=0.5, depth=8)
print("grpc" in sys.modules, "xarray" in sys.modules)
"""
XARRAY = """import sys, xarray
table = xarray.open_dataset(sys.argv[1])
xarray.testing.assert_identical(table, xarray.open_dataset(sys.argv[1], engine="netcdf4").load())
print(xarray.backends.list_engines()["albtpu"].description, table.thu.attrs["units"], "albtpu" in sys.modules)
"""
MISSING = """import sys
sys.modules[sys.argv[2]] = None
import albtpu
try:
    getattr(albtpu, sys.argv[3])
except ImportError as error:
    print(error)
"""
NETCDF4 = """import sys, xarray
print(xarray.open_dataset(sys.argv[1], engine="netcdf4").thu.attrs["units"])
xarray.open_dataset(sys.argv[1])
"""


@unittest.skipUnless(importlib.util.find_spec("pip") and importlib.util.find_spec("setuptools"),
                     "pip or setuptools is missing; apt-get install python3-pip python3-setuptools")
class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = make_folder(cls.addClassCleanup)
        source = cls.folder / "source"  # The build writes into the source folder.
        shutil.copytree(PACKAGE, source, ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        result = subprocess.run(
            [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index",
             "--target", cls.folder / "site", source], capture_output=True, text=True, env=environment)
        assert result.returncode == 0, result.stdout + result.stderr
        cls.environment = {**environment, "PYTHONPATH": str(cls.folder / "site")}

    def run_python(self, program, path=TABLE, arguments=()):
        result = subprocess.run([sys.executable, "-c", program, path.resolve(), *arguments], capture_output=True,
                                text=True, cwd="/", env=self.environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_answers_from_the_installed_files(self):
        where, outcome = self.run_python(QUERY).splitlines()
        self.assertTrue(pathlib.Path(where).is_relative_to(self.folder / "site"), where)
        self.assertEqual(outcome, "INTERPOLATED")

    def test_reads_files_without_grpc_and_xarray(self):
        self.assertEqual(self.run_python(OPEN), "False False\n")

    def test_names_what_pip_installs_for_a_function(self):
        for module, name, extra in (("grpc", "connect", "client"), ("h5py", "open_table", "tables")):
            self.assertEqual(self.run_python(MISSING, arguments=(module, name)),
                             f"albtpu.{name} needs {module}, which is missing; pip install 'albtpu[{extra}]'\n")

    def test_lets_xarray_open_tables_without_naming_an_engine(self):
        renamed = shutil.copy(TABLE, self.folder / "table.dat")
        for path in (TABLE, renamed):
            self.assertEqual(self.run_python(XARRAY, path),
                             "Open table files of albtpu, after checking their seal m True\n")

    def test_is_not_needed_by_xarray_with_the_engine_netcdf4(self):
        environment = {name: value for name, value in self.environment.items() if name != "PYTHONPATH"}
        result = subprocess.run([sys.executable, "-c", NETCDF4, TABLE.resolve()], capture_output=True, text=True,
                                cwd="/", env=environment)
        self.assertEqual(result.stdout, "m\n")
        self.assertIn("did not find a match", result.stderr)  # Without the engine, xarray does not know the file.

    def test_installs_type_hints_and_its_version(self):
        package = self.folder / "site/albtpu"
        self.assertTrue((package / "py.typed").is_file())
        self.assertTrue((package / "v1/uncertainty_pb2.pyi").is_file())
        metadata = next((self.folder / "site").glob("albtpu-*.dist-info/METADATA")).read_text()
        # As PEP 440 writes it: 1.0.0rc1.
        self.assertIn(f"\nVersion: {VERSION.replace('-', '')}\n", metadata)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
