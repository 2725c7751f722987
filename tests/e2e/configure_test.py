"""Which optional parts are built does not depend on what an earlier configuration of the build folder found.

Usage: configure_test.py CMAKE SOURCE_FOLDER C_COMPILER CXX_COMPILER
"""

import pathlib
import re
import subprocess
import sys
import unittest

from commands import make_folder, run

CMAKE, SOURCE, C_COMPILER, CXX_COMPILER = sys.argv[1:5]
# CMake takes a package for missing while one of these is ON.
HIDDEN = ("CMAKE_DISABLE_FIND_PACKAGE_benchmark", "CMAKE_DISABLE_FIND_PACKAGE_MPI")
MISSING = """\
not built: MPI ranks of albtpu-generate (MPI is missing); apt-get install libopenmpi-dev
not built: benchmarks and peers_test (Google Benchmark is missing); apt-get install libbenchmark-dev
"""


class Configuration(unittest.TestCase):
    def setUp(self):
        self.folder = make_folder(self.addCleanup, "albtpu configured ")

    def configure(self, name, *flags):
        return run(CMAKE, "-S", SOURCE, "-B", self.folder / name, "-GNinja", f"-DCMAKE_C_COMPILER={C_COMPILER}",
                   f"-DCMAKE_CXX_COMPILER={CXX_COMPILER}", *flags, stderr=subprocess.STDOUT)

    def not_built(self, name, *flags):
        configured = self.configure(name, *flags)
        self.assertEqual(configured.returncode, 0, configured.stdout)
        return (self.folder / name / "not_built.txt").read_text()

    def test_builds_what_was_missing_at_first(self):
        self.assertEqual(self.not_built("build", *(f"-D{name}=ON" for name in HIDDEN)), MISSING)
        self.assertEqual(self.not_built("build", *(f"-U{name}" for name in HIDDEN)), self.not_built("another"))

    def test_leaves_out_what_is_off_and_insists_on_what_is_on(self):
        off = self.not_built("build", "-DALBTPU_MPI=OFF", "-DALBTPU_BENCH=OFF")
        self.assertIn("not built: benchmarks and peers_test (ALBTPU_BENCH is OFF); -DALBTPU_BENCH=AUTO\n", off)
        self.assertIn("(ALBTPU_MPI is OFF)", off)
        insisted = self.configure("build", "-DALBTPU_BENCH=ON", f"-D{HIDDEN[0]}=ON")
        self.assertNotEqual(insisted.returncode, 0)
        self.assertIn("ALBTPU_BENCH is ON, but Google Benchmark is missing", insisted.stdout)

    def commit(self, *, archived=None, stated="unknown"):
        """The commit that a build of sources outside of git names."""
        source = self.folder / "source"
        (source / "cmake").mkdir(parents=True, exist_ok=True)
        if archived is not None:
            (source / "cmake/commit.txt").write_text(archived)
        output = self.folder / "version.cc"
        subprocess.run([CMAKE, f"-DSOURCE_DIR={source}", "-DVERSION=1", f"-DCOMMIT={stated}", f"-DOUTPUT={output}",
                        f"-DTEMPLATE={SOURCE}/cmake/version.cc.in", "-P", f"{SOURCE}/cmake/write_version.cmake"],
                       check=True)
        return re.search(r'Commit\(\) { return "(.*)"', output.read_text())[1]

    def test_names_the_commit_of_an_archive(self):
        self.assertEqual(self.commit(), "unknown")
        unfilled = pathlib.Path(SOURCE, "cmake/commit.txt").read_text()
        self.assertEqual(self.commit(archived=unfilled), "unknown" if unfilled.startswith("$") else unfilled[:12])
        self.assertEqual(self.commit(archived="0123456789abcdef" * 2 + "\n"), "0123456789ab")
        self.assertEqual(self.commit(archived="0123456789abcdef\n", stated="abc"), "abc")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
