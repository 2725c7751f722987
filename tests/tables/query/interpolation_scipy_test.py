"""A SciPy interpolator over the file, log axes in log, gives what we give.

Usage: interpolation_scipy_test.py ALBTPU_SYNTHETIC_TABLE INTERPOLATE_RANDOM_PULSES
"""

import io
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import xarray
from scipy.interpolate import RegularGridInterpolator

SYNTHETIC_TABLE, INTERPOLATE = sys.argv[1:3]
PULSES = 3000


def scaled(coordinate, interpolation):
    return np.log(coordinate) if interpolation == "log" else coordinate


class Interpolation(unittest.TestCase):
    def test_agrees_with_scipy_over_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "table.h5")
            subprocess.run([SYNTHETIC_TABLE, path], check=True)
            csv = subprocess.check_output([INTERPOLATE, path, str(PULSES)], text=True)
            ours = np.genfromtxt(io.StringIO(csv), delimiter=",", names=True)
            self.assertEqual(len(ours), PULSES)
            with xarray.open_dataset(path, engine="netcdf4") as table:
                self.assertEqual(len(table.data_vars), 12)
                for name, variable in table.data_vars.items():
                    with self.subTest(variable=name):
                        self.assert_agrees(table, variable, ours)

    def assert_agrees(self, table, variable, ours):
        kinds = [table[axis].attrs["interpolation"] for axis in variable.dims]
        nodes = [scaled(table[axis].values.astype(float), kind) for axis, kind in zip(variable.dims, kinds)]
        at = np.column_stack([scaled(ours[axis], kind) for axis, kind in zip(variable.dims, kinds)])
        # Rounding of the logarithm may put a pulse at an end of the domain just outside it.
        at = np.clip(at, [n[0] for n in nodes], [n[-1] for n in nodes])
        values = scaled(variable.values.astype(float), variable.attrs["interpolation"])
        theirs = RegularGridInterpolator(nodes, values)(at)
        if variable.attrs["interpolation"] == "log":
            theirs = np.exp(theirs)
        np.testing.assert_allclose(ours[variable.name], theirs, rtol=1e-5, atol=0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
