"""The package asks albtpu-serve for the whole budget of pulses.

Usage: budget_e2e_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE ALBTPU_QUERY
"""

import json
import sys
import unittest

import numpy as np

import albtpu
from commands import run
from served import Served

ERRORS = dict(position=(0.03, 0.03, 0.05), attitude=(0.0025, 0.0025, 0.005), boresight=(0.001, 0.001, 0.004),
              lever_arm=0.02, scan=0.001, time=1e-5, range_offset=0.01, bottom_range=0.025, surface_height=0.05,
              index=0.001)
QUERY = sys.argv[3]
PULSES = 150_000  # More than four batches.


def pulses(count=PULSES, **columns):
    random = np.random.default_rng(1)

    def draw(least, most):
        return random.uniform(least, most, count).astype(np.float32)

    return dict(wind_speed=draw(3, 10), incidence=draw(0, 25), azimuth=draw(-180, 180), footprint=draw(0.3, 2),
                depth=draw(0, 20), altitude=draw(100, 800), beam_azimuth=draw(0, 360), located="local", errors=ERRORS,
                lever_arm=(0.3, -0.2, 0.5), datum=0.08, extra_horizontal=0.05, extra_vertical=0.04, sea_axis=250,
                aircraft=dict(roll=draw(-20, 20), heading=draw(0, 360), velocity_north=draw(-80, 80),
                              heading_sigma=draw(0, 0.1), wave_height=0.25)) | columns


class Budget(Served):
    def test_has_the_same_bits_for_many_pulses_as_for_each(self):
        query = pulses(quantities=albtpu.BUDGET_QUANTITIES)
        together = self.service.query_budget(**query)
        self.assertEqual(together.covariance_total.shape, (6, PULSES))
        self.assertLessEqual(set(together.best_s44_order), {"", "exclusive", "special", "1a", "1b", "2"})
        for i in (0, 32767, 32768, PULSES - 1):
            one = {name: column[i] if isinstance(column, np.ndarray) else column for name, column in query.items()}
            one["aircraft"] = {name: column[i] if isinstance(column, np.ndarray) else column
                               for name, column in query["aircraft"].items()}
            alone = self.service.query_budget(**one)
            for name in albtpu.BUDGET_QUANTITIES:
                self.assertEqual(alone.values[name].tobytes(), together.values[name][..., i].tobytes(), name)

    def test_has_the_sea_of_a_query_without_the_budget(self):
        query = pulses(quantities=("thu_sea", "tvu_sea", "bias_vertical"), errors=None, aircraft=None)
        budget = self.service.query_budget(**query)
        sea = self.service.query(**{name: query[name] for name in (
            "wind_speed", "incidence", "azimuth", "footprint", "depth")})
        # Of the reported point, which moves less than the spot on a level bottom; the same at nadir.
        self.assertLess((budget.thu_sea / sea.thu).max(), 1 + 1e-5)
        nadir = self.service.query_budget(**{**query, "incidence": 0})
        np.testing.assert_allclose(nadir.thu_sea, self.service.query(
            incidence=0, **{name: query[name] for name in ("wind_speed", "azimuth", "footprint", "depth")}).thu,
            rtol=1e-6)
        np.testing.assert_allclose(budget.tvu_sea, sea.tvu, rtol=1e-6)
        self.assertEqual(budget.bias_vertical.tobytes(), sea.bias_vertical.tobytes())
        self.assertEqual(budget.table, sea.table)

    def test_has_the_coverage_of_a_query_and_of_a_file(self):
        sea = dict(wind_speed=5, incidence=12, azimuth=30, footprint=0.5, depth=np.arange(20))
        file = albtpu.open_table(self.folder / "synthetic.h5")
        for source in (self.service, file):
            np.testing.assert_array_equal(2 * source.query(**sea, coverage="1sigma").thu, source.query(**sea).thu)

    def test_adds_what_is_added_to_every_pulse(self):
        entries = ("covariance_total", "covariance_survey")
        with_extra = self.service.query_budget(**pulses(quantities=entries))
        without = self.service.query_budget(**pulses(quantities=entries, extra_horizontal=0, extra_vertical=0))
        for entry in entries:
            more = with_extra.values[entry] - without.values[entry]
            for axis, variance in enumerate((0.05**2 / 2, 0.05**2 / 2, 0.04**2, 0, 0, 0)):
                np.testing.assert_allclose(more[axis], variance, atol=1e-6 * with_extra.values[entry][axis].max())

    def test_keeps_the_shape_and_gives_a_bad_pulse_its_own_outcome(self):
        budget = self.service.query_budget(**pulses(1, depth=np.array([[4, 1000, 4], [4, np.nan, 4]]),
                                                    altitude=np.array([400, 400, -1])))
        self.assertEqual(budget.outcome.tolist(), [["INTERPOLATED", "OUT_OF_DOMAIN:depth", "INVALID"],
                                                   ["INTERPOLATED", "INVALID", "INVALID"]])
        self.assertEqual(np.isnan(budget.total_thu).tolist(), [[False, True, True]] * 2)
        with self.assertRaisesRegex(AttributeError, "'thu_air': name it in 'quantities'"):
            budget.thu_air

    def test_says_what_it_lacks(self):
        motion = pulses(1)["aircraft"]
        water = albtpu.Water(secchi=5, detector="half", field_of_view=8, pulse_length=1.5, bias="correct")
        for located, aircraft, of_water, lacks in (
                ("local", {}, None, ("wave_height", "water column")), ("level", motion, None, ("water column",)),
                ("pulse", {}, water, ()), ("level", {}, water, ("wave_height",)),
                ("pulse", {"water_sigma_vertical": 0.1}, None, ()),
                ("pulse", {}, albtpu.Water(secchi=5, without_column=True), ("water column",))):
            with self.subTest(located=located, aircraft=list(aircraft), water=of_water):
                left_out = self.service.query_budget(
                    **pulses(1, depth=3, located=located, aircraft=aircraft, water=of_water)).left_out
                self.assertEqual(len(left_out), len(lacks))
                for sentence, part in zip(left_out, lacks):
                    self.assertIn(part, sentence)

    def test_is_answered_on_a_sea(self):
        sea = albtpu.Sea.jonswap(hs=0.42, tp=2.7, waves_from=225)
        budget = self.service.query_budget(**pulses(wind_speed=None, sea=sea))
        self.assertEqual(budget.table.digest, self.service.sea_table(sea).reference.digest)
        self.assertIsNotNone(budget.sea)

    def test_is_answered_in_a_water(self):
        water = albtpu.Water(secchi=5, detector="half", field_of_view=8, pulse_length=1.5, bias="correct")
        query = pulses(1000, quantities=("tvu_air", "tvu_sea", "tvu_water", "total_tvu"), datum=0, extra_vertical=0)
        budget, without = self.service.query_budget(**query, water=water), self.service.query_budget(**query)
        answered = budget.outcomes == 1
        self.assertGreater(answered.sum(), 500)
        self.assertEqual(set(budget.outcome[~answered]), {"OUT_OF_DOMAIN:depth"})
        self.assertTrue((query["depth"][~answered] > budget.water.greatest_depth).all())
        self.assertGreater(budget.tvu_water[answered].min(), 0)
        np.testing.assert_allclose((budget.total_tvu**2 - without.total_tvu**2)[answered],
                                   (budget.tvu_water**2)[answered], atol=1e-6)
        self.assertIn("Secchi depth Z = 5 m", budget.water.derivation)
        self.assertIn("as that of natural particles", " ".join(budget.water.assumptions))
        self.assertEqual(len(budget.water.table.digest), 64)
        self.assertIsNone(without.water)
        with self.assertRaisesRegex(albtpu.ServiceError, "water.secchi is 500 m"):
            self.service.query_budget(**query, water=albtpu.Water(secchi=500, without_column=True))

    def test_has_the_bits_of_the_water_of_albtpu_query(self):
        """Which computes the columns itself, from a survey file in the same words."""
        receiver = dict(detector="half", field_of_view=6, pulse_length=1.5, bias="none")
        for words in (dict(kd=0.15, kd_kind="satellite490", bias="vendor", residual_fraction=0.3),
                      dict(jerlov="3C", detector="peak", photons=200),
                      dict(absorption=0.1, scattering=0.4, detector="centroid", bias="correct"),
                      dict(secchi=6, temperature=12, salinity=33, processed_with=1.33, green_surface=True)):
            words = receiver | words
            lines = [f"{key} = {json.dumps(value)}" for key, value in words.items() if key != "green_surface"]
            channel = "green" if "green_surface" in words else "infrared"
            survey = self.folder / "survey.toml"
            survey.write_text("\n".join(("[sensor]", 'name = "riegl-vq-880-g"', "[datum]", "sigma = 0", "[surface]",
                                         'located = "local"', f'channel = "{channel}"', "[water]", *lines, "")))
            made = run(QUERY, "pulse", "--survey", survey, "--table", self.folder / "synthetic.h5", "--wind-speed", 6.5,
                       "--incidence", 15, "--beam-azimuth", 90, "--altitude", 400, "--depth", 7.5, "--footprint", 0.5,
                       "--coverage", "2sigma", "--json")
            self.assertEqual(made.returncode, 0, made.stderr)
            names = ("thu_water", "tvu_water", "bias_vertical", "bias_along_beam")
            budget = self.service.query_budget(
                wind_speed=6.5, incidence=15, depth=7.5, footprint=0.5, altitude=400, beam_azimuth=90, located="local",
                quantities=names, water=albtpu.Water(**words))
            for name in names:
                self.assertEqual(np.float32(json.loads(made.stdout)[name]), budget.values[name], (words, name))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
