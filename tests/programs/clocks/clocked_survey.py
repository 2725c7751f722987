"""A simulated survey whose points are written by every clock, for tests of how their times are read."""

import struct

import numpy as np

import programs
import sea_states
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

WEEK = 604800
UNIX_EPOCH = 315964800  # 1980-01-06 in s since 1970


class ClockedSurvey(programs.Test):
    right = None  # The answers for the right files, which are those of all tests.

    def setUp(self):
        super().setUp()
        self.survey = SimulatedSurvey(self.folder, "--seconds", 20, "--pulse-rate", 500, "--seed", 3)
        if ClockedSurvey.right is None:
            ClockedSurvey.right = self.annotated(self.survey.las)

    def las(self, source, trajectory=None, *flags, level=None, output="out.las"):
        target = self.folder / output
        target.unlink(missing_ok=True)
        return query("las", source, target, "--trajectory", trajectory or self.survey.sbet, "--lever-arm",
                     "0.3,-0.2,0.5", "--water-level", level or self.survey.water_level, "--classes", 40,
                     "--divergence", 1, "--wind-speed", 6, *(() if "--sea" in flags else ("--table", self.table)),
                     "--details", *flags)

    def annotated(self, source, trajectory=None, *flags):
        result = self.las(source, trajectory, *flags)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.stderr = result.stderr
        return LasFile(self.folder / "out.las").columns()

    def assert_same(self, columns, rows=slice(None), tolerance=0.0):
        for name in ("incidence", "beam_azimuth", "water_depth", "slant_range", "sea_thu", "sea_tvu"):
            np.testing.assert_allclose(columns[name][rows], self.right[name][rows], rtol=tolerance, atol=tolerance,
                                       err_msg=name)

    def with_times(self, name, change, bit=None, version=None):
        """A copy of the points with changed times, global encoding and version."""
        data = bytearray(self.survey.las.read_bytes())
        encoding, = struct.unpack_from("<H", data, 6)
        self.adjusted = bool(encoding & 1)
        if bit is not None:
            struct.pack_into("<H", data, 6, encoding & ~1 | bit)
        if version is not None:
            data[25] = version
        offset, = struct.unpack_from("<I", data, 96)
        length, = struct.unpack_from("<H", data, 105)
        at = 22 if data[104] & 63 >= 6 else 20
        count = (len(data) - offset) // length
        for i in range(count):
            place = offset + i * length + at
            struct.pack_into("<d", data, place, change(i, struct.unpack_from("<d", data, place)[0]))
        path = self.folder / name
        path.write_bytes(data)
        return path

    def gps(self, stated):
        """GPS seconds since 1980 of a time as the right file states it."""
        return stated + 1e9 if self.adjusted else stated + 1900 * WEEK

    def clocks(self):
        """Each way to write the times, and the bit of the header that is wrong for it."""
        return {
            "week": (lambda t: self.gps(t) % WEEK, 1),
            "adjusted": (lambda t: self.gps(t) - 1e9, 0),
            "gps": (lambda t: self.gps(t), 1),
            "unix": (lambda t: self.gps(t) + UNIX_EPOCH - 18, 0),
            "milliseconds": (lambda t: self.gps(t) % WEEK * 1e3, 0),
            "day": (lambda t: self.gps(t) % 86400, 0),
        }

    def without_trajectory(self, source, *flags, output="level.las"):
        target = self.folder / output
        target.unlink(missing_ok=True)
        return query("las", source, target, "--incidence", 15, "--altitude", 400, "--footprint", 0.5, "--classes", 40,
                     "--details", *flags)

    def unix_times(self):
        """Of the points of the right file."""
        self.with_times("same.las", lambda _, t: t)
        return np.array([self.gps(t) + UNIX_EPOCH - 18 for t in LasFile(self.survey.las).field(22, "<f8")])

    def write_tide(self, *hours, name="tide.csv"):
        """Levels around the flight that rise by 1 m in an hour, at these hours from its beginning."""
        begin = self.unix_times().min()
        lines = ["time,water_level"]
        for hour in hours:
            lines.append(f"{sea_states.utc(round(begin) + 3600 * hour)},{self.survey.water_level + hour}")
        return self.write(name, "\n".join(lines) + "\n")
