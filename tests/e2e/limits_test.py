"""Tests the limits of albtpu-serve, and how it reports errors in a request.

Usage: limits_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE ALBTPU_QUERY
"""

import pathlib
import re
import signal
import socket
import ssl
import sys
import threading
import unittest
from concurrent import futures

import grpc

from albtpu.connection import service_error
from albtpu.v1 import uncertainty_service_pb2 as pb
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from secured import SecurityTest
from serving import PATIENCE

REFLECTION_THREADS = 16  # Of limits.h.


class Limits(SecurityTest):
    def test_close_silent_connections(self):
        open_to_all, secure = self.serve().address, self.serve(*self.tls()).address
        context = ssl.create_default_context(cafile=self.ca)
        context.set_alpn_protocols(["h2"])

        def wait_for_the_end(address, handshake):
            host, port = address.split(":")
            with socket.create_connection((host, int(port)), PATIENCE) as plain:
                silent = context.wrap_socket(plain, server_hostname=host) if handshake else plain
                while silent.recv(4096):  # The server sends its settings first.
                    pass
                silent.close()

        with futures.ThreadPoolExecutor() as pool:
            list(pool.map(wait_for_the_end, (open_to_all, secure, secure), (False, False, True)))

    def test_close_connections_that_do_not_speak_http2(self):
        host, port = self.serve().address.split(":")
        with socket.create_connection((host, int(port)), PATIENCE) as browser:
            browser.sendall(b"GET / HTTP/1.1\r\nHost: there\r\n\r\n")
            while browser.recv(4096):
                pass

    def assert_call_fails(self, code, server, request, method="QueryColumns", **options):
        with grpc.insecure_channel(server.address, [("grpc.enable_http_proxy", 0)]) as channel:
            with self.assertRaises(grpc.RpcError) as failure:
                getattr(UncertaintyServiceStub(channel), method)(request, timeout=PATIENCE, **options)
            self.assertEqual(failure.exception.code(), code, failure.exception)
        return failure.exception

    def test_refuse_long_messages_and_metadata(self):
        server = self.serve()
        exhausted = grpc.StatusCode.RESOURCE_EXHAUSTED
        long = pb.QueryColumnsRequest(pulses=dict(depth=bytes(5 << 20)))
        self.assert_call_fails(exhausted, server, long)
        aircraft = pb.QueryBudgetRequest(aircraft=dict(roll=bytes(9 << 20)))
        self.assert_call_fails(exhausted, server, aircraft, "QueryBudget")
        short = pb.QueryColumnsRequest()
        self.assert_call_fails(exhausted, server, short, metadata=[("note", "x" * 20000)])
        self.assertEqual(server.stop(signal.SIGTERM), 0)

    def test_refuse_compressed_messages_without_decompressing_them(self):
        server = self.serve()

        def most_memory():  # kB
            status = pathlib.Path(f"/proc/{server.process.pid}/status").read_text()
            return int(re.search(r"VmHWM:\s+(\d+) kB", status)[1])

        before = most_memory()
        bomb = pb.QueryColumnsRequest(pulses=dict(depth=bytes(160 << 20)))
        failure = self.assert_call_fails(grpc.StatusCode.UNIMPLEMENTED, server, bomb,
                                      compression=grpc.Compression.Gzip)
        self.assertLess(most_memory() - before, 100 << 10, failure)

    def test_bound_the_threads_of_reflection(self):
        server, streams = self.serve(), 3 * REFLECTION_THREADS
        with grpc.insecure_channel(server.address, [("grpc.enable_http_proxy", 0)]) as channel:
            reflect = channel.stream_stream("/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo")
            ended = threading.Event()
            calls = [reflect(iter(ended.wait, True), timeout=PATIENCE) for _ in range(streams)]  # They send no request.
            refused = set()
            while len(refused) < streams - REFLECTION_THREADS:
                refused = {call for call in calls if not call.is_active()}
            self.assertEqual({call.code() for call in refused}, {grpc.StatusCode.RESOURCE_EXHAUSTED})
            for call in calls:
                call.cancel()
            ended.set()
        self.assertEqual(server.stop(signal.SIGTERM), 0)

    def test_repeat_only_a_short_part_of_a_request_in_errors(self):
        request = pb.QueryColumnsRequest(options=dict(table="ä" * 1_000_000))
        server = self.serve()
        budget = pb.QueryBudgetRequest(options=dict(table="ä" * 1_000_000, located=1))
        for long, method in ((request, "QueryColumns"), (budget, "QueryBudget")):
            failure = self.assert_call_fails(grpc.StatusCode.NOT_FOUND, server, long, method)
            self.assertLess(len(failure.details()), 2000)


class Errors(SecurityTest):
    def test_name_all_invalid_fields(self):
        request = pb.QueryColumnsRequest(
            pulses=dict(wind_speed=bytes(4), depth=bytes(12), incidence=bytes(8)))
        streamed = pb.StreamColumnsRequest(query=request)
        budget = pb.QueryBudgetRequest(options=dict(located=1), pulses=request.pulses,
                                       aircraft=dict(altitude=bytes(4), beam_azimuth=bytes(4)))
        with grpc.insecure_channel(self.serve().address, [("grpc.enable_http_proxy", 0)]) as channel:
            stub = UncertaintyServiceStub(channel)
            for call, path in (
                    (lambda: stub.QueryColumns(request, timeout=PATIENCE), "pulses."),
                    (lambda: stub.QueryBudget(budget, timeout=PATIENCE), "pulses."),
                    (lambda: next(stub.StreamColumns(iter([streamed]), timeout=PATIENCE)), "query.pulses.")):
                with self.assertRaises(grpc.RpcError) as failure:
                    call()
                self.assertEqual(failure.exception.code(), grpc.StatusCode.INVALID_ARGUMENT)
                text = str(service_error("there", failure.exception))
                self.assertIn("column 'incidence' has 2 numbers, column 'depth' has 3", text)
                self.assertIn(f"; {path}footprint: column 'footprint' is empty", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
