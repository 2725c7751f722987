"""albtpu-query report and crosscheck, from outside: runs again and again, bad inputs, and what stands beside the
verdict, against computations of its own."""

import json
import shutil

import netCDF4
import numpy as np
import scipy.ndimage

import programs
import reported_survey
from las_file import LasFile
from programs import query
from reported_survey import Report, annotate

FACTOR = 1.959964  # Of 95 %, vertically.


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

    def test_never_replace_what_they_read(self):
        annotated, table = self.folder / "annotated", self.folder / "table"
        shutil.copytree(self.annotated, annotated)
        table.mkdir()
        file = min(annotated.glob("*.las"))
        summary, points = file.with_name(file.name + ".json"), self.write("points.csv", "x,y,elevation\n1,2,3\n")
        part, survey = table / "surface.nc", self.folder / "report.json"
        query("surface", file, "--partial", part, check=0)
        survey.write_text("[project]\nname = 'Mine'\n")
        sea, plan = self.folder / "sea.toml", self.folder / "plan.json"
        for path in (sea, plan):
            path.write_text("[sensor]\nname = 'riegl-vq-880-g'\n")
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        for path, *arguments in (
                (file, "checkpoints", annotated, points, "--points", file),
                (summary, "checkpoints", annotated, points, "--points", summary),
                (points, "checkpoints", annotated, points, "--points", points),
                (file, "surface", file, "--partial", file),
                (summary, "surface", file, "--partial", summary),
                (part, "surface", "merge", part, "--output", table),
                (survey, "report", annotated, "--survey", survey, "--output", self.folder, "--no-page"),
                (sea, "sea", "--survey", sea, "--hs", 1, "--tp", 5, "--waves-from", 200, "--output", sea),
                (plan, "plan", "--survey", plan, "--output", self.folder, "--no-page")):
            self.assert_fails(query(*arguments, "--overwrite"), 1, f"{path}: is read by this run and would be replaced")
        self.assertEqual({path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}, before)

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


class Bottom(Report):
    def land(self, x, y, shape):
        """Cells that have dry points which are not of the water surface."""
        land = np.zeros(shape, bool)
        for path in self.annotated.glob("*.las"):
            las = LasFile(path)
            dry = (las.columns()["share_of"] == 1) & ~np.isin(las.classes, (9, 41, 42))
            at = [las.field(4 * axis, "<i4")[dry] * las.scale[axis] + las.offset[axis] for axis in range(2)]
            column, row = np.floor(at[0] - (x[0] - 0.5)).astype(int), (np.floor(y[0]) - np.floor(at[1])).astype(int)
            inside = (column >= 0) & (column < shape[1]) & (row >= 0) & (row < shape[0])
            land[row[inside], column[inside]] = True
        return land

    def test_has_the_voids_that_labels_of_its_empty_cells_have(self):
        with netCDF4.Dataset(self.made / "grid.nc") as grid:
            counts, x, y = grid["points"][:].filled(0), grid["x"][:].data, grid["y"][:].data
        has = counts > 0
        between = np.ones_like(has)
        for axis in (0, 1):
            before = np.maximum.accumulate(has, axis)
            between &= before & np.flip(np.maximum.accumulate(np.flip(has, axis), axis), axis)
        empty = between & ~has & ~self.land(x, y, has.shape)
        labels, voids = scipy.ndimage.label(empty)
        sizes = np.bincount(labels.ravel())[1:]
        bottom = self.json["bottom"]
        area = has.sum() + empty.sum()
        self.assertEqual(bottom["surveyed_area"], area)
        self.assertAlmostEqual(bottom["empty_share"], empty.sum() / area)
        self.assertEqual(bottom["voids"], voids)
        self.assertEqual(bottom["largest_void"]["area"], sizes.max())
        column = int(np.floor(bottom["largest_void"]["x"] - (x[0] - 0.5)))
        row = int(np.floor(y[0]) - np.floor(bottom["largest_void"]["y"]))
        self.assertEqual(sizes[labels[row, column] - 1], sizes.max())
        self.assertAlmostEqual(bottom["points_per_square_metre"], counts.sum() / area)
        self.assertEqual(bottom["large_voids"], (sizes >= 16 * area / counts.sum()).sum())
        self.assertEqual(bottom["points_of_covered_cells"]["median"], np.median(counts[has]))
        self.assertIn(f"the largest void has {sizes.max()} m2", self.said)


class Contributions(Report):
    def test_by_depth_are_those_of_the_points(self):
        of = {name: values[self.points["total_tvu"] >= 0].astype(float) for name, values in self.points.items()}
        self.assertGreater(len(self.json["contributions"]), 3)
        for band in self.json["contributions"]:
            end = np.inf if band["to"] is None else band["to"]
            inside = (of["water_depth"] >= band["from"]) & (of["water_depth"] < end)
            self.assertEqual(band["points"], inside.sum())
            vertical, horizontal = band["sigma_vertical"], band["sigma_horizontal"]
            variance = of["VarianceX"] + of["VarianceY"]
            self.assertAlmostEqual(horizontal["total"], np.sqrt(variance[inside].mean()), delta=1e-5)
            self.assertAlmostEqual(vertical["total"], np.sqrt(of["VarianceZ"][inside].mean()), delta=1e-5)
            for name, column in (("air", "tvu_air"), ("sea", "tvu_sea")):
                rms = np.sqrt(np.mean((of[column][inside] / FACTOR)**2))
                self.assertAlmostEqual(vertical[name], rms, delta=1e-5)
            for axis in (horizontal, vertical):
                parts = sum(axis[name]**2 for name in axis if name != "total")
                self.assertAlmostEqual(parts, axis["total"]**2, delta=1e-6)
            self.assertAlmostEqual(horizontal["extra"], 0.06, delta=1e-6)
            for name in ("bias_along_beam", "bias_vertical"):
                self.assertAlmostEqual(band[name], of[name][inside].mean(), delta=1e-6)
        self.assertIn("horizontal, m, 1 sigma", self.said)

    def test_of_assumed_numbers_are_shares_of_the_variance(self):
        of = {name: values[self.points["total_tvu"] >= 0].astype(float) for name, values in self.points.items()}
        assumed = self.json["assumed"]
        means = {"horizontal": (of["VarianceX"] + of["VarianceY"]).mean(), "vertical": of["VarianceZ"].mean()}
        numbers = {each["name"] for each in self.json["numbers"] if each.get("assumed")}
        for axis, mean in means.items():
            sources = {name: each[axis] for name, each in assumed["sources"].items()}
            self.assertAlmostEqual(sum(sources.values()), 1, delta=0.01)
            # The samples stand for all points: within some per cent.
            for name, variance in (("lever_arm", 0.02**2 * (2 if axis == "horizontal" else 1)),
                                   ("extra", 0.06**2 if axis == "horizontal" else 0.04**2)):
                self.assertAlmostEqual(sources[name] * mean / variance, 1, delta=0.1, msg=(axis, name))
            self.assertAlmostEqual(assumed[axis], sum(sources.get(name, 0) for name in numbers), delta=1e-9)
        self.assertEqual(assumed["share"], max(assumed[axis] for axis in means))
        self.assertIn("samples of the pulses", assumed["how"])


class Verdict(Report):
    def test_with_the_factor_of_the_overlap_is_that_of_scaled_points(self):
        factor = self.json["wanted"]["with_factor"]
        of = {name: values[self.points["total_tvu"] >= 0].astype(float) for name, values in self.points.items()}
        limit = np.hypot(0.5, 0.013 * of["water_depth"])
        within = factor["factor"] * FACTOR * np.sqrt(of["VarianceZ"]) + abs(of["bias_vertical"]) <= limit
        self.assertAlmostEqual(factor["factor"], self.json["crosscheck"]["factor"]["value"])
        self.assertAlmostEqual(factor["meeting"], within.sum(), delta=0.01 * within.size)
        self.assertIn("applied to every sigma", self.said)

    def test_of_nodes_is_that_of_the_surface(self):
        surface, report = self.folder / "surface", self.folder / "with_surface"
        query("surface", self.annotated, "--output", surface, "--cell", 4, check=0)
        query("report", self.annotated, "--output", report, "--surface", surface, "--no-page", check=0)
        nodes = json.loads((report / "report.json").read_text())["wanted"]["nodes"]
        with netCDF4.Dataset(surface / "surface.nc") as grid:
            order = grid["order_met"][:].compressed()
        self.assertEqual((nodes["nodes"], nodes["meeting"]), (order.size, (order <= 4).sum()))
        self.assertEqual(nodes["cell"], 4)
        alone = self.folder / "alone"
        alone.mkdir()
        for suffix in (".las", ".las.json"):
            shutil.copy(self.annotated / f"flight_1{suffix}", alone)
        self.assert_fails(query("report", alone, "--output", self.folder / "x", "--surface", surface, "--no-page"), 1,
                          "--surface", "give the surface that was made of them")
        self.assert_fails(query("report", alone, "--output", self.folder / "x", "--surface", alone, "--no-page"), 1,
                          "surface.json cannot be read")


class Names(Report):
    def test_of_datum_and_project_are_those_of_the_survey_file(self):
        self.assertEqual(self.json["vertical_datum"], "Chart datum of Mine")
        self.assertEqual(self.json["project"]["client"], "The port's <office>")
        with netCDF4.Dataset(self.made / "grid.nc") as grid:
            self.assertEqual(grid["elevation"].vertical_datum, "Chart datum of Mine")
            depth, elevation = grid["depth"][:], grid["elevation"][:]
        water = (elevation + depth).compressed()
        self.assertLess(np.ptp(water), 3)  # The water, with its waves.
        answered = self.points["total_tvu"] >= 0
        self.assertAlmostEqual(self.json["all"]["elevation"]["mean"], self.points["z"][answered].mean(), delta=1e-3)

    def test_can_be_given_to_the_report(self):
        survey = self.write("names.toml", "[project]\nname = 'Another'\n[datum]\nname = 'MLLW'\n")
        query("report", self.annotated, "--output", self.folder / "named", "--survey", survey, "--no-page", check=0)
        report = json.loads((self.folder / "named/report.json").read_text())
        self.assertEqual((report["project"], report["vertical_datum"]), ({"name": "Another"}, "MLLW"))

    def test_have_no_path_of_the_machine(self):
        for path in (self.made / "report.json", *self.annotated.glob("*.json")):
            for folder in (str(self.annotated.parent), str(self.flight)):
                self.assertNotIn(folder, path.read_text(), path.name)


class Console(Report):
    def test_of_five_files_has_one_table_and_every_note_once(self):
        lines = self.annotation.splitlines()
        self.assertLessEqual(len(lines), 45, self.annotation)
        for number in range(1, 6):
            self.assertEqual(sum(f"flight_{number}.las:" in line for line in lines), 1)
        for once in ("lever_arm 0.02 m (assumed", "trajectory agrees with", "horizontal, %"):
            self.assertEqual(self.annotation.count(once), 1, once)


if __name__ == "__main__":
    programs.main()
