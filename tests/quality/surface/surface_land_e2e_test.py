"""albtpu-query surface --land, from outside: nodes of a beach by the totals of its dry points."""

import json
import pathlib
import shutil
import sys
import tempfile
import unittest

import netCDF4
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "programs/query"))

import programs  # noqa: E402
import reported_survey  # noqa: E402
from las_file import LasFile  # noqa: E402
from programs import query  # noqa: E402
from simulated_survey import LAND, SimulatedSurvey  # noqa: E402

CELL = 2
BOTTOM, NOISE = 40, 7  # Classes.
FACTOR = 1.959964


def setUpModule():
    global folder, annotated, points
    folder = pathlib.Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, folder)
    flight = SimulatedSurvey(folder / "flight", "--lines", 2, "--seconds", 4, "--pulse-rate", 8000, "--range-noise",
                             0.02, "--file-for-each-line")
    annotated = folder / "annotated"
    reported_survey.annotate(flight.folder, annotated, programs.PATHS["shipped_table"])
    columns = {}
    for name in flight.names:
        las = LasFile(annotated / f"{name}.las")
        kinds = flight.truth(name)["kind"]
        of_file = {"x": las.field(0, "<i4") * las.scale[0] + las.offset[0],
                   "y": las.field(4, "<i4") * las.scale[1] + las.offset[1], "class": las.classes,
                   "land": kinds == LAND, **las.columns()}
        for column, values in of_file.items():
            columns.setdefault(column, []).append(values)
    points = {column: np.concatenate(parts) for column, parts in columns.items()}


class Land(programs.Test):
    def surface(self, *flags, name="surface"):
        query("surface", annotated, "--output", self.folder / name, "--cell", CELL, *flags, check=0)
        grid = netCDF4.Dataset(self.folder / name / "surface.nc")
        self.addCleanup(grid.close)
        return grid, json.loads((self.folder / name / "surface.json").read_text())

    @staticmethod
    def land_points(grid):
        return np.round(grid["land_share"][:].filled(0) * grid["points"][:].data).astype(int)

    def in_cells(self, grid, chosen, values=None):
        """Of the chosen points, how many each cell has, or their sum."""
        x, y = grid["x"][:].data, grid["y"][:].data
        column = np.floor(points["x"][chosen] / CELL).astype(int) - round(x[0] / CELL - 0.5)
        row = round(y[0] / CELL - 0.5) - np.floor(points["y"][chosen] / CELL).astype(int)
        cells = np.zeros(grid["points"].shape)
        np.add.at(cells, (row, column), 1 if values is None else values[chosen])
        return cells

    def test_takes_the_dry_points_of_the_ground(self):
        grid, summary = self.surface("--land")
        dry, wet = points["land"] & (points["share_of"] == 1), points["share_of"] == 2
        self.assertGreater(dry.sum(), 1000)
        self.assertTrue((points["class"][dry] == 2).all())
        land, left_out = self.land_points(grid), grid["left_out"][:].data
        whole = left_out == 0
        self.assertGreater(whole.mean(), 0.99)
        np.testing.assert_array_equal(land[whole], self.in_cells(grid, dry)[whole])
        np.testing.assert_array_equal(grid["points"][:].data[whole], self.in_cells(grid, dry | wet)[whole])
        self.assertEqual(summary["land"]["points_with_number"], dry.sum())
        self.assertEqual(summary["land"]["points"], land.sum())
        self.assertEqual(summary["land"]["nodes"], ((land > 0) & (land == grid["points"][:].data)).sum())

    def test_has_the_totals_of_dry_points_alone(self):
        grid, summary = self.surface("--land")
        of_land = (self.land_points(grid) > 3) & (self.land_points(grid) == grid["points"][:].data)
        self.assertGreater(of_land.sum(), 50)
        self.assertTrue((grid["sigma_sea"][:][of_land] == 0).all())
        self.assertTrue(grid["water_depth"][:].mask[of_land].all())
        self.assertTrue(grid["order_met"][:].mask[of_land].all())
        judged = sum(summary["order_met"].values())
        self.assertEqual(judged, summary["nodes"] - summary["land"]["nodes"])
        dry = points["land"]
        once = of_land & (grid["passes"][:].data == 1) & (grid["left_out"][:].data == 0)
        mean_line = self.in_cells(grid, dry, points["tvu_line"] / FACTOR)[once] / grid["points"][:].data[once]
        ratio = grid["sigma_line"][:].data[once] / mean_line
        self.assertGreater(once.sum(), 50)
        self.assertAlmostEqual(np.median(ratio), 1, delta=0.02)

    def test_has_no_part_in_the_verdict_by_nodes(self):
        _, summary = self.surface("--land")
        query("report", annotated, "--output", self.folder / "report", "--surface", self.folder / "surface",
              "--no-page", check=0)
        nodes = json.loads((self.folder / "report/report.json").read_text())["wanted"]["nodes"]
        self.assertGreater(summary["land"]["nodes"], 50)
        self.assertEqual(nodes["nodes"], summary["nodes"] - summary["land"]["nodes"])
        meeting = sum(summary["order_met"][order] for order in ("exclusive", "special", "1a", "1b"))
        self.assertEqual((nodes["meeting"], nodes["fraction"]), (meeting, meeting / nodes["nodes"]))

    def test_leaves_the_nodes_of_the_bottom_as_they_are(self):
        with_land, summary = self.surface("--land")
        without, other = self.surface(name="without")
        self.assertNotIn("land", other)
        self.assertTrue((without["land_share"][:] == 0).all())
        # Where neither a node nor one of its neighbours has a point of land.
        x, y = without["x"][:].data, without["y"][:].data
        rows = np.searchsorted(-with_land["y"][:].data, -y - 1e-3)
        columns = np.searchsorted(with_land["x"][:].data, x - 1e-3)
        land = np.pad(self.land_points(with_land), 2)
        near = sum(land[i:i + land.shape[0] - 4, j:j + land.shape[1] - 4] for i in range(5) for j in range(5))
        far = near[np.ix_(rows, columns)] == 0
        self.assertGreater((without["points"][:].data[far] > 0).sum(), 200)
        for name in ("elevation", "uncertainty", "sigma_sea", "water_depth"):
            np.testing.assert_array_equal(with_land[name][:].filled(-1)[np.ix_(rows, columns)][far],
                                          without[name][:].filled(-1)[far], name)

    def test_takes_tiles_that_have_no_number_of_the_bottom(self):
        tiles, annotated_tiles = self.folder / "tiles", self.folder / "annotated_tiles"
        tiles.mkdir()
        annotated_tiles.mkdir()
        bottomless, other = sorted((folder / "flight").glob("*.las"))
        shutil.copy(other, tiles / other.name)
        las = LasFile(bottomless)
        records = las.records.copy()
        records[las.classes == BOTTOM, 16] = NOISE
        (tiles / bottomless.name).write_bytes(las.bytes[:las.offset_to_points] + records.tobytes() +
                                              las.bytes[las.end_of_points:])
        query("las", tiles, "--output-dir", annotated_tiles, "--survey", folder / "annotated.toml", "--table",
              programs.PATHS["shipped_table"], check=0)
        for name, sources in (("both", [annotated_tiles]), ("one", [annotated / other.name])):
            query("surface", *sources, "--output", self.folder / name, "--cell", CELL, check=0)
        with netCDF4.Dataset(self.folder / "both/surface.nc") as both, \
                netCDF4.Dataset(self.folder / "one/surface.nc") as one:
            np.testing.assert_array_equal(both["uncertainty"][:].filled(-1), one["uncertainty"][:].filled(-1))
        self.surface("--land", name="whole")
        query("surface", annotated_tiles, "--output", self.folder / "land", "--cell", CELL, "--land", check=0)
        with netCDF4.Dataset(self.folder / "land/surface.nc") as land:
            self.assertEqual(json.loads((self.folder / "land/surface.json").read_text())["land"]["points_with_number"],
                             json.loads((self.folder / "whole/surface.json").read_text())["land"]["points_with_number"])
            self.assertTrue((land["sigma_line"][:][land["land_share"][:] > 0] > 0).all())
        query("surface", annotated_tiles / bottomless.name, "--output", self.folder / "alone", "--cell", CELL, "--land",
              check=0)

    def test_parts_have_land_or_not(self):
        made = [self.folder / name for name in ("a.part", "b.part", "c.part")]
        files = sorted(annotated.glob("*.las"))
        for part, file, flags in zip(made, (files[0], files[1], files[1]), (("--land",), ("--land",), ())):
            query("surface", file, "--partial", part, "--cell", CELL, *flags, check=0)
        self.surface("--land")
        query("surface", "merge", *made[:2], "--output", self.folder / "merged", check=0)
        for name in ("surface.nc", "surface.json"):
            self.assertEqual((self.folder / "merged" / name).read_bytes(),
                             (self.folder / "surface" / name).read_bytes())
        output = self.folder / "other"
        self.assert_fails(query("surface", "merge", made[0], made[2], "--output", output), 1, "c.part", "its --land is")
        self.assert_fails(query("surface", "merge", *made[:2], "--output", output, "--land"), 2, "--land has no effect")

    def test_on_a_slope_of_the_terrain_the_slope_counts_once(self):
        """--terrain-slope states the height at a fixed place; a node has its own slope, and the same uncertainty."""
        before, _ = self.surface("--land")
        sloping = self.folder / "sloping"
        sloping.mkdir()
        query("las", folder / "flight", "--output-dir", sloping, "--survey", folder / "annotated.toml", "--table",
              programs.PATHS["shipped_table"], "--terrain-slope", check=0)
        query("surface", sloping, "--output", self.folder / "after", "--cell", CELL, "--land", check=0)
        tvu = np.concatenate([LasFile(file).columns()["tvu_pulse"] for file in sorted(sloping.glob("*.las"))])
        land = points["land"] & (points["class"] == 2)
        with np.errstate(invalid="ignore"):
            stated = self.in_cells(before, land, tvu) / self.in_cells(before, land, points["tvu_pulse"])
        with netCDF4.Dataset(self.folder / "after/surface.nc") as after:
            chosen = (self.land_points(before) == before["points"][:].data) & (stated > 1.1)
            self.assertGreater(chosen.sum(), 20)
            for name in ("sigma_pulse", "sigma_line", "uncertainty"):
                ratio = (after[name][:] / before[name][:])[chosen]
                # The shares of groups are the file's, to a hundredth.
                np.testing.assert_allclose(ratio, 1, atol=0.02, err_msg=name)


if __name__ == "__main__":
    programs.main()
