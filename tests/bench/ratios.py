"""Our code against its peers as a Markdown table: runs the benchmarks of a build folder, takes the best of each peer.

Usage: ratios.py BUILD_FOLDER [--repetitions N] [--min-time SECONDS]
The figures of a row, except those of NumPy, are measured in one run with randomly interleaved repetitions. They are
medians of processor time.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

MANY = 64  # realizations at a time in our benchmarks
CASES = {"0": "nadir", "20": "20°"}
HERE = pathlib.Path(__file__).resolve().parent


def medians(program, repetitions, min_time, names=()):
    """The median (cpu_time, real_time, ...) of each benchmark of a program, or of those in `names`, by name."""
    command = [program, "--benchmark_enable_random_interleaving=true", "--benchmark_report_aggregates_only=true",
               f"--benchmark_repetitions={repetitions}", f"--benchmark_min_time={min_time}", "--benchmark_format=json"]
    if names:
        command.append("--benchmark_filter=^(" + "|".join(map(re.escape, names)) + ")(/process_time)?$")
    report = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    for run in report["benchmarks"]:
        if run.get("error_occurred"):
            sys.exit(f"ratios.py: {run['name']}: {run['error_message']}")
    return {run["run_name"].removesuffix("/process_time"): run
            for run in report["benchmarks"] if run.get("aggregate_name") == "median"}


def finals(program, patterns, arguments):
    """Medians of the fastest benchmarks: a short run of all finds the three fastest of each pattern, and a long run of
    these gives the figures."""
    print(f"{program.name} ...", file=sys.stderr)
    heats = medians(program, 3, arguments.min_time / 4)
    names = set()
    for pattern in patterns:
        matching = [name for name in heats if re.fullmatch(pattern, name)]
        names.update(sorted(matching, key=lambda name: heats[name]["cpu_time"])[:3])
    return medians(program, arguments.repetitions, arguments.min_time, sorted(names))


def best(runs, pattern):
    """The name of the fastest run whose name matches; None if there is none."""
    return min((name for name in runs if re.fullmatch(pattern, name)), key=lambda name: runs[name]["cpu_time"],
               default=None)


class Table:
    def __init__(self):
        self.rows = []

    def add(self, what, unit, ours, peer, ratio):
        self.rows.append((what, f"{ours:.3g} {unit}", f"{peer:.3g} {unit}", f"{ratio:.3g}"))

    def markdown(self):
        lines = ["| what | ours | peer | ratio |", "|---|---:|---:|---:|"]
        return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in self.rows])


def mode_of(name):
    return " ".join(part for part in name.split("/") if part not in ("embree", "any", "whole", "cropped", *CASES))


def add_rays(table, program, arguments):
    peers = {"the scalar walk": "scalar", "Embree": "embree/.*"}
    ours = {"": "packets", " with the control variates' sums,": "packets_and_unshifted"}
    patterns = [f"{pattern}/{degrees}" for pattern in (*ours.values(), *peers.values()) for degrees in CASES]
    runs = finals(program, patterns, arguments)
    for degrees, where in CASES.items():
        for sums, name in ours.items():
            rate = runs[f"{name}/{degrees}"]["items_per_second"] / 1e6
            for peer, pattern in peers.items():
                fastest = best(runs, f"{pattern}/{degrees}")
                if not fastest:
                    continue
                mode = f" ({mode_of(fastest)})" if peer == "Embree" else ""
                lost = f", {runs[fastest]['lost']:.0f} of 10 000 lost" if runs[fastest].get("lost") else ""
                of_peer = runs[fastest]["items_per_second"] / 1e6
                table.add(f"rays a second, {where},{sums} against {peer}{mode}{lost}", "M/s", rate, of_peer,
                          rate / of_peer)


def add_realizations(table, program, arguments, numpy):
    peers = {"plain C++": "plain", "Embree, whole surface refitted": "embree/whole/.*/refit/.*",
             "Embree, whole surface built": "embree/whole/.*/(low|medium)/.*",
             "Embree, cropped to the footprint": "embree/cropped/.*"}
    patterns = [f"{pattern}/{degrees}" for pattern in ("ours", *peers.values()) for degrees in CASES]
    runs = finals(program, [*patterns, "transform/.*", "ours_on_two_threads/0"], arguments)
    transform = runs[best(runs, "transform/.*")]["cpu_time"] / 1e3
    for degrees, where in CASES.items():
        ours = runs[f"ours/{degrees}"]["cpu_time"] / 1e3 / MANY
        for peer, pattern in peers.items():
            fastest = best(runs, f"{pattern}/{degrees}")
            if not fastest:
                continue
            mode = f" ({mode_of(fastest)})" if "Embree" in peer else ""
            of_peer = runs[fastest]["cpu_time"] / 1e3
            table.add(f"one realization, {where}, against {peer}{mode}", "ms", ours, of_peer, of_peer / ours)
        table.add(f"one realization, {where}, over one FFTW transform", "ms", ours, transform, ours / transform)
    for name, milliseconds in numpy.items():
        ours = runs["ours/0"]["cpu_time"] / 1e3 / MANY
        table.add(f"one realization, {CASES['0']}, against {name}", "ms", ours, milliseconds, milliseconds / ours)
    one, two = (runs[name]["real_time"] / 1e3 / MANY for name in ("ours/0", "ours_on_two_threads/0"))
    table.add("a realization on two threads (ours) and on one (peer)", "ms", two, one, one / two)


def processor():
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text()
        facts = dict(re.findall(r"^(model name|flags)\s*: (.*)$", text, re.MULTILINE))
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
    parser.add_argument("--repetitions", type=int, default=15)
    parser.add_argument("--min-time", type=float, default=0.1)
    arguments = parser.parse_args()
    programs = arguments.build / "tests" / "bench"
    numpy = json.loads(subprocess.run(
        [sys.executable, "-B", HERE / "monte_carlo" / "numpy_realization.py", programs / "beam_case_surface"],
        check=True, stdout=subprocess.PIPE).stdout)
    table = Table()
    add_rays(table, programs / "rays_bench", arguments)
    add_realizations(table, programs / "realization_bench", arguments, numpy)
    print(f"{processor()}; {compiler(arguments.build)}. One core except in the last row. A "
          "realization is 512² points of sea, 10 000 rays, 5 depths.\n")
    print(table.markdown())


if __name__ == "__main__":
    main()
