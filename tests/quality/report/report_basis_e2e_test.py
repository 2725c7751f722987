"""What a report rests on, from outside: the vertical datum that some of its files state."""

import json
import pathlib
import shutil
import sys

import netCDF4

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "programs/query"))

import programs  # noqa: E402
import reported_survey  # noqa: E402
from programs import query  # noqa: E402
from reported_survey import Report  # noqa: E402


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


if __name__ == "__main__":
    programs.main()
