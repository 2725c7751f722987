"""What a report rests on, from outside: the vertical datum that some of its files state, the specifications that hold
for its points and those that hold for land, and the annotations of its files."""

import json
import pathlib
import re
import shutil
import sys

import netCDF4

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "programs/query"))

import programs  # noqa: E402
import reported_survey  # noqa: E402
from programs import query  # noqa: E402
from reported_survey import Report, annotate  # noqa: E402


def setUpModule():
    reported_survey.make("--no-page")


class Basis(Report):
    def copy(self, change, name="copy"):
        """A copy of the survey, in place of an earlier one; `change` changes a summary, given its file's name."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.annotated, folder)
        for path in sorted(folder.glob("*.json")):
            summary = json.loads(path.read_text())
            change(path.name.removesuffix(".las.json"), summary)
            path.write_text(json.dumps(summary))
        return folder

    def report(self, folder, *flags, name="report"):
        query("report", folder, "--output", self.folder / name, "--no-page", "--overwrite", *flags, check=0)
        return json.loads((self.folder / name / "report.json").read_text())


class Datum(Basis):
    def stating(self, **names):
        """A copy of the survey in which these files alone name a vertical datum."""
        def change(name, summary):
            summary["input"].pop("vertical_datum")
            if name in names:
                summary["input"]["vertical_datum"] = names[name]

        return self.copy(change)

    def test_is_compared_with_the_first_file_that_states_one(self):
        folder, points = self.stating(flight_2="MLLW", flight_4="NAVD88"), self.folder / "points.csv"
        points.write_text("x,y,elevation\n1,2,3\n")
        first, second = folder / "first", folder / "second"
        for part, names in ((first, "123"), (second, "45")):
            part.mkdir()
            for name in names:
                for suffix in (".las", ".las.json"):
                    (folder / f"flight_{name}{suffix}").rename(part / f"flight_{name}{suffix}")
        together = shutil.copytree(first, self.folder / "together")
        shutil.copytree(second, together, dirs_exist_ok=True)
        for command in (("report", together, "--output", self.folder / "made", "--no-page"), ("crosscheck", together),
                        ("surface", together, "--output", self.folder / "made"),
                        ("surface", first, second, "--output", self.folder / "made"),
                        ("checkpoints", first, second, points)):
            with self.subTest(command[0]):
                self.assert_fails(query(*command), 1, "flight_4.las: its vertical datum is NAVD88",
                                  "flight_2.las it is MLLW", "report each datum apart")
        self.assertFalse((self.folder / "made").exists())

    def test_is_compared_with_the_first_part_of_a_surface_that_states_one(self):
        folder = self.stating(flight_2="MLLW", flight_3="NAVD88")
        parts = [self.folder / f"{number}.part" for number in (1, 2, 3)]
        for part in parts:
            query("surface", folder / f"flight_{part.stem}.las", "--partial", part, "--cell", 4, check=0)
        query("surface", "merge", *parts[:2], "--output", self.folder / "merged", check=0)
        self.assertEqual(json.loads((self.folder / "merged/surface.json").read_text())["vertical_crs"], "MLLW")
        self.assert_fails(query("surface", "merge", *parts, "--output", self.folder / "made"), 1,
                          "3.part: its vertical datum is NAVD88", "2.part it is MLLW", "make all parts alike")

    def test_is_that_of_any_file(self):
        folder = self.stating(flight_3="MLLW", flight_5="MLLW")
        self.assertEqual(self.report(folder)["vertical_datum"], "MLLW")
        with netCDF4.Dataset(self.folder / "report/grid.nc") as grid:
            self.assertEqual(grid["elevation"].vertical_datum, "MLLW")
        self.assertIsNone(self.report(self.stating())["vertical_datum"])


class OfLand(Basis):
    OWN = """
title = "Topographic lidar"
source = "Contract, section 3"
land = "rmse"
[[class]]
name = "A"
coverage = "1sigma"
vertical = {constant = %s}
"""

    def test_is_no_specification_of_points(self):
        self.assertEqual([each["name"] for each in self.json["specifications"]], ["s44", "catzoc", "noaa", "usgs"])
        classes = [each for of in self.json["specifications"] for each in of["classes"]]
        self.assertEqual([each["index"] for each in classes], list(range(len(classes))))
        for tally in (self.json["all"], *self.json["lines"], *self.json["files"], *self.json["by_depth"]):
            self.assertEqual(len(tally["meeting"]), len(classes))
        self.assertEqual([each["meeting"] for each in classes], self.json["all"]["meeting"])
        self.assertEqual({each["specification"] for each in self.json["land"]["classes"]}, {"ASPRS"})

    def test_leaves_the_verdict_on_the_bottom_to_s44(self):
        for constant, met in ((0.001, False), (0.9, True)):
            own = self.write("own.toml", self.OWN % constant)
            for flags, order in (((), "1b"), (("--s44-order", "special"), "special")):
                result = query("report", self.annotated, "--output", self.folder / "report", "--no-page", "--overwrite",
                               "--spec", own, *flags, check=0)
                report = json.loads((self.folder / "report/report.json").read_text())
                self.assertEqual((report["wanted"]["specification"], report["wanted"]["class"]), ("IHO S-44", order))
                self.assertIn("Topographic lidar: its limits are root mean square errors", result.stderr)
                self.assertIn(f"the verdict on the bottom is that of IHO S-44 {order}", result.stderr)
                self.assertEqual([each["met"] for each in report["land"]["classes"]
                                  if each["specification"] == "Topographic lidar"], [met])
                self.assertIn(f"; Topographic lidar {'A' if met else 'no class'}; ASPRS", result.stdout)
        self.assertEqual(self.report(self.annotated)["wanted"], self.json["wanted"])

    def test_has_no_class_for_points(self):
        self.assert_fails(query("report", self.annotated, "--output", self.folder / "made", "--spec", "asprs",
                                "--class", "10 cm"), 2, "--class", "ASPRS", "root mean square errors of land",
                          "--s44-order")
        self.assertFalse((self.folder / "made").exists())


class Annotation(Basis):
    def setUp(self):
        super().setUp()
        self.other = self.folder / "other"
        annotate(self.flight, self.other, self.one_table, datum=0.5)
        sizes = [{path.name: path.stat().st_size for path in folder.glob("*.las")}
                 for folder in (self.annotated, self.other)]
        self.assertEqual(*sizes)

    def test_decides_what_resume_keeps(self):
        made, report = self.folder / "report", self.folder / "report/report.json"

        def resume(folder):
            return query("report", folder, "--output", made, "--no-page", "--resume", check=0).stderr

        self.assertNotIn("already", resume(self.annotated))
        self.assertIn("already", resume(self.annotated))
        self.assertNotIn("already", resume(self.other))
        self.assertGreater(json.loads(report.read_text())["all"]["tvu"]["mean"], self.json["all"]["tvu"]["mean"] + 0.5)
        self.assertIn("already", resume(self.other))
        # Reports of before do not state the annotations.
        json_of_before = json.loads(report.read_text())
        for file in json_of_before["made_from"]["files"]:
            file.pop("summary_digest")
        report.write_text(json.dumps(json_of_before))
        self.assertNotIn("already", resume(self.other))

    def test_is_that_of_the_surface(self):
        made, flags = self.folder / "report", ("--no-page", "--overwrite")
        files = sorted(self.annotated.glob("*.las"))
        parts = [self.folder / name for name in ("a.part", "b.part")]
        for part, of_part in zip(parts, (files[1::2], files[::2])):
            query("surface", *of_part, "--partial", part, "--cell", 4, check=0)
        query("surface", "merge", *parts, "--output", self.folder / "merged", check=0)
        for name, folder in (("surface", self.annotated), ("of_other", self.other)):
            query("surface", folder, "--output", self.folder / name, "--cell", 4, check=0)
        for name in ("surface", "merged"):
            query("report", self.annotated, "--output", made, "--surface", self.folder / name, *flags, check=0)
        for name, folder in (("of_other", self.annotated), ("merged", self.other)):
            result = query("report", folder, "--output", made, "--surface", self.folder / name, *flags)
            self.assert_fails(result, 1, "--surface: is of other files or annotations",
                              "give the surface that was made of them")
        json_of_before = self.folder / "merged/surface.json"
        surface = json.loads(json_of_before.read_text())
        surface.pop("annotations_digest")
        json_of_before.write_text(json.dumps(surface))
        result = query("report", self.annotated, "--output", made, "--surface", self.folder / "merged", *flags)
        self.assert_fails(result, 1, "surface.json is none of albtpu-query surface", "make it again")


class Sea(Basis):
    WAVES = "[[sea.waves]]\nhs = 0.4\ntp = 3\nwaves_from = 250\n"

    def test_is_given_again_where_files_were_annotated_with_waves(self):
        survey = self.folder / "waves.toml"
        survey.write_text(reported_survey.SURVEY.format(flight=self.flight, datum=0.05, coverage="p95").replace(
            "[sea]\nwind_speed = 5\nwind_from = 250\n", self.WAVES))
        folder, flags = self.folder / "waves", ("--hs", 0.4, "--tp", 3, "--waves-from", 250)
        folder.mkdir()
        query("las", self.flight, "--output-dir", folder, "--survey", survey, check=0)
        without, by_survey, by_flags = (self.report(folder, *given) for given in ((), ("--survey", survey), flags))
        self.assertFalse(without["crosscheck"]["sea_known"])
        self.assertTrue(by_survey["crosscheck"]["sea_known"])
        self.assertEqual(by_survey["crosscheck"], by_flags["crosscheck"])
        checked = json.loads(query("crosscheck", folder, "--json", "--survey", survey, check=0).stdout)
        self.assertEqual({key: by_survey["crosscheck"][key] for key in checked}, checked)
        # Waves are a part of what a report is made from.
        for again, said in ((flags, True), ((), False)):
            stderr = query("report", folder, "--output", self.folder / "report", "--no-page", "--resume", *again,
                           check=0).stderr
            self.assertEqual("already" in stderr, said, again)
        of_other = self.folder / "of_other"
        for annotated, given, message in (
                (self.annotated, flags, "was annotated for a wind, not for the waves that are given"),
                (folder, (*flags, "--tail", "none"), 'its tail is "relax", and that of the given one is "none"'),
                (folder, ("--hs", 0.5, "--tp", 3, "--waves-from", 250), "its hs is 0.4, and that of the given one is"),
                (folder, (*flags, "--wind-speed", 9), "was annotated for another sea: its wind_speed")):
            result = query("report", annotated, "--output", of_other, "--no-page", *given)
            self.assert_fails(result, 1, message)
        result = query("report", folder, "--output", of_other, "--no-page", "--wind-speed", 5)
        self.assert_fails(result, 2, "--wind-speed and --wind-from have no effect without waves")


class Directions(Basis):
    def test_are_wanted(self):
        survey, folder = self.folder / "angles.toml", self.folder / "angles"
        survey.write_text(re.sub(r"\[trajectory\]\n.*\n.*\n", "", reported_survey.SURVEY.format(
            flight=self.flight, datum=0.05, coverage="p95").replace("wind_from = 250\n", "")))
        folder.mkdir()
        query("las", self.flight, "--output-dir", folder, "--survey", survey, "--table", self.one_table,
              "--incidence", 20, "--altitude", 400, check=0)
        points = self.folder / "points.csv"
        points.write_text("x,y,elevation\n500000,4000000,-5\n")
        for command in (("report", folder, "--output", self.folder / "report", "--no-page"), ("crosscheck", folder),
                        ("surface", folder, "--output", self.folder / "surface"), ("checkpoints", folder, points)):
            with self.subTest(command[0]):
                self.assert_fails(query(*command), 1, "was annotated without the directions of its beams",
                                  "give --beam-azimuth or --flight-direction")


if __name__ == "__main__":
    programs.main()
