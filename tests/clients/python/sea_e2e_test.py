"""Seas that Python sends are answered from one table: by albtpu-serve, and from the file of it.

Usage: sea_e2e_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
"""

import queue
import sys
import threading
import unittest

import numpy as np

import albtpu
from served import Served

COUNT = 100_000  # More than one batch.
WIND_SEA = albtpu.Sea.jonswap(hs=0.42, tp=2.7, waves_from=225).with_wind(6.5, from_=225)
CROSSED = (WIND_SEA + albtpu.Sea.jonswap(hs=1.1, tp=9.5, waves_from=295, gamma=7, spread=18)).with_depth(12)
MEASURED = albtpu.Sea.spectrum(
    np.linspace(0.05, 0.45, 41), 0.02 * np.linspace(0.05, 0.45, 41) ** -3 / 20, r2=np.full(41, 0.4),
    alpha2=np.linspace(200, 240, 41), record_length=1200)


def pulses(count, seed=1):
    random = np.random.default_rng(seed)
    return dict(incidence=random.uniform(-1, 32, count), azimuth=random.uniform(-400, 400, count),
                footprint=random.uniform(0.05, 7, count), depth=random.uniform(-1, 65, count))


class Seas(Served):
    def test_have_one_table_in_service_and_file(self):
        for sea in (WIND_SEA, CROSSED, MEASURED, albtpu.Sea.calm()):
            answer = self.service.query(sea=sea, **pulses(COUNT), coverage="p95", standard_errors=True)
            table = sea.compile(self.service)
            self.assertEqual(table.table().reference.digest, answer.table.digest)
            self.assertEqual(self.service.sea_table(sea).attributes, table.table().attributes)
            ours = table.query(**pulses(COUNT), coverage="p95", standard_errors=True)
            self.assertEqual(ours.sea, answer.sea)
            np.testing.assert_array_equal(ours.outcome, answer.outcome)
            for name, theirs in answer.values.items():
                largest = np.nan_to_num(np.abs(theirs)).max()
                np.testing.assert_allclose(ours.values[name], theirs, 1e-5, 1e-6 * largest, err_msg=name)

    def test_say_what_was_assumed(self):
        answer = self.service.query(sea=MEASURED, incidence=10, footprint=0.6, depth=8)
        self.assertEqual(answer.sea.x_azimuth, self.service.sea_table(MEASURED).attributes["x_azimuth"])
        self.assertTrue(0 < answer.sea.share_measured < 1)
        self.assertTrue(any("wind" in sentence for sentence in answer.sea.assumptions))
        self.assertIsNone(self.service.query(wind_speed=5, incidence=10, footprint=0.6, depth=8).sea)

    def test_answer_a_query_without_pulses(self):
        answer = self.service.query(sea=CROSSED, incidence=10, footprint=0.5, depth=np.empty((0, 3)))
        self.assertEqual((answer.thu.shape, answer.table.id), ((0, 3), self.service.sea_table(CROSSED).reference.id))

    def test_say_what_neighbouring_pulses_share(self):
        sides = [0.5, 1, 2, 5]
        share = CROSSED.correlation(self.service, cell=sides, footprint=0.6, incidence=20)
        self.assertEqual(share.vertical.shape, (4,))
        for values in (share.slope_x, share.slope_y, share.horizontal, share.vertical, share.height):
            self.assertTrue((np.diff(values) < 0).all() and values[0] < 1 and values[-1] > 0, values)
        along = dict(footprint=0.6, incidence=20)
        self.assertAlmostEqual(CROSSED.correlation(self.service, (0, 0), **along).vertical[0], 1, places=6)
        pairs = CROSSED.correlation(self.service, [(1, 0), (-1, 0)], 0.5, **along)
        self.assertNotAlmostEqual(pairs.vertical[0], pairs.vertical[1], places=3)  # Waves travel.
        both = CROSSED.correlation(self.service, [(1, 0), (-1, 0)], 0.5, both_ways=True, **along)
        np.testing.assert_allclose(both.vertical[0], both.vertical[1], atol=1e-6)
        series = CROSSED.correlation(self.service, (0, 0), [0, 0.1, 0.5], **along)
        self.assertTrue((np.diff(series.horizontal) < 0).all(), series)
        for wrong in (dict(), dict(dx=(1, 2, 3)), dict(dx=np.zeros((0, 2))), dict(dx=(1, 0), cell=1),
                      dict(dx=[(1, 0), (2, 0)], dt=[1, 2, 3])):
            with self.assertRaises(albtpu.ArgumentError):
                CROSSED.correlation(self.service, **wrong, **along)
        with self.assertRaisesRegex(albtpu.ServiceError, r"footprint is 0 m \(expected 0.05 to 10\)"):
            CROSSED.correlation(self.service, (1, 0), footprint=0)

    def test_are_refused_by_the_server_with_the_name_of_the_wrong_number(self):
        with self.assertRaisesRegex(albtpu.ServiceError, r"components\[0\]\.peak_period is 0 s"):
            self.service.query(sea=albtpu.Sea.jonswap(hs=1, tp=0, waves_from=0), incidence=10, footprint=0.5, depth=8)

    def test_are_refused_in_a_flood_that_keeps_no_table_waiting(self):
        codes = queue.SimpleQueue()

        def flood(caller):
            with albtpu.connect(self.server.address, patience=0) as service:
                for i in range(4):
                    sea = albtpu.Sea.calm().with_wind(3 + caller / 10 + i / 1000)
                    try:
                        service.query(sea=sea, incidence=10, footprint=0.5, depth=8)
                        codes.put("OK")
                    except albtpu.Error as error:
                        codes.put(getattr(error, "code", repr(error)))

        callers = [threading.Thread(target=flood, args=(caller,)) for caller in range(40)]
        for caller in callers:
            caller.start()
        while any(caller.is_alive() for caller in callers):
            self.assertTrue(self.service.query(wind_speed=5, incidence=10, footprint=0.5, depth=8).interpolated)
        got = [codes.get() for _ in range(160)]
        self.assertLessEqual(set(got), {"OK", "RESOURCE_EXHAUSTED"})
        self.assertIn("OK", got)

    def test_are_saved_as_tables(self):
        path = self.folder / "saved.h5"
        table = CROSSED.compile(self.service)
        table.save(path)
        self.assertEqual(albtpu.open_table(path).table().reference.digest, table.table().reference.digest)
        with self.assertRaisesRegex(albtpu.TableFileError, "File exists"):
            table.save(path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
