"""The arguments of queries, and the shape of the answers; the names of both.

Usage: query_test.py TABLE.h5
"""

import dataclasses
import sys
import unittest
import warnings

import numpy as np
import xarray

import albtpu
from albtpu import AXES, BUDGET_QUANTITIES, QUANTITIES, budget, schema, sea, water
from albtpu.v1 import budget_pb2, pulse_pb2, sea_pb2, table_pb2, uncertainty_pb2, water_pb2

TABLE = sys.argv[1]
PULSE = dict(wind_speed=5, incidence=10, azimuth=30, footprint=0.5, depth=8)


class Queries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = albtpu.open_table(TABLE)

    def query(self, **changes):
        return self.source.query(**{**PULSE, **changes})

    def test_accept_numbers_lists_and_arrays_of_one_shape(self):
        one = self.query()
        self.assertEqual(one.thu.shape, ())
        self.assertGreater(float(one.thu), 0)
        for depth, shape in (([8, 9], (2,)), (np.int16([[8], [9]]), (2, 1)), (np.float32(8), ()),
                             (np.array([8, 9], ">f8"), (2,)), (np.arange(20)[5:9:2], (2,)), ([], (0,))):
            answer = self.query(depth=depth)
            self.assertEqual((answer.thu.shape, answer.outcome.shape), (shape, shape))
            if answer.thu.size:
                self.assertAlmostEqual(answer.thu.flat[0], float(self.query(depth=np.ravel(depth)[0]).thu), 7)

    def test_broadcast(self):
        incidence, depth = np.linspace(0, 25, 4)[:, None], np.linspace(0, 20, 3)
        answer = self.query(incidence=incidence, depth=depth)
        self.assertEqual(answer.thu.shape, (4, 3))
        for i, j in np.ndindex(4, 3):
            self.assertEqual(answer.thu[i, j], self.query(incidence=incidence[i, 0], depth=depth[j]).thu)

    def test_treat_masked_and_non_finite_coordinates_as_invalid(self):
        for depth in (np.ma.masked_array([8, 9], [False, True]), [8, np.nan], [8, np.inf], [8, -1e300]):
            answer = self.query(depth=depth)
            self.assertEqual(list(answer.outcome), ["INTERPOLATED", "INVALID"])
            self.assertTrue(np.isnan(answer.tvu[1]))

    def test_accept_numbers_too_large_for_single_precision(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for depth in (1e300, [1e300, 8]):
                self.assertEqual(self.query(depth=depth).outcome.flat[0], "INVALID")
            self.assertEqual(self.query(depth=[1e300, 8], incidence=[[5], [10]]).outcome[0, 0], "INVALID")

    def test_return_only_what_was_requested(self):
        answer = self.query(quantities="tvu")
        self.assertEqual(list(answer.values), ["tvu"])
        self.assertEqual(answer.standard_errors, {})
        self.assertIsNone(answer.best_s44_order)
        with self.assertRaisesRegex(AttributeError, "no 'thu': name it in 'quantities'"):
            answer.thu
        with self.assertRaisesRegex(AttributeError, "no 'colour'$"):
            answer.colour

    def test_return_names_units_and_provenance(self):
        answer = self.query(depth=[8, 30, np.nan, 9], standard_errors=True, best_s44_order=True, s44_order="2")
        self.assertEqual(answer.outcome_counts(), {"INTERPOLATED": 2, "OUT_OF_DOMAIN:depth:above": 1, "INVALID": 1})
        self.assertEqual(list(answer.interpolated), [True, False, False, True])
        self.assertEqual(answer.table[:3], ("synthetic", "synthetic", "1"))
        self.assertEqual(len(answer.table.digest), 64)
        self.assertEqual((answer.coverage, answer.azimuth_absent), ("2sigma", False))
        self.assertEqual(set(answer.to_dict()), set(answer.units))
        units = {name: answer.units[name] for name in ("thu", "thu_standard_error", "refraction_along_wind",
                                                       "remaining_tvu", "outcomes", "best_s44_orders")}
        self.assertEqual(list(units.values()), ["m", "m", "degree", "m", "", ""])
        self.assertIn("of shape (4,), 2sigma, table synthetic 1: ", repr(answer))
        self.assertIn("2 INTERPOLATED", repr(answer))

    def test_refuse_arrays_of_xarray_that_numpy_would_pair_by_position(self):
        def array(*dims):
            return xarray.DataArray(np.full([3] * len(dims), 5.0), dims=dims)

        for wind, depth in ((array("time"), array("pulse")), (array("x", "y"), array("y", "x")),
                            (array("time", "pulse"), array("time"))):
            with self.assertRaisesRegex(albtpu.ArgumentError, "the dimensions differ: wind_speed .* depth .*broadcast"):
                self.query(wind_speed=wind, depth=depth)
        for wind, depth in ((array("y", "x"), array("x")), (array("x"), 5), (array(), array("x")),
                            (array("x"), [5] * 3)):
            self.assertEqual(self.query(wind_speed=wind, depth=depth).thu.shape[-1], 3)

    def test_convert_to_an_xarray_dataset(self):
        depth = np.linspace(0, 20, 3)
        answer = self.query(incidence=np.linspace(0, 25, 4)[:, None], depth=depth, standard_errors=True,
                          best_s44_order=True, s44_order="1a", coverage="p95")
        dataset = answer.to_xarray(("incidence", "depth"))
        np.testing.assert_array_equal(dataset.thu.sel(depth=10.0), answer.thu[:, 1])
        self.assertEqual(dataset.depth.attrs["units"], "m")
        self.assertEqual(dataset.wind_speed.item(), 5)
        self.assertEqual(dataset.thu.attrs["ancillary_variables"], "thu_standard_error")
        self.assertEqual(dataset.attrs["table_digest"], answer.table.digest)
        self.assertIn("INTERPOLATED", dataset.outcomes.attrs["flag_meanings"])
        self.assertEqual(self.query(depth=depth).to_xarray().thu.dims, ("pulse",))
        self.assertEqual(self.query(depth=[]).to_xarray().thu.shape, (0,))
        self.assertEqual(self.query().to_xarray().thu.dims, ())
        one = self.query(depth=[8.0]).to_xarray(("depth",))
        self.assertEqual((one.depth.values, one.wind_speed.dims), ([8], ()))
        for dims, hint in ((("depth",), "dims has 1 names: the answer has 2 dimensions"),
                           (("depth", "incidence"), "incidence varies along .*: it cannot index the dimension")):
            with self.assertRaisesRegex(albtpu.ArgumentError, hint):
                answer.to_xarray(dims)


class Names(unittest.TestCase):
    def test_are_those_of_the_messages_in_their_order(self):
        for ours, message in ((AXES, pulse_pb2.PulseColumns), (QUANTITIES, uncertainty_pb2.SeaSurfaceColumns),
                              (budget.AIRCRAFT, budget_pb2.AircraftColumns)):
            self.assertEqual(list(ours), [field.name for field in message.DESCRIPTOR.fields])
        for ours, enum in (
                (["unspecified", *AXES], pulse_pb2.Axis), (["unspecified", *QUANTITIES], uncertainty_pb2.Quantity),
                (schema.OUTCOMES, uncertainty_pb2.Outcome), (["unspecified", *schema.SCALES[1:]], table_pb2.Scale),
                (["unspecified", *schema.S44_ORDERS[1:]], uncertainty_pb2.S44Order),
                (["unspecified", *sea.TAILS], sea_pb2.TailRule),
                (["unspecified", *water.KD_KINDS], water_pb2.KdKind),
                (["unspecified", *water.JERLOV_TYPES], water_pb2.JerlovType),
                (["unspecified", *water.DETECTORS], water_pb2.EchoDetector),
                (["unspecified", *water.BIASES], water_pb2.BiasHandling),
                (["unspecified", *(name.removesuffix("s") if name == "best_s44_orders" else name
                                   for name in BUDGET_QUANTITIES)], budget_pb2.BudgetQuantity)):
            beginning = enum.keys()[0].removesuffix("UNSPECIFIED")
            self.assertEqual([beginning + name.upper() for name in ours], enum.keys())

    def test_of_a_water_are_those_of_its_message(self):
        self.assertEqual({field.name for field in dataclasses.fields(albtpu.Water)},
                         {field.name for field in water_pb2.WaterState.DESCRIPTOR.fields})
        self.assertEqual(list(albtpu.WaterSummary._fields),
                         [field.name for field in water_pb2.WaterSummary.DESCRIPTOR.fields])
        message = albtpu.Water(kd=0.12, kd_kind="diffuse532", jerlov="1C", detector="half", bias="calibrated",
                               calibration=(5, -0.04, 0.01), green_surface=True).message()
        self.assertEqual(message, water_pb2.WaterState(
            kd=0.12, kd_kind=water_pb2.KD_KIND_DIFFUSE532, jerlov=water_pb2.JERLOV_TYPE_1C,
            detector=water_pb2.ECHO_DETECTOR_HALF, bias=water_pb2.BIAS_HANDLING_CALIBRATED,
            calibration=dict(depth=5, offset=-0.04, sigma=0.01), green_surface=True))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
