"""Tests albtpu-serve as a program: flags, exit codes, signals, health and reflection.

Usage: serve_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
"""

import fcntl
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import threading
import unittest

import grpc
import numpy as np

import albtpu
from albtpu.v1 import uncertainty_service_pb2 as pb
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from commands import run
from served import SERVE, TablesTest, budget, columns, make_table
from serving import PATIENCE, READY, Server, connect

PULSES = 65536
QUERIES = {"QueryColumns": columns([5] * PULSES), "QueryBudget": budget([5] * PULSES)}
# Messages of the protocols of health and of reflection, of which the package has no stubs.
HEALTH, SERVING = "/grpc.health.v1.Health/Check", b"\x08\x01"
REFLECTION = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo"
LIST_SERVICES, FILE_OF_SYMBOL = b"\x3a", b"\x22"  # Fields of a request: a text of a length in one byte follows.


class Flags(TablesTest):
    def test_that_are_invalid_are_usage_errors(self):
        self.assert_does_not_start(2, ["--nonsense"], "--nonsense")
        self.assert_does_not_start(2, ["--listen"], "--listen")
        self.assert_does_not_start(2, ["HOST:PORT"], "--listen", "50051")
        self.assert_does_not_start(2, ["word"], "word")

    def test_allow_plain_text_beyond_this_machine_only_with_insecure(self):
        self.assert_does_not_start(2, ["--insecure"], "--listen", "0.0.0.0:0")
        server = self.serve("--insecure", listen="0.0.0.0:0")
        self.assertTrue(server.address.startswith("0.0.0.0:"))

    def test_accept_localhost_and_ipv6_addresses(self):
        for host in filter(self.exists_on_this_machine, ("localhost", "::1")):
            host = f"[{host}]" if ":" in host else host
            server = self.serve(listen=host + ":0")
            with connect(server.address) as channel:
                health = channel.unary_unary(HEALTH)
                self.assertEqual(health(b"", timeout=PATIENCE, wait_for_ready=True), SERVING)

    @staticmethod
    def exists_on_this_machine(host):
        """Containers may lack IPv6, and a file system without /etc/hosts lacks the name localhost."""
        try:
            family, kind, _, _, address = socket.getaddrinfo(host, 0, type=socket.SOCK_STREAM)[0]
            with socket.socket(family, kind) as probe:
                probe.bind(address)
            return True
        except OSError:
            return False

    def test_print_version_and_help_to_standard_output(self):
        version = self.assert_succeeds(run(SERVE, "--version"))
        self.assertRegex(version, r"\Aalbtpu-serve \d+\.\d+\.\d+\S*\ncommit \S+\n(table|no tables).*\n")
        self.assertIn("--default-table", self.assert_succeeds(run(SERVE, "--help")))


class Tables(TablesTest):
    def test_are_counted_and_the_default_is_named(self):
        self.assertIn("1 table, default 'quick'", self.serve().lines[0])
        make_table(self.tables / "survey/1.h5")
        make_table(self.tables / "survey/2.h5")
        self.assertIn("3 tables, default 'survey/2'", self.serve().lines[0])
        self.assertIn("3 tables, default 'quick'", self.serve("--default-table", "quick").lines[0])
        make_table(self.tables / "slow.h5")
        (self.tables / "survey").rename(self.folder / "survey")
        self.assertIn("2 tables, no default", self.serve().lines[0])

    def test_must_exist_and_be_intact(self):
        self.assert_does_not_start(1, ["nowhere"], "--tables", self.folder / "nowhere")
        (self.folder / "empty").mkdir()
        self.assert_does_not_start(1, ["there is no table in"], "--tables", self.folder / "empty")
        self.assert_does_not_start(1, ["'slow'"], "--default-table", "slow")
        os.truncate(self.tables / "quick.h5", (self.tables / "quick.h5").stat().st_size - 1)
        self.assert_does_not_start(1, ["quick.h5"])

    def test_of_the_water_column_is_read_when_the_server_starts(self):
        def answer(server):
            request = budget([4, 8], ["BUDGET_QUANTITY_TVU_WATER"])
            request.water.CopyFrom(albtpu.Water(secchi=5, detector="half", field_of_view=8, pulse_length=2,
                                                bias="correct").message())
            return self.stub_of(server).QueryBudget(request)

        installed = answer(self.serve())
        self.assertTrue((np.frombuffer(installed.budget.tvu_water, "<f4") > 0).all())
        # As a table of another place would be, and in place of one that the environment names in vain.
        shipped = pathlib.Path(SERVE).parent.parent / "share/albtpu/water/water_column.h5"
        copy = shutil.copy(shipped.resolve(), self.folder / "water.h5")
        nowhere = {"ALBTPU_WATER_TABLE": str(self.folder / "none.h5")}
        self.assertEqual(answer(self.serve("--water-table", copy, environment=nowhere)), installed)
        self.assert_refused(run(SERVE, "--tables", self.tables, "--listen", "127.0.0.1:0", environment=nowhere), 1,
                            "no --water-table given", "none.h5")
        self.assert_does_not_start(1, ["--water-table", "quick.h5"], "--water-table", self.tables / "quick.h5")

    def test_of_the_water_column_may_be_missing(self):
        program = self.folder / "bin/albtpu-serve"
        program.parent.mkdir()
        shutil.copy(SERVE, program)  # Beside it is no share/albtpu.
        server = Server(program, "--tables", self.tables)
        self.addCleanup(server.__exit__)
        server.wait_for("no table of the water column")
        request = budget([4])
        request.water.CopyFrom(albtpu.Water(secchi=5, detector="half", field_of_view=8, pulse_length=2,
                                            bias="correct").message())
        with self.assertRaises(grpc.RpcError) as failed:
            self.stub_of(server).QueryBudget(request)
        self.assertEqual(failed.exception.code(), grpc.StatusCode.FAILED_PRECONDITION)
        self.assertIn("--water-table", failed.exception.details())
        request.ClearField("water")
        self.assertEqual(self.stub_of(server).QueryBudget(request).pulse_count, 1)


class Signals(TablesTest):
    def test_stop_the_server_with_success(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            server = self.serve()
            self.assertEqual(server.stop(number), 0)

    def test_let_calls_in_progress_finish(self):
        server = self.serve()
        clients = [BusyClient(server.address, method) for method in ("QueryColumns", "QueryBudget", "QueryColumns")]
        for client in clients:
            self.assertTrue(client.answered.wait(PATIENCE))
        self.assertEqual(server.stop(signal.SIGTERM), 0)
        for client in clients:
            client.thread.join(PATIENCE)
            # A call that reaches the server at the moment of the signal is cancelled.
            self.assertIn(client.failure.code(), (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED))

    def open_stream(self, server, requests):
        """An answer was received for the first of `requests`."""
        answers = self.stub_of(server).StreamColumns(requests, timeout=2 * PATIENCE, wait_for_ready=True)
        next(answers)
        return answers

    def test_let_streams_finish(self):
        """The connection closes with its last stream: the answers must have been read before."""
        server = self.serve()
        signalled = threading.Event()
        # Small answers, of which many are on their way when the stream ends, and large ones.
        clients = [StreamingClient(server.address, pulses, signalled) for pulses in (4096,) * 12 + (PULSES,) * 2]
        for client in clients:
            self.assertTrue(client.answered.wait(PATIENCE))
        server.process.send_signal(signal.SIGTERM)
        server.wait_for("draining")
        signalled.set()
        for client in clients:
            client.thread.join(PATIENCE)
            self.assertEqual((client.answers, client.code), (8, grpc.StatusCode.OK))
        self.assertEqual(server.process.wait(PATIENCE), 0)

    def test_do_not_wait_for_a_stream_that_does_not_end(self):
        server = self.serve()
        never = threading.Event()
        self.addCleanup(never.set)

        def requests():
            yield pb.StreamColumnsRequest(query=QUERIES["QueryColumns"])
            never.wait(2 * PATIENCE)

        answers = self.open_stream(server, requests())
        self.assertEqual(server.stop(signal.SIGTERM), 0)
        with self.assertRaises(grpc.RpcError) as failure:
            next(answers)
        self.assertIn(failure.exception.code(), (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED))

    def start_with_pipe(self):
        """A server whose log is a pipe: its process, the end to read from, and the first line."""
        reader, writer = os.pipe()
        process = subprocess.Popen([SERVE, "--tables", self.tables, "--listen", "127.0.0.1:0"], stderr=writer)
        os.close(writer)
        return process, reader, os.read(reader, 4096).decode()

    def test_work_when_nobody_reads_the_log(self):
        process, reader, line = self.start_with_pipe()
        self.assertIn("ready on", line)
        os.close(reader)
        process.terminate()
        self.assertEqual(process.wait(PATIENCE), 0)

    def test_and_calls_work_when_the_log_is_full(self):
        process, reader, line = self.start_with_pipe()
        address = READY.search(line)[1]
        lines = fcntl.fcntl(reader, fcntl.F_SETPIPE_SZ, 4096) // 50  # Lines are at least that long.
        with connect(address) as channel:
            stub = UncertaintyServiceStub(channel)
            for _ in range(lines):
                self.assertEqual(list(stub.StreamColumns(iter([]), timeout=PATIENCE)), [])
            os.read(reader, 4096)
            list(stub.StreamColumns(iter([]), timeout=PATIENCE))
        process.terminate()
        self.assertEqual(process.wait(PATIENCE), 0)
        with os.fdopen(reader) as log:
            self.assertRegex(log.read(),
                             r"albtpu-serve: \d+ lines were left out \(the reader of the log did not keep up\)\n")


class BusyClient:
    """Sends large batches, one after the other, until a call fails."""

    def __init__(self, address, method):
        self.address, self.method = address, method
        self.answered = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        with connect(self.address) as channel:
            call = getattr(UncertaintyServiceStub(channel), self.method)
            try:
                while True:
                    answer = call(QUERIES[self.method], timeout=PATIENCE, wait_for_ready=False)
                    assert answer.pulse_count == PULSES
                    self.answered.set()
            except grpc.RpcError as failure:
                self.failure = failure


class StreamingClient:
    """Sends one batch on a connection of its own, and seven more after `signalled`."""

    def __init__(self, address, pulses, signalled):
        self.address, self.signalled = address, signalled
        self.request = pb.StreamColumnsRequest(query=columns([5] * pulses))
        self.answered, self.answers, self.code = threading.Event(), 0, None
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def requests(self):
        yield self.request
        self.signalled.wait(PATIENCE)
        for _ in range(7):
            yield self.request

    def run(self):
        with connect(self.address, own_connection=True) as channel:
            stream = UncertaintyServiceStub(channel).StreamColumns(self.requests(), timeout=2 * PATIENCE)
            try:
                for _ in stream:
                    self.answers += 1
                    self.answered.set()
            except grpc.RpcError:
                pass  # Its code is kept.
            self.code = stream.code()


class Reflection(TablesTest):
    def ask(self, channel, field, text=""):
        request = field + bytes([len(text)]) + text.encode()
        reflect = channel.stream_stream(REFLECTION)
        return next(reflect(iter([request]), timeout=PATIENCE, wait_for_ready=True))

    def test_lists_and_describes_the_services(self):
        with connect(self.serve().address) as channel:
            listed = self.ask(channel, LIST_SERVICES)
            for service, methods in (("albtpu.v1.UncertaintyService", ("StreamColumns", "QueryBudget")),
                                     ("grpc.health.v1.Health", ("Check", "Watch"))):
                self.assertIn(service.encode(), listed)
                described = self.ask(channel, FILE_OF_SYMBOL, service)
                for name in (service.rpartition(".")[2], *methods):
                    self.assertIn(name.encode(), described)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
