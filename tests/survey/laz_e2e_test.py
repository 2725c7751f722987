"""albtpu-query las with LAZ: the same numbers and the same bytes as with LAS, whatever is compressed.

The LAZ inputs are made by albtpu_laz_copy, and outputs are read through it.
"""

import json
import pathlib
import struct
import subprocess

import numpy as np

import programs
from las_file import LasFile
from programs import make_flight, make_table, query

FLAGS = ("--scanner", "across-track", "--water-level", 0, "--wind-speed", 6, "--footprint", 0.6)
SAMPLES = pathlib.Path(programs.PATHS["laz_samples"])


def laz_copy(source, target, *flags):
    subprocess.run([programs.PATHS["laz_copy"], source, target, *map(str, flags)], check=True)
    return target


class LazTest(programs.Test):
    def annotate(self, source, target, *flags, table=True):
        where = ("--table", self.table) if table else ()
        query("las", source, target, *where, *FLAGS, *flags, "--overwrite", check=0)
        return target

    def flight(self, version=4, point_format=6, extra_bytes=0, name="in"):
        return make_flight(self.folder / f"{name}.las", version, point_format, extra_bytes)

    def as_las(self, path):
        """The points of a file of either kind, and its VLRs without the LASzip record."""
        return LasFile(laz_copy(path, self.folder / f"{path.name} again.las"))

    def assert_same_las(self, laz, las):
        """The LAZ file is the LAS file, compressed."""
        self.assertTrue(laz.read_bytes()[104] & 0x80)
        again = self.as_las(laz)
        self.assertEqual(again.bytes, las.read_bytes())

    def test_kinds_of_input_and_output_do_not_change_the_numbers(self):
        for version, point_format, extra_bytes in (
                (2, 0, 0), (2, 1, 3), (2, 2, 1), (2, 3, 300), (3, 4, 0), (3, 5, 2), (4, 1, 0), (4, 6, 6), (4, 7, 0),
                (4, 8, 1), (4, 9, 4), (4, 10, 9)):
            with self.subTest(version=version, point_format=point_format, extra_bytes=extra_bytes):
                las = self.flight(version, point_format, extra_bytes)
                laz = laz_copy(las, self.folder / "in.laz")
                flags = ("--details", "--classes", 26 if point_format < 6 else 40)
                wanted = self.annotate(las, self.folder / "las to.las", *flags)
                values = LasFile(wanted)
                self.assertGreater(np.mean(values.field(values.record_length - 28, "<f4") > 0), 0.2)
                self.assertEqual(self.annotate(laz, self.folder / "laz to.las", *flags).read_bytes(),
                                 wanted.read_bytes())
                compressed = self.annotate(las, self.folder / "las to.laz", *flags)
                self.assert_same_las(compressed, wanted)
                self.assertEqual(self.annotate(laz, self.folder / "laz to.laz", *flags).read_bytes(),
                                 compressed.read_bytes())
                # Busier than a survey: a pattern fills the fields that a flight leaves open.
                self.assertLess(compressed.stat().st_size, wanted.stat().st_size)

    def test_chunks_and_tables_of_every_form_are_read(self):
        for point_format in (3, 6):
            las = self.flight(2 if point_format == 3 else 4, point_format, 2)
            classes = ("--classes", 26 if point_format < 6 else 40)
            wanted = self.annotate(las, self.folder / "wanted.las", *classes)
            for flags in (("--chunk-size", 777), ("--chunk-size", "variable"), ("--chunk-size", 4294967294),
                          ("--table", "end"), ("--table", "end", "--chunk-size", "variable"), ("--table", "none"),
                          ("--table", "none", "--chunk-size", 1000)):
                with self.subTest(point_format=point_format, flags=flags):
                    laz = laz_copy(las, self.folder / "in.laz", *flags)
                    target = self.annotate(laz, self.folder / "out.las", *classes)
                    self.assertEqual(target.read_bytes(), wanted.read_bytes())

    def test_versions_before_1_2(self):
        las = self.flight(2, 1, 4)
        data = bytearray(las.read_bytes())
        for minor in (1, 0):
            data[25] = minor
            las.write_bytes(data)
            laz = laz_copy(las, self.folder / "in.laz")
            target = self.annotate(laz, self.folder / "out.laz", "--classes", 26)
            wanted = self.annotate(las, self.folder / "wanted.las", "--classes", 26)
            self.assertEqual(wanted.read_bytes()[25], minor)
            self.assert_same_las(target, wanted)
        # LAS 1.0 has a signature before its points.
        offset, = struct.unpack_from("<I", data, 96)
        struct.pack_into("<I", data, 96, offset + 2)
        data[offset:offset] = b"\xdd\xcc"
        las.write_bytes(data)
        wanted = self.annotate(las, self.folder / "wanted.las", "--classes", 26)
        las = LasFile(wanted)
        self.assertEqual(las.bytes[las.offset_to_points - 2:las.offset_to_points], b"\xdd\xcc")

    def test_server_writes_the_same_bytes(self):
        laz = laz_copy(self.flight(), self.folder / "in.laz")
        tables = self.folder / "tables"
        tables.mkdir()
        make_table(tables / "quick.h5")
        local = self.annotate(laz, self.folder / "local.laz")
        with programs.server(tables) as address:
            remote = self.annotate(laz, self.folder / "remote.laz", "--server", address, table=False)
        self.assertEqual(local.read_bytes(), remote.read_bytes())

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

    def test_empty_file(self):
        data = bytearray(self.flight().read_bytes())
        offset, = struct.unpack_from("<I", data, 96)
        struct.pack_into("<QIQ", data, 235, 0, 0, 0)
        empty = self.folder / "empty.las"
        empty.write_bytes(data[:offset])
        results = []
        for kind in ("las", "laz"):
            source = laz_copy(empty, self.folder / f"none.{kind}")
            results.append(query("las", source, self.folder / f"out.{kind}", "--table", self.table, *FLAGS))
        self.assertEqual(results[0].returncode, results[1].returncode)
        if results[0].returncode == 0:
            self.assert_same_las(self.folder / "out.laz", self.folder / "out.las")

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
        for name in ("1815.laz", "1_4_w_evlr.laz", "autzen_trim.laz", "extrabytes.laz", "plane.laz",
                     "point-color.las.laz", "simple.laz"):
            with self.subTest(name):
                source, target = self.sample(name), self.folder / f"out {name}"
                result = query("las", source, target, "--table", self.table, "--classes", "0,1,2,3,4,5",
                               "--units", "m", *FLAGS)
                self.assertTrue(target.exists(), result.stderr)
                old, new = self.as_las(source), self.as_las(target)
                np.testing.assert_array_equal(new.records[:, :-8], old.records)
                kept = [vlr for vlr in old.vlrs if vlr[1] != 4]  # The one that describes extra bytes grows.
                self.assertEqual([vlr for vlr in new.vlrs if vlr[1] != 4], kept)
                self.assertEqual(new.bytes[new.end_of_points:], old.bytes[old.end_of_points:])

    def test_samples_that_cannot_be_annotated(self):
        for name, parts in (("append-bug.laz", ("two VLRs",)),
                            ("simple-laszip-compressor-version-1.2r0.laz", ("version 1", "LASzip"))):
            result = query("las", self.sample(name), self.folder / "out.laz", "--table", self.table, *FLAGS)
            self.assert_fails(result, 1, name, *parts)
            self.assertEqual(self.names(), ["quick.h5"])


if __name__ == "__main__":
    programs.main()
