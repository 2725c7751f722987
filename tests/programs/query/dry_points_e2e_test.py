"""Dry points from outside: what they get in a survey with a beach, and the beams of a real topographic survey."""

import json
import pathlib

import numpy as np

import programs
from las_file import LasFile
from programs import PATHS, query
from simulated_survey import BOTTOM, COLUMN, SimulatedSurvey, degrees_apart

LEEWARD = pathlib.Path(PATHS["cases"], "leeward")  # Snow in the Sierra Nevada: SBET and LAS of an airborne scanner.
TOTAL = ("--sensor", "riegl-vq-880-g", "--datum-sigma", 0, "--water-column", "none", "--wind-speed", 6, "--details")


def utm_north(latitude, longitude, central_meridian):
    """Easting, northing, scale and convergence on WGS 84, by Krueger's series to the third order (0.1 mm)."""
    axis, flattening = 6378137.0, 1 / 298.257223563
    n = flattening / (2 - flattening)
    radius = axis / (1 + n) * (1 + n**2 / 4 + n**4 / 64)
    series = (n / 2 - 2 * n**2 / 3 + 5 * n**3 / 16, 13 * n**2 / 48 - 3 * n**3 / 5, 61 * n**3 / 240)
    eccentricity = np.sqrt(flattening * (2 - flattening))
    east = longitude - central_meridian
    conformal = np.sinh(np.arctanh(np.sin(latitude)) - eccentricity * np.arctanh(eccentricity * np.sin(latitude)))
    xi, eta = np.arctan2(conformal, np.cos(east)), np.arcsinh(np.sin(east) / np.hypot(conformal, np.cos(east)))
    x = eta + sum(a * np.cos(2 * j * xi) * np.sinh(2 * j * eta) for j, a in enumerate(series, 1))
    y = xi + sum(a * np.sin(2 * j * xi) * np.cosh(2 * j * eta) for j, a in enumerate(series, 1))
    scale = 0.9996 * (1 + (x * radius / axis)**2 / 2)
    return 500000 + 0.9996 * radius * x, 0.9996 * radius * y, scale, np.arctan(np.tan(east) * np.sin(latitude))


class DryPointsTest(programs.Test):
    def annotate(self, source, *flags):
        target = self.folder / "out.las"
        query("las", source, target, "--overwrite", "--table", PATHS["shipped_table"], *TOTAL, *flags, check=0)
        return LasFile(target).columns(), json.loads((self.folder / "out.las.json").read_text())["answers"]

    def test_of_a_survey_with_a_beach(self):
        survey = SimulatedSurvey(self.folder / "flight", "--seconds", 5, "--pulse-rate", 2000)
        kinds = survey.truth()["kind"]
        columns, answers = self.annotate(survey.las, "--trajectory", survey.sbet, "--water-level", survey.water_level)
        wet, column = kinds == BOTTOM, kinds == COLUMN
        dry = ~wet & ~column
        self.assertGreater(dry.sum(), 100)
        self.assertTrue((columns["total_thu"][~column] > 0).all())
        self.assertTrue((columns["total_thu"][column] == -1).all())
        self.assertEqual(answers["dry"]["points"], dry.sum())
        self.assertEqual(answers["total"]["pulses"], wet.sum())
        np.testing.assert_array_equal(columns["share_of"], np.where(wet, 2, np.where(column, 0, 1)))
        for name in ("thu_sea", "tvu_sea", "bias_vertical"):
            self.assertTrue((columns[name][dry] == 0).all(), name)
        rmse = np.sqrt(np.mean((columns["total_tvu"][dry] / 2)**2))
        self.assertAlmostEqual(answers["dry"]["rmse_vertical"], rmse, delta=1e-5 * rmse)

    def test_of_a_real_survey(self):
        if not LEEWARD.exists():
            self.skipTest(f"{LEEWARD} does not exist")
        columns, answers = self.annotate(LEEWARD / "points.las", "--trajectory", LEEWARD / "sbet.out", "--water-level",
                                         0)
        las = LasFile(LEEWARD / "points.las")
        self.assertEqual(answers["dry"]["points"], las.point_count)
        places = [las.field(4 * i, "<i4") * las.scale[i] + las.offset[i] for i in range(3)]
        records = np.fromfile(LEEWARD / "sbet.out", "<f8").reshape(-1, 17)
        latitude, longitude, height = (np.interp(las.field(20, "<f8"), records[:, 0], records[:, i]) for i in (1, 2, 3))
        east, north, scale, convergence = utm_north(latitude, longitude, np.radians(-117))
        grid_east, grid_north = (places[0] - east) / scale, (places[1] - north) / scale
        azimuth = np.degrees(np.arctan2(grid_east, grid_north) + convergence)
        down = height - places[2]
        slant = np.sqrt(grid_east**2 + grid_north**2 + down**2)
        self.assertLess(np.abs(columns["slant_range"] - slant).max(), 0.005)
        self.assertLess(np.abs(columns["incidence"] - np.degrees(np.arccos(down / slant))).max(), 1e-4)
        self.assertLess(np.abs(degrees_apart(columns["beam_azimuth"], azimuth)).max(), 1e-4)


if __name__ == "__main__":
    programs.main()
