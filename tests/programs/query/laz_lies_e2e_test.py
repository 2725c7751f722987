"""albtpu-query las with LAZ files that are cut short or lie: one message, nothing written, little memory and time.

tests/laz has all lies, of the chunk table, of chunks and of each field, and cuts at each byte; here is one of
each kind.
"""

import resource
import struct
import time

import programs
from programs import FLAGS, laz_copy, make_flight
from serving import ALLOWANCE

# Bytes of addresses, of which threads and libraries reserve most. Sanitizers reserve terabytes.
MOST_MEMORY = 2 << 30 if ALLOWANCE == 1 else resource.RLIM_INFINITY
LONGEST = 20 * ALLOWANCE  # s for a file of some hundred kilobytes, on a busy machine.
# Offsets in the header of LAS 1.4.
HEADER_SIZE, OFFSET_TO_POINTS, VLR_COUNT, POINT_FORMAT, RECORD_LENGTH = 94, 96, 100, 104, 105
EVLR_START, EVLR_COUNT, POINT_COUNT = 235, 243, 247


class Lies(programs.Test):
    def setUp(self):
        super().setUp()
        las = make_flight(self.folder / "in.las", 4, 6, 2)
        self.source, self.target = self.folder / "in.laz", self.folder / "out.laz"
        laz_copy(las, self.source, "--chunk-size", 9000)
        las.unlink()
        self.file = self.source.read_bytes()
        self.points = struct.unpack_from("<Q", self.file, POINT_COUNT)[0]
        self.begin, = struct.unpack_from("<I", self.file, OFFSET_TO_POINTS)
        self.table, = struct.unpack_from("<Q", self.file, self.begin)
        self.quick = self.folder / "quick.h5"
        at, = struct.unpack_from("<H", self.file, HEADER_SIZE)
        while self.file[at + 2:at + 16] != b"laszip encoded":
            at += 54 + struct.unpack_from("<H", self.file, at + 20)[0]
        self.record = at + 54

    def run_on(self, data):
        self.source.write_bytes(data)
        begin = time.monotonic()
        result = programs.query("las", self.source, self.target, "--table", self.quick, *FLAGS, preexec_fn=lambda: (
            resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))))
        self.assertLess(time.monotonic() - begin, LONGEST)
        return result

    def assert_noticed(self, data, *parts):
        result = self.run_on(data)
        written = self.names()
        for name in {"out.laz", "out.laz.json"} & set(written):
            (self.folder / name).unlink()
        self.assert_fails(result, 1, "in.laz: ", *parts)
        self.assertEqual([line for line in result.stderr.splitlines() if ": table synthetic" not in line],
                         [result.stderr.rstrip("\n").split("\n")[-1]])
        self.assertEqual(written, ["in.laz", "quick.h5"])

    def changed(self, *fields):
        """The file with (format, offset, value) changed."""
        data = bytearray(self.file)
        for kind, offset, value in fields:
            struct.pack_into(kind, data, offset, value)
        return bytes(data)

    def test_the_file_is_read_as_it_is(self):
        self.assertEqual(self.run_on(self.file).returncode, 0)

    def test_file_cut_in_each_of_its_parts(self):
        for cut in (0, 100, 374, self.record + 20, self.begin, self.begin + 8, self.begin + 100, self.table,
                    self.table + 8, len(self.file) - 1):
            with self.subTest(bytes=cut):
                self.assert_noticed(self.file[:cut])

    def test_header(self):
        for what, fields in {
                "a point more": [("<Q", POINT_COUNT, self.points + 1)],
                "a chunk more": [("<Q", POINT_COUNT, self.points + 9000)],
                "2^64 - 1 points": [("<Q", POINT_COUNT, (1 << 64) - 1)],
                "another format": [("B", POINT_FORMAT, 0x80 | 7)],
                "both marks of compression": [("B", POINT_FORMAT, 0xC0 | 6)],
                "no mark of compression": [("B", POINT_FORMAT, 6)],
                "the longest records": [("<H", RECORD_LENGTH, 65535)],
                "points beyond the end": [("<I", OFFSET_TO_POINTS, len(self.file) + 1)],
                "2^32 - 1 VLRs": [("<I", VLR_COUNT, 0xFFFFFFFF)],
                "EVLRs in the points": [("<Q", EVLR_START, self.begin + 50), ("<I", EVLR_COUNT, 1)]}.items():
            with self.subTest(what):
                self.assert_noticed(self.changed(*fields))

    def test_one_chunk_of_2_to_the_32_points(self):
        for point_format in (1, 6):
            with self.subTest(point_format=point_format):
                las = make_flight(self.folder / "big.las", 4, point_format)
                laz_copy(las, self.source, "--chunk-size", 4294967294)
                las.unlink()
                data = bytearray(self.source.read_bytes())
                struct.pack_into("<Q", data, POINT_COUNT, 4294967294)
                struct.pack_into("<I", data, 107, 0)
                self.assert_noticed(data)


if __name__ == "__main__":
    programs.main()
