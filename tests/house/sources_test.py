"""What every file of the tree keeps to.

Usage: sources_test.py SOURCE_FOLDER
"""

import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
CODE = (".h", ".cc", ".py", ".sh", ".proto", ".cmake")
NOT_OURS = ("build", "out", "b", ".git", ".cache", "__pycache__")  # Nor a folder that holds a CMakeCache.txt.
MADE = ("_pb2", "_pb2_grpc")  # By protoc; a test of the Python package holds them to the .proto files.
MOST_LINES = 350
MOST_COLUMNS = 120
# A path that only one machine has; written so that this line is not one.
HOME = re.compile(r"(?<![\w.])/(?:home|root|Users|work)/\w")


def files():
    for folder, subfolders, names in os.walk(SOURCE):
        folder = pathlib.Path(folder)
        subfolders[:] = sorted(name for name in subfolders
                               if name not in NOT_OURS and not (folder / name / "CMakeCache.txt").exists())
        for name in sorted(names):
            yield folder / name, (folder / name).relative_to(SOURCE)


def code():
    return [(path, inside, path.read_text()) for path, inside in files()
            if path.suffix in CODE and not path.stem.endswith(MADE)]


class Sources(unittest.TestCase):
    def test_headers_are_included_once(self):
        for path, inside, text in code():
            if path.suffix == ".h" and not path.stem.endswith("-inl"):  # Those are, once for each instruction set.
                self.assertIn("\n#pragma once\n", "\n" + text, inside)

    def test_headers_say_first_what_they_hold(self):
        for path, inside, text in code():
            if path.suffix == ".h":
                self.assertTrue(text.startswith("// "), f"{inside}: the first line says what this is")

    def test_files_hold_one_idea(self):
        for _, inside, text in code():
            self.assertLessEqual(len(text.splitlines()), MOST_LINES, f"{inside}: split it")

    def test_lines_fit(self):
        for _, inside, text in code():
            longest = max(map(len, text.splitlines()), default=0)
            self.assertLessEqual(longest, MOST_COLUMNS, inside)

    def test_leave_nothing_for_later(self):
        mark = re.compile("TO" + "DO|FIX" + "ME")
        for _, inside, text in code():
            self.assertIsNone(mark.search(text), inside)

    def test_work_on_any_machine(self):
        texts = [(inside, path.read_text()) for path, inside in files()
                 if path.suffix in (*CODE, ".md", ".txt", ".toml", ".json", ".in", "")]
        for inside, text in texts:
            if inside == pathlib.Path(__file__).resolve().relative_to(SOURCE.resolve()):
                continue
            self.assertIsNone(HOME.search(text), f"{inside} names a path of one machine")

    def test_scripts_parse_and_can_be_run(self):
        for script in ("quickstart.sh", "test.sh", ".ci/run"):
            subprocess.run(["bash", "-n", SOURCE / script], check=True)
            self.assertTrue((SOURCE / script).stat().st_mode & 0o111, script)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
