"""albtpu-query las with LAZ: the same numbers and the same bytes as with LAS, whatever is compressed.

The LAZ inputs are made by albtpu_laz_copy, and outputs are read through it.
"""

import json
import pathlib

import numpy as np

import programs
from las_file import LasFile
from programs import FLAGS, laz_copy, make_flight, query

SAMPLES = pathlib.Path(programs.PATHS["laz_samples"])


class LazTest(programs.Test):
    def flight(self):
        return make_flight(self.folder / "in.las", 4, 6)

    def as_las(self, path):
        """The points of a file of either kind, and its VLRs without the LASzip record."""
        return LasFile(laz_copy(path, self.folder / f"{path.name} again.las"))

    def assert_same_las(self, laz, las):
        """The LAZ file is the LAS file, compressed."""
        self.assertTrue(laz.read_bytes()[104] & 0x80)
        again = self.as_las(laz)
        self.assertEqual(again.bytes, las.read_bytes())

    def test_output_folder_keeps_kinds_and_names(self):
        flight, survey, out = self.flight(), self.folder / "survey", self.folder / "out"
        survey.mkdir()
        out.mkdir()
        for name in ("A.LAZ", "b.las", "c.Laz", "D.LAS", "same.las", "same.laz"):
            copy = laz_copy(flight, self.folder / f"copy{name[-4:].lower()}")
            copy.rename(survey / name)
        (survey / "notes.txt").write_text("no points")
        command = (survey, "--output-dir", out, "--table", self.table, *FLAGS)
        query("las", *command, check=0)
        names = sorted(path.name for path in survey.iterdir() if path.suffix != ".txt")
        self.assertEqual(sorted(path.name for path in out.iterdir()),
                         sorted(names + [f"{name}.json" for name in names]))
        made = {path.name: path.read_bytes() for path in out.iterdir()}
        for name in names:
            self.assertEqual(bool(made[name][104] & 0x80), name.lower().endswith(".laz"), name)
        self.assertEqual(made["A.LAZ"], made["same.laz"])
        self.assertEqual(made["b.las"], made["same.las"])
        self.assert_same_las(out / "A.LAZ", out / "b.las")
        # The summaries say of which kind a file is, and the same of its points.
        las, laz = (json.loads(made[f"same.{kind}.json"]) for kind in ("las", "laz"))
        self.assertNotEqual(las["input"], laz["input"])
        self.assertEqual(las["answers"], laz["answers"])
        self.assertEqual(las["input"]["points"], laz["input"]["points"])
        self.assertEqual(laz["output"]["bytes"], len(made["same.laz"]))
        # Files that are there: kept, complete, written again.
        self.assert_fails(query("las", *command), 1, "6 of 6 files failed")
        (out / "c.Laz").write_bytes(b"something else")
        (out / "same.laz").unlink()
        result = query("las", *command, "--resume", "--overwrite", check=0)
        self.assertEqual(result.stderr.count("is already complete"), 4)
        self.assertEqual({path.name: path.read_bytes() for path in out.iterdir()}, made)

    def test_format_decides_the_kind_of_all_outputs(self):
        flight, out = self.flight(), self.folder / "out"
        out.mkdir()
        (self.folder / "in.las").rename(self.folder / "b.las")
        laz_copy(self.folder / "b.las", self.folder / "a.laz")
        inputs = (self.folder / "a.laz", self.folder / "b.las")
        for kind in ("laz", "las"):
            query("las", *inputs, "--output-dir", out, "--format", kind, "--table", self.table, *FLAGS, check=0)
            self.assertLessEqual({f"a.{kind}", f"b.{kind}", f"a.{kind}.json"}, {path.name for path in out.iterdir()})
            self.assertEqual((out / f"a.{kind}").read_bytes(), (out / f"b.{kind}").read_bytes())
        self.assert_same_las(out / "a.laz", out / "b.las")
        laz_copy(self.folder / "b.las", self.folder / "b.laz")
        both = (self.folder / "b.las", self.folder / "b.laz", "--output-dir", out, "--table", self.table, *FLAGS)
        self.assert_fails(query("las", *both, "--format", "laz", "--overwrite"), 2, "b.laz")
        result = query("las", inputs[0], self.folder / "x.las", "--format", "laz", "--table", self.table, *FLAGS)
        self.assert_fails(result, 2, "x.las", "--format")
        self.assertEqual(flight.name, "in.las")

    def sample(self, name):
        source = SAMPLES / name
        if not source.exists():
            self.skipTest(f"{source} does not exist")
        return source

    def test_copc_becomes_an_ordinary_file(self):
        source, target = self.sample("simple.copc.laz"), self.folder / "out.laz"
        result = query("las", source, target, "--table", self.table, "--classes", "1,2", "--units", "m", *FLAGS)
        self.assertIn("COPC", result.stderr)
        self.assertIn("COPC", (self.folder / "out.laz.json").read_text())
        old, new = self.as_las(source), self.as_las(target)
        np.testing.assert_array_equal(new.records[:, :-8], old.records)
        self.assertNotIn(b"copc", [user for user, *_ in new.vlrs])
        self.assertEqual(new.evlr_count, 0)

    def test_samples_keep_everything_else(self):
        for name in ("1815.laz", "1_4_w_evlr.laz", "append-bug.laz", "autzen_trim.laz", "extrabytes.laz", "plane.laz",
                     "point-color.las.laz", "simple.laz"):
            with self.subTest(name):
                source, target = self.sample(name), self.folder / f"out {name}"
                result = query("las", source, target, "--table", self.table, "--classes", "0,1,2,3,4,5", "--units", "m",
                               "--incidence", 12, "--water-level", 0, "--wind-speed", 6, "--footprint", 0.6)
                self.assertTrue(target.exists(), result.stderr)
                old, new = self.as_las(source), self.as_las(target)
                np.testing.assert_array_equal(new.records[:, :-8], old.records)
                kept = [vlr for vlr in old.vlrs if vlr[1] != 4]  # The one that describes extra bytes grows.
                self.assertEqual([vlr for vlr in new.vlrs if vlr[1] != 4], kept)
                self.assertEqual(new.bytes[new.end_of_points:], old.bytes[old.end_of_points:])

    def test_two_lists_of_extra_bytes_become_one(self):
        target = self.folder / "out.las"
        query("las", self.sample("append-bug.laz"), target, "--table", self.table, "--classes", 2, "--units", "m",
              *FLAGS)  # All points lie above the water.
        names = {name: (offset, kind) for name, (offset, kind, *_) in LasFile(target).extra_dimensions().items()}
        self.assertEqual(names, {"Deviation": (38, 3), "confidence": (40, 1), "sea_thu": (41, 9), "sea_tvu": (45, 9)})

    def test_samples_that_cannot_be_annotated(self):
        name = "simple-laszip-compressor-version-1.2r0.laz"
        result = query("las", self.sample(name), self.folder / "out.laz", "--table", self.table, *FLAGS)
        self.assert_fails(result, 1, name, "version 1", "LASzip")
        self.assertEqual(self.names(), ["quick.h5"])


if __name__ == "__main__":
    programs.main()
