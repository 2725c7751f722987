"""Reads a LAS file according to the specification, with struct and NumPy only and none of our code."""

import struct

import numpy as np

POINT_SIZES = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
TYPE_SIZES = (1, 1, 2, 2, 4, 4, 8, 8, 4, 8)


def repeat(source, target, times):
    """Writes a LAS 1.4 file with the points of `source` repeated `times` times and nothing after them."""
    data = bytearray(source.read_bytes())
    offset, = struct.unpack_from("<I", data, 96)
    length, = struct.unpack_from("<H", data, 105)
    count, = struct.unpack_from("<Q", data, 247)
    struct.pack_into("<QIQ", data, 235, 0, 0, times * count)
    with open(target, "wb") as file:
        file.write(data[:offset])
        for _ in range(times):
            file.write(data[offset:offset + count * length])
    return target


class LasFile:
    def __init__(self, path):
        self.bytes = path.read_bytes()
        data = self.bytes
        assert data[:4] == b"LASF"
        self.version_minor = data[25]
        self.header_size, self.offset_to_points, self.vlr_count = struct.unpack_from("<HII", data, 94)
        self.point_format, self.record_length, self.point_count = struct.unpack_from("<BHI", data, 104)
        self.scale = struct.unpack_from("<3d", data, 131)
        self.offset = struct.unpack_from("<3d", data, 155)
        self.evlr_start, self.evlr_count = 0, 0
        if self.version_minor >= 4:
            self.evlr_start, self.evlr_count, self.point_count = struct.unpack_from("<QIQ", data, 235)
        self.waveform_start = struct.unpack_from("<Q", data, 227)[0] if self.version_minor >= 3 else 0
        self.end_of_points = self.offset_to_points + self.point_count * self.record_length
        self.vlrs = []
        at = self.header_size
        for _ in range(self.vlr_count):
            user, record, size, text = struct.unpack_from("<16sHH32s", data, at + 2)
            self.vlrs.append((user.rstrip(b"\0"), record, text.rstrip(b"\0"), data[at + 54:at + 54 + size]))
            at += 54 + size
        self.end_of_vlrs = at
        points = np.frombuffer(data, np.uint8, self.point_count * self.record_length, self.offset_to_points)
        self.records = points.reshape(self.point_count, self.record_length)

    def field(self, offset, kind):
        kind = np.dtype(kind)
        return self.records[:, offset:offset + kind.itemsize].copy().view(kind)[:, 0]

    @property
    def z(self):
        return self.field(8, "<i4") * self.scale[2] + self.offset[2]

    @property
    def classes(self):
        return self.field(15, "u1") & 31 if self.point_format < 6 else self.field(16, "u1")

    @property
    def scan_angles(self):
        return self.field(16, "i1") * 1.0 if self.point_format < 6 else self.field(18, "<i2") * 0.006

    def columns(self):
        """The extra dimensions by name, where all are float32 or bytes, in double precision."""
        kinds = {1: "u1", 9: "<f4"}
        return {name: self.field(offset, kinds[kind]).astype(float)
                for name, (offset, kind, *_) in self.extra_dimensions().items()}

    def extra_dimensions(self):
        """The contents of the Extra Bytes record: name -> (offset in a point, type, no-data, description)."""
        (payload,) = [data for user, record, _, data in self.vlrs if user == b"LASF_Spec" and record == 4]
        dimensions, offset = {}, POINT_SIZES[self.point_format]
        for at in range(0, len(payload), 192):
            entry = payload[at:at + 192]
            kind, options = entry[2], entry[3]
            name, description = (entry[i:i + 32].rstrip(b"\0").decode() for i in (4, 160))
            no_data = struct.unpack_from("<d", entry, 40)[0] if options & 1 and kind else None
            assert name not in dimensions
            dimensions[name] = (offset, kind, no_data, description)
            offset += options if kind == 0 else TYPE_SIZES[(kind - 1) % 10] * ((kind - 1) // 10 + 1)
        assert offset == self.record_length, "the described bytes are not all bytes of a point"
        return dimensions
