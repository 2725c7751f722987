"""albtpu-query crosscheck, from outside, on a survey whose points have errors: its truth is a simulation of its own.

Aircraft, scanner, ranges and slopes of the water err as much as is declared, and points lie where processing would put
them (tests/flights). ALBTPU_CROSS_CHECK_SEEDS=20 flies more surveys.
"""

import json
import math
import os
import statistics

import programs
import reported_survey
from programs import query
from simulated_survey import SimulatedSurvey

WIND, WIND_FROM = 5, 250  # As in reported_survey.SURVEY.
RIGHT = {"scan": 0.02, "bottom_range": 0.025}
TRAJECTORY = {"position": [0.02, 0.02, 0.04], "attitude": [0.0025, 0.0025, 0.005]}
SURVEY = (reported_survey.SURVEY.replace('errors = ["{flight}/smrmsg.out"]', "{errors}")
          .replace("classes = [41]", 'classes = [41]\nlocated = "pulse"') + "[sigma]\n{sigma}\n")


def slopes_of_table():
    """One sigma of the slopes along and across the wind that refract as the shipped table says, at nadir."""
    pulse = json.loads(query("pulse", "--table", programs.PATHS["shipped_table"], "--wind-speed", WIND, "--incidence",
                             0.1, "--azimuth", 0, "--footprint", 0.42, "--depth", 1, "--json", check=0).stdout)
    gain = 1 - 1 / 1.34  # The index of the simulated water.
    return [math.tan(math.radians(pulse[name]) / 2) / gain
            for name in ("refraction_along_wind", "refraction_cross_wind")]


class CrossCheckOfErrors(programs.Test):
    def fly(self, seed):
        along, across = slopes_of_table()
        return SimulatedSurvey(self.folder / f"flight_{seed}", "--seed", seed, "--lines", 8, "--cross-lines", 3,
                               "--seconds", 20, "--pulse-rate", 2500, "--file-for-each-line", "--surface-share", 1,
                               "--column-share", 0, "--trajectory-errors", "--scan-noise", RIGHT["scan"],
                               "--range-noise", RIGHT["bottom_range"], "--wave-slopes", f"{along},{across}",
                               "--wind-from", WIND_FROM).folder

    def check(self, flight, errors, sigma):
        annotated = self.folder / "annotated"
        annotated.mkdir(exist_ok=True)
        survey = self.folder / "survey.toml"
        survey.write_text(SURVEY.format(flight=flight, datum=0.05, coverage="p95", errors=errors,
                                        sigma="\n".join(f"{name} = {value}" for name, value in sigma.items())))
        query("las", flight, "--output-dir", annotated, "--survey", survey, "--table",
              programs.PATHS["shipped_table"], "--overwrite", check=0)
        return json.loads(query("crosscheck", annotated, "--json", check=0).stdout)

    def test_finds_right_what_is_right_and_the_air_side_that_is_declared_half_as_large(self):
        half = {name: [each / 2 for each in value] if isinstance(value, list) else value / 2
                for name, value in (RIGHT | TRAJECTORY).items()}
        chi_squares, factors, held, accused_half, accused = [], [], 0, 0, 0
        seeds = int(os.environ.get("ALBTPU_CROSS_CHECK_SEEDS", 1))
        for seed in range(1, 1 + seeds):
            flight = self.fly(seed)
            right = self.check(flight, f'errors = ["{flight}/smrmsg.out"]', RIGHT)
            wrong = self.check(flight, "", half)
            chi_squares.append(right["chi_square"])
            factor = wrong["factor_line"]
            factors.append(factor["value"])
            held += factor["low"] <= 2 <= factor["high"]
            accused += right["guilty_share"] is not None
            accused_half += wrong["guilty_share"] == "trajectory"
            self.assertGreater(right["pairs"], 10_000)
            self.assertTrue(right["sea_known"])
            self.assertEqual(right["intervals_by"], "places")
        print(f"{seeds} surveys: chi-square {min(chi_squares):.3f} to {max(chi_squares):.3f}, mean"
              f" {statistics.mean(chi_squares):.3f}, a part differs in {accused}; the air side declared half as"
              f" large: factor of lines {min(factors):.2f} to {max(factors):.2f}, mean {statistics.mean(factors):.3f},"
              f" its interval has 2 in {held}, the trajectory is named in {accused_half}")
        self.assertAlmostEqual(statistics.mean(chi_squares), 1, delta=0.06)
        self.assertGreaterEqual(held, 0.85 * seeds)
        self.assertEqual(accused_half, seeds)
        self.assertLessEqual(accused, 0.05 * seeds)


if __name__ == "__main__":
    programs.main()
