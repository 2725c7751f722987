"""Tests that tables can be replaced under albtpu-serve without any effect on calls in progress.

Usage: reload_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
"""

import os
import pathlib
import shutil
import signal
import socket
import sys
import threading
import unittest

import grpc
import numpy as np

import albtpu
from albtpu.v1 import admin_service_pb2, admin_service_pb2_grpc
from albtpu.v1 import uncertainty_service_pb2 as pb
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from served import SERVE, TablesTest, budget, columns, make_table
from serving import PATIENCE, connect

RELOADS = 100


def read(answer):
    """The digest, and the THU of an answer or of its share of the sea, which is the same for all its pulses."""
    column = answer.budget.thu_sea if hasattr(answer, "budget") else answer.sea_surface.thu
    values = set(np.frombuffer(column, "<f4").tolist())
    assert len(values) == 1, f"one message has answers from two tables: {values}"
    return answer.table.digest, values.pop()


class ReloadTest(TablesTest):
    def setUp(self):
        super().setUp()
        for factor in (1, 2, 3):
            make_table(self.folder / f"{factor}.h5", "--factor", str(factor))
        self.server = self.serve()
        self.stub = self.stub_of(self.server)

    def put(self, factor):
        """Replaces the table by that of `factor`, atomically."""
        shutil.copy(self.folder / f"{factor}.h5", self.folder / "new")
        os.replace(self.folder / "new", self.tables / "quick.h5")

    def reload(self, address=None):
        """What became of each table."""
        with connect(address or self.server.address) as channel:
            answer = admin_service_pb2_grpc.AdminServiceStub(channel).ReloadTables(
                admin_service_pb2.ReloadTablesRequest(), timeout=PATIENCE, wait_for_ready=True)
        return {table.name: admin_service_pb2.TableChange.Name(table.change).removeprefix("TABLE_CHANGE_")
                for table in answer.tables}

    def ask(self):
        return read(self.stub.QueryColumns(columns([4] * 3), timeout=PATIENCE, wait_for_ready=True))


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
            stub = UncertaintyServiceStub(channel)
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
        self.count(read(stub.QueryColumns(columns([4] * 20000), timeout=PATIENCE, wait_for_ready=True)))

    def ask_budget(self, stub):
        request = budget([4] * 20000, ["BUDGET_QUANTITY_THU_SEA"])
        digest, thu = read(stub.QueryBudget(request, timeout=PATIENCE, wait_for_ready=True))
        with self.lock:
            self.calls += 1
            self.budgets.setdefault(digest, set()).add(thu)

    def ask_short(self, stub):
        self.count(read(stub.QueryColumns(columns([4]), timeout=PATIENCE, wait_for_ready=True)))

    def stream(self, stub):
        requests = [pb.StreamColumnsRequest(query=columns([4] * 10000))] * 8
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
                self.assertEqual(self.reload(), {"quick": "LOADED"})
        load.stop()
        print(f"{RELOADS} reloads under {load.calls} calls, {len(load.failures)} failures")
        self.assertEqual(load.failures, [])
        self.assertGreater(load.calls, RELOADS)
        self.assertEqual([len(values) for values in load.answered.values()], [1, 1])
        self.assertEqual(load.budgets.keys(), load.answered.keys())
        for answered in (load.answered, load.budgets):
            (one,), (two,) = answered.values()
            # Tables are scaled to sea water, in which values twice as large are so but for the third order in slope.
            self.assertAlmostEqual(max(one, two) / min(one, two), 2, places=3)

    def test_by_many_signals_do_no_harm(self):
        for _ in range(50):
            self.server.process.send_signal(signal.SIGHUP)
        self.put(3)
        self.server.process.send_signal(signal.SIGHUP)
        self.reload()
        self.assertEqual(len({self.ask() for _ in range(5)}), 1)
        self.channel.close()  # An idle client takes five seconds to notice that its server stops.
        self.assertEqual(self.server.stop(signal.SIGTERM), 0)


class Water(ReloadTest):
    def test_is_read_again_and_a_damaged_file_changes_nothing(self):
        file = self.folder / "elsewhere" / "water.h5"
        file.parent.mkdir()
        shipped = pathlib.Path(SERVE).parent.parent / "share/albtpu/water/water_column.h5"
        shutil.copy(shipped.resolve(), file)
        address = self.serve("--water-table", file).address
        request = budget([4, 8], ["BUDGET_QUANTITY_TVU_WATER"])
        request.water.CopyFrom(albtpu.Water(secchi=5, detector="half", field_of_view=8, pulse_length=2,
                                            bias="correct").message())
        with connect(address) as channel:
            stub = UncertaintyServiceStub(channel)
            before = stub.QueryBudget(request, timeout=PATIENCE, wait_for_ready=True)
            self.reload(address)
            file.write_bytes(b"not a table")
            with self.assertRaises(grpc.RpcError) as failure:
                self.reload(address)
            self.assertEqual(failure.exception.code(), grpc.StatusCode.FAILED_PRECONDITION)
            self.assertIn("water.h5", failure.exception.details())
            self.assertNotIn(str(file.parent), failure.exception.details())  # Callers learn no path of the server.
            self.assertEqual(stub.QueryBudget(request, timeout=PATIENCE), before)
            shutil.copy(shipped.resolve(), file)
            self.reload(address)
            self.assertEqual(stub.QueryBudget(request, timeout=PATIENCE), before)


class Callers(ReloadTest):
    def test_on_other_machines_are_refused(self):
        address = self.address_of_this_machine()
        if address is None:
            self.skipTest("this machine has only loopback addresses")
        port = self.serve("--insecure", listen="0.0.0.0:0").address.rpartition(":")[2]
        with self.assertRaises(grpc.RpcError) as failure:
            self.reload(f"{address}:{port}")
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
