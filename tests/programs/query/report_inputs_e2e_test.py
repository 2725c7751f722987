"""albtpu-query report and crosscheck, from outside: runs again and again, errors that are known, bad inputs."""

import json
import shutil

import numpy as np

import programs
import reported_survey
from las_file import LasFile
from programs import query
from reported_survey import Report, annotate


def setUpModule():
    reported_survey.make("--no-page")


class Runs(Report):
    def test_keep_what_is_there(self):
        report = self.folder / "report"
        query("report", self.annotated, "--output", report, "--no-page", check=0)
        before = (report / "report.json").stat().st_mtime_ns
        self.assert_fails(query("report", self.annotated, "--output", report, "--no-page"), 1, "--overwrite")
        again = query("report", self.annotated, "--output", report, "--no-page", "--resume", check=0)
        self.assertIn("already", again.stderr)
        self.assertEqual((report / "report.json").stat().st_mtime_ns, before)
        query("report", self.annotated, "--output", report, "--no-page", "--resume", "--cell", 2, check=0)
        self.assertGreater((report / "report.json").stat().st_mtime_ns, before)
        query("report", self.annotated, "--output", report, "--no-page", "--overwrite", check=0)
        self.assertEqual([path.name for path in sorted(report.iterdir())], ["grid.nc", "report.json"])

    def test_are_the_same_from_the_same_files(self):
        for name in ("a", "b"):
            query("report", self.annotated, "--output", self.folder / name, "--no-page", check=0)
        self.assertEqual((self.folder / "a/report.json").read_bytes(), (self.folder / "b/report.json").read_bytes())

    def test_read_laz_as_las(self):
        packed = self.folder / "laz"
        packed.mkdir()
        for path in self.annotated.glob("*.las"):
            laz = packed / f"{path.stem}.laz"
            programs.laz_copy(path, laz)
            summary = json.loads(path.with_suffix(".las.json").read_text())
            summary["output"]["bytes"] = laz.stat().st_size
            (packed / f"{laz.name}.json").write_text(json.dumps(summary))
        query("report", packed, "--output", self.folder / "report", "--no-page", check=0)
        again = json.loads((self.folder / "report/report.json").read_text())
        for key in ("all", "lines", "by_depth", "wanted", "crosscheck"):
            self.assertEqual(again[key], self.json[key], key)


class CrossCheck(Report):
    def test_needs_lines_that_overlap(self):
        alone = self.folder / "alone"
        alone.mkdir()
        for suffix in (".las", ".las.json"):
            shutil.copy(self.annotated / f"flight_1{suffix}", alone)
        self.assert_fails(query("crosscheck", alone), 1, "no lines overlap", "point source ID")


class BadInput(Report):
    def fails(self, folder, *parts, flags=(), code=1):
        output = self.folder / "nothing"
        self.assert_fails(query("report", folder, "--output", output, "--no-page", *flags), code, *parts)
        self.assertFalse(any(output.iterdir()) if output.exists() else False)

    def test_is_one_message(self):
        empty = self.folder / "empty"
        empty.mkdir()
        for folder, code, *parts, flags in (
                (self.flight, 1, "has no total_thu", "--details", ()), (empty, 1, "has no LAS or LAZ file", ()),
                (self.folder / "missing", 1, "missing", ()),
                (self.annotated, 2, "--cell", "from 0.01 to 10000 m", ("--cell", 1e9)),
                (self.annotated, 1, "the grid is too large", "--cell", ("--cell", 0.01)),
                (self.annotated, 1, "is no specification", ("--spec", "usg")),
                (self.annotated, 1, "is no class", ("--spec", "usgs", "--class", "QL9")),
                (self.annotated, 2, "--s44-order", ("--spec", "usgs", "--s44-order", "1a"))):
            self.fails(folder, *parts, flags=flags, code=code)

    def copy(self):
        """A copy of the survey, in place of an earlier one."""
        folder = self.folder / "copy"
        shutil.rmtree(folder, ignore_errors=True)
        return shutil.copytree(self.annotated, folder)

    def edit(self, change):
        """A copy of the survey in which the second summary is changed."""
        folder = self.copy()
        path = folder / "flight_2.las.json"
        summary = json.loads(path.read_text())
        change(summary)
        path.write_text(json.dumps(summary))
        return folder

    def test_of_summaries_that_lie(self):
        def nested(summary):
            for _ in range(100):
                summary["input"]["sea"] = [summary["input"].get("sea")]

        # What is nested more deeply than ours is not read.
        query("report", self.edit(nested), "--output", self.folder / "nested", "--no-page", check=0)
        for change, *parts in (
                (lambda of: of["parameters"].update(metres_per_unit=1e300), "flight_2.las.json", "metres_per_unit"),
                (lambda of: of["parameters"].update(metres_per_unit="m"), "flight_2.las.json", "metres_per_unit"),
                (lambda of: of["parameters"].update(classes="40"), "flight_2.las.json", "no list"),
                (lambda of: of["parameters"].update(classes=[1e300]), "flight_2.las.json", "has a class"),
                (lambda of: of["answers"]["outcomes"].update(NO_SURFACE=2**63), "flight_2.las.json", "more outcomes"),
                (lambda of: of.pop("table"), "flight_2.las.json", "is no summary of a total"),
                (lambda of: of["table"].update(digest="0" * 64), "flight_2.las", "table"),
                (lambda of: of["answers"]["total"].update(coverage="2sigma"), "coverage", "2sigma", "p95"),
                (lambda of: of["parameters"].update(crs="EPSG:26918"), "coordinate system", "UTM zone 18N",
                 "UTM zone 17N"),
                (lambda of: of["parameters"].update(crs="EPSG:4326"), "geographic", "UTM")):
            self.fails(self.edit(change), *parts)
            self.assertFalse((self.folder / "nothing").exists())
        folder = self.copy()
        summary = folder / "flight_2.las.json"
        deep = summary.read_text().replace('"input": {', '"input": {"x": ' + "[" * 500_000, 1)
        for text in (deep, "", "[]", "{}", '{"program": "albtpu-query", "answers": 3}'):
            summary.write_text(text)
            self.fails(folder, "flight_2.las.json", "no summary")
        summary.unlink()
        self.fails(folder, "flight_2.las.json", "missing")

    def test_of_a_specification_with_the_name_of_another(self):
        own = self.folder / "s44.toml"
        own.write_text("title = 'T'\nsource = 'S'\n[[class]]\nname = 'a'\ncoverage = 'p95'\n"
                       "vertical = {constant = 1}\n")
        self.fails(self.annotated, "another name", flags=("--spec", own))

    def test_of_numbers_that_are_no_uncertainties(self):
        folder = self.copy()
        las = LasFile(folder / "flight_2.las")
        where = las.extra_dimensions()
        for name, value in (("VarianceX", np.inf), ("total_tvu", 3e38), ("bias_vertical", -np.inf),
                            ("CovarianceXY", np.nan), ("water_depth", np.nan)):
            records = las.records.copy()
            begin = where[name][0]
            records[:, begin:begin + 4] = np.full(len(records), value, "<f4").view(np.uint8).reshape(-1, 4)
            data = bytearray(las.bytes)
            data[las.offset_to_points:las.end_of_points] = records.tobytes()
            (folder / "flight_2.las").write_bytes(data)
            made = self.folder / "made"
            query("report", folder, "--output", made, "--no-page", "--overwrite", check=0)
            report = json.loads((made / "report.json").read_text())
            of_line = next(line for line in report["lines"] if line["line"] == 2)
            if name in ("bias_vertical", "CovarianceXY"):
                self.assertGreater(of_line["with_number"], 0, name)
            else:
                self.assertEqual(of_line["with_number"], 0, name)
            query("crosscheck", folder, "--patch", 10, check=0)

    def test_of_a_file_that_was_changed(self):
        folder = self.copy()
        with (folder / "flight_3.las").open("ab") as file:
            file.write(b"more")
        self.fails(folder, "flight_3.las", "changed later")

    def test_of_no_point(self):
        folder = self.folder / "dry"
        folder.mkdir()
        annotate(self.flight, folder, self.one_table)
        for path in folder.glob("*.las.json"):
            summary = json.loads(path.read_text())
            summary["parameters"]["classes"] = [99]
            path.write_text(json.dumps(summary))
        self.fails(folder, "no file has a point of the bathymetric classes")


if __name__ == "__main__":
    programs.main()
