"""albtpu-query as a program: exit codes, messages and outputs, and no output lost or half written."""

import contextlib
import json
import math
import os
import pathlib
import signal
import subprocess
import time

import programs
from programs import FLAGS, make_flight, make_table, query

PULSE = ("--wind-speed", 5, "--incidence", 12, "--footprint", 0.5, "--depth", 8)
AXES = ("wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth")
APPENDED = ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu", "bias_along_beam",
            "bias_vertical", "outcome")


class CommandLineTest(programs.Test):
    def pulse(self, *flags, **options):
        return query("pulse", "--table", self.table, *flags, **options)

    def test_pulse_csv_and_server_give_the_same_numbers(self):
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        source.write_text("wind_speed,incidence,azimuth,footprint,depth\n"
                          "5,12,30,0.5,8\n5,12,,0.5,8\n5,12,,0.5,80\n")
        query("csv", source, target, "--table", self.table, check=0)
        rows = [dict(zip(target.read_text().split("\n")[0].split(","), line.split(",")))
                for line in target.read_text().split("\n")[1:4]]
        with programs.server(self.folder) as address:
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

    def test_directions_and_beams_give_the_same_numbers_in_pulse_and_csv(self):
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        source.write_text("wind_speed,incidence,beam_azimuth,altitude,depth\n5,12,40,400.5,8\n")
        query("csv", source, target, "--wind-from", 250.25, "--divergence", 1.3, "--table", self.table, check=0)
        names, cells = (line.split(",") for line in target.read_text().splitlines())
        beam = ("--beam-azimuth", 40, "--wind-from", 250.25, "--altitude", 400.5, "--divergence", 1.3)
        pulse = ("--wind-speed", 5, "--incidence", 12, "--depth", 8)
        answer = json.loads(self.pulse(*pulse, *beam, "--json").stdout)
        self.assertEqual(answer["azimuth"], -390.25)
        # 1.3 and the footprint below 1 m are each rounded to single precision: by 2^-25 at most.
        self.assertAlmostEqual(answer["footprint"], 400.5 / math.cos(math.radians(12)) * 1.3e-3, delta=2**-24)
        for name, cell in zip(names, cells):
            if name in APPENDED[:-1]:
                self.assertEqual(float(cell), answer[name], name)
        self.assert_fails(self.pulse(*pulse, *beam, "--azimuth", 3), 2, "--azimuth gives the azimuth, and so do "
                          "--beam-azimuth and --wind-from")
        self.assert_fails(self.pulse(*pulse, "--altitude", 400), 2, "--altitude alone does not give the footprint")

    def test_out_of_domain_is_an_answer(self):
        result = self.pulse(*PULSE[:-1], 500)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("OUT_OF_DOMAIN:depth:above", result.stdout)
        self.assertNotIn(str(self.folder), result.stdout)

    def test_wrong_flags_are_bad_usage(self):
        # Flags that a survey file has, too, are tested by tests/config/keys_e2e_test.py.
        for flags in (("--depth", "nan"), ("--depth", "-1"), ("--depth", "deep"), ("--depth", ""), ("--azimuth", "inf"),
                      ("--no-such-flag",), ("--footprint",), ("--server", "localhost:1"), ("--server", "localhost"),
                      ("--server", "localhost:0"), ("--server", ""), ("--table-name", "quick"), ("--table-name", "")):
            with self.subTest(flags=flags):
                others = [pair for pair in zip(PULSE[::2], PULSE[1::2]) if pair[0] != flags[0]]
                arguments = [part for pair in others for part in pair]
                self.assert_fails(self.pulse(*arguments, *flags), 2, flags[0])
        self.assert_fails(self.pulse(*PULSE[2:]), 2, "--wind-speed")
        self.assertEqual(self.pulse(*PULSE, "--fetch", "inf", "--azimuth", "-30").returncode, 0)

    def test_each_command_takes_the_flags_that_mean_something_for_it(self):
        style = ("--coverage", "p95", "--s44-order", "1a", "--standard-errors")
        table = ("--table", self.table)
        source = self.folder / "in.csv"
        source.write_text("depth\n1\n")
        query("pulse", *PULSE, *table, *style, check=0)
        query("tables", *table, check=0)
        query("csv", source, self.folder / "out.csv", *PULSE[:-2], *table, *style, "--overwrite", check=0)
        query("las", make_flight(self.folder / "in.las"), self.folder / "out.las", "--water-level", 0,
              "--scanner", "across-track", "--wind-speed", 5, "--footprint", 1, *table, *style, "--overwrite", check=0)

    def test_flags_without_effect_are_bad_usage(self):
        files = ("in.csv", "out.csv", "--table", self.table)
        for command, flags in ((("tables",), ("--standard-errors",)), (("tables",), ("--depth", 3)),
                               (("pulse", *PULSE), ("--overwrite",)),
                               (("csv", *files), ("--classes", 40)), (("csv", *files), ("--token-file", "token")),
                               (("las", *files), ("--depth", 3)), (("health",), ("--table", self.table)),
                               (("health", "--server", "localhost:1"), ("--coverage", "p95"))):
            with self.subTest(command=command[0], flags=flags):
                self.assert_fails(query(*command, *flags), 2, flags[0])

    def test_misspelt_words_get_a_suggestion(self):
        for arguments, *expected in ((["foo"], "'foo' is not a command", "pulse, csv, las, plan, report, surface, "
                                      "crosscheck, checkpoints, trajectory, sea, sensors, keys, tables, health"),
                                     (["tables", "--server=a:1", "--tls-kye=x"], "did you mean --tls-key?"),
                                     (["pulse", *PULSE, "--coverage", "2sigm"], 'did you mean "2sigma"?'),
                                     ([], "no command is given")):
            with self.subTest(arguments=arguments):
                self.assert_fails(query(*arguments), 2, *expected)

    def test_the_interpolation_error_stands_beside_the_standard_error(self):
        tables = pathlib.Path(__file__).resolve().parents[3] / "tables/shipped"
        survey = ("--table", tables / "survey.h5")
        text = query("pulse", *PULSE, *survey, "--standard-errors", check=0).stdout
        self.assertIn("thu                    0.26 % rms, 0.79 % at the 99th percentile", text)
        with programs.server(tables) as address:
            self.assertEqual(query("pulse", *PULSE, "--server", address, "--standard-errors", check=0).stdout, text)
        source = self.write("in.csv", "wind_speed,incidence,footprint,depth\n5,12,0.5,8\n")
        noted = query("csv", source, self.folder / "out.csv", *survey, "--standard-errors", check=0).stderr
        self.assertIn("albtpu-query: interpolation error, relative, at random pulses all over the table: "
                      "refraction_along_wind 0.28 % rms", noted)
        self.assertNotIn("interpolation error", query("csv", source, self.folder / "two.csv", *survey, check=0).stderr)

    def test_las_flags_that_contradict_each_other_are_bad_usage(self):
        source, target = make_flight(self.folder / "in.las"), self.folder / "out.las"
        need = {"--scanner": "across-track", "--water-level": 0, "--wind-speed": 5, "--footprint": 1}

        def las(*files, without=None, more=()):
            pairs = [part for name, value in need.items() if name != without for part in (name, value)]
            return query("las", *files, "--table", self.table, *pairs, *more)

        for name in need:
            self.assert_fails(las(source, target, without=name), 2, name)
        for more in (("--altitude", 400), ("--divergence", 1), ("--altitude", 400, "--divergence", 1),
                     ("--aperture", 0.1), ("--wind-from", 10), ("--flight-direction", 10),
                     ("--azimuth", 10, "--wind-from", 10, "--flight-direction", 10), ("--units", "yard"),
                     ("--scanner", "conical"), ("--lever-arm", "560,0,-300"), ("--water-classes", 40),
                     ("--classes", "26,27", "--water-classes", "27,9")):
            with self.subTest(more=more):
                self.assert_fails(las(source, target, more=more), 2)
        self.assert_fails(las(source), 2, "IN.las OUT.las")
        self.assert_fails(las(source, target, source), 2)
        for csv in (target, f"{target}.json", f"{target.parent}/./{target.name}.json"):
            self.assert_fails(las(source, target, more=("--csv", csv)), 2, f"two outputs would be called {csv}")
        self.assertEqual(las(source, target, more=("--azimuth", "-30.5")).returncode, 0)
        need["--water-level"] = "-0.5"
        self.assertEqual(las(source, target, more=("--overwrite",)).returncode, 0)

    def test_las_needs_exactly_one_way_to_an_incidence(self):
        files = (make_flight(self.folder / "in.las"), self.folder / "out.las", "--table", self.table)
        rest = ("--water-level", 0, "--wind-speed", 5, "--footprint", 1)
        ways = {"--trajectory": ("--trajectory", "sbet.out"),
                "--trajectory-from-returns": ("--trajectory-from-returns",),
                "--scanner": ("--scanner", "across-track"), "--incidence": ("--incidence", 20)}
        self.assert_fails(query("las", *files, *rest), 2, *ways)
        for one in ways:
            for other in ways:
                if one < other:
                    self.assert_fails(query("las", *files, *rest, *ways[one], *ways[other]), 2, one, other)
        foreign = {"--trajectory": (("--flight-direction", 1), ("--altitude", 400), ("--beam-azimuth", 1),
                                    ("--azimuth", 1)),
                   "--trajectory-from-returns": (("--geoid-separation", 25), ("--lever-arm", "0,0,1"),
                                                 ("--trajectory-time", "utc"), ("--flight-direction", 1)),
                   "--scanner": (("--beam-azimuth", 1), ("--crs", "EPSG:26917"),
                                 ("--trajectory-errors", "smrmsg.out")),
                   "--incidence": (("--flight-direction", 1), ("--lever-arm", "0,0,1"))}
        for way, flags in foreign.items():
            for flag in flags:
                with self.subTest(way=way, flag=flag):
                    self.assert_fails(query("las", *files, *rest, *ways[way], *flag), 2,
                                      f"{flag[0]} has no effect with {way}")
        self.assert_fails(query("las", *files, *rest, "--incidence", 90), 2, "--incidence")
        for index in (1, 3):
            self.assert_fails(query("las", *files, *rest, *ways["--trajectory-from-returns"], "--water-index", index),
                              2, "--water-index")

    def test_failures_state_the_problem_and_leave_no_files(self):
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        source.write_text("wind_speed,incidence,footprint,depth\n5,12,0.5,8\n5,12,0.5,deep\n")
        os.mkfifo(self.folder / "pipe")
        before = self.names()
        table = ("--table", self.table)
        for arguments, part in (
                (("csv", source, target, *table), "in.csv line 3, column 'depth': 'deep'"),
                (("csv", self.folder / "no.csv", target, *table), "no.csv"),
                (("csv", source, self.folder / "no" / "out.csv", *table), "out.csv"),
                (("csv", source, source, *table, "--overwrite"), "is the input itself"),
                (("csv", source, target, "--table", self.folder / "no.h5"), "no.h5"),
                (("csv", source, target, "--table", source), "in.csv"),
                (("csv", source, target, "--server", "127.0.0.1:1"), "127.0.0.1:1"),
                (("las", source, target.with_suffix(".las"), *table, *FLAGS), "is not a LAS file"),
                (("las", self.folder / "pipe", target.with_suffix(".las"), *table, *FLAGS),
                 "pipe: is not a regular file")):
            self.assert_fails(query(*arguments), 1, part)
        self.assert_fails(query("csv", source, target, *table, "--depth", 3), 2, "--depth")
        self.assertEqual(self.names(), before)

    def test_installed_tables_answer_by_default(self):
        tables = self.folder / "tables"
        tables.mkdir()
        environment = {"ALBTPU_TABLES": str(tables)}
        self.assert_fails(query("pulse", *PULSE, environment=environment), 1, "--table")
        make_table(tables / "one.h5", "--id", "one")
        make_table(tables / "two.h5", "--id", "two", "--factor", "2")
        self.assert_fails(query("pulse", *PULSE, environment=environment), 1, "one, two")
        self.assertIn("two", query("pulse", *PULSE, "--table-name", "two", environment=environment, check=0).stdout)
        make_table(tables / "survey.h5", "--id", "all")
        self.assertIn("all", query("pulse", *PULSE, environment=environment, check=0).stdout)
        listed = query("tables", environment=environment, check=0).stdout
        self.assertIn("survey (default)", listed)
        with programs.server(tables) as address:
            self.assertEqual(query("tables", "--server", address, check=0).stdout, listed)

    def test_full_standard_output_is_a_failure(self):
        with open("/dev/full", "w") as full:
            result = self.pulse(*PULSE, stdout=full)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)

    def test_a_closed_pipe_ends_help_and_not_answers(self):
        for arguments, code in ((("las", "--help"), 0), (("--version",), 0), (("keys",), 1)):
            reader, writer = os.pipe()
            os.close(reader)
            result = query(*arguments, stdout=writer)
            os.close(writer)
            self.assertEqual((result.returncode, bool(result.stderr)), (code, code != 0), arguments)

    def test_a_closed_standard_error_does_not_stop_the_work(self):
        reader, writer = os.pipe()
        os.close(reader)
        source, target = make_flight(self.folder / "in.las"), self.folder / "out.las"
        query("las", source, target, "--table", self.table, *FLAGS, stderr=writer, check=0)
        os.close(writer)
        self.assertTrue(target.exists())

    def writes(self, process):
        """Whether the process has an output file open in the folder, with or without a name."""
        links = pathlib.Path(f"/proc/{process.pid}/fd").iterdir()
        folder = os.path.realpath(self.folder)
        for link in links:
            with contextlib.suppress(FileNotFoundError):  # The process closes files in the meantime.
                if os.readlink(link).startswith((f"{folder}/#", f"{folder}/.albtpu-")):
                    return True
        return False

    def test_a_signal_leaves_no_files(self):
        # The input is a pipe that stays open, so the program is still working when the signal arrives.
        source, target = self.folder / "in.csv", self.folder / "out.csv"
        os.mkfifo(source)
        before = self.names()
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            command = [programs.PATHS["query"], "csv", source, target, "--table", self.table]
            # What starts the tests may ignore signals, as nohup does, and a program inherits that.
            process = subprocess.Popen(command, stderr=subprocess.PIPE,
                                       preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))
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
