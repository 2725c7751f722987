"""The whole budget over the wire against the same sums behind a plain TCP connection.

Usage: budget_service_ratios.py BUILD_FOLDER [--repetitions N] [--seconds S]
Both run in turn, repeatedly, with client and server on this machine. Figures are medians.
"""

import bench
from service_ratios import Peers, median


def main():
    arguments = bench.parser(__doc__, repetitions=7, seconds=2.0).parse_args()
    runs = {"budget": [], "raw-budget": []}
    with Peers(arguments, "serve-raw-budget") as peers:
        for _ in range(arguments.repetitions):
            runs["budget"].append(peers.run("budget"))
            runs["raw-budget"].append(peers.run("raw-budget", callers=2))  # Which keep two cores busy.
    budget, raw = (median(runs[peer], "pulses_per_second") for peer in runs)
    print(f"{bench.processor()}, shared by client and server; {bench.compiler(arguments.build)}.\n")
    bench.print_table(("`QueryBudget`, 65 536 a message", "raw TCP", "ratio"),
                      [(f"{budget / 1e6:.3g} M/s", f"{raw / 1e6:.3g} M/s", f"{budget / raw:.2f}")], words=0)


if __name__ == "__main__":
    main()
