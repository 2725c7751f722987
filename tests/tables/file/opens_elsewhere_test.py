"""The tools of the field open a table, with named axes and units.

Usage: opens_elsewhere_test.py ALBTPU_SYNTHETIC_TABLE
"""

import os
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
AXIS_UNITS = {"wind_speed": "m s-1", "fetch": "m", "incidence": "degree", "azimuth": "degree",
              "footprint": "m", "depth": "m"}
ANGLES = ("refraction_along_wind", "refraction_cross_wind")
LENGTHS = ("thu", "tvu", "bias_along_beam", "bias_vertical")


def output_of(*command):
    return subprocess.check_output(command, text=True)


class Table(unittest.TestCase):
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
            self.assertEqual(table.attrs["refractive_index"], 1.33)
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
