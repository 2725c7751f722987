"""The first contact with a survey: what `init` says of LAS and LAZ files, that the file it prints is taken, and what
`las` and `csv` answer who is given too little."""

import gzip
import os
import pathlib
import re
import shlex
import shutil
import struct
import tomllib

import programs
from commands import run
from programs import PATHS, laz_copy, make_flight, query
from simulated_survey import SimulatedSurvey

CASES = pathlib.Path(PATHS["cases"])
SAMPLE = pathlib.Path(PATHS["sample"])
DECIDED = ("name", "from_returns", "wind_speed", "column", "sigma")  # Of a file with pairs of returns, by example.


class InitTest(programs.Test):
    def setUp(self):
        super().setUp()
        self.tables = self.folder / "tables"
        self.tables.mkdir()
        self.table.rename(self.tables / "survey.h5")
        self.environment = {"ALBTPU_TABLES": str(self.tables),
                            "PATH": os.path.dirname(PATHS["query"]) + os.pathsep + os.environ["PATH"]}

    def ship(self):
        """Puts the shipped table in the place of the small one, whose footprints end at 2 m."""
        shutil.copy(PATHS["shipped_table"], self.tables / "survey.h5")

    def case(self, name):
        path = self.folder / name
        source = CASES / f"{name}.gz"
        if not source.exists():
            self.skipTest(f"{source} does not exist")
        path.write_bytes(gzip.decompress(source.read_bytes()))
        return path

    def init(self, *files):
        text = query("init", *files, check=0).stdout
        return text, tomllib.loads(text)

    def las(self, *arguments, **keywords):
        return query("las", *arguments, environment=self.environment, cwd=self.folder, **keywords)

    def run_line(self, line):
        return run("sh", "-c", line, environment=self.environment, cwd=self.folder)

    def decide(self, text, keys=DECIDED):
        """The draft `text` with these keys, which it has as examples, decided."""
        for key in keys:
            text, times = re.subn(rf"(?m)^#({key} = .*  # (?:an example|a choice).*)", r"\1", text, count=1)
            self.assertEqual(times, 1, f"{key} is no example in\n{text}")
        return self.toml(text)


class Draft(InitTest):
    def test_of_a_flight(self):
        text, survey = self.init(make_flight(self.folder / "line.las"))
        self.assertEqual({section: keys for section, keys in survey.items() if keys}, {"surface": {"classes": [41]}})
        for said in ("LAS 1.4, point format 6", "class 2: ", ", bottom by its number", ", water surface by its number",
                     "x and y in m; heights in m, vertical datum not stated", "scan pattern: raster",
                     "-20.0 to 20.0 degree", "2022-03-", "adjusted standard GPS time"):
            self.assertIn(said, text)
        decisions = re.findall(r"(?m)^\[(\w+)\]\n# DECIDE", text)
        self.assertEqual(decisions, ["sensor", "trajectory", "sea", "water", "datum"])
        self.assertEqual(re.findall(r"(?m)^#(wind_speed = .*)", text), ["wind_speed = 5  # an example"])

    def test_of_laz_is_the_same(self):
        las = make_flight(self.folder / "line.las")
        laz = laz_copy(las, self.folder / "line.laz")
        self.assertEqual(self.init(las)[0].replace("line.las", "line.laz").replace("_tpu.las", "_tpu.laz")
                         .replace("LAS 1.4", "LAZ 1.4"), self.init(laz)[0])

    def test_is_taken_with_each_key(self):
        """The # of each key with a value removed, one after the other, where the file leaves it open."""
        las = make_flight(self.folder / "line.las")
        lines = self.init(las)[0].split("\n")
        taken = 0
        for at, line in enumerate(lines):
            if not re.match(r"#\w+ = [^A-Z]*$", line.split("  # ")[0]):
                continue
            inner = max((i for i in range(at) if re.match(r"#?\[+\w", lines[i])), default=0)
            if lines[inner].startswith("#"):
                continue
            survey = self.toml("\n".join([*lines[:at], line[1:], *lines[at + 1:]]))
            result = self.las(las, self.folder / "out.las", "--survey", survey)
            self.assertEqual(result.returncode, 2, line)
            self.assertNotRegex(result.stderr, r"survey.toml: line \d+", line)
            taken += 1
        self.assertGreater(taken, 20)

    def test_of_pairs_of_returns_gives_totals_once_decided(self):
        self.ship()
        las = self.case("line.las")
        text, survey = self.init(las)
        self.assertEqual(survey["surface"], {"classes": [41]})
        self.assertIn("NAD83 / UTM zone 17N", text)
        self.assertIn("scan pattern: elliptical, such as Palmer", text)
        result = self.las(las, "out.las", "--survey", self.decide(text), check=0)
        self.assertRegex(result.stderr, r"\n +all +\d+ .*total|total TVU")

    def test_of_a_real_survey_gives_totals_once_decided(self):
        if not SAMPLE.exists():
            self.skipTest(f"{SAMPLE} does not exist")
        text, survey = self.init(SAMPLE)
        self.assertEqual(survey["output"], {"classes": [26]})  # Not the class that its point format would have.
        self.assertIn("2016-05-17T13:43:16Z to ", text)
        self.assertIn("scan pattern: elliptical, such as Palmer", text)
        self.assertIn("level = -23.09 ", text)
        result = self.las(SAMPLE, "out.las", "--survey", self.decide(text, (*DECIDED, "level")), check=0)
        self.assertIn("total TVU", result.stderr)

    def test_of_points_without_times_names_the_flags_that_take_the_place_of_a_trajectory(self):
        las = make_flight(self.folder / "line.las", 2, 0)
        laz = laz_copy(las, self.folder / "line.laz")
        text, survey = self.init(laz)
        self.assertEqual(survey["surface"], {"classes": [9]})
        self.assertIn("GPS times: none (point format 0)", text)
        self.assertIn("no trajectory can be used", text)
        self.assertNotIn("[trajectory]\n# DECIDE", text)  # The heading says it.
        command = re.search(r"(?m)^#  (albtpu-query las .*)$", text)[1]
        self.assertIn("--scanner across-track --altitude 400", command)
        self.decide(text, ("name", "wind_speed", "column", "sigma"))
        result = self.run_line(command)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("total TVU", result.stderr)

    def test_quotes_paths_and_keeps_them_on_one_line(self):
        las = make_flight(self.folder / "line.las")
        text, _ = self.init(las.rename(self.folder / "my line.las"))
        self.assertIn(f"#  albtpu-query las '{self.folder}/my line.las' 'my line_tpu.las' --survey", text)
        text, survey = self.init((self.folder / "my line.las").rename(self.folder / "a\nb = 1.las"))
        self.assertEqual(survey["surface"], {"classes": [41]})
        self.assertIn("a b = 1.las: LAS 1.4", text)

    def test_names_the_sensor_in_the_header(self):
        las = make_flight(self.folder / "line.las")
        for software, name in (("RIEGL VQ-840-GE", "riegl-vq-840-ge"), ("riegl vq-840-g 2.1", "riegl-vq-840-g"),
                               ("Teledyne Optech CZMIL SuperNova", "teledyne-czmil-supernova"),
                               ("Teledyne Optech CZMIL", "teledyne-czmil"), ("RIEGL VQ-840-GX", None)):
            data = bytearray(las.read_bytes())
            data[26:58] = software.encode().ljust(32, b"\0")
            las.write_bytes(data)
            named = re.search(r'(?m)^#name = "(.*)"', self.init(las)[0])[1]
            self.assertEqual(named, name or "leica-chiroptera-4x", software)

    def test_doubts_times_that_cannot_be(self):
        self.assertIn("but this is in the future", self.init(self.case("unix_times.las"))[0])
        las = make_flight(self.folder / "line.las")
        data = bytearray(las.read_bytes())
        data[6] &= 0xFE  # Seconds of the week, says the header now.
        las.write_bytes(data)
        self.assertIn("no week has as many: they may be adjusted standard GPS times (2022-03-", self.init(las)[0])

    def test_asks_for_the_unit_of_heights(self):
        feet = pathlib.Path(PATHS["laz_samples"]) / "1_4_w_evlr.las"
        if not feet.exists():
            self.skipTest(f"{feet} does not exist")
        self.assertRegex(self.init(feet)[0], r"(?s)DECIDE, on the command line:.{,200}--units\s")

    def test_of_a_whole_survey_is_short_enough_to_be_read(self):
        las = make_flight(self.folder / "line.las")
        text = self.init(*[las] * 60)[0]
        self.assertIn("and 52 more files", text)
        self.assertIn("decisions are missing", self.las(las, "out.las", "--survey", self.toml(text)).stderr)

    def test_of_several_files_says_what_differs(self):
        modern = make_flight(self.folder / "a.las")
        old = make_flight(self.folder / "b.las", 2, 1)
        data = bytearray(old.read_bytes())
        struct.pack_into("<H", data, 6, data[6] & 0xFE)
        old.write_bytes(data)
        text, survey = self.init(modern, old)
        self.assertEqual(survey["surface"], {"classes": [9, 41]})
        self.assertEqual(survey["output"], {"classes": [26, 40]}) if "classes" in survey["output"] else None
        for what in ("clocks differ", "classes differ", "--output-dir FOLDER"):
            self.assertIn(what, text)
        self.assertNotIn("The files differ", self.init(modern, modern)[0])
        words = " ".join(self.init(modern, make_flight(self.folder / "c.las", 2, 0))[0].replace("#", "").split())
        self.assertIn("The points of some files have no GPS times, so that no trajectory can be used for them", words)

    def test_of_a_file_without_points(self):
        self.assertIn("empty.las: LAS 1.4, point format 6, 0 points",
                      self.init(make_flight(self.folder / "a.las"), self.empty())[0])
        self.assertNotRegex(self.init(self.empty())[0], "from_returns = true +# a choice")

    def empty(self):
        path = self.folder / "empty.las"
        data = bytearray(make_flight(path).read_bytes())
        begin, = struct.unpack_from("<I", data, 96)
        struct.pack_into("<I", data, 107, 0)
        struct.pack_into("<Q", data, 247, 0)
        path.write_bytes(data[:begin])
        return path

    def test_is_none_if_a_file_cannot_be_read(self):
        good, absent, text = make_flight(self.folder / "a.las"), self.folder / "absent.las", self.toml("x", "x.las")
        cut = self.folder / "cut.las"
        cut.write_bytes(good.read_bytes()[:5000])
        for bad in (absent, text, cut):
            self.assert_fails(query("init", good, bad), 1, f"{bad}: ")
        self.assert_fails(query("init"), 2, "files is required")


class FirstContact(InitTest):
    def answer(self, *arguments, code=2):
        """The answer to a command that lacks much, and the line that it gives as an example."""
        result = query(*arguments, environment=self.environment, cwd=self.folder)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\nalbtpu-query: \w+: \d+ decisions are missing \(listed above\); .*\n\Z")
        example = re.search(r"\nFor example.*\n  (albtpu-query .*)\n", result.stderr)
        return result.stderr, example and example[1]

    def assert_totals(self, line):
        result = self.run_line(line)
        self.assertEqual(result.returncode, 0, f"{line}\n{result.stderr}")
        self.assertIn("total TVU", result.stderr)

    def test_lists_all_that_las_lacks_with_an_example_that_works(self):
        las = make_flight(self.folder / "line.las")
        text, line = self.answer("las", las)
        for said in ("class 41: ", "the output is missing", "where each beam went", "--wind-speed is missing",
                     "the water surface is missing", "the size of the beam is missing", "no sensor is named",
                     "vertical datum is not decided", "water column is not decided", "\n  attitude 0.005",
                     f"albtpu-query init {las} > survey.toml"):
            self.assertIn(said, text)
        self.assertEqual(shlex.split(line)[:4], ["albtpu-query", "las", str(las), "line_tpu.las"])
        self.assert_totals(line)

    def test_counts_only_what_is_still_open(self):
        las = make_flight(self.folder / "line.las")
        text, line = self.answer("las", las, "out.las", "--scanner", "across-track", "--altitude", 390)
        self.assertNotIn("the output is missing", text)
        self.assertNotIn("where each beam went", text)
        self.assertIn("--altitude 390", line)
        self.assertNotIn("--altitude 400", line)
        self.assert_totals(line)

    def test_of_one_missing_thing_is_one_line(self):
        las = make_flight(self.folder / "line.las")
        result = self.las(las, "out.las", "--scanner", "across-track", "--water-level", 0, "--footprint", 0.6)
        self.assert_fails(result, 2, "las: --wind-speed is missing; give the wind speed")
        self.assertEqual(result.stderr.count("\n"), 1)

    def test_works_with_files_of_other_kinds(self):
        self.ship()
        self.assert_totals(self.answer("las", laz_copy(make_flight(self.folder / "a.las", 2, 0),
                                                       self.folder / "a.laz"))[1])
        self.assert_totals(self.answer("las", self.case("line.las"))[1])
        if SAMPLE.exists():
            self.assert_totals(self.answer("las", SAMPLE)[1])

    def test_gives_an_example_that_fits_what_is_given(self):
        # Its returns give the trajectory.
        survey = SimulatedSurvey(self.folder / "flight", "--seconds", 4, "--altitude", 350)
        lines = self.folder / "lines"
        lines.mkdir()
        (self.folder / "FOLDER").mkdir()
        files = [lines / name for name in ("my line.las", "b.las", "c.las")]
        for file in files:
            shutil.copy(survey.las, file)
        by_scanner = ("--scanner", "across-track")
        for inputs, flags, said in (
                ([files[0]], (), " 'my line_tpu.las' --trajectory-from-returns "),
                ([files[1]], by_scanner, "--altitude 400"),
                ([files[1]], ("--incidence", 20, "--footprint", 0.5), "--altitude 400"),
                ([files[1]], ("--wind-from", 250), "--trajectory-from-returns"),
                ([files[1]], (*by_scanner, "--wind-from", 250), "--flight-direction 0"),
                ([files[1]], ("--altitude", 400, "--divergence", 1), " --scanner across-track"),
                ([files[1]], ("--flight-direction", 30), " --scanner across-track"),
                ([files[1]], ("--crs", "EPSG:26917"), "--trajectory-from-returns"),
                ([files[1]], ("--sensor", "arete-pills"), "--divergence 1"),
                ([files[1]], ("--format", "laz"), " b_tpu.laz "),
                ([lines], (), f"{lines} --output-dir FOLDER"),
                ([lines], ("--output-dir", "FOLDER"), "--trajectory-from-returns"),
                ([lines, "FOLDER"], (), f"{lines} --output-dir FOLDER"),
                (files, (), f"'{files[0]}' {files[1]} {files[2]} --output-dir FOLDER"),
                (files, ("--output-dir", "FOLDER"), "--trajectory-from-returns"),
                ([files[1]], ("--incidence", 20, "--wind-from", 250), "--beam-azimuth 0"),
                ([files[1]], ("--beam-azimuth", 30), "--incidence 20")):
            with self.subTest(inputs=inputs, flags=flags):
                _, line = self.answer("las", *inputs, *flags)
                self.assertIn(said, line)
                if "--incidence 20" in line and "--footprint" not in line:  # A footprint of more than 2 m.
                    self.ship()
                self.assert_totals(line + " --overwrite")

    def test_gives_no_example_where_flags_cannot_close_it(self):
        las = make_flight(self.folder / "line.las")
        for flags, said in ((("--sensor", "usgs-eaarl-b"), "no source gives scan (degree) of USGS EAARL-B"),
                            (("--footprint", 1, "--divergence", 1), "the size of the beam is given twice")):
            text, line = self.answer("las", las, *flags)
            self.assertIn(said, text)
            self.assertIsNone(line)

    def test_leaves_a_survey_file_alone(self):
        las, survey = make_flight(self.folder / "line.las"), self.toml("[sea]\nwind_speed = 5\n")
        text, line = self.answer("las", las, "--survey", survey)
        self.assertNotIn("> survey.toml", text)
        self.assert_totals(line)

    def test_of_a_file_that_cannot_be_read_is_the_error_alone(self):
        (self.folder / "empty").mkdir()
        self.toml("", "empty.csv")
        for command, said in (("las absent.las", "No such file"), ("las empty", "no .las or .laz file"),
                              ("csv absent.csv --sensor riegl-vq-880-g", "No such file"),
                              ("csv empty.csv", "is empty; begin the file with a header")):
            result = query(*command.split(), cwd=self.folder)
            self.assert_fails(result, 1, said)
            self.assertEqual(result.stderr.count("\n"), 1)

    def test_lists_all_that_csv_lacks(self):
        pulses = self.toml("depth,incidence\n3,10\n5,12\n", "pulses.csv")
        text, line = self.answer("csv", pulses)
        self.assertIn("columns depth,incidence", text)
        self.assertIn("no columns 'wind_speed', 'footprint'", text)
        result = self.run_line(line)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.folder / "pulses_tpu.csv").read_text().count("INTERPOLATED"), 2)

    def test_binds_the_columns_of_csv_as_a_total_does(self):
        for columns, flags, said in (
                ("altitude,incidence,depth", (), "no column 'wind_speed'"),  # The sensor has a divergence.
                ("footprint,incidence,depth,wind_speed", ("--altitude", 400), None),
                ("footprint,incidence,depth,wind_speed", (), "no column 'altitude'"),
                ("incidence,depth,wind_speed", ("--sensor", "arete-pills"), "no column 'footprint'")):
            pulses = self.toml(f"{columns}\n" + ",".join({"altitude": "400", "footprint": "0.5"}.get(name, "5")
                                                         for name in columns.split(",")) + "\n", "pulses.csv")
            sensor = () if "--sensor" in flags else ("--sensor", "riegl-vq-880-g")
            text, line = self.answer("csv", pulses, *sensor, *flags)
            self.assertIn("how the surface was located", text)
            if said is None:
                self.assertNotIn("line 1", text)
            else:
                self.assertIn(said, text)
            self.assertEqual("'footprint'" in text, said == "no column 'footprint'", text)
            result = self.run_line(line + " --overwrite")
            self.assertEqual(result.returncode, 0, f"{line}\n{result.stderr}")


if __name__ == "__main__":
    programs.main()
