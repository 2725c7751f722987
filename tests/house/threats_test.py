"""Every threat in SECURITY.md has tests that show its defence, and these tests exist.

A test is named as CTest names it, as GoogleTest does (Suite.Test), or by its script and class (script.Class).

Usage: threats_test.py SOURCE BUILD CTEST
"""

import json
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE, BUILD, CTEST = pathlib.Path(sys.argv[1]).resolve(), *sys.argv[2:4]


def threats():
    """[(who, what they may try to, names of tests)]"""
    text = (SOURCE / "SECURITY.md").read_text().partition("\n## Threats and defences\n")[2].partition("\n## ")[0]
    rows = [re.split(r"\s*\|\s*", line.strip("| ")) for line in text.splitlines() if line.startswith("|")]
    return [(row[0], row[1], re.findall(r"`([^`]+)`", row[-1])) for row in rows[2:]]


def tests_of_ctest():
    """The names of tests, and the scripts that they run."""
    listed = subprocess.run([CTEST, "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True,
                            check=True).stdout
    tests = json.loads(listed)["tests"]
    scripts = {pathlib.Path(word) for test in tests for word in test.get("command", []) if word.endswith(".py")}
    return {test["name"] for test in tests}, {path.stem: path for path in scripts}


class Threats(unittest.TestCase):
    def test_have_tests_that_exist(self):
        names, scripts = tests_of_ctest()
        for path in (SOURCE / "tests").rglob("*.cc"):
            found = re.findall(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", path.read_text(), re.MULTILINE)
            names |= {f"{suite}.{test}" for suite, test in found}
        for stem, path in scripts.items():
            names |= {f"{stem}.{each}" for each in re.findall(r"^class (\w+)\(", path.read_text(), re.MULTILINE)}
        self.assertGreater(len(threats()), 10)
        for who, what, tests in threats():
            with self.subTest(who=who, what=what):
                self.assertTrue(tests, "name a test")
                self.assertEqual(set(tests) - names, set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
