"""albtpu-query with many files and large files: killed, resumed, without its server, and in bounded memory."""

import contextlib
import json
import os
import shutil
import signal
import subprocess

import numpy as np

import programs
import short_files
from las_file import LasFile, repeat
from programs import FLAGS, make_flight, make_table, query
from serving import ALLOWANCE
from simulated_survey import SimulatedSurvey


def start(*arguments):
    return subprocess.Popen([programs.PATHS["query"], *map(str, arguments)], stderr=subprocess.PIPE, text=True)


class ManyFilesTest(programs.Test):
    def make_survey(self, count, times=1):
        flight = make_flight(self.folder / "flight.las")
        survey = self.folder / "survey"
        survey.mkdir()
        for i in range(count):
            repeat(flight, survey / f"line{i}.las", times)
        out = self.folder / "out"
        out.mkdir()
        return survey, out

    def outputs(self, out):
        return {path.name: path.read_bytes() for path in out.rglob("*") if path.is_file() and path.name[0] != "."}

    def test_summary_agrees_with_the_points(self):
        source, target = make_flight(self.folder / "in.las"), self.folder / "out.las"
        query("las", source, target, "--table", self.table, *FLAGS, check=0)
        las, summary = LasFile(target), json.loads((self.folder / "out.las.json").read_text())
        chosen = las.classes == 40
        depths = (0 - las.z[chosen]).astype(np.float32)
        thu, tvu = (las.field(las.record_length - at, "<f4")[chosen] for at in (8, 4))
        self.assertEqual(summary["input"]["points"], las.point_count)
        self.assertEqual(summary["input"]["points_by_class"]["40"], np.count_nonzero(chosen))
        self.assertEqual(summary["output"]["bytes"], target.stat().st_size)
        self.assertEqual(summary["table"]["digest"], self.digest())
        answers = summary["answers"]
        self.assertEqual(answers["outcomes"]["INTERPOLATED"], np.count_nonzero(thu >= 0))
        self.assertEqual(sum(answers["s44_best_order"].values()), np.count_nonzero(thu >= 0))
        for band in answers["depth_bands"]:
            inside = (depths >= band["from"]) & (depths < (band["to"] or np.inf)) & (thu >= 0)
            self.assertEqual(band["pulses"], np.count_nonzero(inside))
            for name, values in (("thu", thu[inside]), ("tvu", tvu[inside])):
                self.assertEqual(np.float32(band[name]["least"]), values.min())
                self.assertEqual(np.float32(band[name]["greatest"]), values.max())
                np.testing.assert_allclose(band[name]["mean"], values.mean(dtype=float), rtol=1e-12)
        self.assertEqual(sum(band["pulses"] for band in answers["depth_bands"]), np.count_nonzero(thu >= 0))

    def test_summaries_are_printed_a_line_each(self):
        survey, out = self.make_survey(2)
        arguments = ("las", survey, "--output-dir", out, "--table", self.table, *FLAGS, "--json")
        for more in ((), ("--resume",)):  # Written, and kept.
            lines = query(*arguments, *more, check=0).stdout.splitlines()
            written = [json.loads((out / f"line{i}.las.json").read_text()) for i in range(2)]
            self.assertEqual([json.loads(line) for line in lines], written)
        with open("/dev/full", "w") as full:
            unprinted = query(*arguments, "--resume", stdout=full)
        self.assertEqual(unprinted.returncode, 1)
        self.assertIn("standard output", unprinted.stderr)
        # A file that fails has no line.
        (survey / "line0.las").write_bytes(b"LASF")
        failed = query(*arguments, "--overwrite")
        self.assertEqual(failed.returncode, 1)
        self.assertEqual([json.loads(line)["output"]["name"] for line in failed.stdout.splitlines()], ["line1.las"])

    def digest(self):
        text = query("tables", "--table", self.table, check=0).stdout
        return next(line.split()[1] for line in text.splitlines() if line.split()[0] == "digest")

    def test_subfolders_are_recreated_when_recursive(self):
        survey, out = self.make_survey(1)
        (survey / "north").mkdir()
        shutil.copy(survey / "line0.las", survey / "north" / "line0.las")
        query("las", survey, "--recursive", "--output-dir", out, "--table", self.table, *FLAGS, check=0)
        self.assertEqual(sorted(str(path.relative_to(out)) for path in out.rglob("*.las")),
                         ["line0.las", "north/line0.las"])
        self.assert_fails(query("las", out / "north", "--output-dir", out / "no", *FLAGS), 1, "is not a folder")

    def test_fewer_numbers_than_half_fail_the_run_but_leave_complete_outputs(self):
        source, out = self.folder / "in", self.folder / "out"
        source.mkdir()
        out.mkdir()
        depths = {"shallow": (1, 2), "upside_down": (-1, -2, -3), "half": (4, -4)}
        for name, values in depths.items():
            (source / f"{name}.csv").write_text("depth\n" + "".join(f"{depth}\n" for depth in values))
        flags = ("csv", source, "--output-dir", out, "--table", self.table, "--wind-speed", 5, "--incidence", 12,
                 "--footprint", 0.5, "--resume")
        for run in range(2):  # The second one finds the outputs of the first.
            result = query(*flags)
            self.assert_fails(result, 1, "in all 3 files: only 3 of 7 pulses got a number",
                              "4 OUT_OF_DOMAIN:depth:below: depth -4 to -1 m is below 0 m", "negative downwards?")
            lines = [line for line in result.stderr.splitlines() if "upside_down.csv: no pulse got a number" in line]
            self.assertEqual(len(lines), 1)
            self.assertNotIn("half.csv: only", result.stderr)
            self.assertEqual(result.stderr.count("is already complete"), 3 * run)
        for name, values in depths.items():
            self.assertEqual(len((out / f"{name}.csv").read_text().splitlines()), 1 + len(values))
            self.assertTrue((out / f"{name}.csv.json").is_file())

    def test_killed_run_resumes_where_it_stopped(self):
        survey, out = self.make_survey(4, 20)
        expected = self.folder / "expected"
        expected.mkdir()
        flags = ("--table", self.table, *FLAGS)
        query("las", survey, "--output-dir", expected, *flags, check=0)
        process = start("las", survey, "--output-dir", out, *flags)
        for line in process.stderr:
            if line.endswith("line1.las:\n"):  # The second file is complete.
                break
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=60)
        made = set(self.outputs(out))
        self.assertLessEqual({"line0.las", "line0.las.json", "line1.las", "line1.las.json"}, made)
        self.assert_fails(query("las", survey, "--output-dir", out, *flags), 1, "files failed")
        result = query("las", survey, "--output-dir", out, *flags, "--resume", check=0)
        self.assertGreaterEqual(result.stderr.count("is already complete"), 2)
        self.assertEqual(self.outputs(out), self.outputs(expected))

    def test_resume_reads_names_that_are_no_utf8(self):
        survey, out = self.make_survey(2)
        os.rename(survey / "line0.las", os.fsencode(survey) + b"/k\xfcste.las")
        for complete in (0, 2):
            result = query("las", survey, "--output-dir", out, "--resume", "--table", self.table, *FLAGS, check=0)
            self.assertEqual(result.stderr.count("is already complete"), complete)

    def test_resume_keeps_only_outputs_of_the_same_run(self):
        survey, out = self.make_survey(2)
        flags = ("las", survey, "--output-dir", out, "--resume", "--scanner", "across-track", "--water-level", 0,
                 "--footprint", 1)
        query(*flags, "--wind-speed", 6, "--table", self.table, check=0)
        before = self.outputs(out)
        other = make_table(self.folder / "other.h5", "--factor", "2")
        for more, what in ((("--wind-speed", 7, "--table", self.table), "parameters.wind_speed is 6.0 there, 7.0 here"),
                           (("--wind-speed", 6, "--table", other), "table.digest is")):
            result = query(*flags, *more)
            self.assert_fails(result, 1, "2 of 2 files failed")
            self.assertIn(what, result.stderr)
            self.assertEqual(self.outputs(out), before)
        os.truncate(out / "line0.las", 1000)
        result = query(*flags, "--wind-speed", 6, "--table", self.table, "--overwrite", check=0)
        self.assertEqual(result.stderr.count("is already complete"), 1)
        self.assertEqual(self.outputs(out), before)

    def test_only_complete_files_are_left_when_the_server_stops(self):
        survey, out = self.make_survey(3, 100)
        make_flight(survey / "line0.las")
        with programs.server(self.folder) as address:
            process = start("las", survey, "--output-dir", out, "--server", address, *FLAGS)
            for line in process.stderr:
                if line.endswith("line0.las:\n"):  # The first file is complete.
                    break
        rest = process.communicate(timeout=120)[1]
        if process.returncode == 0:  # It finished before the server had stopped.
            self.skipTest("the client finished before the server had stopped")
        self.assertEqual(process.returncode, 1)
        last = rest.strip().split("\n")[-1]
        self.assertIn(f"server {address}", last)
        self.assertIn("of 3 files are done", last)
        self.assertIn("--resume", last)
        self.assertEqual([path for path in out.iterdir() if path.name.startswith(".")], [])
        with programs.server(self.folder) as address:
            query("las", survey, "--output-dir", out, "--server", address, *FLAGS, "--resume", check=0)
        self.assertEqual(len(self.outputs(out)), 6)
        self.assertEqual((out / "line1.las").read_bytes(), (out / "line2.las").read_bytes())

    def test_memory_does_not_grow_with_the_file(self):
        flight, out = make_flight(self.folder / "flight.las"), self.folder / "out.las"
        source = repeat(flight, self.folder / "in.las", 150)
        self.assertGreater(LasFile(source).point_count, 3_000_000)
        process = start("las", source, out, "--table", self.table, *FLAGS)
        peak = 0.0
        while process.returncode is None:
            with open(f"/proc/{process.pid}/status") as status:
                peak = max([peak, *(float(line.split()[1]) / 1024 for line in status if line.startswith("VmHWM"))])
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(0.01)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)
        self.assertTrue(0 < peak < 300 * ALLOWANCE, f"{peak} MB")
        old, new = LasFile(source), LasFile(out)
        np.testing.assert_array_equal(new.records[:, :-8], old.records)
        one = new.records[:len(LasFile(flight).records)]
        np.testing.assert_array_equal(new.records.reshape(150, *one.shape)[[0, 70, 149]],
                                      np.broadcast_to(one, (3, *one.shape)))


def reads():
    """The reads of this process and of its children that have ended."""
    with open("/proc/self/io") as counts:
        return int(next(line.split()[1] for line in counts if line.startswith("syscr:")))


class ManyTrajectoriesTest(programs.Test):
    """Short files, each with an SBET of its own, a minute after the one before."""

    def make(self, count):
        survey = SimulatedSurvey(self.folder, "--seconds", 4, "--seed", 3, "--start", 1000, "--sbet-rate", 50)
        files = short_files.make(survey.las, self.folder, count)
        (self.folder / "out").mkdir()
        self.flags = ("--output-dir", self.folder / "out", "--trajectory", self.folder / "sbet", "--lever-arm",
                      "0.3,-0.2,0.5", "--water-level", survey.water_level, "--classes", 40, "--divergence", 1,
                      "--wind-speed", 6, "--table", self.table, "--details")
        return files

    def annotate(self, files, *flags):
        """The reads of a run, and what it said: into a file, because how often a pipe is read is a matter of luck."""
        path = self.folder / "said"
        with path.open("w") as said:
            before = reads()
            result = query("las", *files, *self.flags, *flags, stdout=said, stderr=said)
            made = reads() - before
        self.assertEqual(result.returncode, 0, path.read_text())
        return made, path.read_text()

    def test_each_file_adds_the_same_few_reads(self):
        """PROJ's database is not read again for each file, and its trajectory is found without reading the others."""
        files = self.make(60)
        of_one, _ = self.annotate(files[:1])
        of_thirty, _ = self.annotate(files[:30], "--overwrite")
        of_sixty, _ = self.annotate(files, "--overwrite")
        of_each = (of_thirty - of_one) / 29
        self.assertLess(of_each, 20)
        # Were the others read, each file would add one read for each of the others, or more.
        self.assertLess(abs((of_sixty - of_thirty) / 30 - of_each), 1)
        first = LasFile(self.folder / "out" / "00000.las").records[:, -28:]
        self.assertGreater(first.any(axis=1).mean(), 0.5)
        for i in (1, 29, 59):
            columns = LasFile(self.folder / "out" / f"{i:05}.las").columns()
            right = LasFile(self.folder / "out" / "00000.las").columns()
            for name in ("incidence", "sea_thu", "slant_range"):
                # Times that are 60 s later have other last bits: 0.1 us of 60 m/s.
                np.testing.assert_allclose(columns[name], right[name], rtol=1e-5, atol=1e-5)

    def test_resumes_from_many(self):
        files = self.make(20)
        self.annotate(files[:10])
        _, said = self.annotate(files, "--resume")
        self.assertEqual(said.count("is already complete"), 10)
        _, said = self.annotate(files, "--resume")
        self.assertEqual(said.count("is already complete"), 20)
        os.utime(self.folder / "sbet" / "00007.sbet", (2e9, 2e9))
        _, said = self.annotate(files, "--resume", "--overwrite")
        self.assertNotIn("is already complete", said)


if __name__ == "__main__":
    programs.main()
