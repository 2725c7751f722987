"""Copies of a flight line among the files of a survey, from outside: each command that adds up points names both files,
and takes no line for a copy of another."""

import json
import pathlib
import shutil
import struct
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "programs/query"))

import programs  # noqa: E402
import reported_survey  # noqa: E402
from las_file import LasFile  # noqa: E402
from programs import query  # noqa: E402
from reported_survey import Report  # noqa: E402


def setUpModule():
    reported_survey.make("--no-page")


class Copies(Report):
    def survey(self):
        """The annotated survey in a folder of its own, without the last line."""
        folder = shutil.copytree(self.annotated, self.folder / "survey")
        self.leave_out(folder / "flight_5.las")
        return folder

    @staticmethod
    def leave_out(path):
        path.unlink()
        path.with_name(path.name + ".json").unlink()

    def add(self, path, data, source):
        """Writes the bytes `data` as an annotated file with the summary of `source`."""
        path.write_bytes(data)
        summary = json.loads(source.with_name(source.name + ".json").read_text())
        summary["output"]["bytes"] = len(data)
        path.with_name(path.name + ".json").write_text(json.dumps(summary))

    def commands(self, folder):
        points = self.folder / "points.csv"
        places = np.column_stack([self.points[name] for name in "xyz"])[::len(self.points["x"]) // 100]
        points.write_text("id,x,y,elevation\n" + "".join(f"{i},{x},{y},{z}\n" for i, (x, y, z) in enumerate(places)))
        for command in (("report", folder, "--output", self.folder / "made", "--no-page", "--overwrite"),
                        ("crosscheck", folder),
                        ("surface", folder, "--output", self.folder / "grid", "--overwrite"),
                        ("checkpoints", folder, points)):
            yield command

    def assert_noticed(self, folder, copy, of):
        for command in self.commands(folder):
            with self.subTest(command[0], copy=copy):
                self.assert_fails(query(*command), 1, f"{copy}: has points of ", of,
                                  "100 % of those of the smaller file", "give one of the two files")

    def edited(self, edit):
        """The bytes of the second line after a change of its records, of which it may return fewer."""
        las = LasFile(self.annotated / "flight_2.las")
        records = edit(las.records.copy())
        data = bytearray(las.bytes[:las.offset_to_points]) + records.tobytes() + las.bytes[las.end_of_points:]
        struct.pack_into("<Q", data, 247, len(records))
        return data

    def test_under_another_name_are_noticed(self):
        folder = self.survey()
        for suffix in (".las", ".las.json"):
            shutil.copy(folder / f"flight_2{suffix}", folder / f"line_2{suffix}")
        self.assert_noticed(folder, "line_2.las", "flight_2.las")
        self.assertFalse((self.folder / "made").exists() or (self.folder / "grid").exists())

    def test_in_laz_are_noticed(self):
        folder = self.survey()
        packed = programs.laz_copy(folder / "flight_2.las", self.folder / "packed.laz").read_bytes()
        self.add(folder / "flight_2b.laz", packed, folder / "flight_2.las")
        self.assert_noticed(folder, "flight_2b.laz", "flight_2.las")

    def test_in_another_order_with_other_classes_and_heights_are_noticed(self):
        def edit(records):
            records = np.random.default_rng(1).permutation(records)
            records[:, 16] = np.where(records[:, 16] == 40, 40, 2)
            records[:, 8:12] = (records[:, 8:12].copy().view("<i4") + 30).view(np.uint8)
            return records

        folder = self.survey()
        self.add(folder / "reclassified.las", self.edited(edit), folder / "flight_2.las")
        self.assert_noticed(folder, "reclassified.las", "flight_2.las")

    def test_of_the_bottom_alone_are_noticed(self):
        folder = self.survey()
        self.add(folder / "only_bottom.las", self.edited(lambda records: records[records[:, 16] == 40]),
                 folder / "flight_2.las")
        self.assert_noticed(folder, "only_bottom.las", "flight_2.las")

    def test_are_not_what_lines_with_as_many_points_are(self):
        folder = self.survey()
        lines = [LasFile(folder / f"flight_{i}.las") for i in (1, 2, 3, 4)]
        fewest = min(las.point_count for las in lines)
        for i, las in enumerate(lines, 1):
            path = folder / f"flight_{i}.las"
            data = bytearray(las.bytes[:las.offset_to_points] + las.records[:fewest].tobytes())
            struct.pack_into("<Q", data, 247, fewest)
            self.add(path, data, path)
        for command in self.commands(folder):
            with self.subTest(command[0]):
                self.assertNotIn("has points of", query(*command, check=0).stderr)


if __name__ == "__main__":
    programs.main()
