"""albtpu-query report and crosscheck, from outside: the same survey in other units, with points and files that count
for nothing, and with lines that their IDs do not tell apart."""

import json
import re
import shutil
import struct

import netCDF4
import numpy as np

import programs
import reported_survey
from las_file import LasFile
from programs import query
from reported_survey import Report

UNITS = {"m": 1.0, "ft": 0.3048, "us-ft": 1200 / 3937}
WKT_UNITS = {"m": 'UNIT["metre",1]', "ft": 'UNIT["foot",0.3048]', "us-ft": 'UNIT["US survey foot",0.304800609601219]'}
AXIS_UNITS = {"m": "m", "ft": "foot", "us-ft": "US_survey_foot"}
BIT_WITHHELD = 0x04  # Of byte 15 in formats 6 to 10.


def setUpModule():
    reported_survey.make("--no-page")


def vlr(user, record, data):
    return struct.pack("<H16sHH32s", 0, user, record, len(data), b"made by a test") + data


def in_units(source, target, horizontal, vertical, state_vertical):
    """The LAS file with coordinates in other units: the same steps, each as long as before."""
    las = LasFile(source)
    data = bytearray(las.bytes)
    for axis in range(3):
        unit = UNITS[vertical if axis == 2 else horizontal]
        for at in (131 + 8 * axis, 155 + 8 * axis, 179 + 16 * axis, 187 + 16 * axis):
            struct.pack_into("<d", data, at, struct.unpack_from("<d", data, at)[0] / unit)
    records = b""
    for user, record, _, payload in las.vlrs:
        if (user, record) == (b"LASF_Projection", 2112):
            wkt = re.sub(r',AUTHORITY\["EPSG","\d+"\]', "", payload.rstrip(b"\0").decode())
            wkt = wkt.replace('UNIT["metre",1]', WKT_UNITS[horizontal])
            wkt = wkt.replace('PARAMETER["false_easting",500000]',
                              f'PARAMETER["false_easting",{500000 / UNITS[horizontal]!r}]')
            if state_vertical:
                wkt = (f'COMPD_CS["both",{wkt},VERT_CS["height",VERT_DATUM["a datum",2005],{WKT_UNITS[vertical]},'
                       'AXIS["Up",UP]]]')
            payload = wkt.encode()
        records += vlr(user, record, payload)
    struct.pack_into("<I", data, 96, las.header_size + len(records))
    target.write_bytes(bytes(data[:las.header_size]) + records + bytes(data[las.offset_to_points:]))


def change(path, edit):
    """Changes the records of a LAS file; its summary stays right."""
    las = LasFile(path)
    records = las.records.copy()
    edit(records, las)
    data = bytearray(las.bytes)
    data[las.offset_to_points:las.end_of_points] = records.tobytes()
    path.write_bytes(data)


def points_left(folder):
    """Points of the bottom that are not withheld."""
    files = [LasFile(path) for path in folder.glob("*.las")]
    return sum(int(((las.classes == 40) & (las.field(15, "u1") & BIT_WITHHELD == 0)).sum()) for las in files)


class Files(Report):
    def report(self, folder, *flags):
        made = self.folder / "made"
        shutil.rmtree(made, ignore_errors=True)
        result = query("report", folder, "--output", made, "--no-page", *flags, check=0)
        return json.loads((made / "report.json").read_text()), result

    def copy(self, name="copy"):
        shutil.rmtree(self.folder / name, ignore_errors=True)
        return shutil.copytree(self.annotated, self.folder / name)

    def empty(self, folder, name, box=0.0):
        """A tile without points, whose box is what its writer left."""
        las = LasFile(folder / "flight_1.las")
        data = bytearray(las.bytes[:las.offset_to_points])
        struct.pack_into("<6d", data, 179, *[box] * 6)
        struct.pack_into("<IQ", data, 107, 0, 0)
        struct.pack_into("<QIQ", data, 235, 0, 0, 0)
        (folder / f"{name}.las").write_bytes(data)


class Units(Files):
    def test_of_a_map_that_is_not_true_to_scale_are_refused(self):
        flight, survey, folder = (self.folder / name for name in ("map.las", "map.toml", "map"))
        folder.mkdir()
        las = LasFile(self.flight / "flight_1.las")
        (wkt,) = (payload for user, record, _, payload in las.vlrs if (user, record) == (b"LASF_Projection", 2112))
        text = re.sub(r',AUTHORITY\["EPSG","\d+"\]', "", wkt.rstrip(b"\0").decode())
        text = text.replace('"scale_factor",0.9996', '"scale_factor",0.9').ljust(len(wkt)).encode()
        flight.write_bytes(las.bytes.replace(wkt, text))
        survey.write_text(re.sub(r"\[trajectory\](\n[^[].*)*", "", reported_survey.SURVEY.format(
            flight=self.flight, datum=0.05, coverage="p95")))
        query("las", flight, folder / "flight.las", "--survey", survey, "--table", self.one_table, "--incidence", 20,
              "--beam-azimuth", 90, "--altitude", 400, check=0)
        for command in ("report", "surface", "crosscheck"):
            output = ("--output", self.folder / "made") if command != "crosscheck" else ()
            self.assert_fails(query(command, folder, *output), 1, "flight.las: its coordinate system",
                              "is not true to scale: 1 m of it is 1.11 m on the ground", "UTM")

    def test_change_nothing(self):
        for horizontal, vertical, stated in (("m", "us-ft", True), ("m", "ft", False), ("ft", "ft", True),
                                             ("us-ft", "us-ft", True), ("us-ft", "m", True), ("ft", "m", False)):
            with self.subTest(horizontal=horizontal, vertical=vertical, stated=stated):
                flight, annotated = self.folder / "flight_in_units", self.folder / "annotated_in_units"
                for folder in (flight, annotated):
                    shutil.rmtree(folder, ignore_errors=True)
                    folder.mkdir()
                for path in self.flight.glob("*.las"):
                    in_units(path, flight / path.name, horizontal, vertical, stated)
                survey = self.folder / "units.toml"
                survey.write_text(reported_survey.SURVEY.format(flight=self.flight, datum=0.05, coverage="p95"))
                query("las", flight, "--output-dir", annotated, "--survey", survey, "--table", self.one_table,
                      *(() if stated else ("--units", vertical)), check=0)
                report, _ = self.report(annotated)
                self.assert_same(report, horizontal, vertical)
                check = json.loads(query("crosscheck", annotated, "--json", check=0).stdout)
                self.assertAlmostEqual(check["chi_square"], report["crosscheck"]["chi_square"], delta=1e-9)

    def assert_same(self, report, horizontal, vertical):
        self.assertAlmostEqual(report["metres_per_unit"], UNITS[horizontal], delta=1e-9)
        self.assertAlmostEqual(report["metres_per_height_unit"], UNITS[vertical], delta=1e-9)
        ours, theirs = self.json["all"], report["all"]
        self.assertEqual(theirs["points"], ours["points"])
        self.assertLess(abs(theirs["with_number"] - ours["with_number"]), 1e-4 * ours["points"])
        for name in ("thu", "tvu"):
            self.assertAlmostEqual(theirs[name]["mean"], ours[name]["mean"], delta=1e-4 * ours[name]["mean"])
        self.assertLess(abs(report["wanted"]["meeting"] - self.json["wanted"]["meeting"]), 1e-3 * ours["points"])
        # Points in steps of a centimetre, one of 250 on the side of a patch, may change it by rounding.
        ours, theirs = self.json["crosscheck"], report["crosscheck"]
        self.assertLess(abs(theirs["pairs"] - ours["pairs"]), 0.02 * ours["pairs"])
        self.assertAlmostEqual(theirs["chi_square"], ours["chi_square"], delta=0.02 * ours["chi_square"])
        self.assertAlmostEqual(theirs["factor"]["value"], ours["factor"]["value"], delta=0.02)
        self.assertEqual(theirs["guilty_share"], ours["guilty_share"])
        with netCDF4.Dataset(self.folder / "made/grid.nc") as grid, netCDF4.Dataset(self.made / "grid.nc") as metric:
            self.assertEqual(grid["x"].units, AXIS_UNITS[horizontal])
            self.assertEqual(grid["depth"].units, "m")
            metres = grid["x"][:] * UNITS[horizontal]
            np.testing.assert_allclose(np.diff(metres), 1, atol=1e-6)
            np.testing.assert_allclose(metres, metric["x"][:], atol=1e-4)
            self.assertEqual(grid["points"][:].sum(), metric["points"][:].sum())
            self.assertLess(abs(grid["depth"][:].mean() - metric["depth"][:].mean()), 1e-3)


class Points(Files):
    def test_that_are_withheld_or_noise_count_for_nothing(self):
        for share, withheld, point_class in ((10, True, 40), (2, True, 40), (10, False, 7), (10, False, 18),
                                             (10, True, 7), (1, True, 40)):
            folder = self.copy()

            def edit(records, _, share=share, withheld=withheld, point_class=point_class):
                bottom = np.flatnonzero(records[:, 16] == 40)[::share]
                records[bottom, 16] = point_class
                records[bottom, 15] |= BIT_WITHHELD if withheld else 0
                records[bottom, 8:12] = np.full(len(bottom), 300_000, "<i4").view(np.uint8).reshape(-1, 4)  # A bird.

            for path in folder.glob("*.las"):
                change(path, edit)
            left = points_left(folder)
            taken = len(self.points["z"]) - left
            key = "withheld" if point_class == 40 else "noise"
            if share == 1:
                self.assert_fails(query("report", folder, "--output", self.folder / "none", "--no-page"), 1,
                                  "no file has a point")
                continue
            report, result = self.report(folder)
            self.assertEqual(report["all"]["points"], left)
            self.assertEqual(report["left_out"], {"withheld": 0, "noise": 0} | {key: taken})
            self.assertIn(f"{taken} {'withheld points' if key == 'withheld' else 'points of noise'}", result.stdout)
            self.assertEqual(sum(report["wanted"]["without_number"].values()),
                             left - report["all"]["with_number"])
            with netCDF4.Dataset(self.folder / "made/grid.nc") as grid:
                self.assertEqual(grid["points"][:].sum(), left)
            check = json.loads(query("crosscheck", folder, "--json", check=0).stdout)
            self.assertEqual(check["left_out"][key], taken)
            self.assertAlmostEqual(check["chi_square"], self.json["crosscheck"]["chi_square"], delta=0.15)

    def test_count_where_the_annotation_used_them(self):
        folder = self.copy()

        def edit(records, _):
            records[::3, 15] |= BIT_WITHHELD

        for path in folder.glob("*.las"):
            change(path, edit)
            summary = json.loads(path.with_suffix(".las.json").read_text())
            summary["parameters"]["use_withheld"] = True
            path.with_suffix(".las.json").write_text(json.dumps(summary))
        report, _ = self.report(folder)
        self.assertEqual(report["all"], self.json["all"])
        self.assertNotIn("left_out", report)


class Times(Files):
    def test_in_milliseconds_are_read_as_such(self):
        folder = self.copy()

        def edit(records, las):
            times = 1000 * las.field(22, "<f8")
            records[:, 22:30] = times.view(np.uint8).reshape(-1, 8)

        for path in folder.glob("*.las"):
            change(path, edit)
            summary = json.loads(path.with_suffix(".las.json").read_text())
            summary["input"]["geometry"]["seconds_per_time_unit"] = 1e-3
            path.with_suffix(".las.json").write_text(json.dumps(summary))
        report, _ = self.report(folder)
        for key in ("pairs", "lines", "factor", "intervals_by"):
            self.assertEqual(report["crosscheck"][key], self.json["crosscheck"][key], key)
        for name, source in (("made", folder), ("right", self.annotated)):
            query("surface", source, "--output", self.folder / f"{name}_nodes", "--cell", 2, check=0)
        with netCDF4.Dataset(self.folder / "made_nodes/surface.nc") as made, \
                netCDF4.Dataset(self.folder / "right_nodes/surface.nc") as right:
            np.testing.assert_array_equal(made["passes"][:], right["passes"][:])


class Headers(Files):
    def test_are_not_believed(self):
        for boxes in ({"flight_1": [0.0] * 6}, {"flight_2": [1e300, -1e300] * 3}, {"flight_1": [np.nan] * 6},
                      {"flight_3": [0.0, 0.0] + [1e9] * 4}, {f"flight_{i}": [-1.0, 1.0] * 3 for i in range(1, 6)}):
            folder = self.copy()
            for name, box in boxes.items():
                data = bytearray((folder / f"{name}.las").read_bytes())
                struct.pack_into("<6d", data, 179, *box)
                (folder / f"{name}.las").write_bytes(data)
            report, _ = self.report(folder)
            for key in ("all", "lines", "by_depth", "wanted", "crosscheck"):
                self.assertEqual(report[key], self.json[key], key)

    def test_of_files_without_points_count_for_nothing(self):
        for box in (0.0, 1e9, np.nan):
            folder = self.copy()
            self.empty(folder, "a_tile", box)
            self.empty(folder, "z_tile", box)
            report, result = self.report(folder)
            self.assertEqual(report["all"], self.json["all"])
            self.assertEqual([each["name"] for each in report["files"]], [each["name"] for each in self.json["files"]])
            self.assertIn("a_tile.las: has no points, and is left out", result.stderr)
        alone = self.folder / "alone"
        alone.mkdir()
        shutil.copy(self.annotated / "flight_1.las", alone)
        self.empty(alone, "flight_1")
        self.assert_fails(query("report", alone, "--output", self.folder / "none", "--no-page"), 1,
                          "no file has points")


class Lines(Files):
    def ids(self, of, shift=None):
        """A copy with the point source IDs that `of` gives for each line, and times that `shift` changes."""
        folder = self.copy("ids")

        def edit(records, las):
            lines = las.field(20, "<u2")
            records[:, 20:22] = np.array([of(line) for line in lines], "<u2").view(np.uint8).reshape(-1, 2)
            if shift is not None:
                times = las.field(22, "<f8")
                records[:, 22:30] = shift(times).astype("<f8").view(np.uint8).reshape(-1, 8)

        for path in folder.glob("*.las"):
            change(path, edit)
        return folder

    def test_of_one_id_are_told_apart_by_time(self):
        right = self.json["crosscheck"]
        for number in (0, 7, 65535):
            check = json.loads(query("crosscheck", self.ids(lambda _, n=number: n), "--json", check=0).stdout)
            for key in ("pairs", "chi_square", "chi_square_within_lines", "factor", "intervals_by"):
                self.assertEqual(check[key], right[key], key)
            self.assertEqual({(each["a"], each["b"]) for each in check["lines"]}, {(number, number)})
            self.assertEqual(len({each["a_begin"] for each in check["lines"]} | {each["b_begin"]
                                                                                for each in check["lines"]}),
                             len({each[key] for each in right["lines"] for key in "ab"}))
        text = query("crosscheck", self.ids(lambda _: 0), check=0).stdout
        self.assertRegex(text, r"line 0 from \d+ s on lies 0\.\d+ m (above|below) line 0 from \d+ s on")

    def test_of_one_id_have_numbers_of_their_own_in_reports(self):
        """In week time, another day's flights have the same IDs at times far apart."""
        parts = ("points", "with_number", "thu", "tvu", "meeting", "path")
        right = {line["line"]: {part: line[part] for part in parts} for line in self.json["lines"]}
        report, _ = self.report(self.ids(lambda _: 7))
        self.assertEqual({line["line"] for line in report["lines"]}, {7})
        begins = [line["begin"] for line in report["lines"]]
        self.assertEqual(begins, sorted(set(begins)))
        self.assertEqual([{part: line[part] for part in parts} for line in report["lines"]],
                         [right[number] for number in sorted(right)])
        self.assertEqual({each["a_begin"] for each in report["crosscheck"]["lines"]} - set(begins), set())
        self.assertNotIn("begin", self.json["lines"][0])

    @staticmethod
    def move(records, _):
        records[:, :4] = (records[:, :4].copy().view("<i4") + 5).view(np.uint8)

    def test_that_cannot_be_told_apart_are_said_to_be_so(self):
        for shift in (None, lambda times: np.zeros_like(times), lambda times: times * np.nan):
            folder = self.ids(lambda _: 0, shift)
            for path in list(folder.glob("*")):
                if not path.name.startswith("flight_1."):
                    path.unlink()
            for suffix in (".las", ".las.json"):
                shutil.copy(folder / f"flight_1{suffix}", folder / f"twin{suffix}")
            change(folder / "twin.las", self.move)  # Otherwise it is a copy, which is refused.
            self.assert_fails(query("crosscheck", folder), 1, "cannot be told apart", "point source ID 0")
            report, result = self.report(folder)
            self.assertIsNone(report["crosscheck"])
            self.assertIn("cannot be told apart", report["nothing_to_compare"])
            self.assertIn("cannot be told apart", result.stdout)


if __name__ == "__main__":
    programs.main()
