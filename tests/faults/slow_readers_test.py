"""Calls whose clients read slowly or not at all hold no more memory than limits.h allows, and end.

Usage: slow_readers_test.py NAME=PATH..., see programs.py
"""

import re
import time

import albtpu
import faults
import http2
import numpy as np
import programs
import serving
from albtpu.v1 import uncertainty_service_pb2 as wire

# From limits.h.
MAX_BULK_CALLS = 128
MAX_CALLS_PER_CONNECTION = 64
MAX_UNREAD_BYTES = 256 << 20
MAX_INLINE_BYTES = 192 << 10

# s, instead of 60; the server notices after at most twice this time.
MAX_STREAM_IDLE = min(60, 15 * serving.ALLOWANCE)
FLAGS = ("--metrics", "127.0.0.1:0", "--max-stream-idle", str(MAX_STREAM_IDLE))
READ_NOTHING, READ_A_BYTE_AT_A_TIME = 150, 100
PULSES = 6000  # Per request; two requests fit the server's initial window.
BYTES_READ = 20  # By each client that reads a byte at a time.
CONNECTION_BYTES = 64 << 10  # Memory of a connection on the server, without its messages.
OPEN_WINDOW = http2.settings(_4=2**31 - 1) + http2.window_update(0, 2**31 - 1 - 65535)


def query(pulses):
    """A QueryColumnsRequest with one column of pulses and all options."""
    columns = {axis: np.float32(value).tobytes() for axis, value in
               (("wind_speed", 5), ("incidence", 10), ("footprint", 0.5))}
    columns["depth"] = np.linspace(1, 15, pulses, dtype=np.float32).tobytes()
    options = dict(standard_errors=True, best_s44_order=True, s44_order=1)
    return wire.QueryColumnsRequest(pulses=columns, options=options).SerializeToString()


def begin_stream(address, first, requests):
    connection = http2.Connection(address, http2.PREFACE + first)
    content = request()
    connection.socket.sendall(http2.call(1, b"StreamColumns") + requests * http2.message(1, content))
    return connection


def request():
    columns = wire.QueryColumnsRequest.FromString(query(PULSES))
    return wire.StreamColumnsRequest(query=columns).SerializeToString()


def data(got):
    """The part of a frame that belongs to the answers."""
    kind, _, stream, payload = got
    return payload if (kind, stream) == (http2.DATA, 1) else b""


def status(connection):
    """The gRPC status with which the server ended the stream; None if it reset the stream or closed the connection."""
    while got := connection.read():
        kind, flags, stream, payload = got
        if stream == 1 and kind == http2.RST_STREAM:
            return None
        if stream == 1 and flags & http2.END_STREAM:
            return int(re.search(rb"grpc-status.(\d+)", payload, re.DOTALL)[1])
    return None


class SilentCaller:
    """Makes as many unary calls as a connection may have, and reads no answer."""

    def __init__(self, address, content):
        self.connection = http2.Connection(address, http2.PREFACE + http2.settings(_4=0))
        self.connection.finish_handshake()
        self.ended = 0  # Calls that have ended.
        for i in range(MAX_CALLS_PER_CONNECTION):
            for got in self.connection.make_call(2 * i + 1, b"QueryColumns", content):
                self._take(got)

    def _take(self, got):
        kind, flags, _, _ = got
        self.ended += bool(kind == http2.HEADERS and flags & http2.END_STREAM)

    def read_to_the_end(self):
        while self.ended < MAX_CALLS_PER_CONNECTION:
            self._take(self.connection.read())


class SlowReaders(faults.FaultTest):
    def read_answer(self, address):
        """The answer as a client that reads receives it."""
        connection = begin_stream(address, OPEN_WINDOW, 1)
        answer = b""
        while len(answer) < 5 or len(answer) < 5 + int.from_bytes(answer[1:5], "big"):
            answer += data(connection.read())
        connection.close()
        return answer

    def begin(self, count, address, first):
        for _ in range(count):
            connection = begin_stream(address, first, 2)
            self.addCleanup(connection.close)
            yield connection

    def read_bytes(self, connection):
        """Reads BYTES_READ bytes, each when it has arrived."""
        read = b""
        while len(read) < BYTES_READ:
            connection.socket.sendall(http2.window_update(1, 1))
            had = len(read)
            while len(read) == had:
                read += data(connection.read())
        return read

    def test_hold_little_memory_and_end(self):
        server = self.serve(*FLAGS)
        answer, sent = self.read_answer(server.address), request()
        before = faults.memory(server.process)
        with faults.UnaryWitness(self, server.address):
            slow = list(self.begin(READ_A_BYTE_AT_A_TIME, server.address, http2.settings(_4=0)))
            for connection in slow:  # Each of them now counts towards MAX_BULK_CALLS.
                self.assertEqual(self.read_bytes(connection), answer[:BYTES_READ])
            began = time.monotonic()
            silent = [*self.begin(READ_NOTHING // 2, server.address, http2.settings(_4=0)),
                      *self.begin(READ_NOTHING // 2, server.address, OPEN_WINDOW)]
            under_way = 'albtpu_calls_under_way{method="StreamColumns"}'
            faults.wait_until(lambda: self.metric(server, under_way) == MAX_BULK_CALLS,
                              "the limit of long calls is reached")
            with albtpu.connect(server.address, patience=3 * MAX_STREAM_IDLE) as service:
                self.assert_answers(service)  # Also a stream, after others have ended.
            waited = time.monotonic() - began
            statuses = [status(connection) for connection in silent]
            for connection in slow:
                self.assertNotIn(status(connection), (0, 8))  # Neither completed nor refused.
        held = faults.memory(server.process, "VmHWM") - before
        bound = (MAX_BULK_CALLS * (2 * len(sent) + len(answer))
                 + (READ_NOTHING + READ_A_BYTE_AT_A_TIME) * CONNECTION_BYTES)
        refused = statuses.count(8)
        print(f"{held >> 10} KiB held (the messages are at most {bound >> 10}); {refused} streams refused; "
              f"another stream was accepted after {waited:.0f} s")
        self.assertEqual(refused, READ_NOTHING + READ_A_BYTE_AT_A_TIME - MAX_BULK_CALLS)
        self.assertLess(held, 2 * bound)  # Memory that is free in one arena of the allocator is not used by another.
        self.assertLess(waited, (2 * MAX_STREAM_IDLE + 10) * serving.ALLOWANCE)
        self.assert_drains(server)

    def query_and_read_nothing(self, server, content, connections):
        callers = []
        for _ in range(connections):
            callers.append(SilentCaller(server.address, content))
            self.addCleanup(callers[-1].connection.close)
        return callers

    def test_of_short_unary_calls_lose_their_answers(self):
        server, content = self.serve(*FLAGS), query(15000)
        self.assertLess(len(content), MAX_INLINE_BYTES)
        before = faults.memory(server.process)
        began = time.monotonic()
        with faults.Witness(self, server.address):
            callers = self.query_and_read_nothing(server, content, 16)  # A gigabyte of answers.
            for caller in callers:
                caller.read_to_the_end()
        waited = time.monotonic() - began
        held = faults.memory(server.process, "VmHWM") - before
        refused = self.metric(server, 'albtpu_calls_total{code="RESOURCE_EXHAUSTED",method="QueryColumns"}')
        dropped = self.metric(server, "albtpu_unread_answers_total")
        print(f"{held >> 20} MiB held; {refused:.0f} answers refused, {dropped:.0f} dropped, the last after "
              f"{waited:.0f} s")
        self.assertEqual(refused + dropped, len(callers) * MAX_CALLS_PER_CONNECTION)
        # On a busy machine gRPC frees some dropped answers only after others have taken their place.
        calls = len(callers) * MAX_CALLS_PER_CONNECTION
        self.assertLess(held, MAX_UNREAD_BYTES * 3 / 2 + calls * CONNECTION_BYTES)
        self.assertLess(waited, MAX_STREAM_IDLE + serving.PATIENCE)
        self.assert_drains(server)

    def test_of_long_unary_calls_make_room_for_others(self):
        server, content = self.serve(*FLAGS), query(60000)
        self.assertGreater(len(content), MAX_INLINE_BYTES)
        callers = self.query_and_read_nothing(server, content, MAX_BULK_CALLS // MAX_CALLS_PER_CONNECTION)
        answers = 'albtpu_answer_seconds_count{method="QueryColumns"}'  # They count as long calls until they are read.
        faults.wait_until(lambda: self.metric(server, answers) == MAX_BULK_CALLS, "the limit of long calls is reached")
        began = time.monotonic()
        with faults.UnaryWitness(self, server.address), \
                albtpu.connect(server.address, patience=3 * MAX_STREAM_IDLE) as service:
            self.assert_answers(service)  # In a stream, after others have ended.
        waited = time.monotonic() - began
        print(f"another stream was accepted after {waited:.0f} s")
        for caller in callers:
            caller.read_to_the_end()
        self.assertLess(waited, MAX_STREAM_IDLE + serving.PATIENCE)
        self.assert_drains(server)


if __name__ == "__main__":
    programs.main()
