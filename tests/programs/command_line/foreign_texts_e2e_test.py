"""Texts in files of others, from outside: they neither control the terminal nor become a part of an output's markup."""

import json
import re
import struct

import h5py

import programs
import reported_survey
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

HOSTILE = "\x1b]0;owned\x07\x1b[2J\x9b1m<script>&\"'"  # A title, and the screen erased in two ways; markup.
CONTROLS = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]")  # All but the ends of lines.
COLUMNS = "depth,incidence,footprint,wind_speed"


def with_hostile_texts(path):
    """Changes the names of the coordinate system and of the software of a LAS file."""
    las = LasFile(path)
    records = b""
    for user, record, text, data in las.vlrs:
        if (user, record) == (b"LASF_Projection", 2112):
            wkt = data.rstrip(b"\0").decode()
            wkt = re.sub(r',AUTHORITY\["EPSG","\d+"\]', "", wkt)
            data = re.sub(r'^PROJCS\["[^"]*"', lambda _: f'PROJCS["{HOSTILE}"'.replace('&"', '&""'), wkt).encode()
        records += struct.pack("<H16sHH32s", 0, user, record, len(data), text) + data
    head = bytearray(las.bytes[:las.header_size])
    head[26:90] = HOSTILE.encode().ljust(64, b"\0")
    struct.pack_into("<I", head, 96, las.header_size + len(records))
    path.write_bytes(bytes(head) + records + las.bytes[las.offset_to_points:])


class Texts(programs.Test):
    def setUp(self):
        super().setUp()
        self.flight = SimulatedSurvey(self.folder / "flight", "--lines", 2, "--cross-lines", 1, "--seconds", 4,
                                      "--pulse-rate", 1500, "--file-for-each-line").folder
        self.annotated = self.folder / "annotated"
        for path in self.flight.glob("*.las"):
            with_hostile_texts(path)
        self.survey = self.annotated.with_suffix(".toml")
        self.annotated.mkdir()
        toml = re.sub(r'^(client|name) = "(The|Harbour|Chart).*"$', lambda line: f"{line[1]} = {json.dumps(HOSTILE)}",
                      reported_survey.SURVEY, flags=re.MULTILINE)
        self.survey.write_text(toml.format(flight=self.flight, datum=0.05, coverage="p95"))

    def annotate(self):
        return query("las", self.flight, "--output-dir", self.annotated, "--survey", self.survey, "--table", self.table,
                     check=0)


class Terminal(Texts):
    def assert_harmless(self, *arguments, says="owned"):
        result = query(*arguments)
        text = result.stdout + result.stderr
        self.assertIn(says, text, arguments)
        self.assertIsNone(CONTROLS.search(text), (arguments, text))
        return result

    def test_is_not_controlled_by_what_surveys_state(self):
        first = sorted(self.flight.glob("*.las"))[0]
        self.assert_harmless("las", first, self.folder / "one.las", "--table", self.table)  # Decisions are missing.
        self.assert_harmless("init", first)
        self.assertIsNone(CONTROLS.search(self.annotate().stderr))
        self.assert_harmless("report", self.annotated, "--output", self.folder / "report", "--no-page")
        self.assert_harmless("surface", self.annotated, "--output", self.folder / "surface", says="")
        self.assert_harmless("crosscheck", self.annotated, says="")

    def test_is_not_controlled_by_what_is_refused(self):
        def named(name, text):
            path = self.folder / name
            path.write_text(text)
            return path

        pulses = f"{COLUMNS}\n1,2,0.5,5\n"
        csv = ("--table", self.table)
        out = self.folder / "out.csv"
        for arguments in (
                ("csv", named("a.csv", f"{COLUMNS},{HOSTILE},{HOSTILE}\n1,2,3,4,5,6\n"), out, *csv),
                ("csv", named("b.csv", pulses + f"{HOSTILE},2,0.5,5\n"), out, *csv),
                ("csv", named(f"{HOSTILE.replace('/', '')}.csv", "nothing\n1\n"), out, *csv),
                ("sea", named("a.spec", f"{HOSTILE}\n")),
                ("sea", named("b.csv", f"time,hs,{HOSTILE}\n"), "--sea-depth", 5),
                ("las", "in.las", "out.las", "--survey", self.toml(f"[sea]\n{json.dumps(HOSTILE)} = 1\n", "a.toml")),
                ("las", "in.las", "out.las", "--survey", self.toml(f"[{HOSTILE}\n", "b.toml")),
                ("las", "in.las", "out.las", "--survey",
                 self.toml(f"[sensor]\nname = {json.dumps(HOSTILE)}\n", "c.toml"))):
            result = self.assert_harmless(*arguments, says="")
            self.assertNotEqual(result.returncode, 0, arguments)


class Outputs(Texts):
    def test_show_texts_as_texts(self):
        self.annotate()
        made = self.folder / "report"
        query("report", self.annotated, "--output", made, check=0)
        page = made / "report.html"
        if not page.exists():
            self.skipTest("the page needs Matplotlib and netCDF4")
        self.assertNotIn("<script>&", page.read_text())
        self.assertIn("&lt;script&gt;&amp;", page.read_text())
        self.assertIn("<script>&", json.dumps(json.loads((made / "report.json").read_text()), ensure_ascii=False))
        result = query("surface", self.annotated, "--output", self.folder / "surface", "--format", "bag")
        if "need GDAL" in result.stderr:
            self.skipTest(result.stderr)
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.folder / "surface/surface.bag") as bag:
            self.assertNotIn("<script>", bag["BAG_root/metadata"][:].tobytes().decode())


if __name__ == "__main__":
    programs.main()
