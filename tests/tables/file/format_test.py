"""A reader written from tables/FORMAT.md alone finds the seal and the content digest as specified, and the tools of the
field open a table, with named axes and units.

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
import netCDF4
import numpy as np
import xarray

SYNTHETIC_TABLE = sys.argv[1]

AXES = ("wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth")
VARIABLES = ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu", "bias_along_beam",
             "bias_vertical")
AXIS_UNITS = {"wind_speed": "m s-1", "fetch": "m", "incidence": "degree", "azimuth": "degree",
              "footprint": "m", "depth": "m"}
ANGLES = ("refraction_along_wind", "refraction_cross_wind")
LENGTHS = ("thu", "tvu", "bias_along_beam", "bias_vertical")


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


def output_of(*command):
    return subprocess.check_output(command, text=True)


class Tools(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "table.h5")
        subprocess.run([SYNTHETIC_TABLE, cls.path], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_opens_in_ncdump(self):
        header = output_of("ncdump", "-h", self.path)
        self.assertIn("float thu(wind_speed, fetch, incidence, azimuth, footprint, depth) ;", header)
        self.assertIn("float tvu_standard_error(wind_speed, fetch, incidence, azimuth, footprint, depth) ;",
                      header)
        self.assertIn("float refraction_along_wind(wind_speed, fetch, incidence, azimuth, footprint) ;",
                      header)
        self.assertIn('wind_speed:units = "m s-1" ;', header)
        self.assertIn('thu:ancillary_variables = "thu_standard_error" ;', header)
        self.assertIn("thu:_FillValue = NaNf ;", header)
        self.assertIn(':Conventions = "CF-1.10" ;', header)
        self.assertIn(':coverage = "2 sigma" ;', header)

    def test_opens_in_h5dump(self):
        header = output_of("h5dump", "-H", self.path)
        for name in AXES + ANGLES + LENGTHS:
            self.assertIn('DATASET "%s"' % name, header)
        properties = output_of("h5dump", "-p", "-H", "-d", "/thu", self.path)
        for text in ("CHUNKED", "PREPROCESSING SHUFFLE", "COMPRESSION DEFLATE", "VALUE  nan"):
            self.assertIn(text, properties)
        self.assertIn("USERBLOCK_SIZE 512", output_of("h5dump", "-B", "-H", self.path))

    def test_opens_in_xarray(self):
        with xarray.open_dataset(self.path, engine="netcdf4") as table:
            self.assertEqual(set(table.coords), set(AXES))
            for name, units in AXIS_UNITS.items():
                self.assertEqual(table[name].dims, (name,))
                self.assertEqual(table[name].dtype, np.float32)
                self.assertEqual(table[name].attrs["units"], units)
                self.assertTrue(table[name].attrs["long_name"])
                self.assertEqual(table[name].attrs["interpolation"],
                                 "log" if name in ("fetch", "footprint") else "linear")
            for names, dimensions, units in ((ANGLES, AXES[:5], "degree"), (LENGTHS, AXES, "m")):
                for name in names:
                    for variable in (table[name], table[table[name].attrs["ancillary_variables"]]):
                        self.assertEqual(variable.dims, dimensions)
                        self.assertEqual(variable.dtype, np.float32)
                        self.assertEqual(variable.attrs["units"], units)
                        self.assertTrue(variable.attrs["long_name"])
                        self.assertEqual(variable.attrs["interpolation"], "linear")
                        self.assertTrue(np.isnan(variable.encoding["_FillValue"]))
                        self.assertTrue(np.isfinite(variable.values).all())
            self.assertEqual(table.attrs["id"], "synthetic")
            self.assertEqual(table.attrs["realizations"], 500)
            self.assertEqual(table.attrs["refractive_index"], 1.34)
            np.testing.assert_array_equal(table.attrs["interpolation_error"], [0.01, 0.02, 0.03])
            # A named axis is what makes this a table: a value is selected by what it means.
            at = table.thu.sel(wind_speed=5, fetch=1e4, incidence=20, azimuth=90, footprint=0.5, depth=10)
            self.assertGreater(float(at), 0)

    def test_opens_in_netcdf4(self):
        with netCDF4.Dataset(self.path) as table:
            self.assertEqual(table["thu"].dimensions, AXES)
            self.assertEqual(list(table.dimensions), list(AXES))

    def test_opens_in_h5py(self):
        with h5py.File(self.path, "r") as table:
            self.assertEqual(table.userblock_size, 512)
            for i, name in enumerate(AXES):
                self.assertTrue(h5py.h5ds.is_scale(table[name].id))
                self.assertEqual(table["thu"].dims[i][0], table[name])
                self.assertEqual(table["thu"].dims[i].keys(), [name])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
