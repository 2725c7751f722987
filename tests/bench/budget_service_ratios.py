"""The whole budget over the wire against the same sums behind a plain TCP connection.

Usage: budget_service_ratios.py BUILD_FOLDER [--repetitions N] [--seconds S]
Both run in turn, repeatedly, with client and server on this machine. Figures are medians.
"""

import argparse
import pathlib
import statistics
import subprocess

from ratios import compiler, processor
from service_ratios import TABLE, server


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--repetitions", type=int, default=7)
    parser.add_argument("--seconds", type=float, default=2)
    arguments = parser.parse_args()
    program = arguments.build / "tests" / "bench" / "budget_service_bench"
    ours = [arguments.build / "bin" / "albtpu-serve", "--tables", TABLE.parent, "--listen", "127.0.0.1:0"]
    rates = {"budget": [], "raw": []}
    with server(ours, r"ready on (\S+),") as service, server([program, "serve-raw", TABLE], r"^(\d+)$") as raw:
        for _ in range(arguments.repetitions):
            for peer, (_, address) in (("budget", service), ("raw", raw)):
                command = [program, peer, TABLE, address, str(arguments.seconds)]
                rates[peer].append(float(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout))
    budget, raw = (statistics.median(rates[peer]) for peer in ("budget", "raw"))
    print(f"{processor()}, shared by client and server; {compiler(arguments.build)}.\n")
    print("| `QueryBudget`, 65 536 a message | raw TCP | ratio |\n|---:|---:|---:|")
    print(f"| {budget / 1e6:.3g} M/s | {raw / 1e6:.3g} M/s | {budget / raw:.2f} |")


if __name__ == "__main__":
    main()
