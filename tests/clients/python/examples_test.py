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
# Points seen from a sensor that flies north at 50 m/s, 400 m above the water at -23.09 m. The last bathymetric point
# was measured in a gap of the trajectory of 3 s.
WATER_LEVEL, ALTITUDE, DIVERGENCE = -23.09, 400.0, 1.5
Z = np.array([-25.09, -24.09, -23.09, -60.0, -20.0, -28.09, -25.09])
CLASSIFICATION = np.uint8([40, 40, 40, 40, 40, 2, 40])
DEPTH = WATER_LEVEL - Z
TIMES = np.array([10.05, 11.0, 12.3, 13.0, 13.1, 13.2, 17.0])
X = np.array([100.0, -110.0, 0.0, 50.0, 60.0, 70.0, 80.0])
Y = 50 * (TIMES - 10)
TRACK_TIMES = np.r_[10:15:0.1, 18:20:0.1]
TRACK = np.c_[TRACK_TIMES, 0 * TRACK_TIMES, 50 * (TRACK_TIMES - 10), 0 * TRACK_TIMES + ALTITUDE + WATER_LEVEL]
ADJUSTED = TIMES + 2000 * 604800 - 1e9  # The second form of times in LAS, week 2000.


def load(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def with_no_data(answer, quantity, numbers):
    values = answer.values[quantity].astype(float)
    values[~answer.interpolated | (CLASSIFICATION != 40)] = -1
    assert (values >= 0).sum() == numbers and (values == -1).sum() == len(Z) - numbers
    return values


def expected(quantity, azimuth=None):
    """From the angle at which the straight beam would meet the water, refracted by bisection."""
    incidence, slant_range = np.full(len(Z), np.nan), np.full(len(Z), np.nan)
    for i in range(len(Z) - 1):
        distance, depth = abs(X[i]), max(DEPTH[i], 0)
        low, high = 0.0, distance
        for _ in range(100):  # Snell's law: the water is met at `middle` from the sensor.
            middle = (low + high) / 2
            excess = (middle / np.hypot(middle, ALTITUDE)
                      - 1.34 * (distance - middle) / max(np.hypot(distance - middle, depth), 1e-300))
            low, high = (middle, high) if excess < 0 else (low, middle)
        incidence[i] = np.degrees(np.arctan2(low, ALTITUDE))
        slant_range[i] = np.hypot(low, ALTITUDE)
    with albtpu.open_table(TABLE) as table:
        answer = table.query(wind_speed=5, incidence=incidence, depth=DEPTH, azimuth=azimuth,
                             footprint=slant_range * DIVERGENCE / 1000)
    return with_no_data(answer, quantity, 3)


def expected_of_cone(quantity):
    with albtpu.open_table(TABLE) as table:
        answer = table.query(wind_speed=5, incidence=20, depth=DEPTH, footprint=0.6 / np.cos(np.radians(20)))
    return with_no_data(answer, quantity, 4)



class Examples(unittest.TestCase):
    def test_annotate_in_a_pdal_pipeline(self):
        pipeline = json.loads((EXAMPLES / "pdal_pipeline.json").read_text())
        stage = pipeline[1]
        written = [f"{name}=float" for name in stage["add_dimension"]]
        self.assertEqual(pipeline[-1]["extra_dims"].split(","), written)
        self.assertTrue((EXAMPLES / stage["script"]).is_file())
        module = load(stage["module"])
        points = {"X": X, "Y": Y, "Z": Z, "GpsTime": ADJUSTED, "Classification": CLASSIFICATION}
        with Running(FakeService(TABLE)) as running, tempfile.TemporaryDirectory() as folder:
            track = pathlib.Path(folder, "track.csv")
            np.savetxt(track, TRACK, delimiter=",", header="GpsTime,X,Y,Z", comments="")
            trajectory = {**json.loads(stage["pdalargs"]), "trajectory": str(track)}
            cone = {**trajectory, "incidence": 20.0, "altitude": ALTITUDE}
            del cone["trajectory"]
            # In a wind from the west, downwind is east: the beams go to the east and to the west, along the wind.
            for options, wanted in ((trajectory, expected), (cone, expected_of_cone),
                                    ({**trajectory, "wind_from": 270}, lambda name: expected(name, azimuth=0))):
                for where in ({"service": running.address}, {"table": TABLE}):
                    module.pdalargs = {**options, **where}
                    annotated = {name: array.copy() for name, array in points.items()}
                    self.assertIs(getattr(module, stage["function"])(points, annotated), True)
                    for name in stage["add_dimension"]:
                        np.testing.assert_allclose(annotated[name], wanted(name.removeprefix("sea_")),
                                                   rtol=1e-5, atol=1e-7)

    def test_annotate_with_laspy(self):
        example = load("laspy_annotate")
        options = dict(water_level=WATER_LEVEL, wind_speed=5, divergence=DIVERGENCE)
        with albtpu.open_table(TABLE) as table:
            for times in (TIMES, ADJUSTED):
                thu, tvu, answer = example.annotate(table, (X, Y, Z), CLASSIFICATION, example.sensor_at(times, TRACK),
                                                    **options)
                self.assertEqual(thu.dtype, np.float32)
                np.testing.assert_allclose(thu, expected("thu"), rtol=1e-5, atol=1e-7)
                np.testing.assert_allclose(tvu, expected("tvu"), rtol=1e-5, atol=1e-7)
                self.assertEqual(answer.outcome_counts(), {"INTERPOLATED": 3, "OUT_OF_DOMAIN:depth:below": 1,
                                                           "OUT_OF_DOMAIN:depth:above": 1, "INVALID": 1})
            thu, tvu, answer = example.annotate(table, (X, Y, Z), CLASSIFICATION, (20.0, ALTITUDE), **options)
            np.testing.assert_allclose(thu, expected_of_cone("thu"), rtol=1e-5, atol=1e-7)

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
