"""Our interpolation against its peers as a Markdown table.

Usage: interpolation_ratios.py BUILD_FOLDER [--rounds N]
Each round runs every peer once. Figures are medians over the rounds, of processor time on one core.
"""

import statistics
import sys

import bench

MEGABYTES = 15
PULSES = 1 << 17  # as in interpolation_bench
PEERS = (  # description, benchmark of the peer, our benchmark to compare with
    ("scalar double C++, quantities apart", "plain", "columns"),
    ("scalar double C++, quantities side by side", "plain_side_by_side", "columns"),
    ("SciPy RegularGridInterpolator", "RegularGridInterpolator", "columns"),
    ("SciPy map_coordinates", "map_coordinates", "columns"),
    ("`Interpolate`, pulse by pulse", "rows", "columns_errors"),
)


def rates(programs, order):
    """Pulses per second of our code and of all peers, measured once."""
    names = {ours for _, _, ours in PEERS} | {"plain", "plain_side_by_side", "rows"}
    ours = bench.medians(programs / "interpolation_bench",
                         f"^({'|'.join(sorted(names))})/{MEGABYTES}/{order}/{PULSES}$", 3, 0.2)
    scipy = bench.run_json(sys.executable, "-B", bench.HERE / "interpolation/scipy_interpolation.py",
                           programs / "interpolation_case_files", MEGABYTES, order, PULSES)
    return {name.split("/")[0]: run["items_per_second"] for name, run in ours.items()} | scipy


def rows(arguments):
    for order in ("scan", "random"):
        rounds = [rates(arguments.build / "tests/bench", order) for _ in range(arguments.rounds)]
        for name, peer, ours in PEERS:
            of_ours, of_peer = (statistics.median(each[who] for each in rounds) / 1e6 for who in (ours, peer))
            ratio = statistics.median(each[ours] / each[peer] for each in rounds)
            yield name, order, f"{of_ours:.3g} M/s", f"{of_peer:.3g} M/s", f"{ratio:.3g}"


def main():
    arguments = bench.parser(__doc__, rounds=5).parse_args()
    print(f"{bench.processor()}; {bench.compiler(arguments.build)}. One core, six axes, table of {MEGABYTES} MB. THU, "
          "TVU and both biases; in the row of `Interpolate` all six quantities and standard errors.\n")
    bench.print_table(("against", "order", "ours", "peer", "ratio"), rows(arguments), words=2)


if __name__ == "__main__":
    main()
