"""Tests that tables can be replaced under albtpu-serve without any effect on calls in progress.

Usage: reload_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE PROTO_FOLDER
"""

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

import grpc
import numpy as np

from serving import PATIENCE, Server, connect, make_stubs

SERVE, SYNTHETIC_TABLE, PROTO_FOLDER = sys.argv[1:4]
make_stubs(*((PROTO_FOLDER, f"albtpu/v1/{name}.proto")
             for name in ("budget", "pulse", "sea", "table", "uncertainty", "uncertainty_service", "admin_service")))
from albtpu.v1 import admin_service_pb2, admin_service_pb2_grpc  # noqa: E402
from albtpu.v1 import uncertainty_service_pb2_grpc  # noqa: E402
from albtpu.v1 import uncertainty_service_pb2 as pb  # noqa: E402

RELOADS = 100


def columns(count):
    """A request for `count` equal pulses."""
    return pb.QueryColumnsRequest(pulses={
        "wind_speed": np.full(count, 5, "<f4").tobytes(), "incidence": np.float32(10).tobytes(),
        "footprint": np.float32(1).tobytes(), "depth": np.float32(4).tobytes()})


def budget(count):
    """The same pulses, and the share of the sea surface in their budget."""
    return pb.QueryBudgetRequest(
        options={"located": "SURFACE_LOCATION_LEVEL"}, pulses=columns(count).pulses,
        quantities=["BUDGET_QUANTITY_THU_SEA"],
        aircraft={"altitude": np.float32(400).tobytes(), "beam_azimuth": np.float32(90).tobytes()})


def read_budget(answer):
    values = set(np.frombuffer(answer.budget.thu_sea, "<f4").tolist())
    assert len(values) == 1, f"one budget has answers from two tables: {values}"
    return answer.table.digest, values.pop()


def read(answer):
    """The digest, and the THU, which is the same for all pulses of an answer."""
    values = set(np.frombuffer(answer.sea_surface.thu, "<f4").tolist())
    assert len(values) == 1, f"one message has answers from two tables: {values}"
    return answer.table.digest, values.pop()


class ReloadTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.tables = os.path.join(self.folder, "tables")
        os.mkdir(self.tables)
        for factor in (1, 2, 3):
            subprocess.run([SYNTHETIC_TABLE, self.source_of(factor), "--factor", str(factor)], check=True)
        self.put(1)
        self.server = Server(SERVE, "--tables", self.tables)
        self.addCleanup(self.server.__exit__)
        channel = connect(self.server.address)
        self.addCleanup(channel.close)
        self.stub = uncertainty_service_pb2_grpc.UncertaintyServiceStub(channel)
        self.admin = admin_service_pb2_grpc.AdminServiceStub(channel)

    def source_of(self, factor):
        return os.path.join(self.folder, f"{factor}.h5")

    def put(self, factor, name="survey"):
        """Replaces the table `name` by that of `factor`, atomically."""
        path = os.path.join(self.tables, name + ".h5")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        shutil.copy(self.source_of(factor), path + ".new")
        os.replace(path + ".new", path)

    def reload(self):
        answer = self.admin.ReloadTables(admin_service_pb2.ReloadTablesRequest(), timeout=PATIENCE,
                                         wait_for_ready=True)
        return {table.name: admin_service_pb2.TableChange.Name(table.change).removeprefix("TABLE_CHANGE_")
                for table in answer.tables}

    def ask(self, table=""):
        request = columns(3)
        request.options.table = table
        return read(self.stub.QueryColumns(request, timeout=PATIENCE, wait_for_ready=True))


class Load:
    """Clients that send requests without pause until they are stopped."""

    def __init__(self, address):
        self.address = address
        self.stopping = threading.Event()
        self.answered, self.budgets = {}, {}
        self.failures = []
        self.calls = 0
        self.lock = threading.Lock()
        works = (self.ask_long, self.ask_budget, self.ask_short, self.stream)
        self.threads = [threading.Thread(target=self.run, args=(work,)) for work in works]
        for thread in self.threads:
            thread.start()

    def run(self, work):
        with connect(self.address) as channel:
            stub = uncertainty_service_pb2_grpc.UncertaintyServiceStub(channel)
            while not self.stopping.is_set():
                try:
                    work(stub)
                except (grpc.RpcError, AssertionError) as failure:
                    with self.lock:
                        self.failures.append(failure)

    def count(self, *answers):
        with self.lock:
            self.calls += 1
            for digest, thu in answers:
                self.answered.setdefault(digest, set()).add(thu)

    def ask_long(self, stub):
        self.count(read(stub.QueryColumns(columns(20000), timeout=PATIENCE, wait_for_ready=True)))

    def ask_budget(self, stub):
        digest, thu = read_budget(stub.QueryBudget(budget(20000), timeout=PATIENCE, wait_for_ready=True))
        with self.lock:
            self.calls += 1
            self.budgets.setdefault(digest, set()).add(thu)

    def ask_short(self, stub):
        self.count(read(stub.QueryColumns(columns(1), timeout=PATIENCE, wait_for_ready=True)))

    def stream(self, stub):
        requests = [pb.StreamColumnsRequest(query=columns(10000))] * 8
        answers = [read(message.answer)
                   for message in stub.StreamColumns(iter(requests), timeout=PATIENCE, wait_for_ready=True)]
        assert len(answers) == len(requests), f"{len(answers)} answers to {len(requests)} requests"
        assert len(set(answers)) == 1, f"a stream has answers from two tables: {set(answers)}"
        self.count(answers[0])

    def stop(self):
        self.stopping.set()
        for thread in self.threads:
            thread.join(2 * PATIENCE)


class Reloads(ReloadTest):
    def test_under_load_neither_fail_nor_mix_any_call(self):
        load = Load(self.server.address)
        self.addCleanup(load.stop)
        for i in range(RELOADS):
            self.put(2 - i % 2)
            if i % 2 == 0:
                self.server.process.send_signal(signal.SIGHUP)
                self.server.wait_for("tables reloaded", times=i + 1)
            else:
                self.assertEqual(self.reload(), {"survey": "LOADED"})
        load.stop()
        print(f"{RELOADS} reloads under {load.calls} calls, {len(load.failures)} failures")
        self.assertEqual(load.failures, [])
        self.assertGreater(load.calls, RELOADS)
        self.assertEqual([len(values) for values in load.answered.values()], [1, 1])
        self.assertEqual(load.budgets.keys(), load.answered.keys())
        for answered in (load.answered, load.budgets):
            (one,), (two,) = answered.values()
            self.assertAlmostEqual(max(one, two) / min(one, two), 2, places=5)

    def test_by_many_signals_do_no_harm(self):
        for _ in range(50):
            self.server.process.send_signal(signal.SIGHUP)
        self.put(3)
        self.server.process.send_signal(signal.SIGHUP)
        self.reload()
        self.assertEqual(len({self.ask() for _ in range(5)}), 1)
        self.assertEqual(self.server.stop(signal.SIGTERM), 0)


class Callers(ReloadTest):
    def test_on_other_machines_are_refused(self):
        address = self.address_of_this_machine()
        if address is None:
            self.skipTest("this machine has only loopback addresses")
        server = Server(SERVE, "--tables", self.tables, "--insecure", listen="0.0.0.0:0")
        self.addCleanup(server.__exit__)
        port = server.address.rpartition(":")[2]
        with connect(f"{address}:{port}") as channel, self.assertRaises(grpc.RpcError) as failure:
            admin_service_pb2_grpc.AdminServiceStub(channel).ReloadTables(
                admin_service_pb2.ReloadTablesRequest(), timeout=PATIENCE, wait_for_ready=True)
        self.assertEqual(failure.exception.code(), grpc.StatusCode.PERMISSION_DENIED)

    @staticmethod
    def address_of_this_machine():
        """An address that is not a loopback address, or None."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.connect(("192.0.2.1", 9))  # Sends nothing; 192.0.2.0/24 is for documentation (RFC 5737).
            except OSError:
                return None
            address = probe.getsockname()[0]
        return None if address.startswith(("127.", "0.")) else address


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
