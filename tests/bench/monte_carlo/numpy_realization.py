"""One realization as the paper describes it, in NumPy and SciPy: random amplitudes, FFT, Delaunay triangulation,
refraction of each ray at its triangle, centroid at each depth.

Usage: numpy_realization.py BEAM_CASE_SURFACE [SIZE INCIDENCE]
Prints a JSON object: milliseconds of processor time for a realization, with its own triangulation and with one
triangulation for all realizations.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.spatial import Delaunay

# Both diagonals of a square give a Delaunay triangulation. A negligible shear selects the one from the low corner to
# the high corner.
SHEAR = 1e-4


class BeamCase:
    def __init__(self, program, size, incidence):
        with tempfile.TemporaryDirectory() as folder:
            answer = subprocess.run([program, str(size), str(incidence), folder], check=True, capture_output=True)
            self.facts = json.loads(answer.stdout)
            folder = pathlib.Path(folder)
            self.power = np.fromfile(folder / "power.f64").reshape(size, size // 2 + 1)
            points = self.facts["points"]
            self.heights = np.fromfile(folder / "heights.f32", np.float32).astype(float).reshape(points, points)
            self.rays = np.fromfile(folder / "rays.f64").reshape(-1, 2)
        self.size = size
        self.direction = np.array(self.facts["direction"])
        self.depths = np.array(self.facts["depths"])


def draw(case, random):
    """Heights of the patch, its point 0 at (size / 2, size / 2)."""
    amplitude = np.sqrt(case.power / 2) * (random.standard_normal(case.power.shape)
                                           + 1j * random.standard_normal(case.power.shape))
    rows = np.arange(1, case.size // 2)
    amplitude[-rows, 0] = np.conj(amplitude[rows, 0])
    return np.fft.fftshift(np.fft.irfft2(amplitude, (case.size, case.size), norm="forward"))


def sheared(xy):
    return np.column_stack([xy[:, 0] - SHEAR * xy[:, 1], xy[:, 1]])


def triangulate(points, spacing):
    """The triangulation of a square grid about its point points // 2."""
    side = (np.arange(points) - points // 2) * spacing
    return Delaunay(sheared(np.stack(np.meshgrid(side, side, indexing="ij"), -1).reshape(-1, 2)))


def refract(direction, slope, n):
    normal = np.column_stack([-slope, np.ones(len(slope))])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    cosine = -normal @ direction
    return direction / n + (cosine / n - np.sqrt(1 - (1 - cosine**2) / n**2))[:, None] * normal


def trace(case, triangulation, heights):
    """Centroid and path (x, y, path) at each depth, of rays that intersect the triangles with these `heights`."""
    z = heights.ravel()
    per_height = case.direction[:2] / case.direction[2]
    height = np.zeros(len(case.rays))
    last = None
    for _ in range(20):
        simplex = triangulation.find_simplex(sheared(case.rays + height[:, None] * per_height))
        if last is not None and np.array_equal(simplex, last):
            break
        last = simplex
        corners = triangulation.simplices[simplex]
        xy = triangulation.points[corners] + [0, 0]
        xy[..., 0] += SHEAR * xy[..., 1]
        rises = z[corners[:, 1:]] - z[corners[:, :1]]
        slope = np.linalg.solve(xy[:, 1:] - xy[:, :1], rises[..., None])[..., 0]
        over_corner = z[corners[:, 0]] + np.sum(slope * (case.rays - xy[:, 0]), axis=1)
        height = over_corner / (1 - slope @ per_height)
    refracted = refract(case.direction, slope, case.facts["refractive_index"])
    intersection = case.rays + height[:, None] * per_height
    spots = []
    for depth in case.depths:
        path = (height.mean() - depth - height) / refracted[:, 2]
        spot = intersection + path[:, None] * refracted[:, :2]
        spots.append([*(spot.mean(axis=0) - intersection.mean(axis=0)), path.mean()])
    return np.array(spots)


def milliseconds(run, repetitions):
    times = []
    for _ in range(repetitions):
        start = time.process_time()
        run()
        times.append(1e3 * (time.process_time() - start))
    return float(np.median(times))


def main(program, size=512, incidence=0):
    case = BeamCase(program, size, incidence)
    random = np.random.default_rng(1)
    spacing = case.facts["spacing"]
    once = triangulate(size, spacing)
    print(json.dumps({
        "numpy": milliseconds(lambda: trace(case, triangulate(size, spacing), draw(case, random)), 3),
        "numpy, one triangulation for all": milliseconds(lambda: trace(case, once, draw(case, random)), 11)}))


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
