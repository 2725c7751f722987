"""The tables that are shipped are those of the campaigns that are shipped.

Usage: shipped_tables_test.py SOURCE_FOLDER
"""

import pathlib
import sys
import unittest

import h5py

SOURCE = pathlib.Path(sys.argv[1])


def text(attribute):
    return "" if isinstance(attribute, h5py.Empty) else attribute.decode()


class ShippedTables(unittest.TestCase):
    def test_are_made_from_the_campaigns_of_their_names(self):
        made = 0
        for path in sorted((SOURCE / "tables").glob("*.h5")):
            with h5py.File(path) as table:
                campaign = text(table.attrs["campaign"])
                if not campaign:  # published numbers
                    continue
                made += 1
                self.assertEqual(campaign, (SOURCE / f"generator/campaigns/{path.stem}.toml").read_text(), path.name)
                self.assertNotIn("dirty", text(table.attrs["commit"]), path.name)
        self.assertGreater(made, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
