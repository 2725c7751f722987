"""What every file of the tree keeps to.

Usage: sources_test.py SOURCE_FOLDER
"""

import pathlib
import re
import subprocess
import sys
import unittest

import house

TREE = house.Tree(sys.argv[1])
MOST_COLUMNS = 120
# A path that only one machine has; written so that this line is not one.
HOME = re.compile(r"(?<![\w.])/(?:home|root|Users|work)/\w")


class Sources(unittest.TestCase):
    def test_headers_are_included_once(self):
        for path, text in TREE.code.items():
            if path.endswith(".h") and not path.endswith("-inl.h"):  # Those are, once for each instruction set.
                self.assertIn("\n#pragma once\n", "\n" + text, path)

    def test_headers_say_first_what_they_hold(self):
        for path, text in TREE.code.items():
            if path.endswith(".h"):
                self.assertTrue(text.startswith("// "), f"{path}: the first line says what this is")

    def test_lines_fit(self):
        for inside, text in TREE.code.items():
            longest = max(map(len, text.splitlines()), default=0)
            self.assertLessEqual(longest, MOST_COLUMNS, inside)

    def test_leave_nothing_for_later(self):
        mark = re.compile("TO" + "DO|FIX" + "ME")
        for inside, text in TREE.code.items():
            self.assertIsNone(mark.search(text), inside)

    def test_work_on_any_machine(self):
        suffixes = (*house.CODE, ".md", ".txt", ".toml", ".json", ".in", "")
        for path in (pathlib.PurePath(path) for path in TREE.files):
            if path.suffix in suffixes and path.name != "sources_test.py":
                self.assertIsNone(HOME.search((TREE.root / path).read_text()), f"{path} names a path of one machine")

    def test_scripts_parse_and_can_be_run(self):
        for script in ("quickstart.sh", "test.sh", ".ci/run"):
            subprocess.run(["bash", "-n", TREE.root / script], check=True)
            self.assertTrue((TREE.root / script).stat().st_mode & 0o111, script)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
