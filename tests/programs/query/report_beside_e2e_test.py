"""What a report says beside its verdict, against computations of its own: density and voids, contributions and biases
by depth, what rests on assumed numbers, the factor of the overlap, nodes, datum and project."""

import json
import shutil

import netCDF4
import numpy as np
import scipy.ndimage

import programs
import reported_survey
from las_file import LasFile
from programs import query
from reported_survey import Report

FACTOR = 1.959964  # Of 95 %, vertically.


def setUpModule():
    reported_survey.make("--no-page")


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
