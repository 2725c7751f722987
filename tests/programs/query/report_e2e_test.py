"""albtpu-query report, from outside: its numbers, the grid in other programs, the page in a browser."""

import json
import re
import shutil
import struct
import subprocess
import unittest

import netCDF4
import numpy as np

import programs
import reported_survey
from commands import make_folder
from las_file import LasFile
from page_probe import print_page, probe
from programs import query
from reported_survey import Report


def setUpModule():
    reported_survey.make()


class Numbers(Report):
    def test_add_up_to_the_points_of_the_files(self):
        points, answered = self.points, self.points["total_tvu"] >= 0
        report = self.json
        self.assertEqual(report["all"]["points"], len(answered))
        self.assertEqual(report["all"]["with_number"], answered.sum())
        self.assertEqual(sum(line["points"] for line in report["lines"]), len(answered))
        self.assertEqual(sum(each["points"] for each in report["files"]), len(answered))
        self.assertEqual(sum(each["points"] for each in report["by_depth"]), answered.sum())
        self.assertEqual(sum(each["points"] for each in report["depth_bands"]), answered.sum())
        self.assertEqual(sum(report["histograms"]["tvu"]["counts"]), answered.sum())
        self.assertEqual(sum(report["wanted"]["without_number"].values()), (~answered).sum())
        self.assertAlmostEqual(report["all"]["tvu"]["mean"], points["total_tvu"][answered].mean(), delta=1e-6)

    def test_of_points_that_meet_an_order_are_right(self):
        of = {name: values[self.points["total_tvu"] >= 0] for name, values in self.points.items()}
        depth = of["water_depth"]
        within = 1.959964 * np.sqrt(of["VarianceZ"]) + abs(of["bias_vertical"]) <= np.hypot(0.25, 0.0075 * depth)
        # The radius is at most 2.448 times the larger sigma: in these surveys far below the limit of 2 m.
        special = next(each for each in self.json["specifications"][0]["classes"] if each["name"] == "special")
        self.assertGreater(special["meeting"], 0)
        self.assertLess(abs(special["meeting"] - within.sum()), 1e-3 * within.size)
        # The same as the summaries of the files say of the total.
        summaries = [json.loads(path.read_text()) for path in self.annotated.glob("*.las.json")]
        met = sum(each["answers"]["total"]["all"]["s44_met"]["special"] for each in summaries)
        self.assertLess(abs(special["meeting"] - met), 5)

    def test_tell_the_datum_from_what_the_surveyor_adds(self):
        answered = self.points["total_tvu"] >= 0
        np.testing.assert_allclose(self.points["tvu_extra"][answered], 1.959964 * 0.04, rtol=1e-6)
        vertical = self.points["VarianceZ"][answered].sum(dtype=float)
        for name, sigma in (("extra", 0.04), ("datum", 0.05)):
            expected = sigma**2 * answered.sum() / vertical
            self.assertAlmostEqual(self.json["all"]["shares_vertical"][name], expected, delta=1e-4, msg=name)
        page = (self.made / "report.html").read_text()
        self.assertIn("<th>added by the surveyor</th>", page)
        self.assertIn("extra_vertical", [each["name"] for each in self.json["numbers"]])

    def test_have_the_assumptions_with_their_sources(self):
        numbers = {each["name"]: each for each in self.json["numbers"]}
        self.assertTrue(numbers["boresight"]["assumed"])
        self.assertFalse(numbers["scan"]["assumed"])
        self.assertIn("cBLUE", numbers["scan"]["source"])


class Land(Report):
    def dry(self):
        """Classes and numbers of the dry points, and which of them are of the water surface."""
        files = [LasFile(path) for path in sorted(self.annotated.glob("*.las"))]
        columns = [each.columns() for each in files]
        classes = np.concatenate([each.classes for each in files])
        of = {name: np.concatenate([each[name] for each in columns]) for name in columns[0]}
        dry = of["share_of"] == 1
        return classes[dry], {name: values[dry] for name, values in of.items()}, np.isin(classes[dry], (9, 41, 42))

    def test_has_its_table_by_root_mean_square_errors(self):
        classes, of, surface = self.dry()
        land = self.json["land"]
        self.assertGreater((~surface).sum(), 100)
        self.assertEqual(land["points"], (~surface).sum())
        self.assertEqual(land["water_surface_points"], surface.sum())
        horizontal, vertical = of["VarianceX"][~surface] + of["VarianceY"][~surface], of["VarianceZ"][~surface]
        for name, variance in (("horizontal", horizontal), ("vertical", vertical)):
            rmse = np.sqrt(variance.mean(dtype=float))
            self.assertAlmostEqual(land[f"rmse_{name}"], rmse, delta=1e-6)
            self.assertAlmostEqual(land[f"sigma_{name}"]["median"], np.median(np.sqrt(variance)), delta=0.01 * rmse)
        self.assertAlmostEqual(land["rmse_3d"], np.sqrt((horizontal + vertical).mean(dtype=float)), delta=1e-6)
        self.assertEqual({each["class"]: each["points"] for each in land["by_class"]},
                         {int(each): int((classes[~surface] == each).sum()) for each in set(classes[~surface])})
        # Summaries count points of the water surface among the dry ones.
        summaries = [json.loads(path.read_text()) for path in self.annotated.glob("*.las.json")]
        self.assertEqual(sum(each["answers"]["dry"]["points"] for each in summaries), len(classes))

    def test_takes_no_part_in_the_verdict(self):
        self.assertEqual(self.json["wanted"]["points"], len(self.points["x"]))
        self.assertIn(f"{self.json['land']['points']} dry points of land: RMSE", self.said)

    def test_is_held_against_classes_with_the_errors_of_check_points(self):
        report = self.folder / "checked"
        query("report", self.annotated, "--output", report, "--check-points-vertical", 0.1,
              "--check-points-horizontal", 0.2, "--no-page", check=0)
        land, before = json.loads((report / "report.json").read_text())["land"], self.json["land"]
        for name, of_check in (("horizontal", 0.2), ("vertical", 0.1)):
            rmse = before[f"rmse_{name}"]
            self.assertEqual(land[f"rmse_{name}"], rmse)
            self.assertEqual(before["against"][f"judged_{name}"], rmse)
            self.assertAlmostEqual(land["against"][f"difference_{name}"], np.hypot(rmse, of_check))
            self.assertAlmostEqual(land["against"][f"judged_{name}"], np.sqrt(rmse**2 + 2 * of_check**2))
        for made in (land, before):
            met = {each["name"]: each["met"] for each in made["classes"]}
            self.assertEqual(met, {f"{cm:g} cm": made["against"]["judged_vertical"] <= cm / 100
                                   for cm in (5, 10, 15, 20, 33.3)})

    def test_has_a_table_on_the_page(self):
        page = (self.made / "report.html").read_text()
        table = page[page.index("<h2>Land</h2>"):]
        self.assertIn(f"<td>{self.json['land']['rmse_vertical']:.3f}</td>", table[:table.index("</table>")])
        self.assertIn("IHO S-44, edition 6.1.0 (2022)", page)


class Grid(Report):
    def test_has_the_means_of_its_cells(self):
        points = self.points
        answered = points["total_tvu"] >= 0
        with netCDF4.Dataset(self.made / "grid.nc") as grid:
            x, y = grid["x"][:], grid["y"][:]
            column = np.floor(points["x"] - (x[0] - 0.5)).astype(int)
            row = (np.floor(y[0]) - np.floor(points["y"])).astype(int)
            counts = np.zeros((len(y), len(x)), int)
            np.add.at(counts, (row, column), 1)
            np.testing.assert_array_equal(grid["points"][:].filled(-1), counts)
            with_number = np.zeros_like(counts)
            np.add.at(with_number, (row[answered], column[answered]), 1)
            np.testing.assert_array_equal(grid["points_without_number"][:].filled(-1), counts - with_number)
            for name, of_points in (("tvu", "total_tvu"), ("thu", "total_thu"), ("depth", "water_depth")):
                sums = np.zeros(counts.shape)
                np.add.at(sums, (row[answered], column[answered]), points[of_points][answered])
                values = grid[name][:]
                np.testing.assert_array_equal(np.ma.getmaskarray(values), with_number == 0)
                np.testing.assert_allclose(values.compressed(), (sums / np.maximum(with_number, 1))[with_number > 0],
                                           rtol=1e-5)
            # Why: these points have a beam and no surface, or lie above it.
            gap = np.ma.filled(grid["gap"][:], 0)
            np.testing.assert_array_equal(gap > 0, counts > with_number)
            self.assertEqual(grid["gap"].flag_meanings.split()[2], "no_water_surface")
            shares = sum(grid[f"share_{name}"][:] for name in ("air", "sea", "water", "datum", "extra"))
            np.testing.assert_allclose(shares.compressed(), 1, atol=1e-5)
            self.assertEqual(grid["dominant_share"].flag_meanings, "air sea water datum extra")

    def test_is_opened_by_gdal(self):
        info = json.loads(subprocess.run(["gdalinfo", "-json", f"NETCDF:{self.made / 'grid.nc'}:tvu"], check=True,
                                         capture_output=True, text=True).stdout)
        self.assertIn("UTM zone 17N", info["coordinateSystem"]["wkt"])
        self.assertEqual(info["geoTransform"][1], 1)
        self.assertEqual(info["geoTransform"][5], -1)
        self.assertAlmostEqual(info["geoTransform"][0] % 1, 0)
        self.assertLess(info["geoTransform"][0], self.points["x"].min())
        self.assertGreater(info["geoTransform"][3], self.points["y"].max())

    def test_leaves_out_files_whose_names_begin_with_a_dot(self):
        folder = self.folder / "annotated"
        shutil.copytree(self.annotated, folder)
        (folder / ".half.las").write_bytes(sorted(folder.glob("*.las"))[0].read_bytes()[:1000])
        report = self.folder / "visible"
        result = query("report", folder, "--output", report, "--no-page", check=0)
        self.assertNotIn(".half", result.stderr)
        with netCDF4.Dataset(report / "grid.nc") as grid:
            self.assertEqual(grid["points"][:].sum(), len(self.points["x"]))

    def test_takes_the_cell_that_is_asked_for(self):
        report = self.folder / "coarse"
        query("report", self.annotated, "--output", report, "--cell", 25, "--no-page", check=0)
        self.assertFalse((report / "report.html").exists())
        with netCDF4.Dataset(report / "grid.nc") as grid:
            self.assertEqual(grid["x"][1] - grid["x"][0], 25)
            self.assertEqual(grid["points"][:].sum(), len(self.points["x"]))


class Page(Report):
    @unittest.skipIf(shutil.which("chromium") is None, "no Chromium")
    def test_fits_a_telephone_and_a_desk(self):
        for width, height in ((390, 844), (1280, 900)):
            # A headless window may be wider than a telephone: the content is held against the width that it got.
            seen = probe(self.made / "report.html", self.folder, width, height)
            self.assertLessEqual(seen["content"], max(seen["width"], width), seen)
            self.assertEqual(seen["broken"], 0)
            self.assertGreaterEqual(seen["images"], 13)
            self.assertEqual(seen["first"], "1")
            if width == 1280:
                self.assertLess(seen["below"], height)  # The verdict is on the first screen.

    def test_is_drawn_by_the_python_that_the_environment_names(self):
        result = query("report", self.annotated, "--output", self.folder / "undrawn",
                       environment={"ALBTPU_PYTHON": "/nonexistent/python"})
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("(/nonexistent/python: No such file or directory); install python3-matplotlib", result.stderr)

    def test_has_nothing_from_outside(self):
        page = (self.made / "report.html").read_text()
        self.assertEqual(re.findall(r"""(?:src|href)=["'](?!data:)[^"']*""", page), [])
        self.assertNotRegex(page, r"url\(|@import|https?://")

    def test_says_whether_the_survey_passes_where_not_and_why(self):
        page = (self.made / "report.html").read_text()
        wanted = self.json["wanted"]
        self.assertIn(f"THU and TVU are {'' if wanted['passes'] else 'not '}within the limits of IHO S-44 1b", page)
        self.assertIn("no water surface known above them", page)
        self.assertRegex(page, "Prediction and overlap agree|Overlapping lines contradict")
        self.assertIn("Not tested, because these files cannot show it: coverage", page)
        self.assertIn("boresight", page)
        self.assertIn("are within the limits" if wanted["passes"] else "are NOT within the limits", self.said)

    def test_has_every_class_by_depth_line_and_file(self):
        page = (self.made / "report.html").read_text()
        classes = sum(len(each["classes"]) for each in self.json["specifications"])
        for what, rows in (("depth [m]", self.json["depth_bands"]), ("line", self.json["lines"]),
                           ("file", self.json["files"])):
            tables = [each for each in re.findall(r"<table.*?</table>", page, re.S)
                      if each.count("<th>") == classes + 1 and f"<th>{what}</th>" in each]
            self.assertEqual(len(tables), 1, what)
            cells = re.findall(r"<td>(.*?)</td>", tables[0], re.S)
            self.assertEqual(len(cells), (classes + 1) * len(rows), what)
            for row, of in enumerate(rows):
                for index, met in enumerate(of["meeting"]):
                    cell = cells[row * (classes + 1) + 1 + index].replace("< ", "").replace("> ", "")
                    cell = re.sub("<.*?>", "", cell)
                    points = of["with_number"] if what.startswith("depth") else of["points"]
                    self.assertAlmostEqual(float(cell.split()[0]), 100 * met / points, delta=1.01)


class Raised(Report):
    """The first screen of the same lines, one of which lies too high."""

    def test_says_which_line_lies_too_high_and_what_was_assumed(self):
        folder, made = self.folder / "raised", self.folder / "of_raised"
        shutil.copytree(self.annotated, folder)
        with (folder / "flight_2.las").open("r+b") as file:
            for at in (171, 211, 219):  # Offset, maximum and minimum of z.
                file.seek(at)
                value, = struct.unpack("<d", file.read(8))
                file.seek(at)
                file.write(struct.pack("<d", value + 0.5))
        for path in folder.glob("*.las.json"):  # As if nothing of the trajectory had been stated.
            summary = json.loads(path.read_text())
            summary["parameters"]["total"]["numbers"]["position"]["assumed"] = True
            summary["answers"]["total"]["sources"]["assumed"] = {"horizontal": 0.1, "vertical": 0.5}
            path.write_text(json.dumps(summary))
        said = query("report", folder, "--output", made, check=0).stdout
        page, report = (made / "report.html").read_text(), json.loads((made / "report.json").read_text())
        self.assertIs(report["crosscheck"]["agrees"], False)
        self.assertIn("; overlapping lines contradict the prediction", said.splitlines()[1])
        self.assertRegex(page, "(but|and) overlapping lines contradict the prediction</b>")
        self.assertNotIn('class="verdict pass"', page)
        above, lines = re.search(r"Line 2 lies above all (\d+) lines that it overlaps, by ([\d.]+) m", page).groups()
        self.assertGreater(int(above), 1)
        self.assertAlmostEqual(float(lines), 0.5, delta=0.15)
        self.assertIn("More than a third of the variance, 50.0 %, rests on assumed numbers.", page)
        share = 100 * report["assumed"]["sources"]["position"]["vertical"]
        self.assertIn("state the uncertainty of the position of the trajectory; the assumed one makes"
                      f" {share:.1f} % of the vertical variance.", page)


class Named(Report):
    def test_has_project_datum_plan_and_appendix(self):
        page = (self.made / "report.html").read_text()
        for words in ("<h1>Harbour of Mine</h1>", "The port&#x27;s &lt;office&gt;", "Chart datum of Mine",
                      "B.2.2 Sources and values", "plan of 5 lines", "Density and voids",
                      f"<td>{self.json['contributions'][-1]['sigma_horizontal']['sea']:.3f}</td>"):
            self.assertIn(words, page)
        for folder in (self.annotated.parent, self.flight):
            self.assertNotIn(str(folder), page)
        table = f"table {self.json['table']['id']}, version {self.json['table']['version']}"
        self.assertIn(f"<td>{table}</td>", page)
        self.assertIn(f"Water-surface model used for refraction: {table}.", page)


@unittest.skipIf(shutil.which("chromium") is None, "no Chromium")
class Paper(Report):
    def test_cuts_no_column_on_a_desk_and_on_paper(self):
        # The text of A4, the narrower one, is 182 mm wide, at 96 dots in an inch.
        for width, printed in ((1280, False), (688, True)):
            seen = probe(self.made / "report.html", self.folder, width, 900, printed)
            self.assertEqual(seen["cut"], [], width)
            self.assertLessEqual(seen["content"], width)

    @unittest.skipIf(shutil.which("pdftotext") is None, "no pdftotext of poppler-utils")
    def test_has_numbered_pages_with_project_and_date(self):
        for paper in ("A4", "letter"):
            pages = print_page(self.made / "report.html", self.folder, paper)
            self.assertGreater(len(pages), 5)
            for number, page in enumerate(pages, 1):
                self.assertIn(f"page {number} of {len(pages)}", page)
                self.assertIn("Harbour of Mine – 17 – 20", page)
            self.assertIn("Place, date", pages[-1])


class Another(Report):
    """The report of a line whose dry points have no total and whose waves are described, against a specification of the
    user's."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        made, folder = reported_survey.SURVEYS[0], make_folder(cls.addClassCleanup)
        line, own, cls.another = folder / "bathymetric", folder / "own.toml", folder / "another"
        line.mkdir()
        survey = folder / "waves.toml"
        survey.write_text("[sensor]\nname = 'riegl-vq-880-g'\n[surface]\nclasses = [41]\n[[sea.waves]]\nhs = 0.5\n"
                          "tp = 3\nwaves_from = 230\n[datum]\nsigma = 0\n[water]\nkd = 0.15\nkd_kind = 'diffuse532'\n"
                          "detector = 'peak'\nfield_of_view = 3\npulse_length = 1.5\nbias = 'none'\n")
        query("las", sorted(made.flight.glob("*.las"))[0], line / "line.las", "--survey", survey, "--trajectory",
              made.flight / "sbet.out", "--wind-speed", 5, "--classes", 40, "--details", "--points", "bathymetric",
              check=0)
        own.write_text("title = 'My <harbour>'\nsource = 'me'\n[[class]]\nname = 'berths'\ncoverage = 'p95'\n"
                       "vertical = {constant = 0.01}\n")
        query("report", line, "--output", cls.another, "--spec", own, check=0)
        cls.of_another = json.loads((cls.another / "report.json").read_text())
        cls.page = (cls.another / "report.html").read_text()

    def test_has_no_land_where_dry_points_have_no_total(self):
        self.assertIsNone(self.of_another["land"])
        self.assertNotIn("<h2>Land</h2>", self.page)

    def test_holds_the_survey_against_another_specification(self):
        wanted = self.of_another["wanted"]
        self.assertEqual((wanted["class"], wanted["meeting"], wanted["passes"]), ("berths", 0, False))
        self.assertIn("My &lt;harbour&gt;", self.page)
        self.assertNotIn("My <harbour>", self.page)
        self.assertIn("What would help most", self.page)

    def test_says_that_waves_were_described_and_what_was_entered_of_the_water(self):
        self.assertIn("<td>computed for the described sea</td>", self.page)
        self.assertIn("<td>Kd = 0.15 1/m of kind diffuse532: 0.1275 1/m</td>", self.page)


if __name__ == "__main__":
    programs.main()
