"""Checks the output of albtpu-query las with a reader that shares no code with it.

The output must have the same points in the same order, the same bytes in the old fields, and the values that
`albtpu-query csv` gives for the same pulses.
"""

import csv
import json
import pathlib
import struct

import numpy as np

import programs
from las_file import LasFile
from programs import make_flight, query

ALTITUDE, DIVERGENCE = 400.0, 1.5  # m, mrad
WIND_FROM, FLIGHT = 100.0, 30.0  # degree


class LasTest(programs.Test):
    def annotate(self, source, target, classes, water_level, *flags):
        return query("las", source, target, "--table", self.table, "--scanner", "across-track",
                     "--water-level", water_level, "--classes", classes, "--wind-speed", 6.5, "--fetch", 30000,
                     "--altitude", ALTITUDE,
                     "--divergence", DIVERGENCE, "--wind-from", WIND_FROM, "--flight-direction", FLIGHT,
                     *flags, check=0)

    def values_by_csv(self, las, point_class, water_level):
        """THU and TVU of the bathymetric points from `albtpu-query csv`; NaN where there is no number."""
        chosen = las.classes == point_class
        angles, depths = las.scan_angles[chosen], water_level - las.z[chosen]
        incidences = np.abs(angles)
        footprints = ALTITUDE / np.cos(np.radians(incidences)) * (DIVERGENCE * 1e-3)
        azimuths = np.where(angles < 0, FLIGHT - 90, FLIGHT + 90) - (WIND_FROM + 180)
        pulses, answers = self.folder / "pulses.csv", self.folder / "answers.csv"
        with open(pulses, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["depth", "incidence", "footprint", "azimuth"])
            columns = (depths, incidences, footprints, azimuths)
            writer.writerows(zip(*(map(repr, column.tolist()) for column in columns)))
        query("csv", pulses, answers, "--table", self.table, "--wind-speed", 6.5, "--fetch", 30000,
              "--overwrite", check=0)
        with open(answers, newline="") as file:
            rows = list(csv.DictReader(file))
        return [np.array([float(row[name] or "nan") for row in rows], np.float32) for name in ("thu", "tvu")]

    def check(self, source, target, point_class, water_level):
        old, new = LasFile(source), LasFile(target)
        # The same points in the same order with the same bytes, each followed by 8 more.
        self.assertEqual(new.point_count, old.point_count)
        self.assertEqual(new.record_length, old.record_length + 8)
        np.testing.assert_array_equal(new.records[:, :-8], old.records)
        # Everything after the points.
        self.assertEqual(new.bytes[new.end_of_points:], old.bytes[old.end_of_points:])
        # The header apart from sizes, counts and offsets; the VLRs apart from ours; the gap before the points.
        header = bytearray(new.bytes[:old.header_size])
        struct.pack_into("<I", header, 96, old.offset_to_points)
        struct.pack_into("<I", header, 100, old.vlr_count)
        struct.pack_into("<H", header, 105, old.record_length)
        if old.evlr_count:
            self.assertEqual(new.evlr_start - new.end_of_points, old.evlr_start - old.end_of_points)
            struct.pack_into("<Q", header, 235, old.evlr_start)
        self.assertEqual(bytes(header), old.bytes[:old.header_size])
        self.assertEqual(new.vlrs[:old.vlr_count], old.vlrs)
        self.assertEqual(new.bytes[new.end_of_vlrs:new.offset_to_points],
                         old.bytes[old.end_of_vlrs:old.offset_to_points])
        # The new values.
        dimensions = new.extra_dimensions()
        by_csv = self.values_by_csv(old, point_class, water_level)
        for name, expected in zip(("sea_thu", "sea_tvu"), by_csv):
            offset, kind, no_data, description = dimensions[name]
            self.assertEqual((kind, no_data, description), (9, -1.0, "sea surface only, 95 %, m"))
            values = new.field(offset, "<f4")
            chosen = new.classes == point_class
            np.testing.assert_array_equal(values[~chosen], np.float32(-1))
            expected = np.where(np.isnan(expected), np.float32(-1), expected)
            np.testing.assert_array_equal(values[chosen], expected)
            self.assertGreater(np.mean(values[chosen] > 0), 0.9)
        return new

    def test_sample_of_a_real_survey(self):
        source = pathlib.Path(programs.PATHS["sample"])
        if not source.exists():
            self.skipTest(f"{source} does not exist")
        target = self.folder / "out.las"
        result = self.annotate(source, target, 26, -23.09)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, "(?m)^  56382 points; .*\n  depth ")
        new = self.check(source, target, 26, -23.09)
        offset, kind, _, _ = new.extra_dimensions()["undocumented"]
        self.assertEqual((offset, kind), (30, 0))

    def test_returns_of_a_real_survey_tell_its_geometry(self):
        source = pathlib.Path(programs.PATHS["sample"])
        if not source.exists():
            self.skipTest(f"{source} does not exist")
        target = self.folder / "out.las"
        query("las", source, target, "--table", self.table, "--trajectory-from-returns", "--classes", 26,
              "--water-level", -23.09, "--wind-speed", 6.5, "--divergence", 1, "--details", check=0)
        geometry = json.loads((self.folder / "out.las.json").read_text())["input"]["geometry"]
        # In the middle of the file, a straight line that another program fitted to the same pairs is 310.5 m above the
        # water, and is flown at 56.5 m/s.
        self.assertAlmostEqual(geometry["trajectory"]["height_above_water"], 310.5, delta=0.5)
        self.assertAlmostEqual(geometry["trajectory"]["speed"], 56.5, delta=0.5)
        las = LasFile(target)
        dimensions = las.extra_dimensions()
        names = ["sea_thu", "sea_tvu", "incidence", "beam_azimuth", "footprint", "water_depth", "slant_range"]
        self.assertEqual([name for name in dimensions if name in names], names)
        column = {name: las.field(dimensions[name][0], "<f4")[las.classes == 26] for name in names}
        for name in names:
            is_angle = name in ("incidence", "beam_azimuth")
            no_data = dimensions[name][2]
            self.assertTrue(np.isnan(no_data) if is_angle else no_data == -1, name)
        known = np.isfinite(column["incidence"])
        self.assertGreater(np.mean(known), 0.99)
        # The scanner is a cone of 20 degrees about an axis that is near the vertical.
        # The same program's: 17.87 to 20.91 degrees, by a track that is straight.
        self.assertAlmostEqual(float(np.min(column["incidence"][known])), 17.87, delta=0.05)
        self.assertAlmostEqual(float(np.max(column["incidence"][known])), 20.91, delta=0.05)
        np.testing.assert_allclose(column["footprint"][known], 1e-3 * column["slant_range"][known], rtol=1e-6)
        np.testing.assert_array_equal(column["water_depth"],
                                      (-23.09 - las.z[las.classes == 26]).astype(np.float32))

    def test_simulated_flights_in_many_formats(self):
        for version, point_format, extra_bytes in (
                (2, 0, 0), (2, 1, 3), (2, 3, 300), (3, 4, 0), (3, 5, 2),
                (4, 1, 0), (4, 6, 6), (4, 7, 0), (4, 8, 1), (4, 10, 9)):
            with self.subTest(version=version, point_format=point_format, extra_bytes=extra_bytes):
                source = make_flight(self.folder / "in.las", version, point_format, extra_bytes)
                target = self.folder / "out.las"
                result = self.annotate(source, target, 26 if point_format < 6 else 40, 0, "--overwrite")
                self.check(source, target, 26 if point_format < 6 else 40, 0)
                self.assertEqual("whole degrees" in result.stderr, point_format < 6)

    def test_many_files_into_a_folder(self):
        make_flight(self.folder / "a.las")
        make_flight(self.folder / "b.las", 4, 7)
        land = make_flight(self.folder / "land.las", 2, 1)  # It has no class 40.
        out = self.folder / "out"
        out.mkdir()
        (self.folder / "bad.las").write_bytes(b"LASF")
        flags = ("--output-dir", out, "--table", self.table, "--scanner", "across-track", "--classes", 40,
                 "--water-level", 0, "--wind-speed", 6, "--footprint", 1)
        files = [self.folder / name for name in ("a.las", "bad.las", "land.las", "b.las")]
        result = query("las", *files, *flags)
        self.assert_fails(result, 1, "1 of 4 files failed")
        self.assertIn("bad.las", result.stderr)
        self.assertEqual(sorted(path.name for path in out.iterdir()),
                         ["a.las", "a.las.json", "b.las", "b.las.json", "land.las", "land.las.json"])
        values = LasFile(out / "land.las")
        self.assertTrue(np.all(values.field(values.record_length - 8, "<f4") == -1))
        self.assertIn("no point of class 40", result.stderr)
        self.assert_fails(query("las", land, *flags, "--overwrite"), 1,
                          "no file has a point of the bathymetric classes")
        same_name = self.folder / "out" / ".." / "a.las"
        self.assert_fails(query("las", files[0], same_name, *flags), 2, "two inputs are called a.las")

    def test_error_lists_the_classes_of_the_file(self):
        source = make_flight(self.folder / "in.las")
        result = query("las", source, self.folder / "out.las", "--table", self.table, "--water-level", 0,
                       "--scanner", "across-track", "--wind-speed", 6, "--footprint", 1, "--classes", "26,27")
        self.assert_fails(result, 1, "no point of class 26 or 27", "--classes", "class 40: 20200 points")
        self.assertNotIn("out.las", self.names())


if __name__ == "__main__":
    programs.main()
