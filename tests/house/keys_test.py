"""Each key that `albtpu-query keys` lists is one that the tables of [[rules.keys]] in rooms.toml declare, so that
contents.keys_are_declared_once overlooks none.

Usage: keys_test.py SOURCE_FOLDER ALBTPU_QUERY
"""

import json
import subprocess
import sys
import unittest

import contents
import house

TREE = house.Tree(sys.argv[1])
QUERY = sys.argv[2]


class Keys(unittest.TestCase):
    def test_are_all_found_in_the_tables(self):
        if "keys" not in TREE.law.rules:
            self.skipTest("rooms.toml has no tables of keys")
        tables = {table for rule in TREE.law.rules["keys"] for table in rule["tables"]}
        declared = {key.name for _, text in TREE.code_in(tables, (".h", ".cc"))
                    for key in contents.declared_keys(text, in_table=True)}
        listed = json.loads(subprocess.run([QUERY, "keys", "--json"], capture_output=True, check=True).stdout)["keys"]
        self.assertGreater(len(listed), 50)
        self.assertEqual({key["key"] for key in listed} - declared, set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
