"""Files as people have them: headers, flags, clocks and georeferences that lie. The numbers are those of the sound
file, or there is one clear refusal, or a note says what was repaired; never another number in silence."""

import json
import math
import os
import pathlib

import numpy as np

import programs
from false_file import BOUNDS, FLIGHT, OVERLAP, SURVEY, SYNTHETIC, WITHHELD, FalseFiles, Points, geo_keys
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

FLIGHTS = 200 if os.environ.get("ALBTPU_EVERY_CASE") else 8


class Headers(FalseFiles):
    def test_bounds_that_the_points_do_not_have(self):
        bounds = Points(self.sound).get("<6d", BOUNDS)
        for name, wrong in {"minimum 0": (bounds[0], 0, bounds[2], 0, *bounds[4:]), "all 0": (0,) * 6,
                            "no numbers": (math.nan,) * 6, "a far corner": (9e6, bounds[1], 9e6, *bounds[3:]),
                            "exchanged": (bounds[1], bounds[0], bounds[3], bounds[2], bounds[5], bounds[4]),
                            "heights": (*bounds[:4], 900, -900)}.items():
            with self.subTest(name):
                self.mend(lambda points: points.put("<6d", BOUNDS, *wrong) or (), "the header states bounds")
                points = Points(self.sound)
                points.put("<6d", BOUNDS, *wrong)
                fit = ("--trajectory-from-returns", "--water-level", self.survey.water_level)
                common = self.flags()[:4]
                expected = self.of_sound(*common, *fit)
                printed, columns = self.annotated(bytes(points.data), *common, *fit)
                self.assertIsNotNone(columns, printed)
                self.assert_same(columns, expected)

    def test_two_georeferences(self):
        for name, keys in {"feet": [(3072, 2236), (3076, 9003), (4099, 9003)], "another zone": [(3072, 26918)],
                           "another zone, feet": [(3072, 26918), (4099, 9002)]}.items():
            with self.subTest(name):
                self.mend(lambda points: points.insert_vlr(b"LASF_Projection", 34735, geo_keys(*keys)) or (),
                          "GeoTIFF keys .* contradict its well-known text")


class Flags(FalseFiles):
    SURFACE = ("--water-classes", "41")

    def test_withheld_surface(self):
        def change(points):
            wrong = points.points(41)[::20]
            points.raise_by(wrong, 3)
            points.flag(wrong, WITHHELD)
            return wrong
        # Without them, the surface is made of fewer returns: other heights, by millimetres.
        expected = self.of_sound(*self.flags(*self.SURFACE))
        points = Points(self.sound)
        change(points)
        printed, columns = self.annotated(bytes(points.data), *self.flags(*self.SURFACE))
        wet = expected["water_depth"] >= 0
        still = wet & (columns["water_depth"] >= 0)
        self.assertGreater(still.sum(), 0.95 * wet.sum())  # A few have too few returns near by then.
        difference = (columns["water_depth"] - expected["water_depth"])[still]
        self.assertLess(np.abs(difference).max(), 0.6)
        self.assertLess(abs(difference.mean()), 0.02)

    def test_withheld_bottom(self):
        def change(points):
            wrong = points.points(40)[::10]
            points.raise_by(wrong, -30)
            points.flag(wrong, WITHHELD)
            return wrong
        columns, wrong = self.mend(change, "bathymetric points are withheld and have no number")
        self.assertTrue((columns["total_thu"][wrong] == -1).all())
        points = Points(self.sound)
        points.flag(points.points(40), WITHHELD)
        printed, columns = self.annotated(bytes(points.data), *self.flags(), "--points", "bathymetric")
        self.assertIn("all points of class 40 or 43 are withheld", printed)
        self.assertIn("give them numbers by --use-withheld", printed)
        self.assertIsNone(columns)
        expected = self.of_sound(*self.flags())
        _, columns = self.annotated(bytes(points.data), *self.flags(), "--use-withheld")
        self.assert_same(columns, expected)

    def test_synthetic_and_overlap(self):
        self.mend(lambda points: points.flag(points.points(40)[::2], SYNTHETIC) or (), "are synthetic: no pulse")
        self.mend(lambda points: points.flag(points.points(40, 41)[::2], OVERLAP) or (), "")
        self.mend(lambda points: points.flag(points.points(41)[::2], SYNTHETIC) or (), "surface are synthetic",
                  *self.SURFACE)

    def test_noise(self):
        def change(points):
            noise = points.points(2, 1)[::5] or points.points(41)[::5]
            for i in noise:
                points.data[points.at(i, 16)] = 7 if i % 2 else 18
            points.raise_by(noise, 50)
            return noise
        columns, noise = self.mend(change, "the header states bounds")
        self.assertTrue((columns["total_thu"][noise] == -1).all())


class Clocks(FalseFiles):
    def test_times_of_0_and_no_numbers(self):
        for time in (0.0, math.nan, math.inf):
            with self.subTest(time=time):
                def change(points):
                    wrong = points.points(40)[::50]
                    for i in wrong:
                        points.put("<d", points.at(i, 22), time)
                    return wrong
                columns, wrong = self.mend(change, "NO_TRAJECTORY")
                self.assertTrue((columns["total_thu"][wrong] == -1).all())


    def test_times_that_lie_far_from_all_others(self):
        for time in (1.0, -1e9, 1e9, 5e-324, 1e16, 1e300, -1e300):
            with self.subTest(time=time):
                def change(points):
                    wrong = points.points(40)[5:8]
                    for i in wrong:
                        points.put("<d", points.at(i, 22), time)
                    return wrong
                columns, wrong = self.mend(change, "3 points have GPS times a month or more from those of all others")
                self.assertTrue((columns["total_thu"][wrong] == -1).all())

    def test_times_that_were_rounded(self):
        for step in (1.0, 0.5, 1e9):
            points = Points(self.sound)
            middle, = points.get("<d", points.at(points.count // 2, 22))
            for i in range(points.count):
                time, = points.get("<d", points.at(i, 22))
                points.put("<d", points.at(i, 22), step * round(time / step) if step < 1e9 else middle)
            printed, columns = self.annotated(bytes(points.data), *self.flags())
            self.assertIsNone(columns, printed)
            self.assertIn("the GPS times of its points are rounded", printed)


class Classes(FalseFiles):
    def test_bottom_of_another_class_is_no_land(self):
        expected = self.of_sound(*self.flags())
        for number in (29, 64, 3):
            points = Points(self.sound)
            others = points.points(40)[::2]
            for i in others:
                points.classify(i, number)
            printed, columns = self.annotated(bytes(points.data), *self.flags())
            self.assertIn(f" points of class {number} lie below the water surface and have no number", printed)
            deep = [i for i in others if expected["water_depth"][i] > 1]
            self.assertTrue((columns["total_thu"][deep] == -1).all())
            self.assert_same(columns, expected, others)

    def test_ground_below_the_water_is_said(self):
        points = Points(self.sound)
        for i in points.points(40)[::2]:
            points.classify(i, 2)
        printed, _ = self.annotated(bytes(points.data), *self.flags())
        self.assertIn(" points of the ground lie below the water surface and have the numbers of land", printed)


class ScanAngles(FalseFiles):
    def test_in_another_unit(self):
        for factor in (0.006, 0.001, 1 / 57.3):
            with self.subTest(factor=factor):
                points = Points(self.sound)
                for i in range(points.count):
                    angle, = points.get("<h", points.at(i, 18))
                    points.put("<h", points.at(i, 18), round(angle * factor))
                printed, columns = self.annotated(bytes(points.data), *self.flags()[:4], "--scanner", "across-track",
                                                  "--altitude", 400, "--water-level", self.survey.water_level)
                self.assertIsNone(columns)
                self.assertIn("scan angles are within", printed)


class DryPoints(FalseFiles):
    def test_have_a_total_that_falls_with_the_water(self):
        """All points but noise have one; those of the bottom above the water count as DRY."""
        _, columns = self.annotated(self.sound, *self.flags())
        las = LasFile(self.folder / "out.las")
        column = las.classes == 45  # Of the water column: neither.
        self.assertTrue((columns["total_thu"][~column] > 0).all())
        self.assertTrue((columns["total_thu"][column] == -1).all())
        dry = (las.classes != 40) & ~column
        self.assertTrue((columns["thu_sea"][dry] == 0).all())
        self.assertTrue((columns["water_depth"][dry] == -1).all())
        # Of the surface itself, the air side of the bottom at no depth: all but what locates the surface.
        self.assertLess(np.median(columns["total_tvu"][dry]), np.median(columns["total_tvu"][~dry]))
        _, bathymetric = self.annotated(self.sound, *self.flags(), "--points", "bathymetric")
        self.assertTrue((bathymetric["total_thu"][dry] == -1).all())
        for name, values in bathymetric.items():
            np.testing.assert_array_equal(values[~dry], columns[name][~dry], err_msg=name)
        points = Points(self.sound)
        for i in points.points(40, 45):
            points.data[points.at(i, 16)] = 2
        (self.folder / "in").mkdir()
        (self.folder / "outs").mkdir()
        (self.folder / "in/land.las").write_bytes(points.data)
        query("las", self.folder / "in", "--output-dir", self.folder / "outs", *self.flags())
        land = LasFile(self.folder / "outs/land.las").columns()
        self.assertTrue((land["total_thu"] > 0).all())
        np.testing.assert_array_equal(land["total_thu"][dry], columns["total_thu"][dry])

    def test_bottom_above_the_water_is_dry_and_says_so(self):
        las = LasFile(self.survey.las)
        lower = float(np.quantile(las.z[las.classes == 40], 0.8))  # A fifth of the bottom falls dry.
        printed, columns = self.annotated(self.sound, *self.flags()[:4], "--incidence", 20, "--beam-azimuth", 0,
                                          "--altitude", 400, "--water-level", lower)
        dry = (las.classes == 40) & (las.z > lower)
        outcomes = json.loads((self.folder / "out.las.json").read_text())["answers"]["outcomes"]
        self.assertEqual(outcomes["DRY"], dry.sum())
        self.assertIn(f"{dry.sum()} DRY", printed)
        self.assertTrue((columns["total_thu"][dry] > 0).all())
        self.assertTrue((columns["thu_sea"][dry] == 0).all())
        # If most of the bottom is above it, the level is wrong, and the run fails although all points have numbers.
        lowest = float(np.quantile(las.z[las.classes == 40], 0.2))
        printed, _ = self.annotated(self.sound, *self.flags()[:4], "--incidence", 20, "--beam-azimuth", 0, "--altitude",
                                    400, "--water-level", lowest, failing=True)
        self.assertIn("above the water surface", printed)


class SoundFlights(programs.Test):
    """No right trajectory is refused, whatever the waves are and whether the classes of the surface are given."""

    def test_over_seas_of_up_to_one_and_a_half_metres(self):
        refused = []
        for i in range(FLIGHTS):
            height = 1.5 * i / (FLIGHTS - 1)
            folder = self.folder / str(i)
            # In a longer one even a small difference is significant.
            flight = [20 if each == 4 and i % 4 == 3 else each for each in FLIGHT]
            survey = SimulatedSurvey(folder, *flight, "--wave-height", f"{height:.3f}", "--seed", i + 1)
            level = ("--water-level", survey.water_level)
            for surface in (level, ("--water-classes", 41), (*level, "--water-classes", 41))[i % 3::3]:
                result = query("las", survey.las, folder / "out.las", "--table", self.table,
                               "--classes", 40, "--trajectory", survey.sbet, "--lever-arm", "0.35,-0.12,0.42",
                               "--wind-speed", 6, "--divergence", 1, *surface)
                if result.returncode != 0:
                    refused.append((round(height, 2), surface, result.stderr.splitlines()[-1]))
        print(f"{FLIGHTS} sound flights: {len(refused)} refused")
        self.assertEqual(refused, [])


class Outputs(FalseFiles):
    def test_never_replace_what_the_run_reads(self):
        trajectory, errors = self.folder / "a.out", self.folder / "b.out"
        trajectory.write_bytes(self.survey.sbet.read_bytes())
        errors.write_bytes(self.survey.errors.read_bytes())
        source, survey = self.folder / "in.las", self.folder / "s.toml"
        source.write_bytes(self.sound)
        survey.write_bytes(self.toml_file.read_bytes())
        common = ("--survey", survey, "--table", self.quick, "--trajectory", trajectory, "--trajectory-errors", errors,
                  "--water-level", self.survey.water_level, "--overwrite")
        table, sensor, points = self.folder / "table.h5", self.folder / "sensor.toml", self.folder / "points.csv"
        table.write_bytes(pathlib.Path(self.quick).read_bytes())
        sensor.write_text('title = "Mine"\n' + "".join(
            f'[{name}]\nvalue = {value}\nunit = "{unit}"\nsource = "mine"\n'
            for name, value, unit in (("scan", 0.02, "degree"), ("bottom_range", 0.1, "m"), ("divergence", 1, "mrad"))))
        own = self.write("own.toml", SURVEY.replace("riegl-vq-880-g", str(sensor)))
        points.write_text("depth,incidence,altitude\n8,12,400\n")
        before = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        for path in (trajectory, errors, survey):
            self.assert_fails(query("las", source, path, *common), 1, f"{path.name}: is read by this run")
            self.assert_fails(query("las", source, "--csv", path, *common), 1, f"{path.name}: is read by this run")
        beams = ("--trajectory", trajectory, "--water-level", self.survey.water_level)
        for path in (table, sensor):
            for command, *given in (("las", source, path, *beams),
                                    ("csv", points, path, "--surface-located", "level", "--footprint", 0.5)):
                self.assert_fails(query(command, *given, "--survey", own, "--table", table, "--overwrite"), 1,
                                  f"{path.name}: is read by this run")
        self.assertEqual({path.name: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_are_never_a_second_input(self):
        """Two names with `--csv FOLDER` are an input and its output; of more names, all are inputs."""
        lines, tables = [self.folder / f"{name}.las" for name in "ab"], self.folder / "tables of points"
        tables.mkdir()
        for line in lines:
            line.write_bytes(self.sound)
        common = ("--csv", tables, "--survey", self.toml_file, "--table", self.quick, "--trajectory", self.survey.sbet,
                  "--trajectory-errors", self.survey.errors, "--water-level", self.survey.water_level)
        for more in ((), ("--overwrite",)):
            self.assert_fails(query("las", *lines, *common, *more), 2, "if both are inputs, add --output-dir")
            self.assertEqual(lines[1].read_bytes(), self.sound)
        lines[1].unlink()
        self.assertEqual(query("las", *lines, *common).returncode, 0)
        self.assertEqual(query("las", *lines, *common, "--overwrite").returncode, 0)

    def test_are_no_links(self):
        common = ("--survey", self.toml_file, "--table", self.quick, "--trajectory", self.survey.sbet,
                  "--trajectory-errors", self.survey.errors, "--water-level", self.survey.water_level, "--overwrite")
        source, link, file = (self.folder / name for name in ("in.las", "link.las", "file.las"))
        source.write_bytes(self.sound)
        file.write_bytes(b"a file of someone")
        for target in (file, "/dev/stdout", "nowhere"):
            link.symlink_to(target)
            self.assert_fails(query("las", source, link, *common), 1, "link.las: is a link")
            self.assertTrue(link.is_symlink())
            link.unlink()
        self.assertEqual(file.read_bytes(), b"a file of someone")
        self.assert_fails(query("las", source, self.folder / "out.csv", *common), 2, "for text")


if __name__ == "__main__":
    programs.main()
