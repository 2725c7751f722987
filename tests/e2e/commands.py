"""Runs programs in tests, each test in a folder of its own, and checks how the programs end."""

import os
import pathlib
import subprocess
import tempfile
import unittest

PATIENCE = 300  # s; a loaded machine may need many for what usually takes few.


def run(program, *arguments, environment=None, timeout=PATIENCE, **options):
    """The result of a program; `environment` is added to that of the test, `options` are those of subprocess.run."""
    return subprocess.run([str(part) for part in (program, *arguments)], stdin=subprocess.DEVNULL, text=True,
                          timeout=timeout, env={**os.environ, **(environment or {})},
                          **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})


def make_folder(add_cleanup, prefix=None):
    """A folder until the cleanup of a test or of a class."""
    folder = tempfile.TemporaryDirectory(prefix=prefix)
    add_cleanup(folder.cleanup)
    return pathlib.Path(folder.name)


class FolderTest(unittest.TestCase):
    """A test with its own folder."""

    def setUp(self):
        self.folder = make_folder(self.addCleanup)

    def write(self, name, text):
        """Writes a file in the folder atomically; returns its path."""
        new = self.folder / "new"
        new.write_text(text)
        return new.rename(self.folder / name)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_succeeds(self, result):
        """Returns the standard output of a program that ended with success."""
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def assert_refused(self, result, code, *parts):
        """Standard error is one line of the program with each of `parts`, and standard output is empty."""
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\Aalbtpu-\w+: [^\n]+\n\Z")
        for part in parts:
            self.assertIn(part, result.stderr)
