"""The engine that opens table files in xarray. install_test.py tests that xarray finds it.

Usage: xarray_backend_test.py TABLE.h5
"""

import io
import pathlib
import shutil
import sys
import unittest
from unittest import mock

import h5py
import numpy as np
import xarray

import albtpu
from albtpu.xarray_backend import AlbtpuBackendEntrypoint
from commands import FolderTest

TABLE = pathlib.Path(sys.argv[1])


class Backend(FolderTest):
    def setUp(self):
        super().setUp()
        self.backend = AlbtpuBackendEntrypoint()

    def open(self, file, **options):
        return xarray.open_dataset(file, engine=AlbtpuBackendEntrypoint, **options)

    def test_gives_the_same_dataset_as_netcdf4(self):
        with xarray.open_dataset(TABLE, engine="netcdf4") as expected:
            for file in (TABLE, str(TABLE), io.BytesIO(TABLE.read_bytes())):
                xarray.testing.assert_identical(self.open(file), expected)

    def test_has_the_axes_as_coordinates_and_the_values_of_the_package(self):
        dataset = self.open(TABLE)
        self.assertEqual(list(dataset.coords), list(albtpu.AXES))
        self.assertEqual(dataset.refraction_along_wind.dims, tuple(albtpu.AXES)[:-1])
        pulse = {axis: dataset[axis].values[1] for axis in albtpu.AXES}
        with albtpu.open_table(TABLE) as table:
            self.assertEqual(dataset.thu.sel(pulse).item(), table.query(**pulse).thu)

    def test_guesses_by_content_and_not_by_name(self):
        renamed = shutil.copy(TABLE, self.folder / "table.dat")
        self.assertTrue(self.backend.guess_can_open(renamed))
        self.assertTrue(self.backend.guess_can_open(str(renamed)))
        foreign = self.folder / "foreign.h5"
        with h5py.File(foreign, "w") as file:
            file["x"] = np.zeros(3)
        (self.folder / "empty.h5").touch()
        closed = io.BytesIO(TABLE.read_bytes())
        closed.close()
        unreadable = mock.Mock(tell=lambda: 0, read=lambda: b"")  # Takes no number of bytes.
        for other in (foreign, self.folder / "empty.h5", self.folder / "absent.h5", self.folder,
                      "https://albtpu.example/survey.h5", io.BytesIO(b"CDF"), b"bytes", None, closed, unreadable,
                      "embedded\0null", "\ud800.h5", 1, ["a.nc", "b.nc"], {}):
            self.assertIs(self.backend.guess_can_open(other), False, repr(other))

    def test_leaves_an_open_file_where_it_was(self):
        with open(TABLE, "rb") as file:
            self.assertTrue(self.backend.guess_can_open(file))
            self.assertEqual(file.tell(), 0)

    def test_refuses_a_damaged_table(self):
        damaged = bytearray(TABLE.read_bytes())
        damaged[5000] ^= 1
        path = self.folder / "damaged.h5"
        path.write_bytes(damaged)
        for file, name in ((path, "damaged.h5"), (io.BytesIO(damaged), "BytesIO")):
            with self.assertRaisesRegex(albtpu.TableFileError, f"{name}.*: is damaged"):
                self.open(file)
        with self.assertRaisesRegex(albtpu.TableFileError, "absent.h5: No such file"):
            self.open(self.folder / "absent.h5")

    def test_takes_the_options_of_open_dataset(self):
        whole = self.open(TABLE)
        for options in ({"decode_cf": False}, {"decode_times": False, "mask_and_scale": False}):
            xarray.testing.assert_identical(self.open(TABLE, **options), whole)
        self.assertNotIn("thu", self.open(TABLE, drop_variables="thu"))
        self.assertNotIn("tvu", self.open(TABLE, drop_variables=["thu", "tvu", "absent"]))
        with self.assertRaises(TypeError):
            self.open(TABLE, group="/")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
