"""The same source in two folders, by files of other times, modes and order, gives the same bytes: an object, the wheel
and the archive. Nor does any installed file name the folder of the source.

tests/e2e/reproducible.sh (test.sh --reproducible) compares whole packages, which takes two builds without a cache.

Usage: reproducible_test.py SOURCE BUILD CMAKE
"""

import importlib.util
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import unittest

from commands import FolderTest

SOURCE, BUILD = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
CMAKE = sys.argv[3]
TIME = "1700000000"
OBJECT = SOURCE / "tables/file/atomic_file.cc"  # It is compiled by itself, and has a namespace without a name.
NOT_COPIED = shutil.ignore_patterns("__pycache__", "build", "*.egg-info", "*.h5")


def load_portable():
    specification = importlib.util.spec_from_file_location("portable", SOURCE / "packaging/portable.py")
    portable = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(portable)
    return portable


def change_times_and_modes(folder, number):
    for i, path in enumerate(sorted(folder.rglob("*"), reverse=number == 1)):
        path.chmod((0o755, 0o700)[number] if path.is_dir() else (0o644, 0o660)[number])
        time = 1_500_000_000 + 1000 * number + i
        os.utime(path, (time, time))


class Reproducible(FolderTest):
    def setUp(self):
        super().setUp()
        os.environ |= {"SOURCE_DATE_EPOCH": TIME, "CCACHE_DISABLE": "1"}

    def copies(self, *parts):
        """Two folders with these parts of the source."""
        copies = self.folder / "a", self.folder / "another/place"
        for number, copy in enumerate(copies):
            for part in parts:
                shutil.copytree(SOURCE / part, copy / part, copy_function=shutil.copyfile, ignore=NOT_COPIED)
            change_times_and_modes(copy, number)
        return copies

    def assert_same(self, first, second):
        self.assertGreater(first.stat().st_size, 100)
        self.assertEqual(first.name, second.name)
        self.assertTrue(first.read_bytes() == second.read_bytes(), f"{first.name} differs")

    def test_object(self):
        entry = next(entry for entry in json.loads((BUILD / "compile_commands.json").read_text())
                     if entry["file"] == str(OBJECT))
        words = [word for word in shlex.split(entry["command"]) if not word.startswith("-g")]  # Packages have none.
        if any(word.startswith("-fsanitize") for word in words):
            self.skipTest("sanitizers put the names of the sources into objects")
        if "-include" in words:  # The precompiled header, which belongs to the folder of the build.
            at = words.index("-include")
            del words[at:at + 2]
        made = []
        for copy in self.copies("status", "tables"):
            made.append(copy / "made.o")
            command = [word.replace(str(SOURCE), str(copy)) for word in words]
            command[command.index("-o") + 1] = "made.o"
            subprocess.run(command, check=True, cwd=copy)
        self.assert_same(*made)

    @unittest.skipUnless(importlib.util.find_spec("pip") and importlib.util.find_spec("wheel"),
                         "pip or wheel is missing; apt-get install python3-pip python3-wheel")
    def test_wheel_and_archive(self):
        portable, made = load_portable(), []
        for number, copy in enumerate(self.copies("clients/python")):
            wheels, unpacked = copy / "wheels", copy / "unpacked"
            subprocess.run([sys.executable, "-B", "-m", "pip", "wheel", "--quiet", "--no-index", "--no-deps",
                            "--no-build-isolation", "--wheel-dir", wheels, copy / "clients/python"], check=True)
            (wheel,) = wheels.iterdir()
            subprocess.run([sys.executable, "-m", "wheel", "unpack", "--dest", unpacked, wheel], check=True,
                           stdout=subprocess.DEVNULL)
            (tree,) = unpacked.iterdir()
            change_times_and_modes(tree, number)
            portable.pack_tree_as_wheel(tree, copy)
            portable.pack_archive(tree, copy / "made.tar.xz")
            made.append((next(copy.glob("*.whl")), copy / "made.tar.xz"))
        for first, second in zip(*made):
            self.assert_same(first, second)

    @unittest.skipUnless("CMAKE_BUILD_TYPE:STRING=Release\n" in (BUILD / "CMakeCache.txt").read_text(),
                         "not a build of which packages are made")
    def test_installation_names_no_folder_of_the_build(self):
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", self.folder / "installed", "--strip"], check=True,
                       stdout=subprocess.DEVNULL)
        files = [path for path in (self.folder / "installed").rglob("*") if path.is_file()]
        self.assertGreater(len(files), 100)
        for path in files:
            with self.subTest(path.name):
                self.assertNotIn(bytes(SOURCE) + b"/", path.read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
