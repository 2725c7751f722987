"""Holds a tree to its rooms.toml: each rule of uses.py, shape.py and contents.py. A rule that takes numbers or lists
from [rules] is held where they are given.

Usage: rooms_test.py SOURCE_FOLDER
"""

import sys
import unittest

import house
import rules

TREE = house.Tree(sys.argv[1])


class Rooms(unittest.TestCase):
    def test_are_seen_at_all(self):
        self.assertGreater(sum(1 for _ in house.includes(TREE.root, TREE.rooms)), 1000)
        self.assertGreater(len(house.Targets(TREE.root, TREE.rooms).links), 20)

    def test_keep_the_rules(self):
        for rule in rules.held(TREE.law):
            with self.subTest(rule.__name__):
                if breaches := list(rule(TREE)):
                    self.fail("\n".join(breaches))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
