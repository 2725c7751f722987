"""The pulses of interpolation_bench by SciPy: prints pulses per second as JSON, after a check against our answers.

Usage: scipy_interpolation.py INTERPOLATION_CASE_FILES MEGABYTES scan|random PULSES
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.ndimage import map_coordinates

AXES = ("wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth")
LOG = ("fetch", "footprint")
QUANTITIES = ("thu", "tvu", "bias_along_beam", "bias_vertical")


def fold(azimuth):
    half_turn = np.mod(np.abs(azimuth), 180)
    return np.minimum(half_turn, 180 - half_turn)


class Case:
    def __init__(self, folder):
        def read(kind, name):
            return np.fromfile(folder / kind / name, "<f4").astype(float)

        def scaled(kind, name):
            return np.log(read(kind, name)) if name in LOG else read(kind, name)

        self.nodes = [scaled("nodes", axis) for axis in AXES]
        shape = [len(nodes) for nodes in self.nodes]
        self.values = [read("values", quantity).reshape(shape) for quantity in QUANTITIES]
        self.answers = np.stack([read("answers", quantity) for quantity in QUANTITIES], -1)
        columns = [fold(scaled("pulses", axis)) if axis == "azimuth" else scaled("pulses", axis) for axis in AXES]
        self.pulses = np.stack([np.clip(np.broadcast_to(column, len(self.answers)), nodes[0], nodes[-1])
                                for column, nodes in zip(columns, self.nodes)], -1)


def regular_grid(case):
    interpolate = RegularGridInterpolator(case.nodes, np.stack(case.values, -1))
    return lambda: interpolate(case.pulses)


def spline_of_order_one(case):
    def answer():
        places = np.stack([np.interp(column, nodes, np.arange(len(nodes)))
                           for column, nodes in zip(case.pulses.T, case.nodes)])
        return np.stack([map_coordinates(values, places, order=1) for values in case.values], -1)
    return answer


def main():
    program, megabytes, order, pulses = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, folder, megabytes, order, pulses], check=True)
        case = Case(pathlib.Path(folder))
    rates = {}
    for name, peer in (("RegularGridInterpolator", regular_grid), ("map_coordinates", spline_of_order_one)):
        interpolate = peer(case)
        start = time.process_time()
        theirs = interpolate()
        rates[name] = len(case.pulses) / (time.process_time() - start)
        np.testing.assert_allclose(case.answers, theirs, rtol=1e-5)
    print(json.dumps(rates))


if __name__ == "__main__":
    main()
