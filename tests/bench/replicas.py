"""Pulses per second from two replicas behind one address and from one replica, each limited to a share of a core.

Usage: replicas.py BUILD_FOLDER [--share S] [--repetitions N]

Clients and servers share this machine. Two replicas can be twice as fast as one only if there is enough processor time
for both and for the client, so a control group limits each replica to a share of a core. Needs root.
"""

import contextlib
import itertools
import os
import pathlib
import statistics
import sys

import bench
from serving import Server

PERIOD = 10_000  # us, short compared with the time of a message.


class ControlGroup:
    """Limits one process to `share` of a core."""

    count = itertools.count()

    def __init__(self, process, share):
        first = pathlib.Path("/sys/fs/cgroup/cpu")  # Of cgroups version 1.
        parent = first if first.exists() else first.parent
        self.folder = parent / f"albtpu-{os.getpid()}-{next(self.count)}"
        quota = int(share * PERIOD)
        try:
            self.folder.mkdir()
            if first.exists():
                (self.folder / "cpu.cfs_period_us").write_text(str(PERIOD))
                (self.folder / "cpu.cfs_quota_us").write_text(str(quota))
            else:
                (self.folder / "cpu.max").write_text(f"{quota} {PERIOD}")
            (self.folder / "cgroup.procs").write_text(str(process.pid))
        except OSError as error:
            sys.exit(f"replicas.py: cannot make a control group for processor time ({error}); run it as root")

    def remove(self):
        self.folder.rmdir()


@contextlib.contextmanager
def replicas(serve, count, share):
    """The common address of `count` servers, and the process of the first."""
    with contextlib.ExitStack() as stack:
        servers = [stack.enter_context(Server(serve, "--tables", bench.TABLES)) for _ in range(count)]
        for group in [ControlGroup(server.process, share) for server in servers]:
            stack.callback(group.remove)  # After its server has ended.
        stack.push(lambda *_: [server.__exit__() for server in servers] and None)
        yield "ipv4:" + ",".join(server.address for server in servers), servers[0].process.pid


def rate(build, address, process):
    # Lines of 16 x 16384 pulses, one call for each: calls are short, so no replica idles long at the end of a run.
    run = bench.run_json(build / "tests/bench/service_bench", "stream", "--callers", 16, "--batch", 16384, "--table",
                         bench.TABLES / "survey.h5", "--address", address, "--server-pid", process, "--seconds", 10)
    return run["pulses_per_second"]


def main():
    arguments = bench.parser(__doc__, share=0.3, repetitions=5).parse_args()  # Share of a core for each replica.
    rates = {1: [], 2: []}
    for _ in range(arguments.repetitions):
        for count in rates:
            with replicas(arguments.build / "bin/albtpu-serve", count, arguments.share) as (address, first):
                rates[count].append(rate(arguments.build, address, first))
    one, two = (statistics.median(rates[count]) / 1e6 for count in (1, 2))
    print(f"Replicas with {arguments.share} of a core each: one {one:.3g}, two {two:.3g} million pulses a second, "
          f"{two / one:.2f} times as many.")


if __name__ == "__main__":
    main()
