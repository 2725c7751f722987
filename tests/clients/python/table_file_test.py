"""Queries of a table file.

Usage: table_file_test.py ALBTPU_SYNTHETIC_TABLE INTERPOLATE_RANDOM_PULSES
"""

import hashlib
import io
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np
from scipy.interpolate import RegularGridInterpolator

import albtpu
from commands import make_folder
from random_pulses import pulses_of_all_kinds

SYNTHETIC_TABLE, INTERPOLATE = sys.argv[1:3]
AXES = tuple(albtpu.AXES)
PULSE = dict(wind_speed=5, fetch=5000, incidence=10, azimuth=30, footprint=0.5, depth=8)


class TableFile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = make_folder(cls.addClassCleanup)
        cls.path = cls.make("synthetic.h5")
        cls.source = albtpu.open_table(cls.path)
        cls.table = cls.source.table()
        cls.file = h5py.File(cls.path)
        cls.addClassCleanup(cls.file.close)

    @classmethod
    def make(cls, name, *flags):
        subprocess.run([SYNTHETIC_TABLE, cls.folder / name, *flags], check=True)
        return cls.folder / name

    def test_returns_the_values_of_the_file_at_its_nodes_bit_by_bit(self):
        nodes = np.meshgrid(*(self.table.axes[axis].nodes for axis in AXES), indexing="ij", sparse=True)
        answer = self.source.query(**dict(zip(AXES, nodes)), standard_errors=True)
        self.assertTrue(answer.interpolated.all())
        for name in albtpu.QUANTITIES:
            for ours, dataset in ((answer.values, name), (answer.standard_errors, f"{name}_standard_error")):
                values = self.file[dataset][:]
                values = values if values.ndim == 6 else values[..., None]
                expected = np.broadcast_to(values, answer.outcomes.shape)
                np.testing.assert_array_equal(ours[name], expected, dataset)

    def test_agrees_with_scipy_between_nodes(self):
        random = np.random.default_rng(2)
        axes = self.table.axes
        pulses = {axis: np.clip(random.uniform(*nodes[[0, -1]], 2000).astype("f4"), *nodes[[0, -1]])
                  for axis, nodes in ((axis, axes[axis].nodes) for axis in AXES)}
        scaled = {axis: np.log if axes[axis].scale == "log" else np.positive for axis in AXES}
        answer = self.source.query(**pulses)
        for name in albtpu.QUANTITIES:
            values = self.file[name][:].astype(float)
            over = AXES[:values.ndim]
            nodes = [scaled[axis](axes[axis].nodes.astype(float)) for axis in over]
            at = np.column_stack([scaled[axis](pulses[axis].astype(float)) for axis in over])
            theirs = RegularGridInterpolator(nodes, values)(at)
            # Both sum in double precision; ours is then rounded to single precision.
            np.testing.assert_allclose(answer.values[name], theirs, rtol=1e-7, atol=1e-9, err_msg=name)

    def test_gives_the_same_answer_whether_or_not_a_column_is_constant(self):
        pulses = pulses_of_all_kinds(self.table, 500)
        for axis in AXES:
            nodes = self.table.axes[axis].nodes
            for number in (nodes[1] * 0.9, nodes[-1], np.nan, 1e9):
                once = self.source.query(**{**pulses, axis: number})
                # A column with two different numbers; the first 500 pulses have the first.
                repeated = {name: np.append(column, column[0]) for name, column in pulses.items()}
                repeated[axis] = np.append(np.full(500, number), 3.0)
                many = self.source.query(**repeated)
                np.testing.assert_array_equal(once.outcomes, many.outcomes[:500])
                np.testing.assert_array_equal(once.outcome_axes, many.outcome_axes[:500])
                np.testing.assert_allclose(once.thu, many.thu[:500], rtol=2e-7)

    def test_names_the_first_axis_that_caused_an_outcome(self):
        for changes, word in (({}, "INTERPOLATED"), ({"depth": 20.001}, "OUT_OF_DOMAIN:depth:above"),
                              ({"depth": -0.1, "wind_speed": 2.9}, "OUT_OF_DOMAIN:wind_speed:below"),
                              ({"wind_speed": 2.9, "depth": np.nan}, "INVALID"),
                              ({"fetch": np.inf}, "INTERPOLATED"), ({"fetch": -np.inf}, "INVALID"),
                              ({"fetch": 1e30}, "INTERPOLATED"), ({"fetch": 999.9}, "OUT_OF_DOMAIN:fetch:below"),
                              ({"azimuth": -100000.5}, "INTERPOLATED"), ({"azimuth": np.inf}, "INVALID"),
                              ({"footprint": 0}, "OUT_OF_DOMAIN:footprint:below"),
                              ({"incidence": -1}, "OUT_OF_DOMAIN:incidence:below")):
            answer = self.source.query(**{**PULSE, **changes})
            self.assertEqual(answer.outcome, word, changes)
            self.assertEqual(np.isnan(answer.thu), word != "INTERPOLATED", changes)
        answer = self.source.query(**{**PULSE, "wind_speed": 2.9, "depth": np.nan})
        self.assertEqual(list(albtpu.AXES)[answer.outcome_axes - 1], "depth")

    def test_folds_azimuths_by_the_symmetry_of_the_sea(self):
        azimuth = np.array([30, -30, 150, 210, 330, 390, -510])
        thu = self.source.query(**{**PULSE, "azimuth": azimuth}).thu
        np.testing.assert_array_equal(thu, np.full(7, thu[0]))

    def test_returns_the_larger_of_along_and_across_the_wind_without_azimuth(self):
        pulses = pulses_of_all_kinds(self.table, 2000, seed=3)
        del pulses["azimuth"]
        without = self.source.query(**pulses, standard_errors=True)
        self.assertTrue(without.azimuth_absent)
        along, across = (self.source.query(**pulses, azimuth=azimuth, standard_errors=True)
                         for azimuth in (0, 90))
        for name in albtpu.QUANTITIES:
            larger = np.abs(across.values[name]) > np.abs(along.values[name])
            for kind in ("values", "standard_errors"):
                expected = np.where(larger, getattr(across, kind)[name], getattr(along, kind)[name])
                np.testing.assert_array_equal(getattr(without, kind)[name], expected, f"{kind} {name}")

    def test_converts_to_95_per_cent(self):
        two_sigma, p95 = (self.source.query(**PULSE, coverage=coverage) for coverage in ("2sigma", "p95"))
        for name in ("tvu", "refraction_along_wind"):
            self.assertAlmostEqual(p95.values[name] / two_sigma.values[name], 0.979982, 6)
        self.assertTrue(0.865 < p95.thu / two_sigma.thu < 0.981)
        self.assertEqual(p95.bias_vertical, two_sigma.bias_vertical)

    def test_compares_with_the_limits_of_s44(self):
        answer = self.source.query(**{**PULSE, "depth": [8, 999]}, s44_order="1b", best_s44_order=True)
        p95 = self.source.query(**PULSE, coverage="p95")
        self.assertAlmostEqual(answer.remaining_thu[0], np.sqrt(5.4 ** 2 - p95.thu ** 2), 5)
        tvu_limit = np.hypot(0.5, 0.013 * 8)
        self.assertAlmostEqual(answer.remaining_tvu[0], np.sqrt(tvu_limit ** 2 - p95.tvu ** 2), 5)
        self.assertEqual(list(answer.best_s44_order), ["exclusive", ""])
        self.assertTrue(np.isnan(answer.remaining_thu[1]))

    def test_returns_nan_for_what_a_table_does_not_have(self):
        published = albtpu.open_table(self.make("published.h5", "--published"))
        self.assertNotIn("bias_vertical", published.table().quantities)
        answer = published.query(**PULSE, standard_errors=True)
        self.assertTrue(np.isnan(answer.bias_vertical) and np.isnan(answer.standard_errors["thu"]))
        self.assertFalse(np.isnan(answer.thu))

    def test_identifies_its_table(self):
        self.assertEqual(self.table.reference.name, "synthetic")
        self.assertEqual(self.table.reference.digest, self.file.attrs["content_digest"].decode())
        self.assertEqual(list(self.table.axes), list(AXES))

    def test_is_refused_if_it_is_damaged(self):
        whole = self.path.read_bytes()
        for content, problem in ((b"", "is empty"), (b"LAS", "does not begin with its seal"),
                                 (whole[:100], "is truncated: it has 100 bytes"), (whole[:-1], "is truncated"),
                                 (whole + b"\0", "is damaged: it has"), (whole[512:], "without the seal"),
                                 (whole[:8] + b"\2" + whole[9:], "has format version 2"),
                                 (whole[:9999] + b"?" + whole[10000:], "SHA-256")):
            path = self.folder / "broken.h5"
            path.write_bytes(content)
            with self.assertRaisesRegex(albtpu.TableFileError, f"broken.h5: .*{problem}"):
                albtpu.open_table(path)
        with self.assertRaisesRegex(albtpu.TableFileError, "nowhere.h5: No such file"):
            albtpu.open_table(self.folder / "nowhere.h5")

    def test_is_refused_if_it_violates_the_format(self):
        for change, problem in VIOLATIONS:
            path = self.folder / "changed.h5"
            shutil.copy(self.path, path)
            with h5py.File(path, "r+") as file:
                change(file)
            seal(path)
            with self.assertRaisesRegex(albtpu.TableFileError, f"changed.h5: .*{problem}"):
                albtpu.open_table(path)


def values(name, change):
    return lambda file: file[name].write_direct(np.ascontiguousarray(change(file[name][:])))


def attribute(of, name, value):
    return lambda file: file[of].attrs.create(name, value)


def stored(create, name="thu"):
    """The variable as `create(file, name, shape)` stores it."""
    def change(file):
        shape, attributes = file[name].shape, dict(units=file[name].attrs["units"], interpolation="linear")
        del file[name]
        create(file, name, shape)
        file[name].attrs.update(attributes)
    return change


def dataset(**options):
    return stored(lambda file, name, shape: file.create_dataset(name, dtype="<f4", **{"shape": shape, **options}))


def link(file):
    del file["thu"]
    file["thu"] = h5py.ExternalLink("/dev/zero", "/thu")


def virtual(file, name, shape):
    layout = h5py.VirtualLayout(shape, "<f4")
    layout[...] = h5py.VirtualSource("/dev/zero", name, shape)
    file.create_virtual_dataset(name, layout)


VIOLATIONS = (
    (lambda file: file.pop("thu"), "variable 'thu' is missing"),
    (link, "variable 'thu' is a link"),
    (dataset(external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)]), "variable 'thu' has its values in other files"),
    (stored(virtual), "variable 'thu' has its values in other files"),
    (dataset(chunks=True, scaleoffset=2), "variable 'thu' has filters other than"),
    (dataset(shape=(2**15, 2**14), chunks=(64, 64), compression="gzip"), "'thu' has 536870912 values: at most"),
    (values("depth", lambda nodes: nodes[::-1]), "axis 'depth' has nodes"),
    (values("thu", lambda thu: 0 * thu + 2e6), "above 1e"),
    (attribute("tvu", "units", "feet"), "'tvu' is in 'feet'"),
    (attribute("fetch", "interpolation", "cubic"), "'cubic'"),
    (attribute("/", "coverage", "1 sigma"), "'1 sigma'"),
    (attribute("/", "table_kind", "lake"), "is a table of kind 'lake': expected kind 'sea_surface' or 'one_sea'$"),
    (attribute("/", "table_kind", "sea_surface"), "'table_kind' is 'sea_surface': files of that kind do not have it$"),
    (attribute("/", "table_kind", 1), "attribute 'table_kind' of '/' is a number"))


class TableOfOneSea(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.path = make_folder(cls.addClassCleanup) / "sea.h5"
        subprocess.run([SYNTHETIC_TABLE, cls.path, "--sea"], check=True)
        cls.source = albtpu.open_table(cls.path)

    def test_names_its_kind(self):
        table = self.source.table()
        self.assertEqual(table.kind, "one_sea")
        self.assertNotIn("table_kind", table.attributes)
        self.assertIn("0 to 180", table.axes["azimuth"].long_name)

    def test_agrees_with_the_interpolation_of_the_library(self):
        csv = subprocess.check_output([INTERPOLATE, self.path, "3000"], text=True)
        theirs = np.genfromtxt(io.StringIO(csv), delimiter=",", names=True)
        answer = self.source.query(**{axis: theirs[axis] for axis in AXES}, standard_errors=True)
        self.assertTrue(answer.interpolated.all())
        for name in albtpu.QUANTITIES:
            np.testing.assert_allclose(answer.values[name], theirs[name], rtol=1e-5, atol=1e-9, err_msg=name)
            np.testing.assert_allclose(answer.standard_errors[name], theirs[f"{name}_standard_error"], rtol=1e-5,
                                       atol=1e-9, err_msg=name)

    def test_repeats_after_half_a_turn_and_has_no_mirror(self):
        thu = self.source.query(**{**PULSE, "azimuth": np.array([30, 210, -150, 390, -510])}).thu
        np.testing.assert_array_equal(thu, np.full(5, thu[0]))
        mirrored = self.source.query(**{**PULSE, "azimuth": np.array([-30, 150])}).thu
        self.assertEqual(mirrored[0], mirrored[1])
        self.assertNotEqual(mirrored[0], thu[0])

    def test_answers_at_any_wind_and_fetch(self):
        thu = self.source.query(**{**PULSE, "wind_speed": np.array([0, 6.5, 100, np.inf, -1, np.nan]),
                                   "fetch": np.array([1e-3, 0, 1e9, np.inf, -1, np.nan])}).thu
        np.testing.assert_array_equal(thu, np.full(6, thu[0]))
        self.assertFalse(np.isnan(thu[0]))

    def test_returns_the_worst_azimuth_without_one(self):
        pulse = {name: number for name, number in PULSE.items() if name != "azimuth"}
        for coverage in ("2sigma", "p95"):
            worst = self.source.query(**pulse, coverage=coverage)
            self.assertTrue(worst.azimuth_absent)
            at_nodes = self.source.query(**pulse, azimuth=self.source.table().axes["azimuth"].nodes, coverage=coverage)
            for name in albtpu.QUANTITIES:
                largest = at_nodes.values[name][np.abs(at_nodes.values[name]).argmax()]
                np.testing.assert_allclose(worst.values[name], largest, rtol=1e-6, err_msg=name)


def seal(path):
    """Renews the seal of a changed file, as specified in tables/FORMAT.md."""
    file = bytearray(path.read_bytes())
    file[16:24] = len(file).to_bytes(8, "little")
    file[24:56] = hashlib.sha256(file[:24] + file[56:]).digest()
    path.write_bytes(file)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
