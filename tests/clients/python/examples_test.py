"""Runs the examples. PDAL and laspy are not installed; the tests call the functions with arrays instead.

Usage: examples_test.py EXAMPLES_FOLDER TABLE.h5
"""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import albtpu
from fake_service import FakeService, Running

EXAMPLES, TABLE = pathlib.Path(sys.argv[1]), sys.argv[2]
Z = np.array([-25.09, -24.09, -23.09, -60.0, -20.0, -28.09])
SCAN_ANGLE = np.array([-15.0, 15.0, 0.0, 3.0, 3.0, 20.0])
CLASSIFICATION = np.uint8([40, 40, 40, 40, 40, 2])
DEPTH = np.float64([2, 1, 0, 36.91, -3.09, 5])


def load(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def expected(quantity):
    with albtpu.open_table(TABLE) as table:
        answer = table.query(wind_speed=5, incidence=np.abs(SCAN_ANGLE), depth=DEPTH,
                             footprint=0.6 / np.cos(np.radians(SCAN_ANGLE)))
    values = answer.values[quantity].astype(float)
    values[~answer.interpolated | (CLASSIFICATION != 40)] = -1
    assert (values >= 0).sum() == 3 and (values == -1).sum() == 3
    return values


class Examples(unittest.TestCase):
    def test_annotate_in_a_pdal_pipeline(self):
        pipeline = json.loads((EXAMPLES / "pdal_pipeline.json").read_text())
        stage = pipeline[1]
        written = [f"{name}=float" for name in stage["add_dimension"]]
        self.assertEqual(pipeline[-1]["extra_dims"].split(","), written)
        self.assertTrue((EXAMPLES / stage["script"]).is_file())
        module = load(stage["module"])
        points = {"Z": Z, "ScanAngleRank": SCAN_ANGLE.astype("f4"), "Classification": CLASSIFICATION}
        with Running(FakeService(TABLE)) as running:
            for where in ({"service": running.address}, {"table": TABLE}):
                module.pdalargs = {**json.loads(stage["pdalargs"]), **where}
                annotated = {name: array.copy() for name, array in points.items()}
                self.assertIs(getattr(module, stage["function"])(points, annotated), True)
                for name in stage["add_dimension"]:
                    np.testing.assert_allclose(annotated[name], expected(name.removeprefix("total_")),
                                               rtol=1e-5, atol=1e-7)

    def test_annotate_with_laspy(self):
        with albtpu.open_table(TABLE) as table:
            thu, tvu, answer = load("laspy_annotate").annotate(
                table, Z, SCAN_ANGLE, CLASSIFICATION, water_level=-23.09, wind_speed=5, altitude=400,
                divergence=1.5)
        self.assertEqual(thu.dtype, np.float32)
        np.testing.assert_allclose(thu, expected("thu"), rtol=1e-5, atol=1e-7)
        np.testing.assert_allclose(tvu, expected("tvu"), rtol=1e-5, atol=1e-7)
        self.assertEqual(answer.outcome_counts(), {"INTERPOLATED": 3, "OUT_OF_DOMAIN:depth": 2})

    def test_map_uncertainty_with_xarray(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", EXAMPLES / "uncertainty_maps.py", TABLE, folder],
                           env={**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": folder},
                           check=True, capture_output=True)
            for plot in ("thu.png", "tvu.png", "special_order.png"):
                self.assertTrue(pathlib.Path(folder, plot).read_bytes().startswith(b"\x89PNG"), plot)
            self.assertIn("wind_speed", pathlib.Path(folder, "best_orders.csv").read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
