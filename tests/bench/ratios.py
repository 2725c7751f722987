"""Ours against its peers as a Markdown table: runs the benchmarks of a build folder and takes the best of each peer.

Usage: ratios.py BUILD_FOLDER [--repetitions N] [--min-time SECONDS]
Everything in a row was measured in one run, repetitions interleaved at random; figures are medians of processor time.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

CASES = {"0": "nadir", "20": "20°"}
HERE = pathlib.Path(__file__).resolve().parent


def medians(program, arguments):
    """Of each benchmark of a program: its median (cpu_time, real_time, items_per_second, ...) by name."""
    command = [program, "--benchmark_enable_random_interleaving=true", "--benchmark_report_aggregates_only=true",
               f"--benchmark_repetitions={arguments.repetitions}", f"--benchmark_min_time={arguments.min_time}",
               "--benchmark_format=json"]
    print(f"{program.name} ...", file=sys.stderr)
    report = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    for run in report["benchmarks"]:
        if run.get("error_occurred"):
            sys.exit(f"ratios.py: {run['name']}: {run['error_message']}")
    return {run["run_name"].removesuffix("/process_time"): run
            for run in report["benchmarks"] if run.get("aggregate_name") == "median"}


def best(runs, pattern, key="cpu_time", most=False):
    """The name and figure of the fastest whose name matches; None if there is none."""
    found = {name: run[key] for name, run in runs.items() if re.fullmatch(pattern, name)}
    return (max if most else min)(found.items(), key=lambda item: item[1]) if found else None


class Table:
    def __init__(self):
        self.rows = []

    def add(self, what, unit, ours, peer, ratio):
        self.rows.append((what, f"{ours:.3g} {unit}", f"{peer:.3g} {unit}", f"{ratio:.3g}"))

    def markdown(self):
        lines = ["| what | ours | peer | ratio |", "|---|---:|---:|---:|"]
        return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in self.rows])


def mode_of(name):
    return " ".join(part for part in name.split("/") if part not in ("embree", "any", "whole", "cropped"))


def add_rays(table, runs):
    for degrees, where in CASES.items():
        peers = [("the scalar walk", best(runs, f"scalar/{degrees}", "items_per_second", most=True)),
                 ("Embree", best(runs, f"embree/.*/{degrees}", "items_per_second", most=True))]
        for sums, ours in (("", runs[f"packets/{degrees}"]),
                           (" with the control variates' sums", runs[f"packets_and_undisturbed/{degrees}"])):
            for peer, fastest in peers:
                if not fastest:
                    continue
                name, rate = fastest
                mode = f" ({mode_of(name.rsplit('/', 1)[0])})" if peer == "Embree" else ""
                lost = f", {runs[name]['lost']:.0f} of 10 000 lost" if runs[name].get("lost") else ""
                table.add(f"rays a second, {where},{sums} against {peer}{mode}{lost}", "M/s",
                          ours["items_per_second"] / 1e6, rate / 1e6, ours["items_per_second"] / rate)


def add_realizations(table, runs, numpy):
    transform = best(runs, "transform/.*")
    for degrees, where in CASES.items():
        ours = runs[f"ours/{degrees}"]["cpu_time"] / 1e3
        peers = [("plain C++", best(runs, f"plain/{degrees}")),
                 ("Embree, whole surface refitted", best(runs, f"embree/whole/.*/refit/.*/{degrees}")),
                 ("Embree, whole surface built", best(runs, f"embree/whole/.*/(low|medium)/.*/{degrees}")),
                 ("Embree, cropped to the footprint", best(runs, f"embree/cropped/.*/{degrees}")),
                 ("one FFTW transform", transform)]
        for peer, fastest in peers:
            if not fastest:
                continue
            name, microseconds = fastest
            mode = f" ({mode_of(name.rsplit('/', 1)[0])})" if "Embree" in peer else ""
            ratio = microseconds / 1e3 / ours if fastest is not transform else ours / (microseconds / 1e3)
            table.add(f"one realization, {where}, against {peer}{mode}", "ms", ours, microseconds / 1e3, ratio)
        if degrees == "0":
            for name, milliseconds in numpy.items():
                table.add(f"one realization, {where}, against {name}", "ms", ours, milliseconds, milliseconds / ours)
    one, two = (runs[f"ours_on_threads/real_time/threads:{n}"]["real_time"] / 1e3 for n in (1, 2))
    table.add("realizations of two threads against one, time for each", "ms", two, one, one / two)


def processor():
    try:
        facts = dict(re.findall(r"^(model name|flags)\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE))
    except OSError:
        facts = {}
    sets = [name for flag, name in (("avx2", "AVX2"), ("avx512f", "AVX-512")) if flag in facts.get("flags", "").split()]
    return ", ".join([facts.get("model name", os.uname().machine), f"{os.cpu_count()} cores", *sets])


def compiler(build):
    cache = dict(re.findall(r"^(CMAKE_CXX_COMPILER|CMAKE_BUILD_TYPE):\w+=(.*)$", (build / "CMakeCache.txt").read_text(),
                            re.MULTILINE))
    version = subprocess.run([cache["CMAKE_CXX_COMPILER"], "--version"], check=True, capture_output=True, text=True)
    return f"{version.stdout.splitlines()[0]}, {cache['CMAKE_BUILD_TYPE']}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--repetitions", type=int, default=9)
    parser.add_argument("--min-time", type=float, default=0.1)
    arguments = parser.parse_args()
    programs = arguments.build / "tests" / "bench"
    numpy = json.loads(subprocess.run(
        [sys.executable, "-B", HERE / "numpy_realization.py", programs / "beam_case_surface"],
        check=True, stdout=subprocess.PIPE).stdout)
    table = Table()
    add_rays(table, medians(programs / "rays_bench", arguments))
    add_realizations(table, medians(programs / "realization_bench", arguments), numpy)
    print(f"{processor()}; {compiler(arguments.build)}. One core but for the last row; a "
          "realization is 512² points of sea, 10 000 rays, 5 depths.\n")
    print(table.markdown())


if __name__ == "__main__":
    main()
