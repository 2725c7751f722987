"""What a shell sees of albtpu-query: exit codes, messages, outputs, and nothing lost or half written."""

import contextlib
import json
import os
import pathlib
import resource
import signal
import subprocess
import time

import programs
from programs import make_flight, make_table, query

PULSE = ("--wind-speed", 5, "--incidence", 12, "--footprint", 0.5, "--depth", 8)
AXES = ("wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth")
APPENDED = ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu", "bias_along_beam",
            "bias_vertical", "outcome")


class CommandLineTest(programs.Test):
    def pulse(self, *flags):
        return query("pulse", "--table", self.table, *flags)

    def test_pulse_csv_and_server_give_the_same_numbers(self):
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        source.write_text("wind_speed,incidence,azimuth,footprint,depth\n"
                          "5,12,30,0.5,8\n5,12,,0.5,8\n5,12,,0.5,80\n")
        query("csv", source, target, "--table", self.table, check=0)
        rows = [dict(zip(target.read_text().split("\n")[0].split(","), line.split(",")))
                for line in target.read_text().split("\n")[1:4]]
        tables = self.folder / "tables"
        tables.mkdir()
        make_table(tables / "quick.h5")
        with programs.server(tables) as address:
            remote = self.folder / "remote.csv"
            query("csv", source, remote, "--server", address, check=0)
            self.assertEqual(remote.read_text(), target.read_text())
            for flags, row in ((("--azimuth", 30), rows[0]), ((), rows[1]), (("--depth", 80), rows[2])):
                arguments = (*(PULSE if "--depth" not in flags else PULSE[:-2]), *flags, "--json")
                local = self.pulse(*arguments)
                self.assertEqual(local.returncode, 0, local.stderr)
                self.assertEqual(query("pulse", "--server", address, *arguments).stdout, local.stdout)
                answer = json.loads(local.stdout)
                for name in APPENDED:
                    expected = row[name] if name == "outcome" else float(row[name]) if row[name] else None
                    self.assertEqual(answer[name], expected, name)
                self.assertLessEqual({*AXES, *APPENDED, "table", "digest", "coverage"}, set(answer))

    def test_pulse_prints_answers_on_standard_output_only(self):
        result = self.pulse(*PULSE)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("2 sigma", result.stdout)
        self.assertNotIn(str(self.folder), result.stdout)

    def test_out_of_domain_is_an_answer(self):
        result = self.pulse(*PULSE[:-1], 500)
        self.assertEqual(result.returncode, 0)
        self.assertIn("OUT_OF_DOMAIN:depth", result.stdout)
        self.assertIn("from 0 to 20 m", result.stdout)

    def test_wrong_flags_are_bad_usage(self):
        for flags in (("--depth", "nan"), ("--depth", "inf"), ("--depth", "-1"), ("--depth", "deep"),
                      ("--depth", ""), ("--wind-speed", "-5"), ("--fetch", "nan"), ("--fetch", "-inf"),
                      ("--fetch", "-1"), ("--azimuth", "inf"), ("--coverage", "3sigma"), ("--s44-order", "3"),
                      ("--no-such-flag",), ("--footprint",), ("--server", "localhost:1"),
                      ("--server", "localhost"), ("--server", "localhost:0"), ("--server", ""),
                      ("--table-name", "quick"), ("--table-name", "")):
            with self.subTest(flags=flags):
                others = [pair for pair in zip(PULSE[::2], PULSE[1::2]) if pair[0] != flags[0]]
                arguments = [part for pair in others for part in pair]
                self.assert_fails(self.pulse(*arguments, *flags), 2, flags[0])
        self.assert_fails(self.pulse(*PULSE[2:]), 2, "--wind-speed")
        self.assert_fails(query(), 2)
        self.assert_fails(query("no-such-command"), 2)
        self.assertEqual(self.pulse(*PULSE, "--fetch", "inf", "--azimuth", "-30").returncode, 0)

    def test_every_command_takes_the_shared_flags(self):
        shared = ("--table", self.table, "--coverage", "p95", "--s44-order", "1a", "--standard-errors",
                  "--overwrite")
        source = self.folder / "in.csv"
        source.write_text("depth\n1\n")
        query("pulse", *PULSE, *shared, check=0)
        query("tables", *shared, check=0)
        query("csv", source, self.folder / "out.csv", *PULSE[:-2], *shared, check=0)
        query("las", make_flight(self.folder / "in.las"), self.folder / "out.las", "--water-level", 0,
              "--wind-speed", 5, "--footprint", 1, *shared, check=0)

    def test_las_flags_that_do_not_fit(self):
        source, target = make_flight(self.folder / "in.las"), self.folder / "out.las"
        need = {"--water-level": 0, "--wind-speed": 5, "--footprint": 1}

        def las(*files, without=None, more=()):
            pairs = [part for name, value in need.items() if name != without for part in (name, value)]
            return query("las", *files, "--table", self.table, *pairs, *more)

        for name in need:
            self.assert_fails(las(source, target, without=name), 2, name)
        for more in (("--altitude", 400), ("--divergence", 1), ("--altitude", 400, "--divergence", 1),
                     ("--wind-from", 10), ("--flight-direction", 10),
                     ("--azimuth", 10, "--wind-from", 10, "--flight-direction", 10), ("--classes", "256"),
                     ("--classes", "bottom"), ("--classes", ""), ("--units", "yard"), ("--altitude", "nan")):
            with self.subTest(more=more):
                self.assert_fails(las(source, target, more=more), 2)
        self.assert_fails(las(source), 2, "IN.las OUT.las")
        self.assert_fails(las(source, target, source), 2)
        self.assertEqual(las(source, target, more=("--azimuth", "-30.5")).returncode, 0)
        need["--water-level"] = "-0.5"
        self.assertEqual(las(source, target, more=("--overwrite",)).returncode, 0)

    def test_failures_say_what_is_wrong_and_leave_nothing(self):
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        source.write_text("wind_speed,incidence,footprint,depth\n5,12,0.5,8\n5,12,0.5,deep\n")
        os.mkfifo(self.folder / "pipe")
        before = self.names()
        table = ("--table", self.table)
        self.assert_fails(query("csv", source, target, *table), 1, "in.csv line 3, column 'depth': 'deep'")
        self.assert_fails(query("csv", self.folder / "no.csv", target, *table), 1, "no.csv")
        self.assert_fails(query("csv", source, self.folder / "no" / "out.csv", *table), 1, "out.csv")
        self.assert_fails(query("csv", source, source, *table, "--overwrite"), 1, "is the input itself")
        self.assert_fails(query("csv", source, target, "--table", self.folder / "no.h5"), 1, "no.h5")
        self.assert_fails(query("csv", source, target, "--table", source), 1, "in.csv")
        self.assert_fails(query("csv", source, target, "--server", "127.0.0.1:1"), 1, "127.0.0.1:1")
        self.assert_fails(query("csv", source, target, *table, "--depth", 3), 2, "--depth")
        las = ("--water-level", 0, "--wind-speed", 5, "--footprint", 1)
        self.assert_fails(query("las", source, target, *table, *las), 1, "is not a LAS file")
        self.assert_fails(query("las", self.folder / "pipe", target, *table, *las), 1, "pipe: is not a regular file")
        self.assertEqual(self.names(), before)

    def test_existing_output_is_kept_unless_told(self):
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        source.write_text("wind_speed,incidence,footprint,depth\n5,12,0.5,8\n")
        target.write_text("precious")
        self.assert_fails(query("csv", source, target, "--table", self.table), 1, "already exists")
        self.assertEqual(target.read_text(), "precious")
        source.write_text("wind_speed,incidence,footprint,depth\n5,12,0.5,deep\n")
        self.assert_fails(query("csv", source, target, "--table", self.table, "--overwrite"), 1, "line 2")
        self.assertEqual(target.read_text(), "precious")
        source.write_text("wind_speed,incidence,footprint,depth\n5,12,0.5,8\n")
        query("csv", source, target, "--table", self.table, "--overwrite", check=0)
        self.assertIn("INTERPOLATED", target.read_text())

    def test_installed_tables_answer_by_default(self):
        tables = self.folder / "tables"
        tables.mkdir()
        environment = {**os.environ, "ALBTPU_TABLES": str(tables)}
        self.assert_fails(query("pulse", *PULSE, env=environment), 1, "--table")
        make_table(tables / "one.h5", "--id", "one")
        self.assertIn("one", query("pulse", *PULSE, env=environment, check=0).stdout)
        make_table(tables / "two.h5", "--id", "two", "--factor", "2")
        self.assert_fails(query("pulse", *PULSE, env=environment), 1, "one, two")
        self.assertIn("two", query("pulse", *PULSE, "--table-name", "two", env=environment, check=0).stdout)
        make_table(tables / "survey.h5", "--id", "all")
        self.assertIn("all", query("pulse", *PULSE, env=environment, check=0).stdout)
        listed = query("tables", env=environment, check=0).stdout
        self.assertIn("survey (default)", listed)
        with programs.server(tables) as address:
            self.assertEqual(query("tables", "--server", address, check=0).stdout, listed)

    def test_full_disk_leaves_nothing(self):
        source, target = make_flight(self.folder / "in.las"), self.folder / "out.las"
        limit = source.stat().st_size // 2
        before = self.names()
        result = query("las", source, target, "--table", self.table, "--water-level", 0, "--wind-speed", 5,
                       "--footprint", 1,
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.assert_fails(result, 1, "out.las: File too large (no output was written); ")
        self.assertEqual(self.names(), before)

    def test_full_standard_output_is_a_failure(self):
        with open("/dev/full", "w") as full:
            command = [programs.PATHS["query"], "pulse", "--table", self.table, *map(str, PULSE)]
            result = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)

    def test_work_goes_on_when_nobody_reads_its_messages(self):
        reader, writer = os.pipe()
        os.close(reader)
        source, target = make_flight(self.folder / "in.las"), self.folder / "out.las"
        flags = ("--water-level", 0, "--wind-speed", 5, "--footprint", 1)
        command = [programs.PATHS["query"], "las", source, target, "--table", self.table, *map(str, flags)]
        self.assertEqual(subprocess.run(command, stderr=writer).returncode, 0)
        os.close(writer)
        self.assertTrue(target.exists())

    def writes(self, process):
        """Whether it has begun an output in the folder, with a name or without."""
        links = pathlib.Path(f"/proc/{process.pid}/fd").iterdir()
        folder = os.path.realpath(self.folder)
        for link in links:
            with contextlib.suppress(FileNotFoundError):  # It closes files meanwhile.
                if os.readlink(link).startswith((f"{folder}/#", f"{folder}/.albtpu-")):
                    return True
        return False

    def test_signal_leaves_nothing(self):
        # The input is a pipe that never ends, so the program is surely at work when the signal comes.
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        os.mkfifo(source)
        before = self.names()
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            command = [programs.PATHS["query"], "csv", source, target, "--table", self.table]
            process = subprocess.Popen(command, stderr=subprocess.PIPE)
            with open(source, "w") as pipe:
                pipe.write("wind_speed,incidence,footprint,depth\n5,12,0.5,8\n")
                pipe.flush()
                deadline = time.monotonic() + 60
                while not self.writes(process) and time.monotonic() < deadline:
                    time.sleep(0.01)
                self.assertTrue(self.writes(process))
                process.send_signal(number)
                process.communicate(timeout=60)
            self.assertEqual(process.returncode, -number)
            self.assertEqual(self.names(), before)


if __name__ == "__main__":
    programs.main()
