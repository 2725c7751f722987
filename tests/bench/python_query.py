"""Pulses per second of the Python package, from NumPy arrays through a service on the same machine.

Usage: python_query.py ALBTPU_SERVE TABLES_FOLDER [MILLIONS_OF_PULSES]

A flight line: constant wind, fetch and footprint, with incidence and depth of each pulse in scan order. Prints medians
and ranges of interleaved repetitions, and the processor time of client and server per million pulses.
"""

import os
import pathlib
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("clients/python/src", "tests/e2e")]

import numpy as np  # noqa: E402

import albtpu  # noqa: E402
from serving import Server  # noqa: E402

SERVE, TABLES = sys.argv[1:3]
PULSES = int(float(sys.argv[3] if len(sys.argv) > 3 else 10) * 1e6)
REPETITIONS = 5
CASES = {
    "all six quantities": {"azimuth": 90.0},
    "THU and TVU": {"azimuth": 90.0, "quantities": ("thu", "tvu")},
    "THU and TVU, no azimuth": {"quantities": ("thu", "tvu")},
    "all, standard errors, 95 %, S-44": {"azimuth": 90.0, "standard_errors": True, "coverage": "p95",
                                         "best_s44_order": True, "s44_order": "1b"},
}


def flight_line(count, dtype):
    scan = np.abs(np.linspace(-20, 20, 5000))
    return dict(wind_speed=5.0, footprint=0.5, incidence=np.resize(scan, count).astype(dtype),
                depth=(5 + 4 * np.sin(np.linspace(0, 3000, count))).astype(dtype))


def processor_seconds(process):
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main():
    print(f"{PULSES / 1e6:g} million pulses      Mpulses/s (range)      s a million: client, server")
    with Server(SERVE, "--tables", TABLES) as server, albtpu.connect(server.address) as service:
        cases = {f"{name}, {dtype}": dict(options, **flight_line(PULSES, dtype))
                 for name, options in CASES.items() for dtype in ("float32", "float64")}
        measured = {name: [] for name in cases}
        service.query(**next(iter(cases.values())))  # Not measured: the first call allocates memory.
        for _ in range(REPETITIONS):
            for name, query in cases.items():
                before = time.perf_counter(), time.process_time(), processor_seconds(server.process.pid)
                service.query(**query)
                after = time.perf_counter(), time.process_time(), processor_seconds(server.process.pid)
                measured[name].append([b - a for a, b in zip(before, after)])
    for name, runs in measured.items():
        wall, *processors = zip(*runs)
        rates = [PULSES / 1e6 / seconds for seconds in wall]
        client, serving = (statistics.median(seconds) * 1e6 / PULSES for seconds in processors)
        print(f"{name:42} {statistics.median(rates):5.1f} ({min(rates):.1f} to {max(rates):.1f})"
              f"   {client:.3f} {serving:.3f}")


if __name__ == "__main__":
    main()
