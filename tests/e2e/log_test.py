"""Tests what albtpu-serve logs and what it does not.

Usage: log_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
"""

import collections
import json
import os
import signal
import sys
import unittest

import grpc

from albtpu.v1 import uncertainty_service_pb2 as pb
from served import TablesTest, columns
from serving import PATIENCE

ID = "survey-42.line_7"
PULSES = [5] * 4  # Their depths, m.


class Log(TablesTest):
    def start(self, *flags):
        self.server = self.serve(*flags)
        self.stub = self.stub_of(self.server)

    def request_missing_table(self, request_id):
        """Requests a table that does not exist; returns the id that the server gives the call."""
        with self.assertRaises(grpc.RpcError) as failure:
            self.stub.QueryColumns(columns(PULSES, table="nowhere"), timeout=PATIENCE, wait_for_ready=True,
                                   metadata=[("x-request-id", request_id)] if request_id else None)
        return dict(failure.exception.trailing_metadata())["x-request-id"]

    def stop(self):
        """Stops the server and returns the lines of its log."""
        self.channel.close()  # An idle client takes five seconds to notice that its server stops.
        self.assertEqual(self.server.stop(signal.SIGTERM), 0)
        self.server.wait_for("stopped")
        return self.server.lines

    def assert_limited(self, words):
        """Of the 1000 lines with these words that the calls make, the log has 100 a second."""
        lines = [line for line in map(json.loads, self.stop()) if words in line["message"]]
        self.assertGreater(len(lines), 0)
        self.assertLessEqual(sum(1 + line.get("lines_left_out", 0) for line in lines), 1000)
        per_second = collections.Counter(line["time"][:19] for line in lines)
        # A second as counted by the server may extend over two seconds of the clock.
        self.assertLessEqual(max(per_second.values()), 200)

    def test_is_json_on_request(self):
        self.start("--log-json")
        self.request_missing_table(ID)
        list(self.stub.StreamColumns(iter([pb.StreamColumnsRequest(query=columns(PULSES))] * 3), timeout=PATIENCE))
        os.truncate(self.tables / "quick.h5", 100)
        self.server.process.send_signal(signal.SIGHUP)
        self.server.wait_for("not reloaded")
        lines = [json.loads(line) for line in self.stop()]
        for line in lines:
            self.assertRegex(line["time"], r"\A\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z\Z")
        kinds = [(line["level"], line["message"].split()[0]) for line in lines]
        self.assertEqual(kinds, [("info", "ready"), ("info", "call"), ("info", "call"), ("error", "tables"),
                                 ("info", "draining"), ("info", "stopped")])
        failed, streamed = lines[1:3]
        self.assertEqual((failed["method"], failed["code"]), ("QueryColumns", "NOT_FOUND"))
        self.assertIn("'nowhere'", failed["message"])
        self.assertEqual((streamed["method"], streamed["code"], streamed["answers"], streamed["pulses"]),
                         ("StreamColumns", "OK", 3, 12))
        self.assertGreater(streamed["seconds"], 0)

    def test_contains_the_id_of_the_caller_or_a_generated_one(self):
        self.start("--log-json")
        self.assertEqual(self.request_missing_table(ID), ID)
        made = [self.request_missing_table(other) for other in ("", "a b", "x" * 65, "\"")]
        for request_id in made:
            self.assertRegex(request_id, r"\A[0-9a-f]{16}\Z")
        self.assertEqual(len(set(made)), len(made))
        lines = [json.loads(line) for line in self.stop()]
        logged = [line["request_id"] for line in lines if "request_id" in line]
        self.assertEqual(logged, [ID, *made])

    def test_omits_successful_calls(self):
        self.start()
        for _ in range(50):
            self.stub.QueryColumns(columns(PULSES), timeout=PATIENCE, wait_for_ready=True)
        self.assertEqual(len(self.stop()), 3)

    def test_cannot_be_flooded(self):
        self.start("--log-json")
        for _ in range(1000):
            self.request_missing_table("")
        self.assert_limited("call failed")

    def test_cannot_be_flooded_by_what_is_no_message(self):
        self.start("--log-json")
        call = self.channel.unary_unary("/albtpu.v1.UncertaintyService/QueryColumns")
        request = columns(PULSES, table="??").SerializeToString().replace(b"??", b"\xff\xff")  # No UTF-8.
        for _ in range(1000):
            with self.assertRaises(grpc.RpcError):
                call(request, timeout=PATIENCE, wait_for_ready=True)
        self.assert_limited("Protobuf: ")

    def test_is_plain_text_by_default(self):
        self.start()
        self.request_missing_table(ID)
        self.assertRegex(self.stop()[1], r"\Aalbtpu-serve: call failed: there is no table 'nowhere'.* "
                                         rf"\[request_id={ID} method=QueryColumns code=NOT_FOUND .*\]\Z")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
