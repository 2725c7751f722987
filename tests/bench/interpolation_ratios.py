"""Our interpolation against its peers as a Markdown table.

Usage: interpolation_ratios.py BUILD_FOLDER [--rounds N]
Each round runs every peer once. Figures are medians over the rounds, of processor time on one core.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys

from ratios import compiler, processor

HERE = pathlib.Path(__file__).resolve().parent
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
    pattern = f"^({'|'.join(sorted(names))})/{MEGABYTES}/{order}/{PULSES}$"
    report = json.loads(subprocess.run(
        [programs / "interpolation_bench", f"--benchmark_filter={pattern}", "--benchmark_min_time=0.2",
         "--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=3", "--benchmark_format=json",
         "--benchmark_report_aggregates_only=true"], check=True, stdout=subprocess.PIPE).stdout)
    ours = {run["run_name"].split("/")[0]: run["items_per_second"]
            for run in report["benchmarks"] if run["aggregate_name"] == "median"}
    scipy = json.loads(subprocess.run(
        [sys.executable, "-B", HERE / "interpolation" / "scipy_interpolation.py", programs / "interpolation_case_files",
         str(MEGABYTES), order, str(PULSES)], check=True, stdout=subprocess.PIPE).stdout)
    return {**ours, **scipy}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    programs = arguments.build / "tests" / "bench"
    print(f"{processor()}; {compiler(arguments.build)}. One core, six axes, table of {MEGABYTES} MB. THU, TVU and "
          "both biases; in the row of `Interpolate` all six quantities and standard errors.\n")
    print("| against | order | ours | peer | ratio |\n|---|---|---:|---:|---:|")
    for order in ("scan", "random"):
        rounds = [rates(programs, order) for _ in range(arguments.rounds)]
        for name, peer, ours in PEERS:
            of_ours, of_peer = (statistics.median(each[who] for each in rounds) / 1e6 for who in (ours, peer))
            ratio = statistics.median(each[ours] / each[peer] for each in rounds)
            print(f"| {name} | {order} | {of_ours:.3g} M/s | {of_peer:.3g} M/s | {ratio:.3g} |")


if __name__ == "__main__":
    main()
