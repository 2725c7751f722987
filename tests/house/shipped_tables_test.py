"""The tables that are shipped are those of the campaigns that are shipped, and as good as they should be.

Usage: shipped_tables_test.py SOURCE_FOLDER
"""

import pathlib
import sys
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(sys.argv[1])
CHECKED = ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu")


def text(attribute):
    return "" if isinstance(attribute, h5py.Empty) else attribute.decode()


class ShippedTables(unittest.TestCase):
    def test_are_made_from_the_campaigns_of_their_names(self):
        made = 0
        for path in sorted((SOURCE / "tables" / "shipped").glob("*.h5")):
            with h5py.File(path) as table:
                campaign = text(table.attrs["campaign"])
                if not campaign:  # published numbers
                    continue
                made += 1
                self.assertEqual(campaign, (SOURCE / f"generator/campaigns/{path.stem}.toml").read_text(), path.name)
                self.assertNotIn("dirty", text(table.attrs["commit"]), path.name)
        self.assertGreater(made, 0)


class TableOfWater(unittest.TestCase):
    def setUp(self):
        self.path = SOURCE / "tables/water/shipped/water_column.h5"
        self.table = h5py.File(self.path)
        self.addCleanup(self.table.close)

    def test_is_made_from_the_campaign_of_water(self):
        campaign = (SOURCE / "generator/campaigns/water.toml").read_text()
        self.assertEqual(text(self.table.attrs["campaign"]), campaign)
        self.assertNotIn("dirty", text(self.table.attrs["commit"]))
        self.assertLess(self.path.stat().st_size, 5e6)

    def test_is_right_between_its_nodes(self):
        for detector, share in (("peak", 0.97), ("half", 0.99), ("centroid", 0.99)):
            numbers = self.table.attrs[f"interpolation_error_bias_vertical_{detector}"]
            self.assertGreaterEqual(numbers[1], share, detector)
            self.assertGreaterEqual(numbers[4], 200, detector)


class SurveyTable:
    """What both tables for surveys promise."""

    def setUp(self):
        self.path = SOURCE / "tables/shipped" / self.name
        self.table = h5py.File(self.path)
        self.addCleanup(self.table.close)

    def test_is_small_enough_to_ship(self):
        self.assertLess(self.path.stat().st_size, 15e6)

    def test_is_right_between_its_nodes(self):
        for name in CHECKED:
            rms, percentile_99, _, _, pulses = self.table.attrs[f"interpolation_error_{name}"]
            self.assertLessEqual(rms, 0.005, name)
            self.assertLessEqual(percentile_99, 0.02, name)
            self.assertGreater(pulses, 250, name)

    def test_knows_every_value_to_a_per_cent_or_two(self):
        for name, least, most in (("refraction_along_wind", 0.01, 0.01), ("refraction_cross_wind", 0.01, 0.01),
                                  ("thu", 1e-3, 0.01), ("tvu", 1e-3, 0.02)):
            values, errors = self.table[name][:], self.table[f"{name}_standard_error"][:]
            asked = values >= least
            self.assertLessEqual((errors[asked] / values[asked]).max(), most, name)


class TableOfElfouhaily(SurveyTable, unittest.TestCase):
    name = "survey.h5"

    def test_is_calm_without_wind(self):
        self.assertEqual(self.table["wind_speed"][0], 0)
        for name in CHECKED + ("bias_along_beam", "bias_vertical"):
            self.assertTrue((self.table[name][0] == 0).all(), name)


class TableOfApel(SurveyTable, unittest.TestCase):
    name = "survey_apel.h5"


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
