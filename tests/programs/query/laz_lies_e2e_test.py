"""albtpu-query las with LAZ files that are cut short or lie: one message, nothing written, little memory and time."""

import random
import resource
import struct
import time

import programs
from programs import FLAGS, laz_copy, make_flight

SEED = 20240501
MOST_MEMORY = 2 << 30  # Bytes of addresses, of which threads and libraries reserve most.
LONGEST = 20  # s for a file of some hundred kilobytes, on a busy machine.
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

    def assert_refused(self, data, *parts):
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

    def test_file_cut_anywhere(self):
        cuts = [0, 3, 4, 100, 226, 227, 374, 375, self.record - 60, self.record, self.record + 20, self.begin - 1,
                self.begin, self.begin + 7, self.begin + 8, self.begin + 9, self.begin + 40, self.begin + 100,
                self.table - 1, self.table, self.table + 4, self.table + 8, self.table + 9, len(self.file) - 1]
        numbers = random.Random(SEED)
        cuts += [numbers.randrange(len(self.file)) for _ in range(15)]
        for cut in cuts:
            with self.subTest(bytes=cut):
                self.assert_refused(self.file[:cut])

    def test_header(self):
        for what, fields in {
                "more points": [("<Q", POINT_COUNT, self.points + 1)],
                "fewer points": [("<Q", POINT_COUNT, self.points - 1)],
                "a chunk more": [("<Q", POINT_COUNT, self.points + 9000)],
                "2^32 points": [("<Q", POINT_COUNT, 1 << 32)],
                "2^63 points": [("<Q", POINT_COUNT, 1 << 63)],
                "2^64 - 1 points": [("<Q", POINT_COUNT, (1 << 64) - 1)],
                "another format": [("B", POINT_FORMAT, 0x80 | 7)],
                "an older format": [("B", POINT_FORMAT, 0x80 | 1)],
                "an unknown format": [("B", POINT_FORMAT, 0x80 | 11)],
                "the old mark of compression": [("B", POINT_FORMAT, 0x40 | 6)],
                "both marks": [("B", POINT_FORMAT, 0xC0 | 6)],
                "no mark of compression": [("B", POINT_FORMAT, 6)],
                "longer records": [("<H", RECORD_LENGTH, 33)],
                "shorter records": [("<H", RECORD_LENGTH, 31)],
                "too short records": [("<H", RECORD_LENGTH, 29)],
                "empty records": [("<H", RECORD_LENGTH, 0)],
                "the longest records": [("<H", RECORD_LENGTH, 65535)],
                "points beyond the end": [("<I", OFFSET_TO_POINTS, len(self.file) + 1)],
                "points at the end": [("<I", OFFSET_TO_POINTS, len(self.file) - 3)],
                "points in the header": [("<I", OFFSET_TO_POINTS, 100)],
                "points a byte later": [("<I", OFFSET_TO_POINTS, self.begin + 1)],
                "no VLR": [("<I", VLR_COUNT, 0)],
                "2^32 - 1 VLRs": [("<I", VLR_COUNT, 0xFFFFFFFF)],
                "EVLRs in the points": [("<Q", EVLR_START, self.begin + 50), ("<I", EVLR_COUNT, 1)],
                "EVLRs beyond the end": [("<Q", EVLR_START, 1 << 62), ("<I", EVLR_COUNT, 1)]}.items():
            with self.subTest(what):
                self.assert_refused(self.changed(*fields))

    def test_file_whose_writer_was_stopped_before_the_table(self):
        """LASzip leaves the place of the offset in it until the table is written."""
        data = self.changed(("<Q", self.begin, self.begin))[:self.table]
        self.assertEqual(self.run_on(data).returncode, 0)

    def test_one_chunk_of_2_to_the_32_points(self):
        for point_format in (1, 6):
            with self.subTest(point_format=point_format):
                las = make_flight(self.folder / "big.las", 4, point_format)
                laz_copy(las, self.source, "--chunk-size", 4294967294)
                las.unlink()
                data = bytearray(self.source.read_bytes())
                struct.pack_into("<Q", data, POINT_COUNT, 4294967294)
                struct.pack_into("<I", data, 107, 0)
                self.assert_refused(data)


if __name__ == "__main__":
    programs.main()
