"""Tests several servers behind one name: clients use them in turn, and a failing server costs a retry, never a pulse.

Usage: replicas_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE ALBTPU_QUERY
"""

import signal
import subprocess
import sys
import threading
import time
import unittest
import urllib.error

import names
import numpy as np

import albtpu
from commands import make_folder, run
from served import SERVE, make_table
from serving import PATIENCE, Server

NAME = "replicas.test"  # A domain reserved for tests (RFC 6761).
ADDRESSES = ("127.0.0.1", "127.0.0.2")
QUERY = sys.argv[3]
PULSES = 6_000_000  # A few tenths of a second from Python.
LINES = 1_000_000  # Some tenths of a second of CSV.


class Replica(Server):
    def __init__(self, tables, listen):
        super().__init__(SERVE, "--tables", tables, "--metrics", "127.0.0.1:0", listen=listen)

    def count(self, metric):
        """The sum of a metric over its labels."""
        lines = None
        while lines is None:  # A busy server may close the connection after a second, while we write or read.
            try:
                lines = self.metrics().splitlines()
            except ConnectionResetError:
                continue
            except urllib.error.URLError as error:
                if not isinstance(error.reason, (BrokenPipeError, ConnectionResetError)):
                    raise
        return sum(float(line.rpartition(" ")[2]) for line in lines if line.startswith((metric + "{", metric + " ")))

    def is_busy(self):
        return self.count("albtpu_calls_under_way") > 0 and self.count("albtpu_pulses_total") > 0


def depths(count):
    return np.linspace(0, 20, count, dtype=np.float32)


class Replicas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = make_folder(cls.addClassCleanup)
        make_table(cls.folder / "tables/quick.h5")
        (cls.folder / "in.csv").write_text("depth\n" + "".join(f"{depth:.3f}\n" for depth in depths(LINES // 10)) * 10)

    def setUp(self):
        self.replicas, port = [], 0
        for address in ADDRESSES:  # Both use the port that was free for the first.
            replica = Replica(self.folder / "tables", f"{address}:{port}")
            self.addCleanup(replica.__exit__)
            self.replicas.append(replica)
            port = replica.address.rpartition(":")[2]
        self.address = f"dns:///{NAME}:{port}"

    def busy_one(self):
        """A replica that has answered a part of the requests, but not all."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            for replica in self.replicas:
                if replica.is_busy():
                    return replica
        raise AssertionError("no replica is busy")

    def csv(self, output, *source):
        """A command that annotates the file."""
        return (QUERY, "csv", "in.csv", output, *source, "--wind-speed", "5", "--incidence", "10", "--footprint", "0.5",
                "--overwrite")

    def start(self, output):
        return subprocess.Popen(self.csv(output, "--server", self.address), cwd=self.folder, stderr=subprocess.PIPE,
                                text=True)

    def assert_written(self, client, output):
        said = client.communicate(timeout=PATIENCE)[1]
        self.assertEqual(client.returncode, 0, said)
        undisturbed = self.folder / "undisturbed.csv"
        if not undisturbed.exists():
            alone = run(*self.csv(undisturbed, "--table", "tables/quick.h5"), cwd=self.folder)
            self.assertEqual(alone.returncode, 0, alone.stderr)
        self.assertTrue((self.folder / output).read_bytes() == undisturbed.read_bytes())
        self.assertEqual((self.folder / output).read_bytes().count(b"\n"), LINES + 1)

    def test_share_the_work(self):
        self.assert_written(self.start("out.csv"), "out.csv")
        pulses = [replica.count("albtpu_pulses_total") for replica in self.replicas]
        self.assertEqual(sum(pulses), LINES)
        self.assertGreater(min(pulses), 0.2 * LINES)  # There are only a few chunks.

    def test_answer_each_pulse_of_a_file_once_when_one_is_killed(self):
        client = self.start("killed.csv")
        self.busy_one().stop(signal.SIGKILL)
        self.assertIsNone(client.poll(), "the client finished first")
        self.assert_written(client, "killed.csv")

    def test_answer_each_pulse_of_a_file_once_when_one_stops_responding(self):
        client = self.start("silent.csv")
        silent = self.busy_one()
        silent.process.send_signal(signal.SIGSTOP)  # Like a machine that has lost its network.
        self.assertIsNone(client.poll(), "the client finished first")
        self.assert_written(client, "silent.csv")
        silent.process.send_signal(signal.SIGCONT)

    def test_answer_each_pulse_of_arrays_once_when_one_is_killed(self):
        pulses = dict(wind_speed=5, incidence=10, footprint=0.5, depth=depths(PULSES))
        answers = []
        with albtpu.connect(self.address) as service:
            client = threading.Thread(target=lambda: answers.append(service.query(**pulses)))
            client.start()
            self.busy_one().stop(signal.SIGKILL)
            self.assertTrue(client.is_alive(), "the client finished first")
            client.join(PATIENCE)
            disturbed, = answers
            undisturbed = service.query(**pulses)
        self.assertEqual(disturbed.outcomes.size, PULSES)
        self.assertEqual(disturbed.outcomes.tobytes(), undisturbed.outcomes.tobytes())
        for name, values in undisturbed.values.items():
            self.assertTrue(np.array_equal(disturbed.values[name], values, equal_nan=True), name)


if __name__ == "__main__":
    names.give({NAME: ADDRESSES})
    unittest.main(argv=sys.argv[:1], verbosity=2)
