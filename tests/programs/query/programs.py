"""Runs the real programs in tests: albtpu-query and what it needs.

Their paths are the arguments of the test script, NAME=PATH.
"""

import contextlib
import functools
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "e2e"))
from commands import FolderTest, run  # noqa: E402
from serving import Server  # noqa: E402

PATHS = dict(argument.split("=", 1) for argument in sys.argv[1:])
FLAGS = ("--scanner", "across-track", "--water-level", 0, "--wind-speed", 6, "--footprint", 0.6)  # For a made flight.


def query(*arguments, check=None, **keywords):
    """Runs albtpu-query. Fails if `check` is given and is not its exit code."""
    result = run(PATHS["query"], *arguments, **keywords)
    if check is not None and result.returncode != check:
        raise AssertionError(f"albtpu-query {arguments} exited {result.returncode}: {result.stderr}")
    return result


@functools.cache  # The tests of a script often begin with the same files.
def written_by(program, options):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "made"
        subprocess.run([PATHS[program], path, *options], check=True)
        return path.read_bytes()


def make(path, program, options):
    new = path.with_suffix(".new")
    new.write_bytes(written_by(program, tuple(map(str, options))))
    return new.rename(path)


def make_table(path, *options):
    return make(path, "synthetic_table", options)


def make_flight(path, *options):
    return make(path, "simulated_flight", options)


def laz_copy(source, target, *flags):
    """The LAS or LAZ file `source` as the other kind, or of other chunks."""
    subprocess.run([PATHS["laz_copy"], source, target, *map(str, flags)], check=True)
    return target


@contextlib.contextmanager
def server(folder):
    """A server for the tables in `folder` on a free port; yields HOST:PORT."""
    with Server(PATHS["serve"], "--tables", folder) as running:
        yield running.address


class Test(FolderTest):
    """A test with its own folder and a table in it, `table`."""

    def setUp(self):
        super().setUp()
        self.table = make_table(self.folder / "quick.h5")

    def toml(self, text, name="survey.toml"):
        return self.write(name, text)

    def assert_fails(self, result, code, *parts):
        """Checks for one clear message at the end of standard error, and nothing on standard output."""
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        last = result.stderr.rstrip("\n").split("\n")[-1]
        self.assertTrue(last.startswith("albtpu-query: "), result.stderr)
        self.assertRegex(last, r"\Aalbtpu-query: .+(: |; ).+")  # The problem, and what to do.
        for part in parts:
            self.assertIn(part, last)


def main():
    unittest.main(argv=sys.argv[:1], verbosity=2)
