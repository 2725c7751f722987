"""Dry points from outside: what they get in a survey with a beach, and the beams of a real topographic survey."""

import json
import pathlib

import numpy as np

import programs
from las_file import LasFile
from programs import PATHS, query
from simulated_survey import BOTTOM, COLUMN, SimulatedSurvey, degrees_apart

LEEWARD = pathlib.Path(PATHS["cases"], "leeward")  # Snow in the Sierra Nevada: SBET and LAS of an airborne scanner.
FACTOR_95 = 1.959963985  # 95 % of a normal error.
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


# The standard deviations of the configuration of cases/leeward: m and degrees.
SIGMA = {"position": (0.05, 0.05, 0.1), "attitude": (0.0025, 0.0025, 0.003), "boresight": (0.001, 0.001, 0.004),
         "lever_arm": 0.02, "bottom_range": 0.02, "scan": 0.001}


def body_axes(roll, pitch, heading):
    """Forward, right and down as columns on the axes north, east, down."""
    def turn(first, second, angle):
        matrix = np.eye(3)
        matrix[[first, second], [first, second]] = np.cos(angle)
        matrix[first, second], matrix[second, first] = -np.sin(angle), np.sin(angle)
        return matrix
    return turn(0, 1, heading) @ turn(2, 0, pitch) @ turn(1, 2, roll)


def covariance_of(beam, slant_range, angles, scans=2):
    """North, east, down of the lidar equation, by differences, with the standard deviations of SIGMA."""
    axes = body_axes(*angles)
    in_body = axes.T @ beam
    across = np.cross(in_body, [0, 1, 0])  # In the plane of a scan to left and right lies the other.
    across /= np.linalg.norm(across)

    def point(position=(0, 0, 0), attitude=(0, 0, 0), boresight=(0, 0, 0), lever_arm=(0, 0, 0), bottom_range=(0,),
              scan=(0, 0)):
        body = body_axes(*(np.array(angles) + np.radians(attitude)))
        scanned = in_body + np.radians(scan[0]) * np.cross(across, in_body) + np.radians(scan[1]) * across
        turned = scanned + np.cross(np.radians(boresight), scanned)
        return np.array(position) + body @ (np.array(lever_arm) + (slant_range + bottom_range[0]) * turned)

    columns = []
    for name, sigmas in SIGMA.items():
        count = {"bottom_range": 1, "scan": scans}.get(name, 3)
        for i, sigma in enumerate(np.broadcast_to(sigmas, count)):
            # 2 numbers of a scan, of which the first may be the only one with an error.
            error = np.zeros(max(count, 2 if name == "scan" else 1))
            error[i] = sigma
            columns.append((point(**{name: error}) - point(**{name: -error})) / 2)
    return np.transpose(columns) @ np.array(columns)


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
        rmse = np.sqrt(np.mean((columns["total_tvu"][dry] / FACTOR_95)**2))
        self.assertAlmostEqual(answers["dry"]["rmse_vertical"], rmse, delta=1e-5 * rmse)

    def test_on_a_slope(self):
        """The height at a fixed place: with the gradient g of all points within 3 m, by plain least squares."""
        survey = SimulatedSurvey(self.folder / "flight", "--seconds", 2, "--pulse-rate", 30000)
        flags = ("--trajectory", survey.sbet, "--water-level", survey.water_level, "--coverage", "1sigma")
        level, _ = self.annotate(survey.las, *flags)
        sloping, _ = self.annotate(survey.las, *flags, "--terrain-slope")
        las = LasFile(survey.las)
        dry = level["share_of"] == 1
        known = np.isfinite(sloping["terrain_slope"])
        self.assertGreater(known.sum(), 1000)
        self.assertTrue((las.classes[known] == 2).all())
        for name, values in level.items():
            same = np.ones_like(known) if name not in ("total_tvu", "tvu_air", "tvu_pulse", "tvu_line") else ~known
            np.testing.assert_array_equal(sloping[name][same], values[same], name)
        self.assertTrue((sloping["tvu_slope"][~known] == -1).all())
        x, y, z = (las.field(4 * i, "<i4") * las.scale[i] + las.offset[i] for i in range(3))
        ground = np.flatnonzero(dry & (las.classes == 2))
        compared = 0
        for i in np.flatnonzero(known)[::97]:
            near = ground[np.maximum(abs(x[ground] - x[i]), abs(y[ground] - y[i])) < 3]
            # At the edge of the swath, points lie on an arc, and heights are rounded to a centimetre.
            if len(near) < 20 or np.linalg.eigvalsh(np.cov(x[near], y[near]))[0] < 1:
                continue
            compared += 1
            design = np.stack([np.ones_like(x[near]), x[near] - x[i], y[near] - y[i]], axis=1)
            gradient = np.linalg.lstsq(design, z[near], rcond=None)[0][1:]
            normal = np.append(-gradient, 1)  # On the axes of the file, z up.
            entries = {name: sloping[name][i] for name in sloping if "ariance" in name}
            covariance = np.array([[entries["VarianceX"], entries["CovarianceXY"], entries["CovarianceXZ"]],
                                   [entries["CovarianceXY"], entries["VarianceY"], entries["CovarianceYZ"]],
                                   [entries["CovarianceXZ"], entries["CovarianceYZ"], entries["VarianceZ"]]])
            # The azimuth on the grid differs from the true one by the convergence, half a degree here.
            angle, azimuth = np.radians([sloping["incidence"][i], sloping["beam_azimuth"][i]])
            beam = np.array([np.sin(angle) * np.sin(azimuth), np.sin(angle) * np.cos(azimuth), -np.cos(angle)])
            across = normal @ normal - (normal @ beam)**2
            footprint = sloping["footprint"][i]**2 / 16 * across
            # Planes of four points a cell on ripples: the slope is known to 0.5 %.
            slope = np.hypot(*gradient)
            self.assertAlmostEqual(np.tan(np.radians(sloping["terrain_slope"][i])), slope, delta=0.005)
            self.assertAlmostEqual(sloping["tvu_footprint"][i], np.sqrt(footprint), delta=0.005 * 0.4 / 4 + 1e-3)
            self.assertAlmostEqual(sloping["total_tvu"][i], np.sqrt(normal @ covariance @ normal + footprint),
                                   delta=0.005 * np.sqrt(covariance[0, 0] + covariance[1, 1]) + 1e-3)
            horizontal = np.sqrt(gradient @ covariance[:2, :2] @ gradient)
            self.assertAlmostEqual(sloping["tvu_slope"][i], horizontal, delta=0.005 * np.sqrt(covariance[0, 0]) + 1e-3)
        self.assertGreater(compared, 50)

    def test_on_a_slope_needs_dry_points_and_beams(self):
        survey = SimulatedSurvey(self.folder / "flight", "--seconds", 1, "--pulse-rate", 500)
        for flags, why in ((("--trajectory", survey.sbet, "--points", "bathymetric"), "is of dry points"),
                           (("--scanner", "across-track", "--altitude", 400), "--trajectory")):
            result = query("las", survey.las, self.folder / "out.las", "--table", PATHS["shipped_table"], *TOTAL,
                           "--water-level", survey.water_level, "--terrain-slope", *flags)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(why, result.stderr)
            self.assertFalse((self.folder / "out.las").exists())

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

    def test_of_a_real_survey_have_the_covariance_of_the_lidar_equation(self):
        """With the standard deviations of its own configuration, at each 50th point."""
        if not LEEWARD.exists():
            self.skipTest(f"{LEEWARD} does not exist")
        sigma = "\n".join(f"{name} = {list(value) if isinstance(value, tuple) else value}"
                          for name, value in SIGMA.items())
        survey = self.toml(f"[datum]\nsigma = 0\n[sigma]\n{sigma}\ntime = 0\nrange_offset = 0\n")
        columns, _ = self.annotate(LEEWARD / "points.las", "--trajectory", LEEWARD / "sbet.out", "--water-level", 0,
                                   "--crs", "EPSG:32611", "--coverage", "1sigma", "--survey", survey)
        times = LasFile(LEEWARD / "points.las").field(20, "<f8")
        records = np.fromfile(LEEWARD / "sbet.out", "<f8").reshape(-1, 17)
        found, one_angle = [], []
        for i in range(0, len(times), 50):
            angle, azimuth = np.radians([columns["incidence"][i], columns["beam_azimuth"][i]])
            beam = np.array([np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle)])
            roll, pitch, heading, wander = (np.interp(times[i], records[:, 0], records[:, k]) for k in (7, 8, 9, 10))
            slant_range = columns["slant_range"][i]
            for scans, ratios in ((2, found), (1, one_angle)):
                covariance = covariance_of(beam, slant_range, (roll, pitch, heading - wander), scans)
                ratios.append([columns["total_thu"][i] / np.sqrt(covariance[0, 0] + covariance[1, 1]),
                               columns["total_tvu"][i] / np.sqrt(covariance[2, 2])])
        print("THU and TVU of cases/leeward less those of its lidar equation, %:",
              100 * (np.array(found).min(axis=0) - 1), "to", 100 * (np.array(found).max(axis=0) - 1),
              "and of one with a single scan angle:", 100 * (np.array(one_angle).min(axis=0) - 1), "to",
              100 * (np.array(one_angle).max(axis=0) - 1))
        # The vertical of a point is not that of the sensor, 2 km away: 3e-4 rad.
        self.assertLess(np.abs(np.array(found) - 1).max(), 1e-3)


if __name__ == "__main__":
    programs.main()
