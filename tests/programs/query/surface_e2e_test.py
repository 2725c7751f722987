"""albtpu-query surface, from outside: its nodes against a computation of their own, and the surface of parts, which is
that of one process."""

import json
import pathlib
import shutil
import struct
import tempfile
import unittest

import netCDF4
import numpy as np

import programs
import reported_survey
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

CELL = 2
FACTOR = 1.959964


def setUpModule():
    global folder, flight, annotated, made, said, parts
    folder = pathlib.Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, folder)
    flight = SimulatedSurvey(folder / "flight", "--lines", 2, "--cross-lines", 1, "--seconds", 4, "--pulse-rate", 5000,
                             "--file-for-each-line", "--range-noise", 0.02).folder
    annotated, made = folder / "annotated", folder / "surface"
    reported_survey.annotate(flight, annotated, programs.PATHS["shipped_table"])
    said = query("surface", annotated, "--output", made, "--cell", CELL, check=0).stdout
    parts = [make_part(f"{i}.part", file) for i, file in enumerate(sorted(annotated.glob("*.las")))]


def make_part(name, *files, flags=()):
    query("surface", *files, "--partial", folder / name, "--cell", CELL, *flags, check=0)
    return folder / name


def annotate(name, file, *flags):
    """A file annotated otherwise."""
    output = folder / name
    output.mkdir()
    query("las", flight / file.name, "--output-dir", output, "--survey", folder / "annotated.toml", "--table",
          programs.PATHS["shipped_table"], *flags, check=0)
    return output / file.name


class Grid(programs.Test):
    def setUp(self):
        super().setUp()
        self.grid = netCDF4.Dataset(made / "surface.nc")
        self.addCleanup(self.grid.close)
        self.json = json.loads((made / "surface.json").read_text())
        points = reported_survey.Survey.read(annotated)
        self.points = {name: values[points["total_tvu"] >= 0] for name, values in points.items()}

    def layer(self, name):
        return self.grid[name][:].filled(np.nan) if self.grid[name].dtype.kind == "f" else self.grid[name][:].data

    def cells(self):
        """Of the points, row and column in the grid; each lies in the cell of its node."""
        x, y = self.grid["x"][:].data, self.grid["y"][:].data
        column = np.floor(self.points["x"] / CELL).astype(int) - round(x[0] / CELL - 0.5)
        row = round(y[0] / CELL - 0.5) - np.floor(self.points["y"] / CELL).astype(int)
        self.assertLessEqual(abs(x[column] - self.points["x"]).max(), CELL / 2 + 1e-3)
        self.assertLessEqual(abs(y[row] - self.points["y"]).max(), CELL / 2 + 1e-3)
        return row, column

    def test_counts_every_point(self):
        row, column = self.cells()
        counts = np.zeros(self.layer("points").shape, int)
        np.add.at(counts, (row, column), 1)
        np.testing.assert_array_equal(self.layer("points") + self.layer("left_out"), counts)
        self.assertEqual(self.json["points_with_number"], len(row))
        self.assertLess(self.layer("left_out").sum(), 0.001 * len(row))
        self.assertEqual(self.json["nodes"], (self.layer("points") > 0).sum())

    def test_has_the_planes_of_least_squares(self):
        row, column = self.cells()
        x, y, elevation = self.grid["x"][:].data, self.grid["y"][:].data, self.layer("elevation")
        places = np.argwhere(self.layer("points") > 4)
        compared = 0
        for r, c in places[:: max(len(places) // 60, 1)]:
            around = (abs(row - r) <= 1) & (abs(column - c) <= 1)
            own = (row == r) & (column == c)
            if len(set(zip(row[around], column[around]))) < 9 or self.layer("left_out")[r - 1:r + 2, c - 1:c + 2].any():
                continue
            at = np.column_stack([self.points["x"] - x[c], self.points["y"] - y[r], np.ones(len(row))])
            slope = np.linalg.lstsq(at[around], self.points["z"][around], rcond=None)[0][:2]
            residuals = self.points["z"][own] - at[own, :2] @ slope
            self.assertAlmostEqual(elevation[r, c], residuals.mean(), delta=1e-4)
            self.assertAlmostEqual(self.layer("deviation")[r, c], residuals.std(ddof=1), delta=1e-4)
            self.assertAlmostEqual(self.layer("shoalest")[r, c], self.points["z"][own].max(), delta=1e-4)
            compared += 1
        self.assertGreater(compared, 20)

    def test_adds_up_the_parts_of_the_uncertainty(self):
        parts = [self.layer(f"sigma_{part}") for part in ("pulse", "sea", "line", "survey")]
        sigma = self.layer("uncertainty_1sigma")
        np.testing.assert_allclose(np.sqrt(sum(part**2 for part in parts)), sigma, rtol=1e-5)
        np.testing.assert_allclose(self.layer("uncertainty"), FACTOR * sigma, rtol=1e-5)
        np.testing.assert_array_equal(self.layer("depth"), -self.layer("elevation"))
        # A node is better than a point, but not as if its points were independent.
        compared = self.json["for_comparison"]
        self.assertLess(compared["points_taken_as_independent_95"], 0.95 * self.json["uncertainty_95"])
        self.assertLess(self.json["uncertainty_95"], compared["mean_tvu_of_points_95"])
        # Where one line sees a cell once, the line's share is that of its points.
        row, column = self.cells()
        once = (self.layer("passes") == 1) & (self.layer("points") > 3)
        taken = once[row, column]
        mean = np.zeros(once.shape)
        np.add.at(mean, (row[taken], column[taken]), self.points["tvu_line"][taken] / FACTOR)
        with np.errstate(invalid="ignore"):
            mean /= self.layer("points")
        self.assertGreater(once.sum(), 50)
        ratio = self.layer("sigma_line")[once] / mean[once]
        self.assertAlmostEqual(np.median(ratio), 1, delta=0.02)

    def test_says_what_it_is(self):
        self.assertEqual(self.grid["elevation"].positive, "up")
        self.assertEqual(self.grid["depth"].positive, "down")
        self.assertEqual(self.grid["elevation"].units, "m")
        self.assertIn("WGS 84 / UTM zone 17N", self.grid["crs"].crs_wkt)
        self.assertIn("nodes of 2 m", said)


class Command(programs.Test):
    def test_does_not_depend_on_the_order_of_the_files(self):
        other = self.folder / "annotated"
        shutil.copytree(annotated, other)
        files = sorted(other.glob("*.las"))
        for old, new in zip(files, reversed("abc")):
            for suffix in ("", ".json"):
                pathlib.Path(f"{old}{suffix}").rename(other / f"{new}.las{suffix}")
        query("surface", other, "--output", self.folder / "surface", "--cell", CELL, check=0)
        self.assertEqual((self.folder / "surface/surface.nc").read_bytes(), (made / "surface.nc").read_bytes())

    def test_keeps_what_is_there(self):
        before = (made / "surface.nc").read_bytes()
        self.assert_fails(query("surface", annotated, "--output", made), 1, "surface")
        self.assertEqual((made / "surface.nc").read_bytes(), before)
        self.assertEqual(sorted(path.name for path in made.iterdir()), ["surface.json", "surface.nc"])

    def test_takes_the_waves_of_the_table_of_the_annotation(self):
        def surface_of(name, spectrum):
            """The part of the sea, by the summaries of a table of this spectrum."""
            files = self.folder / name
            shutil.copytree(annotated, files)
            for path in files.glob("*.json"):
                summary = json.loads(path.read_text())
                self.assertTrue(summary["table"].pop("spectrum").startswith("Elfouhaily"))
                if spectrum:
                    summary["table"]["spectrum"] = spectrum
                path.write_text(json.dumps(summary))
            query("surface", files, "--output", self.folder / f"{name}_surface", "--cell", CELL, check=0)
            with netCDF4.Dataset(self.folder / f"{name}_surface/surface.nc") as grid:
                return grid["sigma_sea"][:].compressed()
        with netCDF4.Dataset(made / "surface.nc") as grid:
            elfouhaily = grid["sigma_sea"][:].compressed()
        np.testing.assert_array_equal(surface_of("before_1_0", None), elfouhaily)
        apel = surface_of("apel", "Apel (1994) with the fetch law of JONSWAP, cosine-2S spreading")
        self.assertGreater(np.mean(apel != elfouhaily), 0.9)  # By little: neighbours share more, or less, of the waves.

    def test_wants_the_sea_of_the_annotation(self):
        self.assert_fails(query("surface", annotated, "--output", self.folder / "new", "--hs", 1, "--tp", 5,
                                "--waves-from", 250), 1, "was annotated for a wind")
        self.assert_fails(query("surface", annotated, "--output", self.folder / "new", "--wind-speed", 5), 2,
                          "have no effect without waves")
        self.assertFalse((self.folder / "new").exists())


class Merging(programs.Test):
    def merge(self, *given, output="merged"):
        return query("surface", "merge", *given, "--output", self.folder / output)

    def assert_same(self, output="merged"):
        for name in ("surface.nc", "surface.json"):
            self.assertEqual((self.folder / output / name).read_bytes(), (made / name).read_bytes(), name)


class Merge(Merging):
    def test_makes_the_surface_of_one_process(self):
        self.assertEqual(self.merge(*parts).returncode, 0)
        self.assert_same()

    def test_takes_parts_in_any_order_and_of_several_files(self):
        files = sorted(annotated.glob("*.las"))
        two = make_part("two.part", files[2], files[0])
        self.assertEqual(self.merge(two, parts[1]).returncode, 0)
        self.assert_same()
        self.assertEqual(self.merge(*reversed(parts), output="reversed").returncode, 0)
        self.assert_same("reversed")

    def test_parts_are_the_same_whenever_they_are_made(self):
        file = sorted(annotated.glob("*.las"))[0]
        self.assertEqual(make_part("again.part", file).read_bytes(), parts[0].read_bytes())

    def test_refuses_what_is_no_part_or_damaged(self):
        foreign = self.folder / "foreign.part"
        foreign.write_bytes((made / "surface.nc").read_bytes())
        self.assert_fails(self.merge(parts[0], foreign), 1, "foreign.part: is no part of a surface")
        whole = parts[1].read_bytes()
        for at in (30, len(whole) // 2, len(whole) - 60):
            changed = self.folder / "changed.part"
            changed.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:])
            self.assert_fails(self.merge(parts[0], changed), 1, "changed.part: was cut short or changed")
        for size in (20, 1000, len(whole) - 1):
            short = self.folder / "short.part"
            short.write_bytes(whole[:size])
            self.assert_fails(self.merge(parts[0], short), 1, "short.part: was cut short or changed")
        self.assert_fails(self.merge(parts[0], self.folder / "none.part"), 1, "none.part: cannot be read")
        self.assertFalse((self.folder / "merged").exists())

    def test_refuses_parts_of_other_settings(self):
        file = sorted(annotated.glob("*.las"))[1]
        cell = folder / "cell.part"
        query("surface", file, "--partial", cell, "--cell", 3, check=0)
        others = {"--cell is 3 m (in": cell}
        for name, what, flags in (("water", "index of the water is 1.341 (in", ("--water-index", 1.341)),
                                  ("coverage", "coverage is 1sigma (in", ("--coverage", "1sigma")),
                                  ("crs", "coordinate system is NAD83 / UTM zone 17N (in", ("--crs", "EPSG:26917"))):
            with self.subTest(name):
                others[what] = make_part(f"{name}.part", annotate(name, file, *flags))
        for what, part in others.items():
            with self.subTest(what):
                self.assert_fails(self.merge(parts[0], part), 1, part.name, "0.part", what)
        self.assertFalse((self.folder / "merged").exists())

    def test_refuses_a_file_that_is_in_two_parts(self):
        twice = make_part("twice.part", *sorted(annotated.glob("*.las"))[:2])
        self.assert_fails(self.merge(twice, parts[1]), 1, "give each file in one part")
        self.assert_fails(self.merge(parts[0], parts[0]), 1, "give each file in one part")


class EmptyPart(Merging):
    """Of files without points."""

    def setUp(self):
        super().setUp()
        tile = self.folder / "empty/tile.las"
        tile.parent.mkdir()
        las = LasFile(sorted(annotated.glob("*.las"))[0])
        head = bytearray(las.bytes[:las.offset_to_points])
        struct.pack_into("<I", head, 107, 0)
        if las.version_minor >= 4:
            struct.pack_into("<QIQ", head, 235, 0, 0, 0)
        tile.write_bytes(head)
        self.empty = self.folder / "empty.part"
        result = query("surface", tile.parent, "--partial", self.empty, "--cell", CELL, check=0)
        self.assertIn("0 points of 0 files", result.stdout)
        self.assertIn("tile.las: has no points, and is left out", result.stderr)

    def test_changes_no_byte(self):
        self.assertEqual(self.merge(self.empty, *parts).returncode, 0)
        self.assert_same()
        self.assertEqual(self.merge(*parts, self.empty, output="last").returncode, 0)
        self.assert_same("last")

    def test_alone_makes_no_surface(self):
        self.assert_fails(self.merge(self.empty), 1, "empty.part: of files without points; give a part of files with")
        self.assertFalse((self.folder / "merged").exists())


class Partial(programs.Test):
    def test_keeps_a_part_that_is_there(self):
        file = sorted(annotated.glob("*.las"))[0]
        before = parts[0].read_bytes()
        self.assert_fails(query("surface", file, "--partial", parts[0]), 1, "is there already")
        self.assertEqual(parts[0].read_bytes(), before)
        make_part("0.part", file, flags=("--overwrite",))
        self.assertEqual(parts[0].read_bytes(), before)

    def test_fails_whole(self):
        before, other = self.names(), self.folder / "other.las"
        other.write_bytes(b"none")
        self.assert_fails(query("surface", annotated, other, "--partial", self.folder / "new.part"), 1, "other.las")
        self.assertEqual(self.names(), sorted([*before, "other.las"]))

    def test_arguments_that_do_not_go_together_are_bad_usage(self):
        before = self.names()
        new = self.folder / "new"
        for arguments in ((annotated,), (annotated, "--partial", new, "--output", new), ("merge", "--output", new),
                          ("merge", parts[0], "--partial", new), ("merge", parts[0], "--output", new, "--cell", 1)):
            with self.subTest(arguments):
                self.assert_fails(query("surface", *arguments), 2, "surface: ")
        self.assertEqual(self.names(), before)


if __name__ == "__main__":
    programs.main()
