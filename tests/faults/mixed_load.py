"""Puts all kinds of load on a server at once, for any length of time; its answers stay correct and its memory flat.

Usage: mixed_load.py query=PATH serve=PATH synthetic_table=PATH simulated_flight=PATH [--minutes N]

At the same time: files are annotated, some by clients that are killed and resumed; arrays, single pulses, whole budgets
with and without a water column, and pulses on seas are queried; requests are invalid; streams are cancelled or never
read; connections are silent or do not speak HTTP/2; tables are replaced. Every answer is compared with that of the
table file, budgets with that of the server at rest. Prints what was done, and a straight line through the resident
memory of the server after a tenth of the time. From 10 minutes on, a line that rises by more than 5 % is a failure. At
rest, the load has paused and the server has given back its free memory; some MiB of what remains are caches of threads
that come and go. Seeds are fixed, so that only timing differs between runs.
"""

import argparse
import itertools
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import types

import grpc
import numpy as np

import albtpu
from albtpu.v1 import uncertainty_service_pb2 as pb
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub

from serving import PATIENCE, Server, connect

FLIGHT = ("--scanner", "across-track", "--water-level", "0", "--wind-speed", "5", "--footprint", "1")
MOST_GROWTH = 1.05
PAUSES = {"replace_table": 2, "silent_connections": 0.5, "strange_connections": 0.5, "invalid_requests": 0.1}  # s
SEAS, WATERS = 8, 8
FLAT_FROM = 10  # Minutes; a shorter run has too little load of each kind to judge whether memory is flat.
EARLY = 0.1  # Of the running time.
GIVEN_BACK = 10  # s; after this time the server has given back its free memory: service/allocator.cc.


class Wrong(Exception):
    """An answer that differs from that of the table, or an unexpected failure."""


def expect(good, *what):
    if not good:
        raise Wrong(*what)


class MixedLoad:
    """The load on a server. Each method without `_` is one kind of load and applies it once."""

    def __init__(self, programs, folder):
        self.programs, self.folder, self.numbers = programs, folder, itertools.count()
        self.tables = folder / "tables"
        self.tables.mkdir()
        for factor in (2, 3):
            self._run(programs.synthetic_table, folder / f"{factor}.h5", "--factor", factor)
        self._run(programs.synthetic_table, self.tables / "survey.h5")
        self._replace_table(2)
        self.flight = folder / "flight.las"
        self._run(programs.simulated_flight, self.flight)
        self.annotated = folder / "annotated.las"
        self._query("las", self.flight, self.annotated, "--table", self.tables / "survey.h5", *FLIGHT)
        random_numbers = np.random.default_rng(1)
        ranges = {"wind_speed": (3, 12), "incidence": (0, 25), "footprint": (0.5, 3), "depth": (0, 12)}
        self.pulses = {name: random_numbers.uniform(*ends, 200_000).astype(np.float32)
                       for name, ends in ranges.items()}
        with albtpu.open_table(self.tables / "survey.h5") as table:
            self.expected = table.query(**self.pulses)
        self.replacements = {}
        for factor in (2, 3):
            with albtpu.open_table(folder / f"{factor}.h5") as table:
                answer = table.query(**self._some(slice(0, 1000)))
                self.replacements[answer.table.digest] = answer
        self.server = Server(programs.serve, "--tables", self.tables)
        self.expected_budget = self._budget(self.pulses)
        self.expected_in_waters = [self._budget_in_water(i) for i in range(WATERS)]

    def file(self):
        self._annotate(self._output())

    def killed_client(self):
        output = self._output()
        command = [self.programs.query, "las", self.flight, output, "--server", self.server.address, *FLIGHT]
        process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
        time.sleep(random.Random(str(output)).uniform(0, 0.2))
        process.kill()
        process.wait()
        self._annotate(output, "--resume")

    def array(self):
        with albtpu.connect(self.server.address, patience=PATIENCE) as service:
            self._compare(service.query(**self.pulses), self.expected)

    def budget(self):
        self._compare_budgets(self._budget(self.pulses), self.expected_budget)

    def water(self):
        i = next(self.numbers) % WATERS
        self._compare_budgets(self._budget_in_water(i), self.expected_in_waters[i])

    def single_pulses(self):
        with connect(self.server.address) as channel:
            stub = UncertaintyServiceStub(channel)
            for i in range(100):
                pulse = {name: value[i] for name, value in self.pulses.items()}
                request = pb.QueryPulsesRequest(pulses=[pulse])
                row, = stub.QueryPulses(request, timeout=PATIENCE).uncertainties
                expect(row.outcome == self.expected.outcomes[i], "outcome", i, row)
                if row.outcome == 1:
                    np.testing.assert_allclose(row.sea_surface.thu, self.expected.thu[i], 2e-5, 1e-7)

    def table_under_replacement(self):
        with albtpu.connect(self.server.address, patience=PATIENCE) as service:
            answer = service.query(**self._some(slice(0, 1000)), table="spare")
            self._compare(answer, self.replacements[answer.table.digest])

    def sea(self):
        # Few seas: as many as are kept would fill the memory reserved for them, which is no growth.
        i = next(self.numbers) % SEAS
        sea = albtpu.Sea.jonswap(hs=0.2 + 0.1 * i, tp=4, waves_from=30 * i).with_wind(5)
        pulses = self._some(slice(0, 1000))
        with albtpu.connect(self.server.address, patience=PATIENCE) as service:
            self._compare(service.query(sea=sea, **pulses), sea.compile(service).query(**pulses))

    def replace_table(self):
        self._replace_table(2 + next(self.numbers) % 2)
        self.server.process.send_signal(signal.SIGHUP)

    def invalid_requests(self):
        with connect(self.server.address) as channel:
            stub = UncertaintyServiceStub(channel)
            for pulses in ({}, {"depth": b"123"}, {"depth": bytes(8), "wind_speed": bytes(12)},
                           {"depth": bytes(5 << 20)}):
                try:
                    stub.QueryColumns(pb.QueryColumnsRequest(pulses=pulses), timeout=PATIENCE)
                    raise Wrong("an invalid request was answered", pulses)
                except grpc.RpcError as error:
                    expect(error.code().name in ("INVALID_ARGUMENT", "RESOURCE_EXHAUSTED"), error)

    def cancelled_stream(self):
        with connect(self.server.address) as channel:
            requests = itertools.repeat(self._request())
            stream = UncertaintyServiceStub(channel).StreamColumns(requests, timeout=PATIENCE)
            for _ in range(3):
                next(stream)
            stream.cancel()

    def unread_stream(self):
        with connect(self.server.address) as channel:
            stream = UncertaintyServiceStub(channel).StreamColumns(itertools.repeat(self._request()), timeout=2)
            expect(stream.code() == grpc.StatusCode.DEADLINE_EXCEEDED, stream.details())

    def silent_connections(self):
        self._talk([b""] * 50)

    def strange_connections(self):
        numbers = random.Random(next(self.numbers))
        self._talk([b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + numbers.randbytes(200) for _ in range(50)])

    def _budget(self, pulses, **more):
        errors = dict(position=(0.03, 0.03, 0.05), scan=0.001, bottom_range=0.025)
        with albtpu.connect(self.server.address, patience=PATIENCE) as service:
            return service.query_budget(**pulses, table="survey", altitude=400, beam_azimuth=90, located="local",
                                        errors=errors, aircraft=dict(roll=5), **more)

    def _budget_in_water(self, i):
        water = albtpu.Water(secchi=4 + i, detector="half", field_of_view=8, pulse_length=1.5, bias="none")
        return self._budget(self._some(slice(0, 1000)), water=water)

    @staticmethod
    def _compare_budgets(budget, expected):
        for name, column in expected.values.items():
            expect(budget.values[name].tobytes() == column.tobytes(), name)

    def _talk(self, messages):
        host, port = self.server.address.rsplit(":", 1)
        for message in messages:
            with socket.create_connection((host, int(port)), PATIENCE) as connection:
                connection.sendall(message)

    def _request(self):
        columns = {name: value[:20_000].tobytes() for name, value in self.pulses.items()}
        return pb.StreamColumnsRequest(query={"pulses": columns})

    def _some(self, part):
        return {name: value[part] for name, value in self.pulses.items()}

    @staticmethod
    def _compare(answer, expected):
        expect((answer.outcomes == expected.outcomes).all(), "outcomes")
        for name in ("thu", "tvu"):
            np.testing.assert_allclose(getattr(answer, name), getattr(expected, name), 2e-5, 1e-7, name)

    def _replace_table(self, factor):
        new = self.tables / "new"
        new.write_bytes((self.folder / f"{factor}.h5").read_bytes())
        os.replace(new, self.tables / "spare.h5")

    def _output(self):
        return self.folder / f"{next(self.numbers)}.las"

    def _annotate(self, output, *more):
        self._query("las", self.flight, output, "--server", self.server.address, *FLIGHT, *more)
        expect(output.read_bytes() == self.annotated.read_bytes(), "the bytes of the file differ")
        output.unlink()
        pathlib.Path(f"{output}.json").unlink()

    def _query(self, *arguments):
        self._run(self.programs.query, *arguments)

    @staticmethod
    def _run(*command):
        run = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        expect(run.returncode == 0, run.stderr)


class Run:
    """Repeats each kind of load in its own thread until the time is over or one of them fails."""

    def __init__(self, load, seconds, rests):
        self.load = load
        self.stop, self.going = threading.Event(), threading.Event()
        self.change, self.paused = threading.Condition(), 0
        self.counts, self.failures, self.memory, self.memory_at_rest = {}, [], [], []
        kinds = [name for name in vars(MixedLoad) if not name.startswith("_")]
        self.threads = [threading.Thread(target=self._repeat, args=(name,)) for name in kinds]
        self.going.set()
        for thread in self.threads:
            thread.start()
        for part in (EARLY, 1 - EARLY):
            end = time.monotonic() + part * seconds
            while time.monotonic() < end and not self.stop.wait(1):
                self.memory.append(self._resident_memory())
            if rests and not self.stop.is_set():
                self.memory_at_rest.append(self._rest())
        self.stop.set()
        self.going.set()
        for thread in self.threads:
            thread.join()

    def _repeat(self, name):
        count = 0
        try:
            while not self.stop.is_set():
                getattr(self.load, name)()
                count += 1
                self.stop.wait(PAUSES.get(name, 0))
                self._pause()
        except Exception as failure:  # Reported at the end.
            self.failures.append((name, count, failure))
            self.stop.set()
            with self.change:
                self.change.notify()
        self.counts[name] = count

    def _pause(self):
        """Waits while the load rests."""
        if self.going.is_set():
            return
        with self.change:
            self.paused += 1
            self.change.notify()
        self.going.wait()
        with self.change:
            self.paused -= 1

    def _rest(self):
        """MiB that the server keeps without load."""
        self.going.clear()
        with self.change:
            self.change.wait_for(lambda: self.paused == len(self.threads) or self.stop.is_set())
        self.stop.wait(GIVEN_BACK)
        memory = self._resident_memory()
        self.going.set()
        return memory

    def _resident_memory(self):
        pages = pathlib.Path(f"/proc/{self.load.server.process.pid}/statm").read_text().split()[1]
        return int(pages) * os.sysconf("SC_PAGE_SIZE") / 2**20

    def fitted_memory(self):
        """MiB at the ends of a straight line through all but the first tenth of the run."""
        memory = self.memory[round(EARLY * len(self.memory)):]
        if len(memory) < 2:
            return memory[0], memory[0]
        rise, start = np.polyfit(np.arange(len(memory)), memory, 1)
        return start, start + rise * (len(memory) - 1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", nargs="+", metavar="NAME=PATH")
    parser.add_argument("--minutes", type=float, default=0.15)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        programs = dict(program.split("=", 1) for program in arguments.programs)
        load = MixedLoad(types.SimpleNamespace(**programs), pathlib.Path(folder))
        with load.server:
            run = Run(load, 60 * arguments.minutes, rests=arguments.minutes >= FLAT_FROM)
            code = load.server.stop(signal.SIGTERM)
    for name, count, failure in run.failures:
        print(f"{name} failed in round {count + 1}: {failure!r}")
    for name, count in sorted(run.counts.items()):
        print(f"{name}: {count}")
    is_flat = True
    if run.memory:  # Empty if the run failed at once.
        early, late = run.fitted_memory()
        hours = (1 - EARLY) * arguments.minutes / 60
        print(f"resident memory under load, by a line through it: {early:.1f} MiB after "
              f"{EARLY * arguments.minutes:g} minutes, {late:.1f} MiB after {arguments.minutes:g} "
              f"({late / early - 1:+.1%}, {(late - early) / hours:+.2f} MiB an hour); "
              f"at most {max(run.memory):.1f} MiB")
        is_flat = arguments.minutes < FLAT_FROM or late <= MOST_GROWTH * early
    if len(run.memory_at_rest) == 2:
        early, late = run.memory_at_rest
        print(f"at rest: {early:.1f} MiB, then {late:.1f} MiB ({late / early - 1:+.1%})")
    sys.exit(0 if not run.failures and code == 0 and is_flat else 1)


if __name__ == "__main__":
    main()
