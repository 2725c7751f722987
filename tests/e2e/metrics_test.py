"""Tests the metrics of albtpu-serve as Prometheus receives them, and their use in docs/monitoring.

Tests that need promtool (Debian package prometheus) are skipped without it.

Usage: metrics_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
"""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import unittest
import urllib.error
import urllib.request

import grpc
import numpy as np

from albtpu.v1 import uncertainty_service_pb2 as pb
from served import TablesTest, budget, columns, make_table
from serving import PATIENCE

MONITORING = pathlib.Path(__file__).resolve().parents[2] / "docs/monitoring"
PROMTOOL = shutil.which("promtool")
SAMPLE = re.compile(r'(\w+)(?:\{(.*)\})? (\S+)')
needs_promtool = unittest.skipUnless(PROMTOOL, "promtool is missing; apt-get install prometheus")


class Metrics(TablesTest):
    def setUp(self):
        super().setUp()
        self.server = self.serve("--metrics", "127.0.0.1:0")
        self.stub = self.stub_of(self.server)

    def samples(self):
        """The samples by name and labels, as the server writes them."""
        lines = [line for line in self.server.metrics().splitlines() if line and not line.startswith("#")]
        matches = [SAMPLE.fullmatch(line) for line in lines]
        self.assertNotIn(None, matches)
        return {(match[1], frozenset(re.findall(r'(\w+)="(.*?)"', match[2] or ""))): float(match[3])
                for match in matches}

    def value(self, name, **labels):
        return self.samples()[name, frozenset(labels.items())]

    def ask(self, request):
        return self.stub.QueryColumns(request, timeout=PATIENCE, wait_for_ready=True)

    def ask_budget(self, depths, table=""):
        return self.stub.QueryBudget(budget(depths, table=table), timeout=PATIENCE, wait_for_ready=True)

    def test_count_calls_and_pulses_exactly(self):
        for _ in range(10):
            self.ask(columns([1, 2, 3]))
        self.ask(columns([1, -1, 1000, np.nan]))
        requests = [pb.StreamColumnsRequest(query=columns(np.full(20000, 2)))] * 3
        self.assertEqual(len(list(self.stub.StreamColumns(iter(requests), timeout=PATIENCE))), 3)
        with self.assertRaises(grpc.RpcError):
            self.ask(columns([1], table="nowhere"))
        pulse = dict(wind_speed=5, incidence=10, footprint=1, depth=5)
        rows = pb.QueryPulsesRequest(pulses=[pulse, {**pulse, "incidence": 89}, {**pulse, "wind_speed": np.inf}])
        self.stub.QueryPulses(rows, timeout=PATIENCE)
        self.ask_budget([1, 2, 1000, -1])
        self.ask_budget([3])
        with self.assertRaises(grpc.RpcError):
            self.ask_budget([1], table="nowhere")
        for outcome, axis, count in (("INTERPOLATED", "", 10 * 3 + 1 + 60000 + 1 + 3), ("OUT_OF_DOMAIN", "depth", 4),
                                     ("INVALID", "depth", 1), ("OUT_OF_DOMAIN", "incidence", 1),
                                     ("INVALID", "wind_speed", 1), ("OUT_OF_DOMAIN", "wind_speed", 0)):
            self.assertEqual(self.value("albtpu_pulses_total", outcome=outcome, axis=axis), count)
        for method, code, count in (("QueryColumns", "OK", 11), ("QueryColumns", "NOT_FOUND", 1),
                                    ("StreamColumns", "OK", 1), ("QueryPulses", "OK", 1), ("QueryBudget", "OK", 2),
                                    ("QueryBudget", "NOT_FOUND", 1)):
            self.assertEqual(self.value("albtpu_calls_total", method=method, code=code), count)
        for method, count, pulses in (("QueryColumns", 11, 34), ("StreamColumns", 3, 60000), ("QueryBudget", 2, 5)):
            self.assertEqual(self.value("albtpu_answer_pulses_count", method=method), count)
            self.assertEqual(self.value("albtpu_answer_pulses_sum", method=method), pulses)
            self.assertEqual(self.value("albtpu_answer_seconds_count", method=method), count)
            self.assertEqual(self.value("albtpu_calls_under_way", method=method), 0)

    def test_count_faults_from_zero(self):  # Prometheus sees no increase in a counter that appears at 1.
        for method in pb.DESCRIPTOR.services_by_name["UncertaintyService"].methods_by_name:
            for code in ("INTERNAL", "UNKNOWN", "DATA_LOSS", "RESOURCE_EXHAUSTED"):
                self.assertEqual(self.value("albtpu_calls_total", method=method, code=code), 0, method)

    def test_name_the_tables_in_use_and_count_reloads(self):
        def digest():
            (labels,) = [dict(labels) for name, labels in self.samples() if name == "albtpu_table_info"]
            self.assertEqual((labels["name"], labels["default"]), ("quick", "true"))
            return labels["digest"]
        self.assertEqual(digest(), self.ask(columns([1])).table.digest)
        make_table(self.tables / "quick.h5", "--factor", "2")
        self.server.process.send_signal(signal.SIGHUP)
        self.server.wait_for("tables reloaded")
        self.assertEqual(digest(), self.ask(columns([1])).table.digest)
        os.truncate(self.tables / "quick.h5", 10)
        self.server.process.send_signal(signal.SIGHUP)
        self.server.wait_for("tables not reloaded")
        self.assertEqual(self.value("albtpu_last_reload_successful"), 0)
        make_table(self.tables / "quick.h5", "--factor", "2")
        for times in (2, 3):
            self.server.process.send_signal(signal.SIGHUP)
            self.server.wait_for("tables reloaded", times)
        self.assertEqual(self.value("albtpu_last_reload_successful"), 1)
        for result, count in (("loaded", 2), ("refused", 1), ("unchanged", 1)):
            self.assertEqual(self.value("albtpu_reloads_total", result=result), count)

    def test_describe_the_process(self):
        with open(f"/proc/{self.server.process.pid}/statm") as file:
            resident = int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")
        self.assertLess(abs(self.value("process_resident_memory_bytes") / resident - 1), 0.2)
        descriptors = len(os.listdir(f"/proc/{self.server.process.pid}/fd"))
        self.assertLess(abs(self.value("process_open_fds") - descriptors), 5)
        self.assertGreater(self.value("process_cpu_seconds_total"), 0)

    def test_include_all_that_dashboard_and_alerts_use(self):
        self.ask(columns([1]))
        # The metrics of TLS exist only with TLS.
        known = {name for name, _ in self.samples()} | {"up", "albtpu_certificate_expiry_timestamp_seconds"}
        with open(MONITORING / "grafana.json") as file:
            panels = json.load(file)["panels"]
        used = "\n".join(target["expr"] for panel in panels for target in panel["targets"])
        used += (MONITORING / "alerts.yaml").read_text()
        names = set(re.findall(r"\b(?:albtpu|process)_[a-z_]+\b(?=[{\[) ]| ==)", used))
        self.assertGreater(len(names), 10)
        self.assertLessEqual(names, known)
        page = (MONITORING / "README.md").read_text()
        for name in {re.sub("_(bucket|sum|count)$", "", name) for name in known if name.startswith("albtpu")}:
            self.assertIn(f"`{name}`", page)

    @needs_promtool
    def test_have_the_format_that_prometheus_expects(self):
        self.ask(columns([1]))
        check = subprocess.run([PROMTOOL, "check", "metrics"], input=self.server.metrics(), capture_output=True,
                               text=True)
        self.assertEqual((check.returncode, check.stderr), (0, ""))

    @needs_promtool
    def test_have_alert_rules_that_fire_when_they_should(self):
        for flags in (("check", "rules", "alerts.yaml"), ("test", "rules", "alerts_test.yaml")):
            check = subprocess.run([PROMTOOL, *flags], cwd=MONITORING, capture_output=True, text=True)
            self.assertEqual(check.returncode, 0, check.stdout + check.stderr)

    def test_are_compared_with_the_limit_of_the_server(self):
        limits = (MONITORING.parents[1] / "service/server/ground/limits.h").read_text()
        most = sum(int(re.search(rf"int {name} = (\d+);", limits)[1])
                   for name in ("kMaxConnections", "kOwnDescriptors"))
        self.assertIn(f'clamp_max(process_max_fds{{job="albtpu"}}, {most})', (MONITORING / "alerts.yaml").read_text())

    def test_are_at_one_path_alone(self):
        address = self.server.wait_for("metrics on").removesuffix("/metrics").rpartition("/")[2]
        urllib.request.urlopen(f"http://{address}/metrics", timeout=PATIENCE).close()
        for path in ("/metricsx", "/metrics/calls", "/"):
            with self.subTest(path), self.assertRaisesRegex(urllib.error.HTTPError, "404"):
                urllib.request.urlopen(f"http://{address}{path}", timeout=PATIENCE)

    def test_need_a_free_address_on_this_machine(self):
        taken = self.server.wait_for("metrics on").removesuffix("/metrics").rpartition("/")[2]
        for address, code, problem in ((taken, 1, "Address already in use"), ("0.0.0.0:0", 2, "--metrics"),
                                       ("9464", 2, "--metrics")):
            self.assert_does_not_start(code, [problem], "--metrics", address)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
