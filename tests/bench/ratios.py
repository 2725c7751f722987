"""Our code against its peers as a Markdown table: runs the benchmarks of a build folder, takes the best of each peer.

Usage: ratios.py BUILD_FOLDER [--repetitions N] [--min-time SECONDS]
The figures of a row, except those of NumPy, are measured in one run with randomly interleaved repetitions. They are
medians of processor time.
"""

import re
import sys

import bench

MANY = 64  # realizations at a time in our benchmarks
CASES = {"0": "nadir", "20": "20°"}


def finals(program, patterns, arguments):
    """Medians of the fastest benchmarks: a short run of all finds the three fastest of each pattern, and a long run of
    these gives the figures."""
    print(f"{program.name} ...", file=sys.stderr)
    heats = bench.medians(program, ".", 3, arguments.min_time / 4)
    names = set()
    for pattern in patterns:
        matching = [name for name in heats if re.fullmatch(pattern, name)]
        names.update(sorted(matching, key=lambda name: heats[name]["cpu_time"])[:3])
    names = "|".join(map(re.escape, sorted(names)))
    return bench.medians(program, f"^({names})(/process_time)?$", arguments.repetitions, arguments.min_time)


def best(runs, pattern):
    """The name of the fastest run whose name matches; None if there is none."""
    return min((name for name in runs if re.fullmatch(pattern, name)), key=lambda name: runs[name]["cpu_time"],
               default=None)


def row(what, unit, ours, peer, ratio):
    return what, f"{ours:.3g} {unit}", f"{peer:.3g} {unit}", f"{ratio:.3g}"


def mode_of(name):
    return " ".join(part for part in name.split("/") if part not in ("embree", "any", "whole", "cropped", *CASES))


def rays(program, arguments):
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
                yield row(f"rays a second, {where},{sums} against {peer}{mode}{lost}", "M/s", rate, of_peer,
                          rate / of_peer)


def realizations(program, arguments, numpy):
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
            yield row(f"one realization, {where}, against {peer}{mode}", "ms", ours, of_peer, of_peer / ours)
        yield row(f"one realization, {where}, over one FFTW transform", "ms", ours, transform, ours / transform)
    for name, milliseconds in numpy.items():
        ours = runs["ours/0"]["cpu_time"] / 1e3 / MANY
        yield row(f"one realization, {CASES['0']}, against {name}", "ms", ours, milliseconds, milliseconds / ours)
    one, two = (runs[name]["real_time"] / 1e3 / MANY for name in ("ours/0", "ours_on_two_threads/0"))
    yield row("a realization on two threads (ours) and on one (peer)", "ms", two, one, one / two)


def main():
    arguments = bench.parser(__doc__, repetitions=15, min_time=0.1).parse_args()
    programs = arguments.build / "tests/bench"
    numpy = bench.run_json(sys.executable, "-B", bench.HERE / "monte_carlo/numpy_realization.py",
                           programs / "beam_case_surface")
    rows = [*rays(programs / "rays_bench", arguments),
            *realizations(programs / "realization_bench", arguments, numpy)]
    print(f"{bench.processor()}; {bench.compiler(arguments.build)}. One core except in the last row. A "
          "realization is 512² points of sea, 10 000 rays, 5 depths.\n")
    bench.print_table(("what", "ours", "peer", "ratio"), rows)


if __name__ == "__main__":
    main()
