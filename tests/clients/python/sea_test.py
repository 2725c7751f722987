"""Seas have the numbers of the C++ library, bit for bit, and say what is wrong with an argument.

Usage: sea_test.py ALBTPU_SEA_STATES
"""

import gzip
import math
import subprocess
import sys
import unittest

import numpy as np
import xarray

import albtpu
from albtpu import spectrum
from albtpu.v1 import sea_pb2
from commands import FolderTest

SEA_STATES = sys.argv[1]
FREQUENCIES = (0.033, 0.05, 0.1, 0.225, 0.35, 0.485)
# Energy, r2 and alpha2 of records, the newest first.
RECORDS = {
    "2020 06 08 03 50": ((0.0, 0.12, 1.253, 0.707, 0.031, 0.004), (999.0, 0.41, 0.33, 0.5, 0.07, 0.999),
                         (999.0, 230.0, 12.5, 359.9, 88.0, 141.3)),
    "2020 06 08 02 50": ((0.0, 0.1, 1.1, 999.0, 0.03, 0.0), (0.1, 0.2, 0.3, 0.4, 999.0, 0.6),
                         (10.0, 20.0, 30.0, 40.0, 50.0, 999.0)),
}


def write_real_time(folder):
    for column, (suffix, quantity) in enumerate(((".data_spec", "spec"), (".swr2", "r2"), (".swdir2", "alpha2"))):
        lines = [f"#YY  MM DD hh mm {'Sep_Freq  < ' if column == 0 else ''}{quantity}_1 (freq_1) {quantity}_2 (freq_2)"]
        for time, record in RECORDS.items():
            pairs = " ".join(f"{value:.3f} ({f:.3f})" for value, f in zip(record[column], FREQUENCIES))
            lines.append(f"{time} {'0.225 ' if column == 0 else ''}{pairs}")
        (folder / f"buoy{suffix}").write_text("\n".join(lines) + "\n")
    return folder / "buoy.data_spec"


def write_history(folder):
    for column, letter in enumerate("wki"):
        lines = ["#YY  MM DD hh mm " + " ".join(f"{f:.4f}" for f in FREQUENCIES)]
        for time, record in reversed(RECORDS.items()):
            scale = 100 if letter == "k" else 1
            values = (999.0 if value == 999 else round(scale * value, 2) for value in record[column])
            lines.append(f"{time} " + " ".join(f"{value:.2f}" for value in values))
        with gzip.open(folder / f"41010{letter}2020.txt.gz", "wt") as file:
            file.write("\n".join(lines) + "\n")
    return folder / "41010w2020.txt.gz"


def of_library(path):
    """The messages that the C++ client sends of the records of a file, by time."""
    lines = subprocess.run([SEA_STATES, path], check=True, capture_output=True, text=True).stdout.splitlines()
    return {np.datetime64(int(time), "s"): sea_pb2.SeaState.FromString(bytes.fromhex(state))
            for time, state in map(str.split, lines)}


class Ndbc(FolderTest):
    def test_has_the_bits_of_the_library(self):
        for write in (write_real_time, write_history):
            path = write(self.folder)
            expected = of_library(path)
            self.assertEqual(len(expected), len(RECORDS))
            for time, message in expected.items():
                self.assertEqual(albtpu.Sea.ndbc(path, time).message(), message, f"{path.name} at {time}")
                self.assertEqual(albtpu.Sea.ndbc(path, f"{time}Z").message(), message)
            self.assertEqual(albtpu.Sea.ndbc(path).message(), expected[max(expected)])

    def test_is_isotropic_without_directions(self):
        path = write_real_time(self.folder)
        for suffix in (".swr2", ".swdir2"):
            path.with_suffix(suffix).unlink()
        sea = albtpu.Sea.ndbc(path)
        self.assertFalse(np.any(sea.waves.cosines))
        [state] = [message for time, message in of_library(path).items() if time == np.datetime64("2020-06-08T03:50")]
        self.assertEqual(list(sea.message().frequency_spectrum.densities), list(state.frequency_spectrum.densities))

    def test_says_what_is_wrong(self):
        path = write_real_time(self.folder)
        (self.folder / "text.data_spec").write_text("not a buoy\n")
        (self.folder / "cut.data_spec").write_text(path.read_text()[:-5])
        for name, time, message in (
                ("absent.data_spec", None, "No such file"), ("text.data_spec", None, "its first line is not"),
                ("buoy.swr2", None, "does not name spec_1"), ("cut.data_spec", None, "line 3 does not match"),
                ("buoy.data_spec", "2020-06-08T03:00Z", "the closest is at 2020-06-08T02:50Z"),
                ("buoy.data_spec", "yesterday", "it should be like")):
            with self.assertRaisesRegex(albtpu.ArgumentError, message):
                albtpu.Sea.ndbc(self.folder / name, time)


class Described(unittest.TestCase):
    def test_is_sent_in_radians(self):
        sea = (albtpu.Sea.jonswap(hs=0.42, tp=2.7, waves_from=225)
               + albtpu.Sea.jonswap(hs=1.1, tp=9.5, waves_from=295, gamma=7, spread=18))
        state = sea.with_wind(6.5, from_=225).with_depth(12).with_tail("level", tail_from=0.9).message()
        first, second = state.components.components
        self.assertEqual((first.significant_wave_height, first.peak_period, first.gamma), (0.42, 2.7, 3.3))
        self.assertEqual(first.travels_towards, 225 * math.pi / 180 + math.pi)
        self.assertFalse(first.HasField("spread"))
        self.assertEqual((second.gamma, second.spread), (7, 18 * math.pi / 180))
        self.assertEqual((state.wind_speed, state.wind_from), (6.5, 225 * math.pi / 180))
        self.assertEqual((state.water_depth, state.tail_rule, state.tail_from), (12, sea_pb2.TAIL_RULE_LEVEL, 0.9))

    def test_of_masked_numbers_knows_none_there(self):
        f, energy, r2 = [0.1, 0.2, 0.3], [1.0, 2.0, 1.0], [0.5, 0.5, 0.5]
        masked, missing = np.ma.masked_equal([30.0, 30.0, 999.0], 999.0), [30, 30, np.nan]
        self.assertEqual(albtpu.Sea.spectrum(f, energy, r2=r2, alpha2=masked).message(),
                         albtpu.Sea.spectrum(f, energy, r2=r2, alpha2=missing).message())
        densities = albtpu.Sea.spectrum(f, np.ma.masked_equal(energy, 2.0)).message().frequency_spectrum.densities
        np.testing.assert_array_equal(densities, [1, np.nan, 1])

    def test_takes_the_numbers_that_are_given(self):
        waves = albtpu.Sea.spectrum([0.1, 0.2], [1, 2], trusted_up_to=0).message().frequency_spectrum
        self.assertEqual(waves.trusted_up_to, 0)  # Refused by the server.
        with self.assertRaisesRegex(albtpu.ArgumentError, "frequencies has the shape"):
            albtpu.Sea.spectrum([], [])

    def test_calm_has_no_wind_and_no_waves(self):
        state = albtpu.Sea.calm().message()
        self.assertTrue(state.HasField("wind_speed"))
        self.assertEqual((state.wind_speed, state.WhichOneof("waves")), (0, None))


class Directional(unittest.TestCase):
    """Sums over directions, which need no xarray."""

    def test_of_a_cosine_have_its_harmonics(self):
        directions = np.radians(np.arange(5, 365, 10))
        density = 0.3 * (1 + 2 * 0.4 * np.cos(2 * (directions - 1.1)))
        bins = spectrum._direction_weights(directions) @ density / (2 * math.pi)
        expected = 0.3 * np.array([1, 0.4 * math.cos(2.2), 0.4 * math.sin(2.2)] + 10 * [0])
        np.testing.assert_allclose(bins, expected, atol=1e-15)

    def test_keep_the_harmonics_that_the_directions_resolve(self):
        for count, harmonics in ((8, 1), (12, 2), (24, 5), (36, 6), (72, 6)):
            weights = spectrum._direction_weights(np.linspace(0, 2 * np.pi, count, endpoint=False))
            self.assertEqual(weights.shape, (1 + 2 * harmonics, count))

    def test_give_the_ends_of_a_sector_the_weight_of_their_neighbours(self):
        widths = spectrum._widths(np.radians([0, 10, 20, 30, 40, 50, 60, 70]))
        np.testing.assert_allclose(widths, np.radians(10))


class Xarray(unittest.TestCase):
    def setUp(self):
        self.directions = np.arange(0, 360, 15.0)
        spread = 1 + 2 * 0.4 * np.cos(2 * np.radians(self.directions - 60))
        efth = np.array([0.1, 1.0, 0.2])[:, None] * spread / 360
        self.dataset = xarray.Dataset(
            {"efth": (("time", "freq", "dir"), efth[None]), "wspd": ("time", [6.0]), "wdir": ("time", [250.0])},
            {"freq": [0.05, 0.1, 0.3], "dir": self.directions, "time": [0]})

    def test_reads_a_spectrum_by_the_conventions_of_wavespectra(self):
        sea = albtpu.Sea.from_xarray(self.dataset)
        np.testing.assert_allclose(sea.waves.densities, [0.1, 1.0, 0.2])
        np.testing.assert_allclose(np.hypot(sea.waves.cosines[0], sea.waves.sines[0]), 0.4 * np.array([0.1, 1.0, 0.2]))
        self.assertAlmostEqual(math.atan2(sea.waves.sines[0][1], sea.waves.cosines[0][1]), math.radians(120))
        self.assertEqual((sea.wind_speed, sea.wind_from), (6, 250 * math.pi / 180))

    def test_says_what_is_wrong(self):
        two = xarray.concat([self.dataset, self.dataset], "time")
        for dataset, message in ((two, "select one time"), (self.dataset.drop_vars("efth"), "no variable efth")):
            with self.assertRaisesRegex(albtpu.ArgumentError, message):
                albtpu.Sea.from_xarray(dataset)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
