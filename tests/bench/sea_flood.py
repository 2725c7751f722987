"""Times of queries of a table while others flood the server with different seas, as a Markdown table.

Usage: sea_flood.py ALBTPU_SERVE TABLES_FOLDER [--seconds S] [--callers N]

Callers ask for seas that nobody asked for before, each for the next one as soon as it has an answer or a refusal.
Rounds with and without the flood alternate. `short` queries have one pulse and are answered at once, `long` ones 65 536
pulses and wait for a worker.
"""

import argparse
import collections
import contextlib
import itertools
import random
import subprocess
import sys
import threading
import time

import bench
import grpc
import numpy as np
from albtpu.v1 import sea_pb2, uncertainty_service_pb2 as pb
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from serving import Server, connect

ROUNDS, PAUSE = 4, 0.003  # s between queries: a caller that is no flood itself


def flood(address, callers):
    """Asks for new seas until killed; prints what became of them every half second."""
    counts, lock = collections.Counter(), threading.Lock()

    def call(seed):
        numbers = random.Random(seed)
        with connect(address) as channel:
            stub = UncertaintyServiceStub(channel)
            while True:
                waves = sea_pb2.WaveComponents(components=[dict(significant_wave_height=numbers.uniform(0.1, 2),
                                                                peak_period=numbers.uniform(3, 10))])
                sea = dict(components=waves, wind_speed=numbers.uniform(3, 12))
                try:
                    stub.QueryColumns(pb.QueryColumnsRequest(sea=sea, pulses=columns(1)))
                    code = "OK"
                except grpc.RpcError as error:
                    code = error.code().name
                with lock:
                    counts[code] += 1

    for seed in range(callers):
        threading.Thread(target=call, args=(seed,), daemon=True).start()
    while True:
        time.sleep(0.5)
        with lock:
            print(*itertools.chain.from_iterable(counts.items()), flush=True)


def columns(count):
    depth = np.linspace(1, 10, count, dtype="<f4").tobytes()
    one = {name: np.float32(value).tobytes() for name, value in dict(wind_speed=5, incidence=10, footprint=1).items()}
    return dict(one, depth=depth)


def latencies(stub, count, seconds):
    request, taken, end = pb.QueryColumnsRequest(pulses=columns(count)), [], time.monotonic() + seconds
    while (begin := time.monotonic()) < end:
        stub.QueryColumns(request)
        taken.append(time.monotonic() - begin)
        time.sleep(PAUSE)
    return taken


@contextlib.contextmanager
def flooding(options, address):
    """Yields a counter of what became of the seas, which is filled at the end."""
    counts = collections.Counter()
    command = [sys.executable, __file__, options.serve, options.tables, "--callers", str(options.callers), "--flood",
               address]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        process.stdout.readline()
        yield counts
        process.kill()
        words = process.stdout.read().split("\n")[-2].split()
        counts.update(dict(zip(words[::2], map(int, words[1::2]))))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("serve")
    parser.add_argument("tables")
    parser.add_argument("--seconds", type=float, default=3)
    parser.add_argument("--callers", type=int, default=24)
    parser.add_argument("--flood", metavar="ADDRESS", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.flood:
        flood(options.flood, options.callers)
    taken = {(kind, flooded): [] for kind in ("short", "long") for flooded in (False, True)}
    rounds = []
    with Server(options.serve, "--tables", options.tables) as server, connect(server.address) as channel:
        stub = UncertaintyServiceStub(channel)
        latencies(stub, 65536, 0.5)
        for flooded in (False, True) * ROUNDS:
            with contextlib.ExitStack() as stack:
                if flooded:
                    rounds.append(stack.enter_context(flooding(options, server.address)))
                for kind, count in (("short", 1), ("long", 65536)):
                    taken[kind, flooded] += latencies(stub, count, options.seconds)
    bench.print_table(("query", "p50", "p99", "p50, flooded", "p99, flooded"),
                      ((kind, *(f"{1e3 * np.percentile(taken[kind, flooded], percent):.2f} ms"
                                for flooded in (False, True) for percent in (50, 99))) for kind in ("short", "long")))
    print(f"\n{options.callers} callers: {dict(sum(rounds, collections.Counter()))}")


if __name__ == "__main__":
    main()
