"""The package gets the same answers from albtpu-serve as from the table file.

Usage: service_e2e_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE SHIPPED_TABLES...
"""

import pathlib
import shutil
import signal
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import albtpu
from albtpu.s44 import limits
from albtpu.calls import ColumnStream
from random_pulses import pulses_of_all_kinds
from served import SERVE, Served, make_table
from serving import Server

SHIPPED_TABLES = sys.argv[3:]
PULSES = 5_000
# Relative error of a sum in single precision; for biases, in which terms cancel, relative to the greatest value.
RELATIVE, CANCELLED = 1e-5, 1e-6
ORDER = "special"
# More batches than are in flight at a time.
LINE = dict(wind_speed=5, incidence=np.linspace(0, 20, 600_000), footprint=0.5,
            depth=np.linspace(20, 0, 600_000))


class Service(Served):
    FLAGS = ("--default-table", "synthetic")

    @classmethod
    def make_tables(cls):
        super().make_tables()
        make_table(cls.folder / "angles.h5", "--published")
        for table in SHIPPED_TABLES:
            shutil.copy(table, cls.folder)
        cls.files = {path.stem: albtpu.open_table(path) for path in sorted(cls.folder.glob("*.h5"))}

    def assert_alike(self, ours, theirs, what, ties=None):
        """`ties` marks, by quantity, the pulses whose standard error may be that at either azimuth."""
        self.assertEqual(ours.table, theirs.table)
        arrays = theirs.to_dict()
        self.assertEqual(list(ours.to_dict()), list(arrays))
        for name, array in ours.to_dict().items():
            message = f"{what}: {name}"
            expected = arrays[name]
            if name == "best_s44_orders":  # Where a value equals a limit up to rounding, either order is correct.
                self.assertLess(np.mean(array != expected), 1e-4, message)
            elif array.dtype == np.uint8:
                np.testing.assert_array_equal(array, expected, message)
            elif name.startswith("remaining"):  # sqrt(limit^2 - ours^2), where ours may almost equal the limit.
                limit = limits(ORDER, np.where(theirs.interpolated, theirs.pulses["depth"], 0))
                off = np.abs(array**2 - expected**2) > 2 * RELATIVE * limit[name.endswith("tvu")] ** 2
                self.assertFalse(off.any(), f"{message}: {array[off]} is not {expected[off]}")
                np.testing.assert_array_equal(np.isnan(array), np.isnan(expected), message)
            else:
                cancelled = CANCELLED * np.nan_to_num(np.abs(expected)).max() if "bias" in name else 0
                alike = np.isclose(array, expected, rtol=RELATIVE, atol=cancelled, equal_nan=True)
                if ties and name.endswith("_standard_error"):
                    alike |= ties[name.removesuffix("_standard_error")]
                self.assertTrue(alike.all(), f"{message}: {array[~alike]} is not {expected[~alike]}")

    def test_agrees_with_the_file(self):
        options = dict(standard_errors=True, best_s44_order=True, s44_order=ORDER)
        for name, file in self.files.items():
            pulses = pulses_of_all_kinds(file.table(), PULSES)
            for left_out in ((), ("azimuth",), ("fetch", "azimuth")):
                kept = {axis: column for axis, column in pulses.items() if axis not in left_out}
                ties = None if "azimuth" not in left_out else {
                    quantity: np.isclose(np.abs(along), np.abs(across), rtol=RELATIVE)
                    for quantity, along, across in zip(albtpu.QUANTITIES, *(
                        file.query(**kept, azimuth=azimuth).values.values() for azimuth in (0, 90)))}
                for coverage in ("2sigma", "p95"):
                    query = dict(**kept, **options, coverage=coverage)
                    self.assert_alike(self.service.query(**query, table=name), file.query(**query),
                                      f"{name} at {coverage} without {left_out}", ties)

    def test_has_the_bits_of_the_file_at_its_nodes(self):
        file, random = self.files["synthetic"], np.random.default_rng(1)
        nodes = {name: random.choice(axis.nodes, PULSES) for name, axis in file.table().axes.items()}
        ours, theirs = (source.query(**nodes, standard_errors=True) for source in (self.service, file))
        self.assertTrue(ours.interpolated.all())
        for name, array in theirs.to_dict().items():
            np.testing.assert_array_equal(ours.to_dict()[name], array, name)

    def test_agrees_with_the_file_for_constant_columns(self):
        file = self.files["synthetic"]
        pulses = pulses_of_all_kinds(file.table(), 3000, seed=5)
        for axis, number in (("wind_speed", 5), ("fetch", np.inf), ("depth", 21), ("footprint", np.nan)):
            query = {**pulses, axis: number}
            self.assert_alike(self.service.query(**query), file.query(**query), f"{axis} {number}")

    def test_agrees_with_the_file_in_any_water(self):
        for name in ("synthetic", "survey"):
            file = self.files[name]
            pulses = pulses_of_all_kinds(file.table(), 3000, seed=7)
            for index in (file.table().attributes["refractive_index"], 1.345, 1.36):
                query = dict(**pulses, refractive_index=index, standard_errors=True)
                self.assert_alike(self.service.query(**query, table=name), file.query(**query), f"{name} at {index}")
        with self.assertRaisesRegex(albtpu.ArgumentError, "1 to 2"):
            self.files["synthetic"].query(**pulses, refractive_index=3)

    def test_lists_and_describes_tables_as_the_files_do(self):
        listed = self.service.tables()
        self.assertEqual([table.reference for table in listed],
                         [file.table().reference for file in self.files.values()])
        self.assertEqual([table.reference.name for table in listed if table.is_default], ["synthetic"])
        for name, file in self.files.items():
            theirs, ours = self.service.table(name), file.table()
            for axis in albtpu.AXES:
                np.testing.assert_array_equal(theirs.axes[axis].nodes, ours.axes[axis].nodes)
                self.assertEqual(theirs.axes[axis][1:], ours.axes[axis][1:])
            self.assertEqual(list(theirs.quantities), list(ours.quantities))
            self.assertEqual([quantity[2:] for quantity in theirs.quantities.values()],
                             [quantity[2:] for quantity in ours.quantities.values()])
            self.assertEqual((theirs.title, theirs.campaign), (ours.title, ours.campaign))
            self.assertEqual(theirs.attributes, ours.attributes)

    def test_lists_the_tables_if_a_name_is_unknown(self):
        pulse = dict(wind_speed=5, incidence=10, footprint=0.5, depth=8)
        for call in (lambda: self.service.query(**pulse, table="nowhere"),
                    lambda: self.service.table("nowhere"),
                    lambda: self.service.query(**{**pulse, "depth": []}, table="nowhere")):
            with self.assertRaisesRegex(albtpu.TableNotFoundError, "synthetic"):
                call()

    def test_answers_a_query_without_pulses(self):
        answer = self.service.query(wind_speed=5, incidence=10, footprint=0.5, depth=np.empty((0, 3)))
        self.assertEqual(answer.thu.shape, (0, 3))
        self.assertEqual(answer.table, self.files["synthetic"].table().reference)

    def test_waits_for_a_server_to_restart(self):
        with Server(SERVE, "--tables", self.folder) as server:
            client = albtpu.connect(server.address, patience=60)
            self.addCleanup(client.close)
            self.assertEqual(len(client.tables()), len(self.files))
            server.stop(signal.SIGTERM)
        with Server(SERVE, "--tables", self.folder, listen=server.address):
            self.assertEqual(len(client.tables()), len(self.files))

    def query_while_the_server_is_replaced(self, *flags):
        """The answer to a query during which the server is replaced by one whose table was made with `flags`."""
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        table = pathlib.Path(folder, "synthetic.h5")
        make_table(table)
        servers = [Server(SERVE, "--tables", folder)]
        store, stored = ColumnStream._store, []

        def store_and_replace(stream, *answer):
            store(stream, *answer)
            stored.append(answer)
            if len(stored) == 2:
                servers[0].stop(signal.SIGKILL)
                make_table(table, *flags)
                servers.append(Server(SERVE, "--tables", folder, listen=servers[0].address))

        try:
            with albtpu.connect(servers[0].address, patience=60) as client:
                with mock.patch.object(ColumnStream, "_store", store_and_replace):
                    return client.query(**LINE)
        finally:
            for server in servers:
                server.__exit__()

    def test_continues_when_a_server_is_killed_and_restarted(self):
        answer = self.query_while_the_server_is_replaced()
        np.testing.assert_array_equal(answer.thu, self.service.query(**LINE).thu)

    def test_never_mixes_two_tables(self):
        with self.assertRaisesRegex(albtpu.TableChangedError, "changed from digest"):
            self.query_while_the_server_is_replaced("--factor", "2")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
