"""Pulses per second of the Python package, from NumPy arrays through a service on the same machine: the sea surface of
queries, and the whole budget.

Usage: python_query.py ALBTPU_SERVE TABLES_FOLDER [MILLIONS_OF_PULSES]

Flight lines: of queries with constant wind, fetch and footprint, with incidence and depth of each pulse in scan order;
of the budget, of two fifths of the pulses, with incidence, azimuths, depth and attitude of each pulse and all errors of
the air side. Prints medians and ranges of interleaved repetitions, and the processor time of client and server per
million pulses.
"""

import statistics
import sys
import time

import bench  # Finds the modules of other folders.

import albtpu
import numpy as np
from serving import Server

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
ERRORS = dict(position=(0.03, 0.03, 0.05), attitude=(0.0025, 0.0025, 0.005), boresight=(0.001, 0.001, 0.004),
              lever_arm=0.02, scan=0.001, time=1e-5, range_offset=0.01, bottom_range=0.025, surface_height=0.05,
              index=0.001)


def line_of_budget(count):
    i = np.arange(count)
    columns = dict(incidence=15 + 3 * np.sin(i / 500), azimuth=i * 0.9 % 360, depth=8 + 3 * np.sin(i / 2e4),
                   beam_azimuth=(i * 0.9 + 70) % 360)
    attitude = dict(roll=3 * np.sin(i / 3e3), pitch=2 + np.sin(i / 5e3), heading=30 + np.sin(i / 1e4))
    single = {name: column.astype(np.float32) for name, column in columns.items()}
    return dict(single, wind_speed=5.0, footprint=0.5, altitude=400.0, located="local", errors=ERRORS, datum=0.08,
                sea_axis=70, aircraft={name: column.astype(np.float32) for name, column in attitude.items()})


def main():
    print(f"{PULSES / 1e6:g} million pulses      Mpulses/s (range)      s a million: client, server")
    with Server(SERVE, "--tables", TABLES) as server, albtpu.connect(server.address) as service:
        cases = {f"{name}, {dtype}": (service.query, PULSES, dict(options, **bench.flight_line(PULSES, dtype)))
                 for name, options in CASES.items() for dtype in ("float32", "float64")}
        line = line_of_budget(2 * PULSES // 5)
        for name, quantities in (("THU and TVU", ("total_thu", "total_tvu")), ("all", albtpu.BUDGET_QUANTITIES)):
            cases[f"budget, {name}"] = service.query_budget, 2 * PULSES // 5, dict(line, quantities=quantities)
        measured = {name: [] for name in cases}
        for first in ("all six quantities, float32", "budget, all"):
            cases[first][0](**cases[first][2])  # Not measured: the first call allocates memory.
        for _ in range(REPETITIONS):
            for name, (ask, _, query) in cases.items():
                before = time.perf_counter(), time.process_time(), bench.processor_seconds(server.process.pid)
                ask(**query)
                after = time.perf_counter(), time.process_time(), bench.processor_seconds(server.process.pid)
                measured[name].append([b - a for a, b in zip(before, after)])
    for name, runs in measured.items():
        wall, *processors = zip(*runs)
        pulses = cases[name][1]
        rates = [pulses / 1e6 / seconds for seconds in wall]
        client, serving = (statistics.median(seconds) * 1e6 / pulses for seconds in processors)
        print(f"{name:42} {statistics.median(rates):5.1f} ({min(rates):.1f} to {max(rates):.1f})"
              f"   {client:.3f} {serving:.3f}")


if __name__ == "__main__":
    main()
