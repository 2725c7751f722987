"""Tests albtpu-serve as a program: flags, exit codes, signals, health and reflection.

Usage: serve_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE PROTO_FOLDER
"""

import fcntl
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

import grpc
import numpy as np
from google.protobuf import descriptor_pb2

from serving import PATIENCE, READY, Server, connect, make_stubs

SERVE, SYNTHETIC_TABLE, PROTO_FOLDER = sys.argv[1:4]
STUBS = make_stubs(*((PROTO_FOLDER, f"albtpu/v1/{name}.proto")
                     for name in ("budget", "pulse", "sea", "table", "uncertainty", "uncertainty_service")),
                   (PROTO_FOLDER, "grpc/health/v1/health.proto"),
                   (os.path.dirname(os.path.abspath(__file__)), "reflection.proto"))
# The Python package of gRPC has the same name as the package of the health protocol, and hides it.
grpc.__path__.append(os.path.join(STUBS, "grpc"))
from grpc.health.v1 import health_pb2, health_pb2_grpc  # noqa: E402
from albtpu.v1 import uncertainty_service_pb2, uncertainty_service_pb2_grpc  # noqa: E402
import reflection_pb2  # noqa: E402
import reflection_pb2_grpc  # noqa: E402

SERVICE = "albtpu.v1.UncertaintyService"
SERVING = health_pb2.HealthCheckResponse.SERVING


class ServeTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.tables = os.path.join(self.folder, "tables")
        self.make_table("quick.h5")

    def make_table(self, name):
        path = os.path.join(self.tables, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        subprocess.run([SYNTHETIC_TABLE, path], check=True)

    def serve(self, *flags, **options):
        server = Server(SERVE, "--tables", self.tables, *flags, **options)
        self.addCleanup(server.__exit__)
        return server

    def assert_fails(self, exit_code, problem, *flags, program=SERVE, environment=None):
        result = subprocess.run([program, *flags], capture_output=True, text=True, timeout=PATIENCE,
                                env={**os.environ, **(environment or {})})
        self.assertEqual(result.returncode, exit_code, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\Aalbtpu-serve: [^\n]+\n\Z")
        self.assertIn(problem, result.stderr)


class Flags(ServeTest):
    def test_that_are_invalid_are_usage_errors(self):
        self.assert_fails(2, "--nonsense", "--nonsense")
        self.assert_fails(2, "--listen", "--listen")
        self.assert_fails(2, "HOST:PORT", "--tables", self.tables, "--listen", "50051")
        self.assert_fails(2, "word", "--tables", self.tables, "word")

    def test_allow_plain_text_beyond_this_machine_only_with_insecure(self):
        self.assert_fails(2, "--insecure", "--tables", self.tables, "--listen", "0.0.0.0:0")
        server = self.serve("--insecure", listen="0.0.0.0:0")
        self.assertTrue(server.address.startswith("0.0.0.0:"))

    def test_accept_localhost_and_ipv6_addresses(self):
        for host in filter(self.exists_on_this_machine, ("localhost", "::1")):
            host = f"[{host}]" if ":" in host else host
            server = self.serve(listen=host + ":0")
            with connect(server.address) as channel:
                self.assertEqual(check_health(channel, ""), SERVING)

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
        version = subprocess.run([SERVE, "--version"], capture_output=True, text=True, check=True)
        self.assertRegex(version.stdout, r"\Aalbtpu-serve \d+\.\d+\.\d+ \(\S+\)\n\Z")
        help_text = subprocess.run([SERVE, "--help"], capture_output=True, text=True, check=True)
        self.assertIn("--default-table", help_text.stdout)


class Tables(ServeTest):
    def test_are_counted_and_the_default_is_named(self):
        self.assertIn("1 table, default 'quick'", self.serve().lines[0])
        self.make_table("survey/1.h5")
        self.make_table("survey/2.h5")
        self.assertIn("3 tables, default 'survey/2'", self.serve().lines[0])
        self.assertIn("3 tables, default 'quick'", self.serve("--default-table", "quick").lines[0])

    def test_need_no_default(self):
        self.make_table("slow.h5")
        self.assertIn("2 tables, no default", self.serve().lines[0])

    def test_must_exist_and_be_intact(self):
        self.assert_fails(1, "nowhere", "--tables", os.path.join(self.folder, "nowhere"))
        os.mkdir(os.path.join(self.folder, "empty"))
        self.assert_fails(1, "there is no table in", "--tables", os.path.join(self.folder, "empty"))
        self.assert_fails(1, "'slow'", "--tables", self.tables, "--default-table", "slow")
        path = os.path.join(self.tables, "quick.h5")
        os.truncate(path, os.path.getsize(path) - 1)
        self.assert_fails(1, "quick.h5", "--tables", self.tables)


class Signals(ServeTest):
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

    def test_let_streams_finish(self):
        server = self.serve()
        request = uncertainty_service_pb2.StreamColumnsRequest(query=BusyClient.request())
        signalled = threading.Event()

        def requests():
            for i in range(8):
                yield request
                if i == 0:
                    signalled.wait(PATIENCE)

        with connect(server.address) as channel:
            stub = uncertainty_service_pb2_grpc.UncertaintyServiceStub(channel)
            answers = stub.StreamColumns(requests(), timeout=PATIENCE, wait_for_ready=True)
            next(answers)
            server.process.send_signal(signal.SIGTERM)
            server.wait_for("draining")
            signalled.set()
            self.assertEqual(len(list(answers)), 7)
        self.assertEqual(server.process.wait(PATIENCE), 0)

    def test_do_not_wait_for_a_stream_that_does_not_end(self):
        server = self.serve()
        request = uncertainty_service_pb2.StreamColumnsRequest(query=BusyClient.request())
        never = threading.Event()
        self.addCleanup(never.set)

        def requests():
            yield request
            never.wait(2 * PATIENCE)

        with connect(server.address) as channel:
            stub = uncertainty_service_pb2_grpc.UncertaintyServiceStub(channel)
            answers = stub.StreamColumns(requests(), timeout=2 * PATIENCE, wait_for_ready=True)
            next(answers)
            self.assertEqual(server.stop(signal.SIGTERM), 0)
            with self.assertRaises(grpc.RpcError) as failure:
                next(answers)
            self.assertIn(failure.exception.code(), (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED))

    def test_work_when_nobody_reads_the_log(self):
        reader, writer = os.pipe()
        process = subprocess.Popen([SERVE, "--tables", self.tables, "--listen", "127.0.0.1:0"], stderr=writer)
        os.close(writer)
        with os.fdopen(reader) as log:
            self.assertIn("ready on", log.readline())
        process.terminate()
        self.assertEqual(process.wait(PATIENCE), 0)

    def test_and_calls_work_when_the_log_is_full(self):
        reader, writer = os.pipe()
        process = subprocess.Popen([SERVE, "--tables", self.tables, "--listen", "127.0.0.1:0"], stderr=writer)
        os.close(writer)
        address = READY.search(os.read(reader, 4096).decode())[1]
        lines = fcntl.fcntl(reader, fcntl.F_SETPIPE_SZ, 4096) // 50  # Lines are at least that long.
        with connect(address) as channel:
            stub = uncertainty_service_pb2_grpc.UncertaintyServiceStub(channel)
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

    PULSES = 65536

    def __init__(self, address, method="QueryColumns"):
        self.address, self.method = address, method
        self.answered = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    @classmethod
    def request(cls):
        column = np.full(cls.PULSES, 5, "<f4").tobytes()
        return uncertainty_service_pb2.QueryColumnsRequest(pulses={
            "wind_speed": column, "incidence": column, "depth": column,
            "footprint": np.float32(1).tobytes()})

    def run(self):
        request = self.request()
        if self.method == "QueryBudget":
            request = uncertainty_service_pb2.QueryBudgetRequest(
                options={"located": "SURFACE_LOCATION_LEVEL"}, pulses=request.pulses,
                aircraft={"altitude": np.float32(400).tobytes(), "beam_azimuth": np.float32(90).tobytes()})
        with connect(self.address) as channel:
            stub = uncertainty_service_pb2_grpc.UncertaintyServiceStub(channel)
            try:
                while True:
                    answer = getattr(stub, self.method)(request, timeout=PATIENCE, wait_for_ready=False)
                    assert answer.pulse_count == self.PULSES
                    self.answered.set()
            except grpc.RpcError as failure:
                self.failure = failure


def check_health(channel, service):
    request = health_pb2.HealthCheckRequest(service=service)
    return health_pb2_grpc.HealthStub(channel).Check(request, timeout=PATIENCE, wait_for_ready=True).status


class Reflection(ServeTest):
    def ask(self, channel, **request):
        stub = reflection_pb2_grpc.ServerReflectionStub(channel)
        requests = iter([reflection_pb2.ServerReflectionRequest(**request)])
        return next(stub.ServerReflectionInfo(requests, timeout=PATIENCE, wait_for_ready=True))

    def test_lists_and_describes_the_services(self):
        with connect(self.serve().address) as channel:
            listed = self.ask(channel, list_services="").list_services_response.service
            self.assertLessEqual({SERVICE, "grpc.health.v1.Health"}, {service.name for service in listed})
            for name in (SERVICE, "grpc.health.v1.Health"):
                answer = self.ask(channel, file_containing_symbol=name).file_descriptor_response
                self.assertIn(name, set(self.services_of(answer.file_descriptor_proto)))

    @staticmethod
    def services_of(serialized_files):
        for serialized in serialized_files:
            file = descriptor_pb2.FileDescriptorProto.FromString(serialized)
            for service in file.service:
                yield f"{file.package}.{service.name}"


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
