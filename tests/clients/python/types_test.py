"""mypy accepts the package, and finds misspelt names and wrong types in programs that use it.

Usage: types_test.py PACKAGE_FOLDER
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PACKAGE = pathlib.Path(sys.argv[1])
USER = """import albtpu
service = albtpu.connect("localhost:1")
thu: int = service.query(wind_speed=5, incidence=[1, 2], footprint=0.5, depth=8.0, dpeth=1).thu
service.query(wind_speed=5, incidence=[1, 2], footprint=0.5)
"""


@unittest.skipUnless(shutil.which("mypy"), "mypy is missing; apt-get install mypy")
class Types(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    def check(self, *files):
        return subprocess.run(["mypy", "--config-file", "pyproject.toml", "--cache-dir", self.folder, *files],
                              capture_output=True, text=True, cwd=PACKAGE)

    def test_are_consistent(self):
        result = self.check()
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_find_a_misspelt_name_a_missing_argument_and_a_wrong_type(self):
        user = self.folder / "user.py"
        user.write_text(USER)
        result = self.check(user)
        self.assertIn('Unexpected keyword argument "dpeth" for "query"', result.stdout)
        self.assertIn('Missing named argument "depth" for "query"', result.stdout)
        self.assertIn("Incompatible types in assignment", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
