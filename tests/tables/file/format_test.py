"""A reader written from tables/FORMAT.md alone: the seal and the content digest come out as specified.

Usage: format_test.py ALBTPU_SYNTHETIC_TABLE
"""

import hashlib
import os
import struct
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

SYNTHETIC_TABLE = sys.argv[1]

AXES = ("wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth")
VARIABLES = ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu", "bias_along_beam",
             "bias_vertical")


def text(attribute):
    if isinstance(attribute, h5py.Empty):
        return b""
    return attribute if isinstance(attribute, bytes) else attribute.encode()


def content_digest(table):
    sha = hashlib.sha256(b"albtpu table content 1\n")

    def add_text(value):
        sha.update(struct.pack("<Q", len(value)) + value)

    def add_floats(values):
        values = np.asarray(values, dtype="<f4")
        sha.update(struct.pack("<Q", values.size) + values.tobytes())

    add_text(text(table.attrs["id"]))
    for name in AXES + VARIABLES:
        if name not in table:
            continue
        add_text(name.encode())
        add_text(text(table[name].attrs["units"]))
        add_text(text(table[name].attrs["interpolation"]))
        add_floats(table[name])
        if name in VARIABLES:
            error = name + "_standard_error"
            add_floats(table[error] if error in table else [])
    add_text(text(table.attrs["campaign"]))
    return sha.hexdigest()


class Format(unittest.TestCase):
    def with_table(self, check, *options):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "table.h5")
            subprocess.run([SYNTHETIC_TABLE, path, *options], check=True)
            check(path)

    def test_has_the_user_block_as_specified(self):
        def check(path):
            with open(path, "rb") as file:
                data = file.read()
            magic, version, zero, length, digest = struct.unpack_from("<8sIIQ32s", data)
            self.assertEqual((magic, version, zero, length), (b"\x89ALBTPU\n", 1, 0, len(data)))
            self.assertEqual(digest, hashlib.sha256(data[:24] + data[56:]).digest())
            self.assertEqual(data[56:512], bytes(456))
            self.assertEqual(data[512:520], b"\x89HDF\r\n\x1a\n")

        self.with_table(check)

    def test_has_the_content_digest_as_specified(self):
        def check(path):
            with h5py.File(path, "r") as table:
                self.assertEqual(text(table.attrs["content_digest"]).decode(), content_digest(table))

        self.with_table(check)
        self.with_table(check, "--published")

    def test_lacks_what_a_published_table_lacks(self):
        def check(path):
            with h5py.File(path, "r") as table:
                self.assertEqual(set(table), set(AXES + VARIABLES[:4]))
                self.assertNotIn("ancillary_variables", table["thu"].attrs)

        self.with_table(check, "--published")

    def test_gives_the_same_bytes_again(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("a.h5", "b.h5")]
            contents = []
            for path in paths:
                subprocess.run([SYNTHETIC_TABLE, path], check=True)
                with open(path, "rb") as file:
                    contents.append(file.read())
            self.assertEqual(*contents)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
