"""Points of LAZ files decoded and encoded in a second, compared with laz-perf and laz-rs as WebAssembly.

Usage: laz_rates.py BUILD [--millions N] [--runs N] [--samples FOLDER]

Files: a simulated survey (point format 6), and the sample autzen_trim.laz (format 3) if it is there, whose points are
repeated, each time moved and later. All programs decode the same files in turn; a file is decoded RUNS times by each.
Prints a Markdown table of medians: of processor time on one core, of elapsed time on two, which needs an idle machine.
The peers need node and npm.
"""

import argparse
import json
import pathlib
import statistics
import struct
import subprocess
import sys
import tempfile

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "formats" / "laz"))
import independent_decoders  # noqa: E402

ROUNDS = 3  # In which the programs take turns.


def repeat(source, target, points):
    """Repeats the records of a LAS file until there are `points` of them: each time 100 000 steps east, a day later."""
    data = source.read_bytes()
    offset, = struct.unpack_from("<I", data, 96)
    point_format, length, count = struct.unpack_from("<BHI", data, 104)
    if data[25] >= 4:
        count, = struct.unpack_from("<Q", data, 247)
    records = np.frombuffer(data, np.uint8, count * length, offset).reshape(count, length)
    head = bytearray(data[:offset])
    struct.pack_into("<I", head, 107, points if point_format < 6 else 0)
    if data[25] >= 4:
        struct.pack_into("<QIQ", head, 235, 0, 0, points)
    time = 20 if point_format < 6 else 22
    with open(target, "wb") as file:
        file.write(head)
        for i in range(-(-points // count)):
            moved = records[:points - i * count].copy()
            moved[:, :4].view("<i4")[:] += 100_000 * i
            moved[:, time:time + 8].view("<f8")[:] += 86_400.0 * i
            file.write(moved.tobytes())
    return target


def make_files(options, folder):
    """The LAZ files, by what they are."""
    programs = options.build / "tests" / "formats"
    points = int(options.millions * 1e6)
    subprocess.run([programs / "albtpu_simulated_survey", folder, "--seconds", "60"], check=True)
    sources = {"simulated survey, format 6": folder / "flight.las"}
    if (options.samples / "autzen_trim.laz").exists():
        sources["sample of a survey, format 3"] = folder / "sample.las"
        subprocess.run([programs / "albtpu_laz_copy", options.samples / "autzen_trim.laz", folder / "sample.las"],
                       check=True)
    files = {}
    for i, (what, source) in enumerate(sources.items()):
        las, laz = folder / "repeated.las", folder / f"{i}.laz"
        subprocess.run([programs / "albtpu_laz_copy", repeat(source, las, points), laz], check=True)
        las.unlink()
        files[what] = laz
    return files


def measure(options, folder, files, peers):
    """{what: {of which program: [points per second of each run]}}"""
    rates = {what: {} for what in files}
    for _ in range(ROUNDS):
        for what, file in files.items():
            command = [options.build / "tests" / "bench" / "albtpu_laz_rate", file, str(options.runs)]
            ours = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
            seconds = {name: ours[name] for name in ("decode", "encode", "decode_two", "encode_two")}
            for peer in peers:
                answer, = independent_decoders.decode(options.decoders, peer, [file], folder, options.runs + 1)
                if len(answer["records"]) == 0 or answer["points"] != ours["points"]:
                    sys.exit(f"laz_rates.py: {peer} cannot decode {file}: {answer.get('error')}")
                seconds[peer] = answer["seconds"][1:]  # The first run compiles it.
            for name, values in seconds.items():
                rates[what].setdefault(name, []).extend(ours["points"] / value for value in values)
    return rates


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--millions", type=float, default=2.2)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--samples", type=pathlib.Path, default=SOURCE.parent / "shared" / "data" / "laz")
    parser.add_argument("--decoders", type=pathlib.Path, help="folder that keeps the peers")
    options = parser.parse_args()
    options.decoders = options.decoders or options.build / "tests" / "formats" / "laz_decoders"
    peers = list(independent_decoders.PACKAGES)
    try:
        independent_decoders.fetch(options.decoders)
    except independent_decoders.Unavailable as reason:
        print(f"laz_rates.py: no peers: {reason}", file=sys.stderr)
        peers = []
    with tempfile.TemporaryDirectory() as folder:
        rates = measure(options, pathlib.Path(folder), make_files(options, pathlib.Path(folder)), peers)
    names = {"decode": "decoded", "encode": "encoded", "decode_two": "decoded on two cores",
             "encode_two": "encoded on two cores"}
    print("| million points/s | ours |" + "".join(f" {peer} | ratio |" for peer in peers))
    print("|---|---:|" + "---:|---:|" * len(peers))
    for what, of_program in rates.items():
        medians = {name: statistics.median(values) / 1e6 for name, values in of_program.items()}
        for name, text in names.items():
            row = f"| {what}, {text} | {medians[name]:.2f} |"
            for peer in peers:
                ratio = medians[name] / medians[peer]
                row += f" {medians[peer]:.2f} | {ratio:.2f} |" if name == "decode" else " | |"
            print(row)


if __name__ == "__main__":
    main()
