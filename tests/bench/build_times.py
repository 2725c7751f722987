"""Where the time of a build goes: seconds of all objects, of folders and of the slowest objects.

Usage: build_times.py BUILD_FOLDER [--slowest N] [--all]

Measures what .ninja_log has of the last build of each object: elapsed time, so that the machine must be idle and ccache
off (CCACHE_DISABLE=1). With --all, programs, libraries and generated files are counted as well.
"""

import argparse
import collections
import pathlib


def seconds_by_output(log):
    """The last build of each output."""
    seconds = {}
    for line in log.read_text().splitlines()[1:]:
        begin, end, _, output, _ = line.split("\t")
        seconds[output] = (int(end) - int(begin)) / 1000
    return seconds


def folder(output):
    """The folder of the source tree that an object comes from, and its target: "survey/albtpu_survey"."""
    return output.partition("/CMakeFiles/")[0] + "/" + output.partition("/CMakeFiles/")[2].partition(".dir/")[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--slowest", type=int, default=20)
    parser.add_argument("--all", action="store_true")
    arguments = parser.parse_args()
    seconds = {output: took for output, took in seconds_by_output(arguments.build / ".ninja_log").items()
               if arguments.all or output.endswith((".o", ".gch"))}
    tests = sum(took for output, took in seconds.items() if output.startswith("tests/"))
    print(f"{len(seconds)} objects, {sum(seconds.values()):.0f} s, of which tests {tests:.0f} s")
    targets = collections.Counter()
    for output, took in seconds.items():
        targets[folder(output)] += took
    for name, took in targets.most_common(arguments.slowest):
        print(f"{took:8.1f} s  {name}")
    for output in sorted(seconds, key=seconds.get, reverse=True)[:arguments.slowest]:
        print(f"{seconds[output]:8.1f} s  {output}")


if __name__ == "__main__":
    main()
