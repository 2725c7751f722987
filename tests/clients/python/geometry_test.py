"""The geometry of pulses has the bits of the C++ library, and the names and units of the package.

Usage: geometry_test.py ALBTPU_RANDOM_BEAMS
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import albtpu
from albtpu import geometry

RANDOM_BEAMS = sys.argv[1]


class Bits(unittest.TestCase):
    def test_are_those_of_the_library(self):
        count = 100_000
        with tempfile.TemporaryDirectory() as folder:
            for index in (1.33, 1.0, 1.342, 1.5):
                path = pathlib.Path(folder, "beams")
                subprocess.run([RANDOM_BEAMS, str(count), str(index), path], check=True)
                *points, incidence, azimuth, slant_range, water_path = np.fromfile(path, "<f8").reshape(9, count)
                ours = geometry.beams_in_radians(*points, index)
                for name, mine, theirs in zip(("incidence", "azimuth", "slant range", "path in water"), ours,
                                              (incidence, azimuth, slant_range, water_path)):
                    same = (mine == theirs) | (np.isnan(mine) & np.isnan(theirs))
                    self.assertTrue(same.all(), f"{name}, index {index}: {np.count_nonzero(~same)} differ")
                    self.assertTrue((np.signbit(mine) == np.signbit(theirs))[~np.isnan(mine)].all(), name)
                    self.assertGreater(np.isfinite(mine).mean(), 0.95, name)


class Beams(unittest.TestCase):
    def test_obey_snells_law(self):
        theta, in_water = np.radians(20), np.arcsin(np.sin(np.radians(20)) / geometry.SEA_WATER_INDEX)
        beams = geometry.beams(east=400 * np.tan(theta) + 12 * np.tan(in_water), north=0, height=400, depth=12)
        self.assertAlmostEqual(float(beams.incidence), 20, 12)
        self.assertAlmostEqual(float(beams.beam_azimuth), 90, 12)
        self.assertAlmostEqual(float(beams.slant_range), 400 / np.cos(theta), 11)
        self.assertAlmostEqual(float(beams.water_path), 12 / np.cos(in_water), 11)

    def test_have_the_shape_to_which_the_points_broadcast(self):
        beams = geometry.beams(east=np.arange(4.0)[:, None], north=1, height=400, depth=[[1, 2, 3]], convergence=2)
        self.assertEqual(beams.incidence.shape, (4, 3))
        self.assertEqual(geometry.beams(east=[], north=1, height=400, depth=2).water_path.shape, (0,))
        for i, depth in enumerate((1, 2, 3)):
            one = geometry.beams(east=2, north=1, height=400, depth=depth, convergence=2)
            self.assertEqual(beams.incidence[2, i], one.incidence)
            self.assertAlmostEqual(float(one.beam_azimuth), np.degrees(np.arctan2(2, 1)) + 2, 12)

    def test_are_nan_where_the_sensor_is_not_above_the_water_or_a_number_is_missing(self):
        depth = np.ma.masked_array([5.0, 5.0, 5.0], [False, False, True])
        beams = geometry.beams(east=30, north=0, height=[400, -400, 400], depth=depth)
        np.testing.assert_array_equal(np.isnan(beams.incidence), [False, True, True])


class Footprint(unittest.TestCase):
    def test_is_the_slant_range_times_the_divergence_plus_the_aperture(self):
        np.testing.assert_array_equal(geometry.footprint([400, 500], 2), [400 * (2 * 1e-3), 500 * (2 * 1e-3)])
        self.assertEqual(geometry.footprint(400, divergence_mrad=1, aperture=0.25), 0.65)

    def test_is_not_known_of_masked_numbers(self):
        masked = np.ma.masked_equal([425.0, -9999.0], -9999.0)
        for numbers in (geometry.footprint(masked, 1), geometry.footprint(1, masked), geometry.footprint(1, 1, masked),
                        geometry.azimuth_from_downwind(masked, 0), geometry.azimuth_from_downwind(0, masked),
                        geometry.azimuth_on_sea(masked, 0), geometry.azimuth_on_sea(0, masked)):
            np.testing.assert_array_equal(np.isnan(numbers), [False, True])


class Azimuth(unittest.TestCase):
    def test_is_zero_for_a_beam_that_travels_with_the_wind(self):
        for beam, wind, expected in ((180, 0, 0), (0, 180, 0), (0, 0, 180), (90, 270, 0), (0, 270, 270),
                                     (180, 1e-300, 0), (-90, 0, 90), (720, 900, 0)):
            self.assertEqual(geometry.azimuth_from_downwind(beam, wind), expected, (beam, wind))
        self.assertEqual(geometry.azimuth_from_downwind(179.99999999999997, 0), 0)  # Not 360.


class Package(unittest.TestCase):
    def test_imports_its_geometry_on_first_use(self):
        program = "import albtpu, sys; assert 'albtpu.geometry' not in sys.modules; albtpu.geometry.beams"
        subprocess.run([sys.executable, "-c", program], check=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
