"""Simulates the replicas, bandwidth and cost of a service for the surveys of a company, a nation, the world.

Usage: capacity.py            prints a Markdown table, the same in every run

In the busiest hour, surveys arrive at random. Each is a file of lognormal size and comes over its client's own line.
Clients alternate between the replicas message by message, so the replicas are one pool of processors and network that
all active surveys share equally; no survey is faster than its line. Assumed values are fields of `Service` and `Load`
below.
"""

import heapq
import math
from dataclasses import dataclass

import numpy as np

import bench

SECONDS_A_YEAR = 365.25 * 86400
SURVEYS = 20_000  # Simulated for each load.
MOST_SLOWDOWN = 2.0  # At the 99th percentile: users notice longer waits.


@dataclass(frozen=True)
class Service:
    pulses_a_core: float = 23e6  # Per second, six quantities over TLS; measured by tests/bench/sizing.py.
    bytes_there: float = 8  # Per pulse, incidence and depth in columns; measured likewise.
    bytes_back: float = 26
    cores: int = 2  # Of a replica.
    network: float = 10e9 / 8  # Of a replica, bytes per second in each direction. Assumed.
    dollars_a_core_hour: float = 0.05  # Approximate list price of large clouds. Assumed.
    dollars_a_gigabyte_out: float = 0.08

    def capacity(self):
        """Pulses per second of a replica, and the resource that limits them."""
        return min((self.cores * self.pulses_a_core, "processor"), (self.network / self.bytes_back, "network"))


@dataclass(frozen=True)
class Load:
    name: str
    pulses_a_year: float
    busiest: float  # Rate in the busiest hour over the mean of the year. Assumed.
    line: float = 1e9 / 8  # Of a client, bytes per second. Assumed.
    median_survey: float = 20e6  # Pulses. Assumed, as is the standard deviation of the logarithm.
    spread: float = 1.0

    def mean_survey(self):
        return self.median_survey * math.exp(self.spread**2 / 2)

    def peak(self):
        """Pulses per second in the busiest hour."""
        return self.pulses_a_year / SECONDS_A_YEAR * self.busiest


LOADS = (Load("a company", 1e9, 50), Load("a nation", 1e11, 20), Load("the world", 1e13, 5),
         Load("a hundred worlds", 1e15, 5))


def shared(arrivals, sizes, capacity, most):
    """The time at which each job ends. Active jobs progress equally, by at most `capacity` in total and `most` each.

    All active jobs progress at the same rate, so they end in the order of their size plus the common progress at the
    time of their arrival.
    """
    ends = np.empty(len(arrivals))
    under_way, now, progress = [], 0.0, 0.0
    for index, (arrival, size) in enumerate(zip([*arrivals, math.inf], [*sizes, 0])):
        while under_way:
            rate = min(most, capacity / len(under_way))
            end = now + (under_way[0][0] - progress) / rate
            if end > arrival:
                progress += (arrival - now) * rate
                break
            progress, ended = heapq.heappop(under_way)
            now = ends[ended] = end
        now = arrival
        heapq.heappush(under_way, (progress + size, index))
    return ends


def slowdown(load, service, replicas):
    """The 99th percentile of the time that a survey takes, over the time that it takes alone."""
    capacity = replicas * service.capacity()[0]
    if replicas == 0 or load.peak() >= capacity:
        return math.inf
    random = np.random.default_rng(1)
    arrivals = np.cumsum(random.exponential(load.mean_survey() / load.peak(), SURVEYS))
    sizes = random.lognormal(math.log(load.median_survey), load.spread, SURVEYS)
    most = min(load.line / service.bytes_back, capacity)
    taken = shared(arrivals, sizes, capacity, most) - arrivals
    return float(np.percentile(taken / (sizes / most), 99))


def fewest_replicas(load, service):
    """The fewest replicas that suffice when one of them is lost."""
    replicas = 2
    while slowdown(load, service, replicas - 1) > MOST_SLOWDOWN:
        replicas += 1
    return replicas


def short(value):
    return f"{value:,.0f}" if value >= 10 else f"{value:.2g}"


def columns(load, service):
    replicas = fewest_replicas(load, service)
    gigabytes_back = load.pulses_a_year * service.bytes_back / 1e9
    yield "pulses a year", f"{load.pulses_a_year:.0e}".replace("e+", "e")
    yield "busiest hour, pulses a second", f"{load.peak():,.0f}"
    yield "processor time a year", short(load.pulses_a_year / service.pulses_a_core / 3600) + " h"
    yield "a year, there + back", (short(load.pulses_a_year * service.bytes_there / 1e12) + " + " +
                                   short(gigabytes_back / 1e3) + " TB")
    yield "busiest hour, back", short(load.peak() * service.bytes_back * 8 / 1e9) + " Gbit/s"
    yield f"replicas of {service.cores} cores, one of which may be lost", f"{replicas}"
    yield "their use in the busiest hour", short(100 * load.peak() / replicas / service.capacity()[0]) + " %"
    yield "slowdown, 99th percentile / with one lost", (
        f"{slowdown(load, service, replicas):.2f} / {slowdown(load, service, replicas - 1):.2f}")
    yield "replicas, $ a year", f"{replicas * service.cores * SECONDS_A_YEAR / 3600 * service.dollars_a_core_hour:,.0f}"
    yield "bytes out, $ a year", f"{gigabytes_back * service.dollars_a_gigabyte_out:,.0f}"


def main():
    service = Service()
    capacity, bound = service.capacity()
    print(f"A replica answers {capacity / 1e6:.0f} M pulses a second at most, bounded by its {bound}.\n")
    cells = zip(*(columns(load, service) for load in LOADS))
    bench.print_table(("", *(load.name for load in LOADS)), ((of[0][0], *(text for _, text in of)) for of in cells))


if __name__ == "__main__":
    main()
