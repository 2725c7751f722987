"""A client written from the .proto files alone gets what stands in the table file.

Usage: python_client_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE PROTO_FOLDER
"""

import os
import subprocess
import sys
import tempfile
import unittest

import grpc
import h5py
import numpy as np
from scipy.interpolate import RegularGridInterpolator

from serving import PATIENCE, Server, connect, make_stubs

SERVE, SYNTHETIC_TABLE, PROTO_FOLDER = sys.argv[1:4]
make_stubs(*((PROTO_FOLDER, f"albtpu/v1/{name}.proto")
             for name in ("budget", "pulse", "sea", "table", "uncertainty", "uncertainty_service")))
from albtpu.v1 import uncertainty_pb2, uncertainty_service_pb2_grpc  # noqa: E402
from albtpu.v1 import uncertainty_service_pb2 as pb  # noqa: E402

AXES = ("wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth")
QUANTITIES = ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu", "bias_along_beam",
              "bias_vertical")
LOG_AXES = ("fetch", "footprint")
PULSES = 2000


def to_bytes(column):
    return np.asarray(column, "<f4").tobytes()


def to_floats(column):
    return np.frombuffer(column, "<f4")


class PythonClient(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        path = os.path.join(cls.folder.name, "survey.h5")
        subprocess.run([SYNTHETIC_TABLE, path], check=True)
        cls.file = h5py.File(path, "r")
        cls.addClassCleanup(cls.file.close)
        cls.server = Server(SERVE, "--tables", cls.folder.name)
        cls.addClassCleanup(cls.server.__exit__)
        channel = connect(cls.server.address)
        cls.addClassCleanup(channel.close)
        grpc.channel_ready_future(channel).result(PATIENCE)
        cls.stub = uncertainty_service_pb2_grpc.UncertaintyServiceStub(channel)
        cls.random = np.random.default_rng(1)

    def ask_columns(self, pulses, **options):
        request = pb.QueryColumnsRequest(options=pb.QueryOptions(**options))
        for axis, column in pulses.items():
            setattr(request.pulses, axis, to_bytes(column))
        return self.stub.QueryColumns(request, timeout=PATIENCE)

    def random_pulses(self):
        pulses = {}
        for axis in AXES:
            first, last = self.file[axis][0], self.file[axis][-1]
            scale = np.log if axis in LOG_AXES else np.array
            drawn = self.random.uniform(scale(first), scale(last), PULSES)
            drawn = (np.exp(drawn) if axis in LOG_AXES else drawn).astype("f4")
            pulses[axis] = np.clip(drawn, first, last)
        return pulses

    def test_gets_the_values_of_the_file_at_its_nodes_bit_by_bit(self):
        at = {axis: self.random.integers(len(self.file[axis]), size=PULSES) for axis in AXES}
        answer = self.ask_columns({axis: self.file[axis][:][at[axis]] for axis in AXES}, standard_errors=True)
        self.assertEqual(answer.pulse_count, PULSES)
        self.assertEqual(set(answer.outcomes), {uncertainty_pb2.OUTCOME_INTERPOLATED})
        for suffix, columns in (("", answer.sea_surface),
                                ("_standard_error", answer.sea_surface_standard_error)):
            for name in QUANTITIES:
                values = self.file[name + suffix][:]
                index = tuple(at[axis] for axis in AXES[:values.ndim])
                np.testing.assert_array_equal(to_floats(getattr(columns, name)), values[index], name + suffix)

    def test_gets_what_scipy_makes_of_the_file_between_nodes(self):
        pulses = self.random_pulses()
        answer = self.ask_columns(pulses)
        scaled = {axis: np.log if axis in LOG_AXES else np.array for axis in AXES}
        for name in QUANTITIES:
            values = self.file[name][:].astype(float)
            axes = AXES[:values.ndim]
            nodes = [scaled[axis](self.file[axis][:].astype(float)) for axis in axes]
            at = np.column_stack([scaled[axis](pulses[axis].astype(float)) for axis in axes])
            theirs = RegularGridInterpolator(nodes, values)(at)
            # Summed in double and rounded once to single precision: within 1e-5 of it, unless a bias cancels.
            cancelled = 1e-7 * np.abs(values).max()
            np.testing.assert_allclose(to_floats(getattr(answer.sea_surface, name)), theirs, rtol=1e-5,
                                       atol=cancelled, err_msg=name)

    def test_learns_the_axes_of_the_file(self):
        listed = self.stub.ListTables(pb.ListTablesRequest(), timeout=PATIENCE)
        self.assertEqual(listed.default_table, "survey")
        self.assertEqual([table.reference.name for table in listed.tables], ["survey"])
        table = self.stub.GetTable(pb.GetTableRequest(table="survey"), timeout=PATIENCE).table
        self.assertEqual(table.reference, listed.tables[0].reference)
        self.assertEqual(table.reference.digest, self.file.attrs["content_digest"].decode())
        self.assertEqual(tuple(axis.name for axis in table.axes), AXES)
        for axis in table.axes:
            np.testing.assert_array_equal(np.float32(axis.nodes), self.file[axis.name][:])
        self.assertEqual(tuple(quantity.name for quantity in table.quantities), QUANTITIES)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
