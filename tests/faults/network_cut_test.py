"""The network fails while a file is annotated. If it recovers, the output is the same; if not, there is one error and
no output.

Usage: network_cut_test.py NAME=PATH..., see programs.py
"""

import hashlib
import io
import pathlib
import tempfile
import threading
import time
import unittest

import albtpu
import faults
import many_files_e2e_test as many_files
import namespaces
import numpy as np
import programs
import serving

REASON = namespaces.enter()
SOME_WRITTEN = 1 << 20  # Bytes; more than a sanitizer writes when it starts, so that part of an answer is written.
SHORT = 5  # s; the length of an interruption that clients survive.
# s, from the interruption to the error: 30 until it is noticed, 13 of patience, 8 attempts of at most 5 to connect.
LONGEST = 100 * serving.ALLOWANCE


def digests_of(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir()}


class Python:
    """The Python client, in a thread: it repeats a query whose answers must all be the same."""

    def __init__(self, address, pulses):
        self.answer = self.failure = None
        self.begun, self.enough = threading.Event(), threading.Event()
        self.thread = threading.Thread(target=self._run, args=(address, pulses), daemon=True)
        self.thread.start()

    def _run(self, address, pulses):
        try:
            with albtpu.connect(address) as service:
                self.answer = service.query(**pulses)
                self.begun.set()
                while not self.enough.is_set():
                    again = service.query(**pulses)
                    for name in ("thu", "tvu", "outcomes"):
                        if getattr(again, name).tobytes() != getattr(self.answer, name).tobytes():
                            raise AssertionError(f"another answer has another {name}")
        except Exception as failure:  # Checked by the test.
            self.failure = failure

    def end(self, patience):
        self.enough.set()
        self.thread.join(patience)


class NetworkCut(faults.FaultTest):
    @classmethod
    def setUpClass(cls):
        if REASON:
            raise unittest.SkipTest(REASON)
        super().setUpClass()
        made = tempfile.TemporaryDirectory()
        cls.addClassCleanup(made.cleanup)
        cls.inputs = pathlib.Path(made.name)
        cls.las = many_files.repeat(programs.make_flight(cls.inputs / "flight.las"), cls.inputs / "long.las", 100)
        cls.csv = cls.inputs / "long.csv"
        cls.many = faults.random_pulses(150_000)
        rows = io.StringIO()
        np.savetxt(rows, np.column_stack(list(cls.many.values())).astype(float), "%.9g", ",")
        # Many more pulses than are queried ahead of the output.
        cls.csv.write_text(",".join(cls.many) + "\n" + 8 * rows.getvalue())
        cls.undisturbed = None

    def setUp(self):
        super().setUp()
        self.server = self.serve("--insecure", listen="0.0.0.0:0", prefix=("unshare", "--net"))
        self.wire = namespaces.Wire(self.server.process)
        self.addCleanup(self.wire.remove)
        self.address = f"{namespaces.THERE}:{self.server.address.rpartition(':')[2]}"

    def cut_in_the_middle(self, cut):
        """Starts a client of each kind, and calls `cut` when all of them are working."""
        self.out = self.folder / "out"
        self.out.mkdir()
        self.clients = [
            self.start_query("las", self.las, self.out / "out.las", "--server", self.address, *programs.FLAGS),
            self.start_query("csv", self.csv, self.out / "out.csv", "--server", self.address)]
        self.python = Python(self.address, self.many)
        self.addCleanup(self.python.end, serving.PATIENCE)
        self.assertTrue(self.python.begun.wait(serving.PATIENCE), self.python.failure)
        for client in self.clients:
            faults.wait_until(lambda: client.poll() is not None or (faults.written(client) or 0) > SOME_WRITTEN,
                              "answers are written")
        cut()
        self.cut_at = time.monotonic()
        self.assertEqual([client.poll() for client in self.clients], [None, None],
                         "a client finished before the network was cut")

    def assert_outputs_are_unaffected(self):
        for client in self.clients:
            errors = client.communicate(timeout=LONGEST)[1]
            self.assertEqual(client.returncode, 0, errors)
        self.python.end(LONGEST)
        self.assertFalse(self.python.thread.is_alive(), "the Python client hangs")
        self.assertIsNone(self.python.failure)
        digests, answers = self.without_server()
        self.assertEqual(digests_of(self.out), digests)
        answer = self.python.answer
        for was, is_ in zip(answers, (answer.thu, answer.tvu, answer.outcome.astype(str))):
            np.testing.assert_array_equal(is_, was)

    def without_server(self):
        """The digests of all files, and the answers to Python's query, by the table in process; computed once."""
        if self.undisturbed is None:
            table = ("--table", self.tables / "survey.h5")
            folder = self.inputs / "undisturbed"
            folder.mkdir()
            programs.query("las", self.las, folder / "out.las", *table, *programs.FLAGS, check=0)
            programs.query("csv", self.csv, folder / "out.csv", *table, check=0)
            type(self).undisturbed = digests_of(folder), self.answer_in_process(self.many)
        return self.undisturbed

    def assert_one_error_each(self):
        for client in self.clients:
            errors = client.communicate(timeout=LONGEST)[1]
            took = time.monotonic() - self.cut_at
            problems = [line for line in errors.splitlines() if f"server {self.address}" in line]
            print(f"after {took:.0f} s: {problems}")
            self.assertEqual(client.returncode, 1, errors)
            self.assertEqual(len(problems), 1, errors)
        self.python.thread.join(LONGEST)
        self.assertFalse(self.python.thread.is_alive(), "the Python client hangs")
        print(f"after {time.monotonic() - self.cut_at:.0f} s: {self.python.failure!r}")
        self.assertIsInstance(self.python.failure, albtpu.UnreachableError)
        self.assertLess(time.monotonic() - self.cut_at, LONGEST)
        self.assertEqual(list(self.out.iterdir()), [])

    def test_of_seconds_does_not_affect_outputs(self):
        self.cut_in_the_middle(self.wire.cut)
        time.sleep(SHORT)  # The interruption itself.
        self.wire.mend()
        self.assert_outputs_are_unaffected()

    def test_that_loses_packets_for_seconds_does_not_affect_outputs(self):
        self.cut_in_the_middle(self.wire.lose)
        time.sleep(SHORT)
        self.wire.find()
        self.assert_outputs_are_unaffected()

    def test_without_end_is_an_error(self):
        self.cut_in_the_middle(self.wire.cut)
        self.assert_one_error_each()

    def test_that_loses_packets_without_end_is_an_error(self):
        self.cut_in_the_middle(self.wire.lose)
        self.assert_one_error_each()


if __name__ == "__main__":
    programs.main()
