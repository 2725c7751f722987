"""One table made by threads, ranks, shards, and runs that were killed and resumed; and what these refuse.

Usage: scale_out_test.py ALBTPU_GENERATE [MPIRUN], without MPIRUN for a build without MPI
"""

import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from commands import PATIENCE, FolderTest

GENERATE = sys.argv[1]
MPIRUN = shutil.which(sys.argv[2]) if sys.argv[2:] else None

CAMPAIGN = (pathlib.Path(__file__).resolve().parents[2] / "generator/six_seas.toml").read_text()
CAMPAIGN = CAMPAIGN.replace("realizations = 40", "realizations = 20")  # Bytes are compared, not the sea.
UNITS = 12 + 4  # encounters and pulses

ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMI", "SLURM_"))}
ENVIRONMENT |= {"SOURCE_DATE_EPOCH": "1700000000", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def run(*command, **options):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, env=ENVIRONMENT,
                          stdin=subprocess.DEVNULL, timeout=PATIENCE, **options)


# Prefix of commands that start MPI: Open MPI leaks memory in libraries that it unloads before AddressSanitizer checks.
LEAKING = "env", f"ASAN_OPTIONS={os.environ.get('ASAN_OPTIONS', '')}:detect_leaks=0"


def ranks(count):
    return *LEAKING, MPIRUN, "--oversubscribe", "-n", count


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError("the condition was not met in time")
        time.sleep(0.002)


SHARED = tempfile.TemporaryDirectory()
SMALL = pathlib.Path(SHARED.name, "small.toml")
WHOLE = pathlib.Path(SHARED.name, "whole")  # A work folder with all units; copied, not changed.
TABLES, ANSWERS = [], []  # of one thread, and of two


def setUpModule():
    """Makes the table of one thread, with which all others are compared, and that of two with a work folder."""
    unittest.addModuleCleanup(SHARED.cleanup)
    SMALL.write_text(CAMPAIGN)
    for threads, flags in ((1, ()), (2, ("--work", WHOLE))):
        path = pathlib.Path(SHARED.name, f"{threads}.h5")
        made = run(GENERATE, "table", "--campaign", SMALL, "--output", path, "--threads", threads, *flags)
        assert made.returncode == 0, made.stderr
        TABLES.append(path.read_bytes())
        ANSWERS.append(made.stdout)


class ScaleOut(FolderTest):
    def setUp(self):
        super().setUp()
        self.work = self.folder / "work"
        self.output = self.folder / "table.h5"
        self.make = (GENERATE, "table", "--campaign", SMALL, "--output", self.output)
        self.merge = (GENERATE, "merge", "--work", self.work, "--output", self.output)

    def shard(self, part):
        return GENERATE, "table", "--campaign", SMALL, "--work", self.work, "--shard", part

    def units(self):
        return sorted(self.work.glob("*.unit"))

    def bytes_in_work(self):
        return {path.name: path.read_bytes() for path in self.work.iterdir()}

    def succeeds(self, *command):
        return self.assert_succeeds(run(*command))

    def refused(self, *command, code=1, **options):
        result = run(*command, **options)
        # Without what MPI prints where there is no /sys, and without the progress of a slow run.
        result.stderr = re.sub(r"^(\[hwloc/|albtpu-generate: units of ).*\n", "", result.stderr, flags=re.MULTILINE)
        self.assert_refused(result, code)
        return result.stderr

    def assert_the_table(self):
        self.assertTrue(self.output.read_bytes() == TABLES[0], "not the same bytes as from one thread")

    def start_and_wait_for_units(self, count, *command):
        process = subprocess.Popen([str(part) for part in command], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        wait_until(lambda: process.poll() is not None or len(self.units()) >= count)
        return process


class SameBytes(ScaleOut):
    def test_from_two_threads_and_with_a_work_folder(self):
        self.assertTrue(TABLES[0] == TABLES[1])
        self.assertEqual(ANSWERS[0], ANSWERS[1])

    def test_from_four_shards_and_a_merge(self):
        for shard in range(4):
            self.succeeds(*self.shard(f"{shard}/4"))
            self.assertEqual(len(self.units()), (shard + 1) * UNITS // 4)
        self.assertEqual(self.succeeds(*self.merge), ANSWERS[0])
        self.assert_the_table()

    def test_from_a_run_that_was_killed_and_resumed(self):
        process = self.start_and_wait_for_units(2, *self.make, "--work", self.work, "--threads", 1)
        process.kill()
        process.communicate()
        self.assertEqual(process.returncode, -signal.SIGKILL)
        self.assertLess(len(self.units()), UNITS)
        self.assertFalse(self.output.exists())
        left = self.bytes_in_work()
        (self.work / ".albtpu-1-0.tmp").write_bytes(b"half a unit")
        self.assertEqual(self.succeeds(*self.make, "--work", self.work, "--resume"), ANSWERS[0])
        self.assert_the_table()
        self.assertEqual(len(self.units()), UNITS)
        now = self.bytes_in_work()
        self.assertTrue(all(now[name] == content for name, content in left.items() if not name.endswith(".tmp")))
        self.assertFalse([name for name in now if name.endswith(".tmp")])

    def test_from_one_process_that_continues_after_a_shard(self):
        self.succeeds(*self.shard("3/8"))
        self.succeeds(*self.make, "--work", self.work, "--resume")
        self.assert_the_table()


@unittest.skipUnless(MPIRUN, "built without MPI (libopenmpi-dev), or there is no mpirun (openmpi-bin)")
class Ranks(ScaleOut):
    def test_make_the_same_bytes(self):
        # Open MPI 5 mixes the warnings of ranks into their answers.
        quiet = ("sh", "-c", 'exec "$@" 2>/dev/null', "sh")
        self.assertEqual(self.succeeds(*ranks(2), *quiet, *self.make, "--threads", 1), ANSWERS[0])
        self.assert_the_table()

    def test_make_the_same_bytes_through_a_work_folder(self):
        self.succeeds(*ranks(3), *self.make, "--threads", 2, "--work", self.work)
        self.assert_the_table()
        self.assertEqual(len(self.units()), UNITS)

    def test_resume_a_killed_run(self):
        process = self.start_and_wait_for_units(2, *ranks(2), *self.make, "--threads", 1, "--work", self.work)
        started = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        victim = max(int(pid) for pid in started)  # rank 0 or 1; the end of either ends all
        os.kill(victim, signal.SIGKILL)
        process.communicate(timeout=PATIENCE)
        self.assertNotEqual(process.returncode, 0)
        self.assertFalse(self.output.exists())
        self.assertLess(len(self.units()), UNITS)
        self.succeeds(*ranks(2), *self.make, "--threads", 1, "--work", self.work, "--resume")
        self.assert_the_table()

    def test_end_together_if_one_fails(self):
        process = self.start_and_wait_for_units(1, *ranks(2), *self.make, "--threads", 1, "--work", self.work)
        self.work.rename(self.folder / "elsewhere")
        _, error = process.communicate(timeout=PATIENCE)
        self.assertNotEqual(process.returncode, 0)
        self.assertRegex(error, r"albtpu-generate: rank 0: .*\(no output was written\)")
        self.assertFalse(self.output.exists())

    def test_end_together_without_a_campaign(self):
        result = run(*ranks(2), GENERATE, "table", "--campaign", self.folder / "absent.toml", "--output", self.output)
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count("absent.toml"), 1)

    def test_refuse_the_launcher_of_another_mpi(self):
        self.assertIn("one of 2 ranks", self.refused(*LEAKING, "PMI_SIZE=2", *self.make))


class Refusals(ScaleOut):
    def copy(self):
        shutil.copytree(WHOLE, self.work)

    def assert_refused_and_untouched(self, *expected):
        there = self.bytes_in_work()
        for command in ((*self.make, "--work", self.work, "--resume"),
                        (*self.shard("1/2"), "--resume"),
                        self.merge):
            error = self.refused(*command)
            for text in expected:
                self.assertIn(text, error)
        self.assertEqual(self.bytes_in_work(), there)
        self.assertFalse(self.output.exists())

    def test_of_units_without_resume(self):
        self.copy()
        self.assertIn("--resume", self.refused(*self.make, "--work", self.work))
        self.assertIn("--resume", self.refused(*self.shard("1/2")))

    def test_of_damaged_units(self):
        self.copy()
        unit = self.work / "encounter-00007.unit"
        whole = unit.read_bytes()
        flipped = bytearray(whole)
        flipped[len(whole) // 2] ^= 1
        for damaged in (bytes(flipped), whole[:-1], whole[:100], b"", whole + b"\0"):
            unit.write_bytes(damaged)
            self.assert_refused_and_untouched("encounter-00007.unit: is ", "delete it")
        unit.unlink()
        self.succeeds(*self.make, "--work", self.work, "--resume")
        self.assert_the_table()

    def test_of_a_merge_of_missing_units(self):
        self.copy()
        (self.work / "encounter-00003.unit").unlink()
        error = self.refused(*self.merge)
        self.assertIn(f"{UNITS - 1} of {UNITS} units, encounter-00003", error)

    def test_of_a_merge_over_a_table(self):
        self.output.write_text("precious")
        merge = (GENERATE, "merge", "--work", WHOLE, "--output", self.output)
        self.assertIn("--overwrite", self.refused(*merge))
        self.assertEqual(self.output.read_text(), "precious")
        self.succeeds(*merge, "--overwrite")
        self.assert_the_table()

    def test_of_a_merge_without_a_work_folder(self):
        self.assertIn("absent", self.refused(GENERATE, "merge", "--work", self.folder / "absent", "--output",
                                             self.output))

    def test_of_flags_that_contradict_each_other(self):
        table = (GENERATE, "table", "--campaign", SMALL)
        for flags, expected in ((("--work", self.work), "--output"), (("--shard", "0/2"), "--work"),
                                (("--output", self.output, "--resume"), "--work"),
                                (("--output", self.output, "--work", self.work, "--shard", "0/2"), "--shard"),
                                (("--work", self.work, "--shard", "2/2"), "i/N"),
                                (("--work", self.work, "--shard=-1/2"), "i/N"),
                                (("--work", self.work, "--shard", "1"), "i/N"),
                                (("--work", self.work, "--shard", "1/2x"), "i/N")):
            self.assertIn(expected, self.refused(*table, *flags, code=2))
        self.assertFalse(self.work.exists())


class FullDisk(ScaleOut):
    def assert_goes_on_after(self, error):
        self.assertRegex(error, r"/encounter-\d+\.unit: .* \(no output was written\)")
        self.assertIn("--resume", error)
        self.assertFalse(self.output.exists())
        self.assertLess(len(self.units()), UNITS)
        self.assertFalse(list(self.work.glob(".*.tmp")))

    def test_is_reported_and_leaves_whole_units(self):
        self.work.mkdir()
        small = run("mount", "-t", "tmpfs", "-o", "size=32k", "none", self.work)
        if small.returncode != 0:
            self.skipTest("a small file system cannot be mounted: " + small.stderr.strip())
        self.addCleanup(run, "umount", self.work)
        self.assert_goes_on_after(error := self.refused(*self.make, "--work", self.work))
        self.assertIn("No space left", error)
        self.assertGreater(len(self.units()), 0)
        self.assertEqual(run("mount", "-o", "remount,size=1m", self.work).returncode, 0)
        self.succeeds(*self.make, "--work", self.work, "--resume")
        self.assert_the_table()

    def test_is_reported_if_the_file_size_is_limited(self):
        error = self.refused(*self.make, "--work", self.work,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512)))
        self.assert_goes_on_after(error)
        self.assertIn("File too large", error)
        self.succeeds(*self.make, "--work", self.work, "--resume")
        self.assert_the_table()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
