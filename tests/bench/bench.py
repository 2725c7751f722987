"""What the scripts of this folder share: arguments, inputs, programs that are measured, and Markdown tables."""

import argparse
import json
import os
import pathlib
import re
import struct
import subprocess
import sys

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HERE = SOURCE / "tests/bench"
TABLES = SOURCE / "tables/shipped"
sys.path[:0] = [str(SOURCE / folder) for folder in ("clients/python/src", "tests/e2e", "tests/laz")]


def parser(description, **numbers):
    """Takes BUILD_FOLDER, and --NAME for each of the numbers, which has a default."""
    made = argparse.ArgumentParser(description=description.splitlines()[0])
    made.add_argument("build", type=pathlib.Path)
    for name, default in numbers.items():
        made.add_argument("--" + name.replace("_", "-"), type=type(default), default=default)
    return made


def print_table(heads, rows, words=1):
    """A Markdown table, row by row as they are measured: columns of words, then of figures."""
    print(f"| {' | '.join(heads)} |\n|{'---|' * words}{'---:|' * (len(heads) - words)}")
    for row in rows:
        print(f"| {' | '.join(row)} |", flush=True)


def run_json(*command):
    """The JSON object that a program prints."""
    run = subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE)
    return json.loads(run.stdout)


def medians(program, pattern, repetitions, min_time):
    """The medians of the benchmarks of a program whose names match, by name."""
    report = run_json(program, "--benchmark_enable_random_interleaving=true", f"--benchmark_filter={pattern}",
                      "--benchmark_report_aggregates_only=true", f"--benchmark_repetitions={repetitions}",
                      f"--benchmark_min_time={min_time}", "--benchmark_format=json")
    for run in report["benchmarks"]:
        if run.get("error_occurred"):
            sys.exit(f"{program.name}: {run['name']}: {run['error_message']}")
    return {run["run_name"].removesuffix("/process_time"): run
            for run in report["benchmarks"] if run.get("aggregate_name") == "median"}


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


def processor_seconds(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory(pid, what="VmRSS"):
    """The bytes that a process has in memory; with "VmHWM", their peak. 0 if it has ended."""
    found = re.search(rf"^{what}:\s+(\d+) kB", pathlib.Path(f"/proc/{pid}/status").read_text(), re.MULTILINE)
    return int(found[1]) << 10 if found else 0


def flight_line(count, dtype=np.float32):
    """Pulses in scan order, without azimuth."""
    scan = np.abs(np.linspace(-20, 20, 5000))
    return dict(wind_speed=5.0, footprint=0.5, incidence=np.resize(scan, count).astype(dtype),
                depth=(5 + 4 * np.sin(np.linspace(0, 3000, count))).astype(dtype))


def simulated_survey(build, folder):
    """A minute of a survey: FOLDER/flight.las and its trajectory, FOLDER/sbet.out."""
    subprocess.run([build / "tests/flights/albtpu_simulated_survey", folder, "--seconds", "60"], check=True)
    return folder / "flight.las"


def laz_copy(build, source, target):
    """The LAS or LAZ file `source` as the other kind."""
    subprocess.run([build / "tests/laz/albtpu_laz_copy", source, target], check=True)
    return target


def repeat(source, target, points, steps=0, seconds=0.0):
    """Repeats the records of a LAS file until there are `points` of them, with nothing after them: each time so many
    steps east and so much later."""
    data = source.read_bytes()
    offset, = struct.unpack_from("<I", data, 96)
    point_format, length, legacy_count = struct.unpack_from("<BHI", data, 104)
    count = struct.unpack_from("<Q", data, 247)[0] if data[25] >= 4 else legacy_count
    records = np.frombuffer(data, np.uint8, count * length, offset).reshape(count, length).copy()
    head = bytearray(data[:offset])
    struct.pack_into("<I", head, 107, points if point_format < 6 else 0)
    if data[25] >= 4:
        struct.pack_into("<QIQ", head, 235, 0, 0, points)
    time = 20 if point_format < 6 else 22
    with open(target, "wb") as file:
        file.write(head)
        for written in range(0, points, count):
            file.write(records[:points - written].data)
            if steps:
                records[:, :4].view("<i4")[:] += steps
            if seconds:
                records[:, time:time + 8].view("<f8")[:] += seconds
        file.flush()
        os.fsync(file.fileno())
    return target
