"""Holds the tree to rooms.toml: who includes and links whom, no circles, no crowded folder, a README in each room.

Usage: rooms_test.py SOURCE_FOLDER
"""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import house  # noqa: E402

SOURCE = pathlib.Path(sys.argv[1])
LAW = house.Law(SOURCE / "rooms.toml")
FOLDERS = sorted({room.split("/")[0] for room in LAW.rooms})
MOST_FILES = 30  # in a folder, beside its subfolders
MIRROR_NO_ROOM = ("validation/physics", "survey/flights")  # Physics of many rooms; a simulation that only tests use.
# Not of the tree: made by builds and by tools.
NOT_OURS = ("build", "out", "b", ".git", ".cache", "__pycache__")


class Includes(unittest.TestCase):
    def test_follow_the_law(self):
        seen = 0
        for path, header in house.includes(SOURCE, FOLDERS):
            here, there = LAW.room_of(path), LAW.room_of(header)
            self.assertIsNotNone(here, f"{path} lies in no room of rooms.toml")
            if there is None or there == here:
                continue
            self.assertIn(there, LAW.uses[here],
                          f"{path} includes {header}: rooms.toml does not let {here} use {there}")
            seen += 1
        self.assertGreater(seen, 100)

    def test_take_only_the_libraries_that_the_room_may_use(self):
        for path, header in house.includes(SOURCE, FOLDERS):
            here = LAW.room_of(path)
            if LAW.room_of(header) or house.SYSTEM.fullmatch(header) or not ("/" in header or "." in header):
                continue
            library = LAW.library_of(header)
            self.assertIsNotNone(library, f"{path} includes {header}, of no library in rooms.toml")
            self.assertIn(library, LAW.allowed_libraries[here], f"{path} includes {header}")

    def test_name_own_headers_from_the_root_of_the_tree(self):
        for path, header in house.includes(SOURCE, (*FOLDERS, "tests")):
            own = header.split("/")[0] in (*FOLDERS, "tests") and not header.startswith(house.WIRE)
            self.assertTrue(not own or (SOURCE / header).is_file(), f"{path} includes {header}")


class Links(unittest.TestCase):
    def setUp(self):
        self.targets = house.Targets(SOURCE, FOLDERS)

    def rooms_of(self, target):
        return {LAW.room_of(source) for source in self.targets.sources[self.targets.named(target)]}

    def test_follow_the_law(self):
        seen = 0
        for target, links in self.targets.links.items():
            rooms = self.rooms_of(target)
            used = rooms.union(*(LAW.uses[room] for room in rooms if room))
            libraries = set().union(*(LAW.allowed_libraries[room] for room in rooms if room))
            for link in links:
                if "$" in link or not rooms:  # made by protoc
                    continue
                if link.startswith("albtpu"):
                    theirs = self.rooms_of(link) or {"proto"}
                    self.assertTrue(theirs & used, f"{target} links {link}: rooms.toml does not let {rooms} use it")
                else:
                    library = LAW.library_of_target(link)
                    self.assertIsNotNone(library, f"{target} links {link}, of no library in rooms.toml")
                    self.assertIn(library, libraries, f"{target} links {link}")
                seen += 1
        self.assertGreater(seen, 20)

    def test_leave_no_source_out_and_compile_none_twice(self):
        compiled = [source for sources in self.targets.sources.values() for source in sources]
        for folder in FOLDERS:
            for path in house.sources_in(SOURCE / folder):
                source = path.relative_to(SOURCE).as_posix()
                if path.suffix == ".cc":
                    self.assertEqual(compiled.count(source), 1, f"{source}: targets that compile it")


class Circles(unittest.TestCase):
    def test_are_nowhere(self):
        self.assertEqual(house.circles(SOURCE, (*FOLDERS, "tests", "clients")), [])

    def test_are_found_where_there_are_some(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            files = {"room/a.h": "b.h", "room/b.h": "c.h", "room/c.h": None, "room/c.cc": "a.h",  # by a source
                     "room/d.h": "e.h", "room/e.h": "d.h",  # by headers
                     "room/f.h": "a.h"}
            (root / "room").mkdir()
            for name, included in files.items():
                (root / name).write_text(f'#include "room/{included}"\n' if included else "#include <vector>\n")
            self.assertEqual(sorted(house.circles(root, ["room"])),
                             [["room/a", "room/b", "room/c"], ["room/d", "room/e"]])

    def test_are_not_in_the_law_either(self):
        order, left = [], {room: set(uses) for room, uses in LAW.uses.items()}
        while free := [room for room, uses in left.items() if not uses]:
            order += free
            left = {room: uses - set(free) for room, uses in left.items() if room not in free}
        self.assertEqual(left, {}, "rooms that use each other")


class Rooms(unittest.TestCase):
    def test_are_not_crowded(self):
        for folder in [SOURCE, *(path for path in SOURCE.rglob("*") if path.is_dir())]:
            inside = folder.relative_to(SOURCE).as_posix() + "/"
            if any(f"/{inside}".find(f"/{name}/") >= 0 for name in NOT_OURS) or (folder / "CMakeCache.txt").exists():
                continue
            if any((parent / "CMakeCache.txt").exists() for parent in folder.parents):
                continue
            files = [path for path in folder.iterdir() if path.is_file()]
            self.assertLessEqual(len(files), MOST_FILES, f"{inside} is crowded: split it into rooms")

    def test_are_mirrored_by_the_tests(self):
        for path in house.sources_in(SOURCE / "tests"):
            folder = path.relative_to(SOURCE / "tests").parent.as_posix()
            if folder.split("/")[0] in FOLDERS and folder not in MIRROR_NO_ROOM:
                self.assertTrue((SOURCE / folder).is_dir(), f"{path.relative_to(SOURCE)} mirrors no room")

    def test_say_who_lives_there(self):
        for room in LAW.rooms:
            readme = SOURCE / room / "README.md"
            self.assertTrue(readme.is_file(), f"{room} has no README.md")
            lines = len(readme.read_text().splitlines())
            self.assertTrue(5 <= lines <= 15, f"{room}/README.md has {lines} lines: 5 to 15 expected")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
