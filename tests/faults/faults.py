"""Shared by the tests of faults: a server to disturb, and a client that must not notice the fault.

The paths of the programs are the arguments of the test script, NAME=PATH; see programs.py.
"""

import contextlib
import pathlib
import re
import signal
import subprocess
import threading
import time
import urllib.request

import albtpu
import grpc
import numpy as np
import programs
import serving
from albtpu.v1 import uncertainty_service_pb2 as wire
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub

SEED = 20240501
AXES = ("wind_speed", "incidence", "footprint", "depth")


def memory(process, what="VmRSS"):
    """Resident memory of a process in bytes; with "VmHWM", its peak. For a sanitized process, without the overhead."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return (int(re.search(rf"{what}:\s+(\d+) kB", status)[1]) << 10) // serving.ALLOWANCE


def written(process):
    """Bytes that a running process has passed to write(); None if it has ended."""
    if process.poll() is not None:
        return None
    try:
        return int(re.search(r"wchar: (\d+)", pathlib.Path(f"/proc/{process.pid}/io").read_text())[1])
    except (FileNotFoundError, ProcessLookupError, TypeError):
        return None


def compress(las):
    """The LAZ file of a LAS file."""
    return programs.laz_copy(las, las.with_suffix(".laz"))


def wait_until(holds, what, patience=serving.PATIENCE):
    end = time.monotonic() + patience
    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"did not happen within {patience} s: {what}")
        time.sleep(0.002)


def random_pulses(count, seed=SEED):
    """Pulses in the synthetic table, a third of them outside: a run in which most have no number would fail."""
    ranges = np.float32([[4, 11], [5, 22], [0.3, 1.2], [1, 26]])
    share = np.random.default_rng(seed).random((4, count), np.float32)
    return dict(zip(AXES, ranges[:, :1] + share * (ranges[:, 1:] - ranges[:, :1])))


class FaultTest(programs.Test):
    """A test with a folder `tables` that has one table, and with the answers of that table in process."""

    def setUp(self):
        super().setUp()
        self.tables = self.folder / "tables"
        self.tables.mkdir()
        programs.make_table(self.tables / "survey.h5")
        self.pulses = random_pulses(500)
        self.expected = self.answer_in_process(self.pulses)

    def answer_in_process(self, pulses):
        """THU, TVU and outcomes from `albtpu-query csv --table`; its nine digits read back to the same float32."""
        source, target = self.folder / "pulses.csv", self.folder / "answers.csv"
        rows = np.column_stack([pulses[axis] for axis in AXES]).astype(float)
        np.savetxt(source, rows, "%.9g", ",", header=",".join(AXES), comments="")
        programs.query("csv", source, target, "--table", self.tables / "survey.h5", "--coverage", "2sigma",
                       "--overwrite", check=0)
        cells = np.genfromtxt(target, delimiter=",", names=True, dtype=None, encoding="ascii")
        return [cells["thu"].astype(np.float32), cells["tvu"].astype(np.float32), cells["outcome"].astype(str)]

    def serve(self, *flags, **options):
        server = serving.Server(programs.PATHS["serve"], "--tables", self.tables, *flags, **options)
        self.addCleanup(server.__exit__)
        return server

    def metric(self, server, sample):
        """A metric of a server that serves metrics; `sample` is its name and labels, as in the text format."""
        url = server.wait_for("metrics on").split()[-1]
        no_proxy = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with no_proxy.open(url, timeout=serving.PATIENCE) as answer:
            return float(re.search(rf"^{re.escape(sample)} (\S+)$", answer.read().decode(), re.MULTILINE)[1])

    def assert_answers(self, service):
        answer = service.query(**self.pulses)
        for was, is_ in zip(self.expected, (answer.thu, answer.tvu, answer.outcome.astype(str))):
            np.testing.assert_array_equal(is_, was)

    def assert_drains(self, server):
        """The server is healthy enough to stop properly."""
        self.assertEqual(server.stop(signal.SIGTERM), 0, server.lines)

    def start_query(self, *arguments):
        process = subprocess.Popen([programs.PATHS["query"], *map(str, arguments)], stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process


class Witness:
    """A client that queries without pause during a fault, alternately over an old and a new connection."""

    def __init__(self, test, address, patience=0.0):
        self.test, self.address, self.patience = test, address, patience  # patience in s, with a refusing server.
        self.answered, self.longest, self.failure = 0, 0.0, None
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def _run(self):
        try:
            with self.connect() as old:
                while not self._ended.wait(0.02) or self.answered == 0:
                    with self.connect() as new:
                        for service in (old, new):
                            begin = time.monotonic()
                            self.query(service)
                            self.longest = max(self.longest, time.monotonic() - begin)
                            self.answered += 1
        except Exception as failure:  # Reported by __exit__, in the thread of the test.
            self.failure = failure

    def connect(self):
        return albtpu.connect(self.address, patience=self.patience, timeout=serving.PATIENCE)

    def query(self, service):
        self.test.assert_answers(service)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, kind, *_):
        self._ended.set()
        self._thread.join(3 * serving.PATIENCE)
        if kind is None:
            if self.failure:
                raise self.failure
            self.test.assertGreater(self.answered, 0)
            print(f"meanwhile {self.answered} calls were answered, the longest in {self.longest:.2f} s")


class UnaryWitness(Witness):
    """Queries by unary calls, which are answered immediately and do not count towards the limit of long calls."""

    @contextlib.contextmanager
    def connect(self):
        options = [("grpc.enable_http_proxy", 0), ("grpc.use_local_subchannel_pool", 1)]
        with grpc.insecure_channel(self.address, options) as channel:
            yield UncertaintyServiceStub(channel)

    def query(self, service):
        pulses = {axis: column.tobytes() for axis, column in self.test.pulses.items()}
        answer = service.QueryColumns(wire.QueryColumnsRequest(pulses=pulses), timeout=serving.PATIENCE)
        for was, sea_surface in zip(self.test.expected, (answer.sea_surface.thu, answer.sea_surface.tvu)):
            np.testing.assert_array_equal(np.frombuffer(sea_surface, "<f4"), was)
