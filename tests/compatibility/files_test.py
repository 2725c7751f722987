"""albtpu-query reads the files that earlier versions read and wrote, and makes the same of them.

Usage: files_test.py NAME=PATH...      albtpu_query, albtpu_generate and laz_copy
"""

import json
import pathlib
import shutil
import sys
import unittest

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "programs/query"))
from runs import ANNOTATE, JUDGE, PRINT, VERSIONS, copy_input, make  # noqa: E402

import albtpu  # noqa: E402
import differences  # noqa: E402
import wire  # noqa: E402
from commands import FolderTest, run  # noqa: E402
from differences import read_json  # noqa: E402

AS_0_1_0 = ("--points", "bathymetric")  # With a sensor; since then dry points have a total, too.
PATHS = dict(argument.split("=", 1) for argument in sys.argv[1:])
QUERY = PATHS["albtpu_query"]
OF_A_SEA = ("waves.json",)  # The digest of a sea is that of one instruction set.


class Files(FolderTest):
    def each_version(self, *written):
        """Each version and a folder with its input, and with those of its files that `written` names."""
        for version in VERSIONS:
            folder = self.folder / version.name
            copy_input(version, folder)
            for name in written:
                for path in version.glob(name):
                    shutil.copy(path, folder / path.relative_to(version))
            yield version, folder

    def assert_as_recorded(self, version, folder, *patterns):
        compared = [path for pattern in patterns for path in sorted(version.glob(pattern))]
        self.assertTrue(compared)
        for path in compared:
            found = folder / path.relative_to(version)
            if path.suffix == ".laz":
                for source, name in ((path, "recorded.las"), (found, "found.las")):
                    run(PATHS["laz_copy"], source, folder / name).check_returncode()
                path, found = folder / "recorded.las", folder / "found.las"
            ignored = ("digest",) if path.name in OF_A_SEA else ("bytes",)  # The details of a total have grown.
            with differences.corrected():
                self.assertEqual(differences.of_files(path, found, ignored), [])

    def test_differences_are_seen(self):
        old = {"thu": 0.25, "files": [{"name": "a.las"}], "unknown": ["scan"], "sea": None}
        for new, found in (({**old, "thu": 0.25001}, ".thu is 0.25001, not 0.25"),
                           ({**old, "thu": None}, ".thu is None"), ({**old, "files": []}, ".files is []"),
                           ({**old, "files": [{}]}, ".files[0].name is gone"),
                           ({**old, "unknown": ["time"]}, ".unknown is ['time']")):
            (line,) = differences.of_json(old, new)
            self.assertIn(found, line)
        self.assertEqual(list(differences.of_json(old, {**old, "thu": 0.2500001, "sea": 1, "more": 2})), [])

    def test_the_same_input_gives_the_same_files(self):
        for version, folder in self.each_version():
            make(QUERY, folder, ANNOTATE[:1], *AS_0_1_0)
            make(QUERY, folder, ANNOTATE[1:] + PRINT)
            self.assert_as_recorded(version, folder, "annotated/*", "*.csv", "*.laz", "*.csv.json", "*.laz.json",
                                    *(name for name, *_ in PRINT))

    def test_plain_answers_are_the_same_at_the_index_of_their_table(self):
        for version, folder in self.each_version():
            make(QUERY, folder, (ANNOTATE[2], PRINT[0]), "--water-index", "1.33")
            for name in ("answers.csv", "pulse.json"):
                self.assertEqual(differences.of_files(version / name, folder / name), [])

    def test_annotated_files_give_the_same_report_and_crosscheck(self):
        for version, folder in self.each_version("annotated/*"):
            make(QUERY, folder, JUDGE)
            self.assert_as_recorded(version, folder, "report/report.json", "crosscheck.json")

    def resume(self, folder, arguments):
        return run(QUERY, *arguments[1:], "--resume", cwd=folder, environment={"ALBTPU_TABLES": str(folder / "tables")})

    def test_outputs_of_before_the_correction_of_the_index_are_not_kept_by_resume(self):
        for _, folder in self.each_version("annotated/*", "sea.laz*", "answers.csv*"):
            for arguments, flags in zip(ANNOTATE, (AS_0_1_0, (), ())):
                result = self.resume(folder, (*arguments, *flags))
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertRegex(result.stderr, "sea_index is null there.*; add --overwrite")

    def test_resume_refuses_a_summary_of_0_1_0_that_does_not_state_the_wind(self):
        # Totals of CSV files had the wind of the survey file, but their summaries did not state it.
        (folder,) = (folder for version, folder in self.each_version("total_answers.csv*") if version.name == "0.1.0")
        result = self.resume(folder, ANNOTATE[3])
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(result.stderr, "total_answers.csv: .*wind_speed is null there.*; add --overwrite")

    def test_tables_of_seas_give_the_same_answers(self):
        for version, folder in self.each_version():
            answers = wire.load(version / "wire")
            file = next(response for response in (wire.parse(wire.method_of(path).output_type, data)
                                                  for path, _, data in answers if path.endswith("/CompileSea"))
                        if response.file).file
            (folder / "sea.h5").write_bytes(file)
            recorded = read_json(version / "python.json")["in process"]
            answer = albtpu.open_table(folder / "sea.h5").query(incidence=[5, 10, 20, 30], footprint=0.5,
                                                                depth=[1, 5, 10, 10], azimuth=45,
                                                                refractive_index=1.33)
            self.assertEqual(list(differences.of_json(recorded["thu"], answer.thu.tolist())), [])
            pulse = run(QUERY, "pulse", "--table", folder / "sea.h5", "--wind-speed", 5, "--incidence", 10,
                        "--footprint", 0.5, "--depth", 5, "--azimuth", -45, "--water-index", 1.33, "--coverage",
                        "2sigma", "--json")
            # The package has the azimuth of the table's frame, which is counterclockwise.
            second = {name: recorded[name][1] for name in ("thu", "tvu")}
            self.assertEqual(list(differences.of_json(second, json.loads(self.assert_succeeds(pulse)))), [])

    def test_campaigns_can_be_planned(self):
        for _, folder in self.each_version():
            self.assert_succeeds(run(PATHS["albtpu_generate"], "plan", "--campaign", folder / "campaign.toml"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
