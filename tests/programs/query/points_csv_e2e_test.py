"""The points of LAS and LAZ files as CSV, against the annotated LAS that NumPy reads."""

import csv
import json

import numpy as np

import programs
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

TOTAL = """[sensor]
name = "riegl-vq-880-g"
[trajectory]
files = ["{flight}/sbet.out"]
[surface]
level = {level}
[sea]
wind_speed = 6
wind_from = 100
[datum]
sigma = 0.08
[water]
column = "none"
[output]
coverage = "p95"
"""
COLUMNS = ["gps_time [s]", "x [m]", "y [m]", "z [m]", "total_thu [m; 95 %]", "total_tvu [m; 95 %]", "class"]


def rows_of(path):
    with open(path, newline="") as file:
        lines = list(csv.reader(file))
    return lines[0], lines[1:]


class PointsCsvTest(programs.Test):
    def setUp(self):
        super().setUp()
        self.flight = SimulatedSurvey(self.folder / "flight", "--seconds", 6, "--pulse-rate", 3000)
        self.survey = self.toml(TOTAL.format(flight=self.flight.folder, level=self.flight.water_level))

    def annotate(self, *arguments, code=0):
        result = query("las", *arguments, "--survey", self.survey, "--table", self.table)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def compare(self, path, las, names=("total_thu", "total_tvu"), head=COLUMNS):
        """The rows are the points of an annotated file."""
        found, rows = rows_of(path)
        self.assertEqual(found, head)
        self.assertEqual(len(rows), las.point_count)
        columns = list(zip(*rows))
        time = las.field(22 if las.point_format >= 6 else 20, "<f8")
        np.testing.assert_array_equal(np.array(columns[0], float), time)  # Every bit.
        for axis in range(3):
            place = las.field(4 * axis, "<i4") * las.scale[axis] + las.offset[axis]
            np.testing.assert_allclose(np.array(columns[1 + axis], float), place, rtol=0, atol=1e-3 * las.scale[axis])
            self.assertLess(max(map(len, columns[1 + axis])), 14)
        dimensions = las.extra_dimensions()
        for name, column in zip(names, columns[4:6]):
            number = las.field(dimensions[name][0], "<f4")
            none = number == -1
            self.assertLessEqual({text for text, empty in zip(column, none) if empty}, {""})
            given = np.array([text for text, empty in zip(column, none) if not empty], np.float32)
            np.testing.assert_array_equal(given, number[~none])
            self.assertGreater(len(given), 100)
        np.testing.assert_array_equal(np.array(columns[6], int), las.classes)
        return rows

    def test_has_each_point_of_the_annotated_file(self):
        both = self.folder / "both.csv"
        self.annotate(self.flight.las, self.folder / "out.las", "--csv", both)
        las = LasFile(self.folder / "out.las")
        self.compare(both, las)
        summary = json.loads((self.folder / "out.las.json").read_text())
        self.assertEqual(summary["output"]["csv"], {"name": "both.csv", "bytes": both.stat().st_size})
        # Alone, beside LAZ, and from LAZ: the same bytes.
        alone, laz = self.folder / "alone.csv", self.folder / "out.laz"
        self.annotate(self.flight.las, "--csv", alone)
        self.assertEqual(alone.read_bytes(), both.read_bytes())
        summary = json.loads((self.folder / "alone.csv.json").read_text())
        self.assertEqual(summary["output"], {"name": "alone.csv", "bytes": alone.stat().st_size, "format": "CSV"})
        self.assertGreater(summary["answers"]["total"]["pulses"], 100)
        self.annotate(self.flight.las, laz, "--csv", self.folder / "of_laz.csv")
        self.assertEqual((self.folder / "of_laz.csv").read_bytes(), both.read_bytes())
        packed = programs.laz_copy(self.flight.las, self.folder / "packed.laz")
        self.annotate(packed, "--csv", self.folder / "packed.csv")
        self.assertEqual((self.folder / "packed.csv").read_bytes(), both.read_bytes())
        # Numbers that replace those of an earlier run, with details.
        self.annotate(self.folder / "out.las", self.folder / "again.las", "--replace", "--details", "--csv",
                      self.folder / "again.csv")
        self.assertEqual((self.folder / "again.csv").read_bytes(), both.read_bytes())
        self.annotate(self.folder / "out.las", "--csv", self.folder / "of_annotated.csv")
        self.assertEqual((self.folder / "of_annotated.csv").read_bytes(), both.read_bytes())

    def test_names_units_and_leaves_out_what_is_not_known(self):
        las = programs.make_flight(self.folder / "line.las")
        out = self.folder / "line_out.las"
        query("las", las, out, "--table", self.table, *programs.FLAGS, "--csv", self.folder / "line.csv", "--units",
              "us-ft", check=0)
        head = ["gps_time [s]", "x [us-ft]", "y [us-ft]", "z [us-ft]", "sea_thu [m; 95 %]", "sea_tvu [m; 95 %]",
                "class"]
        found, rows = rows_of(self.folder / "line.csv")
        self.assertEqual(found[4:], head[4:])
        self.assertEqual(found[3], head[3])
        numbers = LasFile(out).columns()["sea_thu"]
        self.assertEqual([row[4] == "" for row in rows], [number == -1 for number in numbers])
        self.assertTrue((numbers == -1).any() and (numbers >= 0).any())
        feet = SimulatedSurvey(self.folder / "feet", "--seconds", 2, "--grid", "florida-east-ft")
        survey = self.toml(TOTAL.format(flight=feet.folder, level=feet.water_level), "feet.toml")
        query("las", feet.las, "--csv", self.folder / "feet.csv", "--survey", survey, "--table", self.table, "--units",
              "us-ft", check=0)
        self.assertEqual(rows_of(self.folder / "feet.csv")[0][1:4], ["x [us-ft]", "y [us-ft]", "z [us-ft]"])

    def test_of_several_inputs_is_a_file_each(self):
        lines = SimulatedSurvey(self.folder / "lines", "--seconds", 3, "--lines", 2, "--file-for-each-line",
                                "--pulse-rate", 3000)
        self.survey = self.toml(TOTAL.format(flight=lines.folder, level=lines.water_level))
        annotated, tables = self.folder / "annotated", self.folder / "tables"
        alone = self.folder / "alone"
        for folder in (annotated, tables, alone):
            folder.mkdir()
        self.annotate(lines.folder, "--output-dir", annotated, "--csv", tables)
        self.annotate(lines.folder, "--csv", alone)
        for name in ("flight_1", "flight_2"):
            self.compare(tables / f"{name}.csv", LasFile(annotated / f"{name}.las"))
            self.assertEqual((alone / f"{name}.csv").read_bytes(), (tables / f"{name}.csv").read_bytes())
        # What is complete is kept, and made anew where the CSV is gone.
        again = self.annotate(lines.folder, "--output-dir", annotated, "--csv", tables, "--resume")
        self.assertEqual(again.stderr.count("already complete"), 2)
        (tables / "flight_2.csv").unlink()
        self.annotate(lines.folder, "--output-dir", annotated, "--csv", tables, "--resume", code=1)
        again = self.annotate(lines.folder, "--output-dir", annotated, "--csv", tables, "--resume", "--overwrite")
        self.assertEqual(again.stderr.count("already complete"), 1)
        self.assertEqual((tables / "flight_2.csv").read_bytes(), (alone / "flight_2.csv").read_bytes())
        result = self.annotate(lines.folder, "--output-dir", annotated, "--csv", self.folder / "one.csv", code=2)
        self.assert_fails(result, 2, "is no folder", "give one that exists")

    def test_is_whole_or_not_at_all(self):
        taken = self.folder / "taken.csv"
        taken.write_text("mine")
        out = self.folder / "out.las"
        result = self.annotate(self.flight.las, out, "--csv", taken, code=1)
        self.assertIn("already exists", result.stderr)
        self.assertEqual(taken.read_text(), "mine")
        self.assertFalse(out.exists())
        # A file whose points end too early leaves neither.
        cut = self.folder / "cut.las"
        cut.write_bytes(self.flight.las.read_bytes()[:-40])
        for arguments in ((cut, out, "--csv", self.folder / "cut.csv"), (cut, "--csv", self.folder / "cut.csv")):
            self.annotate(*arguments, code=1)
            self.assertEqual([path.name for path in self.folder.iterdir() if "cut" in path.name], ["cut.las"])
            self.assertFalse(out.exists())
        for arguments, part in (((self.flight.las, out, "--csv", out), "two outputs would be called"),
                                ((self.flight.las, "--csv", self.folder / "a.csv", "--format", "laz"),
                                 "--format has no effect")):
            self.assert_fails(self.annotate(*arguments, code=2), 2, part)
        result = self.annotate(self.flight.las, "--csv", self.flight.las, "--overwrite", code=1)
        self.assertIn("is the input itself", result.stderr)
        self.assertEqual(LasFile(self.flight.las).bytes[:4], b"LASF")


if __name__ == "__main__":
    programs.main()
