"""A simulated survey whose LAS file is changed byte by byte, for tests of files that lie."""

import pathlib
import struct
import tempfile

import numpy as np

import programs
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

SURVEY = """[sensor]
name = "riegl-vq-880-g"
lever_arm = [0.35, -0.12, 0.42]
[sea]
wind_speed = 6
[water]
column = "none"
[datum]
sigma = 0.05
[output]
details = true
"""
FLIGHT = ("--scanner", "palmer", "--seconds", 4, "--pulse-rate", 900, "--lever-arm", "0.35,-0.12,0.42",
          "--column-share", 0.5, "--surface-share", 0.5)
WITHHELD, SYNTHETIC, OVERLAP = 4, 1, 8  # Of byte 15 of formats 6 to 10.
BOUNDS = 179  # Maximum and minimum x, then y, then z.
GLOBAL_ENCODING, CREATION, SCALE, OFFSET = 6, 90, 131, 155
CLOSE = 2e-5  # Of numbers in single precision, from coordinates about another origin.


class Points:
    """A LAS file whose bytes are changed. Formats 0 to 5 have class and flags in one byte."""

    def __init__(self, data):
        self.data = bytearray(data)
        self.begin, = struct.unpack_from("<I", data, 96)
        self.format, self.length = struct.unpack_from("<BH", data, 104)
        self.old = self.format < 6
        self.count, = struct.unpack_from("<I", data, 107) if self.old else struct.unpack_from("<Q", data, 247)
        self.time = 20 if self.old else 22  # Its place in a point.

    def put(self, kind, offset, *values):
        struct.pack_into(kind, self.data, offset, *values)

    def get(self, kind, offset):
        return struct.unpack_from(kind, self.data, offset)

    def at(self, point, field):
        return self.begin + point * self.length + field

    def points(self, *classes):
        mask, field = (31, 15) if self.old else (255, 16)
        return [i for i in range(self.count) if self.data[self.at(i, field)] & mask in classes]

    def classify(self, point, number):
        at = self.at(point, 15 if self.old else 16)
        self.data[at] = self.data[at] & 0xe0 | number if self.old else number

    def flag(self, points, bits):
        for i in points:
            self.data[self.at(i, 15)] |= bits << 5 & 0xe0 if self.old else bits

    def raise_by(self, points, metres):
        step = self.get("<3d", SCALE)[2]
        for i in points:
            z, = self.get("<i", self.at(i, 8))
            self.put("<i", self.at(i, 8), z + round(metres / step))

    def insert_vlr(self, user, record, payload):
        header = struct.pack("<H16sHH32s", 0, user, record, len(payload), b"")
        at, = self.get("<H", 94)
        self.data[at:at] = header + payload
        self.begin += len(header) + len(payload)
        self.put("<I", 96, self.begin)
        self.put("<I", 100, self.get("<I", 100)[0] + 1)


def geo_keys(*keys):
    entries = b"".join(struct.pack("<4H", key, 0, 1, value) for key, value in keys)
    return struct.pack("<4H", 1, 1, 0, len(keys)) + entries


class FalseFiles(programs.Test):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shared = cls.class_folder()
        cls.survey = SimulatedSurvey(cls.shared / "flight", *FLIGHT)
        cls.sound = cls.survey.las.read_bytes()
        cls.answers = {}  # Of the sound file, by the flags.
        cls.quick = programs.make_table(cls.shared / "quick.h5")
        cls.toml_file = cls.shared / "survey.toml"
        cls.toml_file.write_text(SURVEY)

    @classmethod
    def class_folder(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        return pathlib.Path(folder.name)

    def flags(self, *surface):
        return ("--survey", self.toml_file, "--table", self.quick, "--trajectory", self.survey.sbet,
                *(surface or ("--water-level", self.survey.water_level)))

    def annotated(self, data, *flags, failing=False):
        """What `las` printed, and the columns that it wrote; None where it refused. If `failing`, it did both."""
        source, target = self.folder / "in.las", self.folder / "out.las"
        source.write_bytes(data)
        target.unlink(missing_ok=True)
        result = query("las", source, target, "--overwrite", *flags)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertEqual(result.returncode == 0 or failing, target.exists())
        return result.stderr, LasFile(target).columns() if target.exists() else None

    def of_sound(self, *flags):
        """The columns of the sound file, annotated once for all tests."""
        if flags not in self.answers:
            self.answers[flags] = self.annotated(self.sound, *flags)[1]
        return self.answers[flags]

    def assert_same(self, columns, expected, but=()):
        kept = np.ones(len(expected["total_thu"]), bool)
        kept[list(but)] = False
        for name, column in expected.items():
            np.testing.assert_allclose(columns[name][kept], column[kept], rtol=CLOSE, atol=CLOSE, err_msg=name)

    def mend(self, change, note, *surface, but=None):
        """The numbers of a changed file are those of the sound one, and `note` is among the notes."""
        expected = self.of_sound(*self.flags(*surface))
        points = Points(self.sound)
        changed = change(points)
        printed, columns = self.annotated(bytes(points.data), *self.flags(*surface))
        self.assertIsNotNone(columns, printed)
        self.assertRegex(printed, note or "trajectory")
        self.assert_same(columns, expected, changed if but is None else but)
        return columns, changed
