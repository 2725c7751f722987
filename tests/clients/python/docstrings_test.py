"""Runs the examples in docstrings, in the folder of the shipped tables.

Usage: docstrings_test.py TABLES_FOLDER
"""

import doctest
import importlib
import os
import pkgutil
import sys
import unittest

import albtpu


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
    os.chdir(sys.argv[1])
    unittest.main(argv=sys.argv[:1], verbosity=2)
