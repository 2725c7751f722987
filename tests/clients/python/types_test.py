"""mypy accepts the package, and finds misspelt names and wrong types in its users. Examples in docstrings run.

Usage: types_test.py PACKAGE_FOLDER TABLES_FOLDER
"""

import doctest
import importlib
import os
import pathlib
import pkgutil
import shutil
import sys
import unittest

import albtpu
from commands import make_folder, run

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
        cls.folder = make_folder(cls.addClassCleanup)

    def check(self, *files):
        return run("mypy", "--config-file", "pyproject.toml", "--cache-dir", self.folder, *files, cwd=PACKAGE)

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


def load_tests(loader, tests, pattern):
    for module in pkgutil.iter_modules(albtpu.__path__, "albtpu."):
        found = doctest.DocTestFinder(exclude_empty=True).find(importlib.import_module(module.name))
        if any(test.examples for test in found):
            tests.addTests(doctest.DocTestSuite(module.name))
    return tests


class Docstrings(unittest.TestCase):
    def test_exist_for_all_public_names(self):
        for name in albtpu.__all__:
            thing = getattr(albtpu, name)
            if callable(thing):
                self.assertTrue(thing.__doc__, name)


if __name__ == "__main__":
    os.chdir(sys.argv[2])  # Of which examples in docstrings open tables.
    unittest.main(argv=sys.argv[:1], verbosity=2)
