"""The whole budget of pulses per second, by the Python package, through a service on the same machine.

Usage: python_budget.py ALBTPU_SERVE TABLES_FOLDER [MILLIONS_OF_PULSES]

A flight line: incidence, azimuths, depth and attitude of each pulse, all errors of the air side; THU and TVU, or all
quantities, in return. Prints medians and ranges.
"""

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
PULSES = int(float(sys.argv[3] if len(sys.argv) > 3 else 4) * 1e6)
REPETITIONS = 5
ERRORS = dict(position=(0.03, 0.03, 0.05), attitude=(0.0025, 0.0025, 0.005), boresight=(0.001, 0.001, 0.004),
              lever_arm=0.02, scan=0.001, time=1e-5, range_offset=0.01, bottom_range=0.025, surface_height=0.05,
              index=0.001)


def flight_line(count):
    i = np.arange(count)
    columns = dict(incidence=15 + 3 * np.sin(i / 500), azimuth=i * 0.9 % 360, depth=8 + 3 * np.sin(i / 2e4),
                   beam_azimuth=(i * 0.9 + 70) % 360)
    attitude = dict(roll=3 * np.sin(i / 3e3), pitch=2 + np.sin(i / 5e3), heading=30 + np.sin(i / 1e4))
    single = {name: column.astype(np.float32) for name, column in columns.items()}
    return dict(single, wind_speed=5.0, footprint=0.5, altitude=400.0, located="local", errors=ERRORS, datum=0.08,
                sea_axis=70, aircraft={name: column.astype(np.float32) for name, column in attitude.items()})


def main():
    line = flight_line(PULSES)
    with Server(SERVE, "--tables", TABLES) as server, albtpu.connect(server.address) as service:
        service.query_budget(**line)  # Not measured: the first call allocates memory.
        for name, quantities in (("THU and TVU", ("total_thu", "total_tvu")), ("all", albtpu.BUDGET_QUANTITIES)):
            rates = []
            for _ in range(REPETITIONS):
                begin = time.perf_counter()
                service.query_budget(**line, quantities=quantities)
                rates.append(PULSES / 1e6 / (time.perf_counter() - begin))
            print(f"{name}: {statistics.median(rates):.2f} ({min(rates):.2f} to {max(rates):.2f}) Mpulses/s")


if __name__ == "__main__":
    main()
