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


class TheSurveyTable(unittest.TestCase):
    def setUp(self):
        self.path = SOURCE / "tables/shipped/survey.h5"
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

    # How many realizations a beam gets is decided before its node is balanced, which moves its value by a little.
    def test_knows_every_value_to_a_per_cent_or_two(self):
        balanced = 1.02
        for name, least, most in (("refraction_along_wind", 0.01, 0.01), ("refraction_cross_wind", 0.01, 0.01),
                                  ("thu", 1e-3, 0.01), ("tvu", 1e-3, 0.02)):
            values, errors = self.table[name][:], self.table[f"{name}_standard_error"][:]
            asked = values >= balanced * least
            self.assertLessEqual((errors[asked] / values[asked]).max(), most, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
