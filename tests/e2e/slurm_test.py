"""The Slurm jobs of docker/slurm make the same table as a single process.

Usage: slurm_test.py ALBTPU_GENERATE SLURM_SCRIPTS
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import slurm

GENERATE, SCRIPTS = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
CAMPAIGN = (pathlib.Path(__file__).resolve().parents[1] / "generator/six_seas.toml").read_text()
UNITS = 12 + 4  # Sea cases and pulses.


@unittest.skipIf(slurm.MISSING, f"{', '.join(slurm.MISSING)} missing; apt-get install slurm-wlm")
class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shared = tempfile.TemporaryDirectory()
        cls.addClassCleanup(shared.cleanup)
        cls.folder = pathlib.Path(shared.name)
        cls.folder.chmod(0o755)
        (cls.folder / "small.toml").write_text(CAMPAIGN)
        cls.environment = dict(PATH=f"{GENERATE.parent}:/usr/bin:/bin:/usr/sbin:/sbin", SOURCE_DATE_EPOCH="1700000000",
                               OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                               OMPI_MCA_rmaps_base_oversubscribe="1",
                               TSAN_OPTIONS=os.environ.get("TSAN_OPTIONS", ""),
                               # Open MPI leaks memory in plug-ins that are unloaded before the check.
                               ASAN_OPTIONS=os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0")
        subprocess.run([GENERATE, "table", "--campaign", "small.toml", "--output", "one.h5"], check=True,
                       cwd=cls.folder, env=cls.environment, capture_output=True)
        (cls.folder / "slurm").mkdir()
        try:
            cls.slurm = slurm.Slurm(cls.folder / "slurm")
        except slurm.CannotStart as error:
            raise unittest.SkipTest(f"Slurm cannot start here: {error}") from error
        cls.addClassCleanup(cls.slurm.stop)

    def submit(self, *command):
        return self.slurm.run("sbatch", "--parsable", f"--chdir={self.folder}", *command, **self.environment)

    def assert_completed(self, *names):
        ended = self.slurm.wait_for_jobs()
        said = "\n".join(path.read_text() for path in self.folder.glob("slurm-*.out"))
        self.assertEqual({name: ended.get(name) for name in names}, {name: {"COMPLETED"} for name in names}, said)

    def assert_same_table(self, name):
        self.assertTrue((self.folder / name).read_bytes() == (self.folder / "one.h5").read_bytes())

    def test_an_array_and_a_merge_that_depends_on_it(self):
        array = self.submit("--array=0-3", SCRIPTS / "shards.sbatch", "small.toml", "units")
        self.submit(f"--dependency=afterok:{array}", SCRIPTS / "merge.sbatch", "units", "array.h5")
        self.assert_completed("albtpu-shards", "albtpu-merge")
        self.assertEqual(len(list((self.folder / "units").glob("*.unit"))), UNITS)
        self.assert_same_table("array.h5")

    def test_an_array_that_is_submitted_again_computes_only_what_is_missing(self):
        units = self.folder / "again"

        def submit():
            self.submit("--array=0-1", SCRIPTS / "shards.sbatch", "small.toml", units)
            self.assert_completed("albtpu-shards")
            return {unit.name: unit.stat().st_mtime_ns for unit in units.glob("*.unit")}

        made = submit()
        lost = min(made)
        (units / lost).unlink()
        made_again = submit()
        self.assertNotEqual(made_again.pop(lost), made.pop(lost))
        self.assertEqual(made_again, made)

    def test_mpi(self):
        self.submit("--nodes=1", "--ntasks-per-node=2", SCRIPTS / "mpi.sbatch", "small.toml", "mpi.h5")
        self.assert_completed("albtpu-mpi")
        self.assert_same_table("mpi.h5")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
