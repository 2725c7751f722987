"""Files as people have them: headers, flags, clocks and georeferences that lie. The numbers are those of the sound file,
or there is one clear refusal, or a note says what was repaired; never another number in silence."""

import json
import math
import os
import pathlib
import random
import re
import struct
import tempfile

import numpy as np

import programs
from las_file import LasFile
from programs import PATHS, query
from simulated_survey import SimulatedSurvey

SURVEY = """[sensor]
name = "riegl-vq-880-g"
lever_arm = [0.35, -0.12, 0.42]
[sea]
wind_speed = 6
[water]
column = "none"
[datum]
sigma = 0.05
[output]
details = true
"""
FLIGHT = ("--scanner", "palmer", "--seconds", 4, "--pulse-rate", 900, "--lever-arm", "0.35,-0.12,0.42",
          "--column-share", 0.5, "--surface-share", 0.5)
WITHHELD, SYNTHETIC, OVERLAP = 4, 1, 8  # Of byte 15 of formats 6 to 10.
BOUNDS = 179  # Maximum and minimum x, then y, then z.
GLOBAL_ENCODING, CREATION, SCALE, OFFSET = 6, 90, 131, 155
CLOSE = 2e-5  # Of numbers in single precision, from coordinates about another origin.
MUTATIONS = 2000 if os.environ.get("ALBTPU_EVERY_CASE") else 300
FLIGHTS = 200 if os.environ.get("ALBTPU_EVERY_CASE") else 8


class Points:
    """A LAS file of format 6 whose bytes are changed."""

    def __init__(self, data):
        self.data = bytearray(data)
        self.begin, = struct.unpack_from("<I", data, 96)
        self.length, = struct.unpack_from("<H", data, 105)
        self.count, = struct.unpack_from("<Q", data, 247)

    def put(self, kind, offset, *values):
        struct.pack_into(kind, self.data, offset, *values)

    def get(self, kind, offset):
        return struct.unpack_from(kind, self.data, offset)

    def at(self, point, field):
        return self.begin + point * self.length + field

    def points(self, *classes):
        return [i for i in range(self.count) if self.data[self.at(i, 16)] in classes]

    def flag(self, points, bits):
        for i in points:
            self.data[self.at(i, 15)] |= bits

    def raise_by(self, points, metres):
        step = self.get("<3d", SCALE)[2]
        for i in points:
            z, = self.get("<i", self.at(i, 8))
            self.put("<i", self.at(i, 8), z + round(metres / step))

    def insert_vlr(self, user, record, payload):
        header = struct.pack("<H16sHH32s", 0, user, record, len(payload), b"")
        at, = self.get("<H", 94)
        self.data[at:at] = header + payload
        self.begin += len(header) + len(payload)
        self.put("<I", 96, self.begin)
        self.put("<I", 100, self.get("<I", 100)[0] + 1)


def geo_keys(*keys):
    entries = b"".join(struct.pack("<4H", key, 0, 1, value) for key, value in keys)
    return struct.pack("<4H", 1, 1, 0, len(keys)) + entries


class FalseFiles(programs.Test):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shared = cls.class_folder()
        cls.survey = SimulatedSurvey(cls.shared / "flight", *FLIGHT)
        cls.sound = cls.survey.las.read_bytes()
        cls.toml_file = cls.shared / "survey.toml"
        cls.toml_file.write_text(SURVEY)

    @classmethod
    def class_folder(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        return pathlib.Path(folder.name)

    def flags(self, *surface):
        return ("--survey", self.toml_file, "--table", PATHS["shipped_table"], "--trajectory", self.survey.sbet,
                *(surface or ("--water-level", self.survey.water_level)))

    def annotated(self, data, *flags, failing=False):
        """What `las` printed, and the columns that it wrote; None where it refused. If `failing`, it did both."""
        source, target = self.folder / "in.las", self.folder / "out.las"
        source.write_bytes(data)
        target.unlink(missing_ok=True)
        result = query("las", source, target, "--overwrite", *flags)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertEqual(result.returncode == 0 or failing, target.exists())
        return result.stderr, LasFile(target).columns() if target.exists() else None

    def assert_same(self, columns, expected, but=()):
        kept = np.ones(len(expected["total_thu"]), bool)
        kept[list(but)] = False
        for name, column in expected.items():
            np.testing.assert_allclose(columns[name][kept], column[kept], rtol=CLOSE, atol=CLOSE, err_msg=name)

    def mend(self, change, note, *surface, but=None):
        """The numbers of a changed file are those of the sound one, and `note` is among the notes."""
        _, expected = self.annotated(self.sound, *self.flags(*surface))
        points = Points(self.sound)
        changed = change(points)
        printed, columns = self.annotated(bytes(points.data), *self.flags(*surface))
        self.assertIsNotNone(columns, printed)
        self.assertRegex(printed, note or "trajectory")
        self.assert_same(columns, expected, changed if but is None else but)
        return columns, changed


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
                _, expected = self.annotated(self.sound, *common, *fit)
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
        _, expected = self.annotated(self.sound, *self.flags(*self.SURFACE))
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
        self.assertIn("are withheld", printed)
        self.assertIsNone(columns)
        _, expected = self.annotated(self.sound, *self.flags())
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


class Mutations(FalseFiles):
    """Random changes of header, flags, clocks and georeference of sound files: as the sound one, with a note where a
    number of the header was of use, or refused. None differs in silence."""

    def mutate(self, draw):
        points = Points(self.sound)
        kind = draw.choice(["bounds", "flags", "times", "encoding", "text", "keys", "scale", "offset", "wkt", "class"])
        chosen = draw.sample(range(points.count), draw.randint(1, 60))
        touched = set()
        if kind == "bounds":
            points.put("<d", BOUNDS + 8 * draw.randrange(6), draw.choice([0, -1e9, 1e9, math.nan, draw.gauss(0, 1e6)]))
        elif kind == "flags":
            points.flag(chosen, draw.choice([WITHHELD, SYNTHETIC, OVERLAP, 2, WITHHELD | SYNTHETIC]))
            touched = set(chosen)
        elif kind == "times":
            for i in chosen:
                points.put("<d", points.at(i, 22), draw.choice([0, math.nan, -math.inf, 1e300, draw.gauss(0, 1e9)]))
            touched = set(chosen)
        elif kind == "encoding":
            points.put("<H", GLOBAL_ENCODING, points.get("<H", GLOBAL_ENCODING)[0] ^ draw.choice([1, 4, 8, 16]))
        elif kind == "text":
            points.data[26:90] = bytes(draw.randrange(256) for _ in range(64))
            points.put("<2H", CREATION, draw.randrange(400), draw.randrange(3000))
        elif kind == "keys":
            points.insert_vlr(b"LASF_Projection", 34735, geo_keys(
                (3072, draw.choice([26917, 32617, 26918, 2236, 4326, 0, 32767])),
                (draw.choice([3076, 4099]), draw.choice([9001, 9002, 9003])), (4096, draw.choice([5703, 6360, 0]))))
        elif kind == "scale":
            axis = draw.randrange(3)
            points.put("<d", SCALE + 8 * axis, points.get("<3d", SCALE)[axis] * draw.choice([0.3048, 3.28084, -1, 10]))
        elif kind == "offset":
            axis = draw.randrange(3)
            points.put("<d", OFFSET + 8 * axis, points.get("<3d", OFFSET)[axis] + draw.choice([-1e3, 25, 1e5, 60]))
        elif kind == "wkt":
            at = bytes(points.data).find(b"UTM zone")
            old, new = draw.choice([(b'"central_meridian",-81', b'"central_meridian",-75'), (b'UNIT["metre",1', b'UNIT["metre",3'),
                                    (b"PROJCS", b"PROJXX"), (b"500000", b"400000")])
            points.data = bytearray(bytes(points.data).replace(old, new))
            self.assertGreater(at, 0)
        else:
            for i in chosen:
                points.data[points.at(i, 16)] = draw.choice([0, 7, 18])
            touched = set(chosen)
        return kind, bytes(points.data), touched

    def test_none_differs_in_silence(self):
        draw = random.Random(36)
        _, expected = self.annotated(self.sound, *self.flags())
        source, target = self.folder / "mutants", self.folder / "out"
        source.mkdir()
        target.mkdir()
        mutants = {}
        for i in range(MUTATIONS):
            kind, data, touched = self.mutate(draw)
            mutants[f"{i:04d}.las"] = kind, touched
            (source / f"{i:04d}.las").write_bytes(data)
        result = query("las", source, "--output-dir", target, *self.flags())
        same = noted = refused = 0
        for name, (kind, touched) in mutants.items():
            with self.subTest(name=name, kind=kind):
                if not (target / name).exists():
                    self.assertRegex(result.stderr, rf"(?m)^albtpu-query: \S*{name}: ")
                    refused += 1
                    continue
                self.assert_same(LasFile(target / name).columns(), expected, touched)
                printed = re.search(rf"(?s)albtpu-query: \S*/out/{name}:\n(.*?)(?=\nalbtpu-query: |\Z)", result.stderr)[1]
                if kind == "bounds":
                    self.assertIn("bounds", printed)
                noted += "header" in printed or "withheld" in printed or "synthetic" in printed
                same += 1
        print(f"{MUTATIONS} mutants: {same} as the sound file, {noted} of them noted; {refused} refused")
        self.assertGreater(same, MUTATIONS / 4)
        self.assertGreater(refused, MUTATIONS / 20)


class SoundFlights(programs.Test):
    """No right trajectory is refused, whatever the waves are and whether the classes of the surface are given."""

    def test_over_seas_of_up_to_one_and_a_half_metres(self):
        refused = []
        for i in range(FLIGHTS):
            height = 1.5 * i / (FLIGHTS - 1)
            folder = self.folder / str(i)
            survey = SimulatedSurvey(folder, *FLIGHT, "--wave-height", f"{height:.3f}", "--seed", i + 1)
            level = ("--water-level", survey.water_level)
            for surface in (level, ("--water-classes", 41), (*level, "--water-classes", 41))[i % 3::3]:
                result = query("las", survey.las, folder / "out.las", "--table", PATHS["shipped_table"], "--classes", 40,
                               "--trajectory", survey.sbet, "--lever-arm", "0.35,-0.12,0.42", "--wind-speed", 6,
                               "--divergence", 1, *surface)
                if result.returncode != 0:
                    refused.append((round(height, 2), surface, result.stderr.splitlines()[-1]))
        print(f"{FLIGHTS} sound flights: {len(refused)} refused")
        self.assertEqual(refused, [])


if __name__ == "__main__":
    programs.main()
