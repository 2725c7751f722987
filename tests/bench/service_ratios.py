"""The service against plain TCP connections and messages of rows, as a Markdown table.

Usage: service_ratios.py BUILD_FOLDER [--repetitions N] [--seconds S]
All cases run in turn, repeatedly, with client and server on this machine. Figures are medians. Each peer is represented
by its fastest numbers of callers, messages in flight and connections.
"""

import contextlib
import statistics
import subprocess
import sys

import bench
import serving

TABLE = bench.TABLES / "survey.h5"
# Numbers of callers, of messages in flight of each caller, and of connections that a caller uses in turn. A caller with
# 24 messages on 24 connections stands for many clients. A plain connection and a stream have one connection each.
CALLS = [(1, 1, 1), (2, 1, 1), (4, 1, 1), (1, 4, 1), (2, 4, 1), (4, 4, 1), (1, 24, 24)]
BARE = [(1, 1, 1), (2, 1, 1), (4, 1, 1), (24, 1, 1)]
STREAMS = [(1, 1, 1), (2, 1, 1), (4, 1, 1)]
BULK = [("raw", 10000, BARE), ("raw", 65536, BARE), ("columns", 10000, CALLS), ("columns", 65536, CALLS),
        ("rows", 10000, CALLS), ("stream", 65536, STREAMS)]


class Peers(contextlib.ExitStack):
    """The service and the same numbers over plain connections, `raw`, as servers; and the program that asks them."""

    def __init__(self, arguments, raw):
        super().__init__()
        self.seconds, self.program = arguments.seconds, arguments.build / "tests/bench/service_bench"
        ours = self.enter_context(serving.Server(arguments.build / "bin/albtpu-serve", "--tables", bench.TABLES))
        self.ours = ours.process, ours.address
        process = self.enter_context(subprocess.Popen([self.program, raw, "--table", TABLE], stdout=subprocess.PIPE,
                                                      text=True))
        self.callback(process.terminate)
        self.raw = process, process.stdout.readline().strip()

    def run(self, peer, **options):
        process, address = self.raw if peer.startswith("raw") else self.ours
        options |= {"table": TABLE, "address": address, "server-pid": process.pid, "seconds": self.seconds}
        run = bench.run_json(self.program, peer, *(word for name, value in options.items()
                                                   for word in (f"--{name}", value)))
        run["cpu"] = run["client_cpu_per_pulse"] + run["server_cpu_per_pulse"]
        return run


def median(runs, *path):
    def value(run):
        for name in path:
            run = run[name]
        return run
    return statistics.median(value(run) for run in runs)


def measure(peers, repetitions):
    """Runs by (peer, batch, callers and messages in flight and connections)."""
    cases = {(peer, batch, way): {"batch": batch} | dict(zip(("callers", "in-flight", "connections"), way))
             for peer, batch, ways in BULK for way in ways}
    cases |= {(peer, 1, 64): {"batch": 1, "in-flight": 64} for peer in ("raw-single", "rows", "stream-single")}
    cases |= {("rows", 1, "alone"): {"batch": 1}, ("rows", 1, "under bulk"): {"batch": 1, "beside": 2}}
    runs = {case: [] for case in cases}
    for repetition in range(repetitions):
        print(f"repetition {repetition + 1} of {repetitions} ...", file=sys.stderr)
        for case, options in cases.items():
            runs[case].append(peers.run(case[0], **options))
    return runs


def best(runs, peer, batch):
    """The runs with the most pulses per second, and their callers, messages in flight and connections in words."""
    (_, _, (callers, in_flight, connections)), of = max(
        ((case, of) for case, of in runs.items() if case[:2] == (peer, batch)),
        key=lambda case_and_runs: median(case_and_runs[1], "pulses_per_second"))
    way = f"{connections} connections" if connections > 1 else f"{callers} × {in_flight}"
    return way, of


def rows_of(runs):
    def row(what, ours, peer):
        (way, ours), (way_of_peer, peer) = ours, peer
        what += f" ({way}; {way_of_peer})" if way else ""
        rate, of_peer = median(ours, "pulses_per_second"), median(peer, "pulses_per_second")
        return (what, f"{rate / 1e6:.3g} M/s", f"{of_peer / 1e6:.3g} M/s", f"{rate / of_peer:.2f}",
                f"{median(ours, 'client_cpu_per_pulse') * 1e9:.3g} + {median(ours, 'server_cpu_per_pulse') * 1e9:.3g}",
                f"{median(peer, 'client_cpu_per_pulse') * 1e9:.3g} + {median(peer, 'server_cpu_per_pulse') * 1e9:.3g}",
                f"{median(ours, 'cpu') / median(peer, 'cpu'):.2f}")
    for peer, name, batch in (("columns", "QueryColumns", 10000), ("columns", "QueryColumns", 65536),
                              ("stream", "StreamColumns", 65536)):
        yield row(f"`{name}`, {batch} a message, against raw TCP", best(runs, peer, batch), best(runs, "raw", batch))
    yield row("`QueryColumns` against `QueryPulses`, 10000 a message", best(runs, "columns", 10000),
              best(runs, "rows", 10000))
    for peer, kind in (("stream-single", "messages of a stream"), ("rows", "calls")):
        yield row(f"single pulses as {kind}, 64 in flight, against raw TCP messages", ("", runs[peer, 1, 64]),
                  ("", runs["raw-single", 1, 64]))


def main():
    arguments = bench.parser(__doc__, repetitions=7, seconds=1.0).parse_args()
    with Peers(arguments, "serve-raw") as peers:
        runs = measure(peers, arguments.repetitions)
    print(f"{bench.processor()}, shared by client and server; {bench.compiler(arguments.build)}. Table `survey`; 4 "
          "columns per pulse in the request, 4 quantities in the response; processor time per pulse, client + server, "
          "in ns. In brackets, for ours and for the peer: callers × messages in flight.\n")
    bench.print_table(("what", "ours", "peer", "ratio", "ours, CPU", "peer, CPU", "ratio"), rows_of(runs))
    alone, under_bulk = runs["rows", 1, "alone"], runs["rows", 1, "under bulk"]
    p50, p99 = median(alone, "latency", "p50"), median(under_bulk, "latency", "p99")
    print(f"\nA single pulse takes {p50 * 1e3:.2f} ms (median) on an idle server, and {p99 * 1e3:.2f} ms (99th "
          f"percentile, {p99 / p50:.1f} times that) beside {median(under_bulk, 'bulk_pulses_per_second') / 1e6:.3g} "
          "million pulses a second in bulk.")


if __name__ == "__main__":
    main()
