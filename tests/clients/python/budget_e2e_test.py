"""The package asks albtpu-serve for the whole budget of pulses.

Usage: budget_e2e_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
"""

import sys
import unittest

import numpy as np

import albtpu
from served import Served

ERRORS = dict(position=(0.03, 0.03, 0.05), attitude=(0.0025, 0.0025, 0.005), boresight=(0.001, 0.001, 0.004),
              lever_arm=0.02, scan=0.001, time=1e-5, range_offset=0.01, bottom_range=0.025, surface_height=0.05,
              index=0.001)
PULSES = 150_000  # More than four batches.


def pulses(count=PULSES, **columns):
    random = np.random.default_rng(1)

    def draw(least, most):
        return random.uniform(least, most, count).astype(np.float32)

    return dict(wind_speed=draw(3, 10), incidence=draw(0, 25), azimuth=draw(-180, 180), footprint=draw(0.3, 2),
                depth=draw(0, 20), altitude=draw(100, 800), beam_azimuth=draw(0, 360), located="local", errors=ERRORS,
                lever_arm=(0.3, -0.2, 0.5), datum=0.08, sea_axis=250,
                aircraft=dict(roll=draw(-20, 20), heading=draw(0, 360), velocity_north=draw(-80, 80),
                              heading_sigma=draw(0, 0.1), wave_height=0.25)) | columns


class Budget(Served):
    def test_has_the_same_bits_for_many_pulses_as_for_each(self):
        query = pulses(quantities=albtpu.BUDGET_QUANTITIES)
        together = self.service.query_budget(**query)
        for i in (0, 32767, 32768, PULSES - 1):
            one = {name: column[i] if isinstance(column, np.ndarray) else column for name, column in query.items()}
            one["aircraft"] = {name: column[i] if isinstance(column, np.ndarray) else column
                               for name, column in query["aircraft"].items()}
            alone = self.service.query_budget(**one)
            for name in albtpu.BUDGET_QUANTITIES:
                self.assertEqual(alone.values[name].tobytes(), together.values[name][..., i].tobytes(), name)

    def test_is_the_sum_of_its_shares(self):
        budget = self.service.query_budget(**pulses(quantities=albtpu.BUDGET_QUANTITIES))
        total = budget.covariance_air + budget.covariance_sea
        total[2] += 0.08**2
        np.testing.assert_allclose(budget.covariance_total, total, rtol=1e-5, atol=1e-8)
        groups = budget.covariance_pulse + budget.covariance_line + budget.covariance_survey
        np.testing.assert_allclose(budget.covariance_total, groups, rtol=1e-5, atol=1e-8)
        np.testing.assert_allclose(budget.total_thu, 2 * np.sqrt(total[0] + total[1]), rtol=1e-5)
        np.testing.assert_allclose(budget.total_tvu, 2 * np.sqrt(total[2]), rtol=1e-5)
        self.assertEqual(budget.covariance_total.shape, (6, PULSES))
        self.assertLessEqual(set(budget.best_s44_order), {"", "exclusive", "special", "1a", "1b", "2"})

    def test_has_the_sea_of_a_query_without_the_budget(self):
        query = pulses(quantities=("thu_sea", "tvu_sea", "bias_vertical"), errors=None, aircraft=None)
        budget = self.service.query_budget(**query)
        sea = self.service.query(**{name: query[name] for name in (
            "wind_speed", "incidence", "azimuth", "footprint", "depth")})
        np.testing.assert_allclose(budget.thu_sea, sea.thu, rtol=1e-6)
        np.testing.assert_allclose(budget.tvu_sea, sea.tvu, rtol=1e-6)
        self.assertEqual(budget.bias_vertical.tobytes(), sea.bias_vertical.tobytes())
        self.assertEqual(budget.table, sea.table)

    def test_has_three_coverages(self):
        two, one, p95 = (self.service.query_budget(**pulses(coverage=name)) for name in ("2sigma", "1sigma", "p95"))
        np.testing.assert_array_equal(2 * one.total_thu, two.total_thu)
        np.testing.assert_allclose(p95.total_tvu, 0.979982 * two.total_tvu, rtol=1e-5)
        sea = dict(wind_speed=5, incidence=12, azimuth=30, footprint=0.5, depth=np.arange(20))
        asked = self.service.query(**sea, coverage="1sigma")
        np.testing.assert_array_equal(2 * asked.thu, self.service.query(**sea).thu)
        file = albtpu.open_table(self.folder / "synthetic.h5")
        np.testing.assert_array_equal(2 * file.query(**sea, coverage="1sigma").tvu, file.query(**sea).tvu)

    def test_keeps_the_shape_and_gives_a_bad_pulse_its_own_outcome(self):
        budget = self.service.query_budget(**pulses(1, depth=np.array([[4, 1000, 4], [4, np.nan, 4]]),
                                                    altitude=np.array([400, 400, -1])))
        self.assertEqual(budget.outcome.tolist(), [["INTERPOLATED", "OUT_OF_DOMAIN:depth", "INVALID"],
                                                   ["INTERPOLATED", "INVALID", "INVALID"]])
        self.assertEqual(np.isnan(budget.total_thu).tolist(), [[False, True, True]] * 2)
        with self.assertRaisesRegex(AttributeError, "'thu_air': name it in 'quantities'"):
            budget.thu_air

    def test_is_answered_on_a_sea(self):
        sea = albtpu.Sea.jonswap(hs=0.42, tp=2.7, waves_from=225)
        budget = self.service.query_budget(**pulses(wind_speed=None, sea=sea))
        self.assertEqual(budget.table.digest, self.service.sea_table(sea).reference.digest)
        self.assertIsNotNone(budget.sea)

    def test_refuses_options_by_name(self):
        for change, message in ((dict(errors=dict(scan=-1)), "options.errors.scan is -1"),
                                (dict(refractive_index=0.9), "options.refractive_index is 0.9")):
            with self.assertRaisesRegex(albtpu.ServiceError, message):
                self.service.query_budget(**pulses(3, **change))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
