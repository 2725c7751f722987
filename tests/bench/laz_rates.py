"""Points of LAZ files decoded and encoded in a second, compared with laz-perf and laz-rs as WebAssembly.

Usage: laz_rates.py BUILD [--millions N] [--runs N] [--samples FOLDER]

Files: a simulated survey (point format 6), and the sample autzen_trim.laz (format 3) if it is there, whose points are
repeated, each time moved and later. All programs decode the same files in turn; a file is decoded RUNS times by each.
Prints a Markdown table of medians: of processor time on one core, of elapsed time on two, which needs an idle machine.
The peers need node and npm.
"""

import pathlib
import statistics
import sys
import tempfile

import bench
import independent_decoders

ROUNDS = 3  # In which the programs take turns.


def make_files(options, folder):
    """The LAZ files, by what they are."""
    points = int(options.millions * 1e6)
    sources = {"simulated survey, format 6": bench.simulated_survey(options.build, folder)}
    sample = options.samples / "autzen_trim.laz"
    if sample.exists():
        sources["sample of a survey, format 3"] = bench.laz_copy(options.build, sample, folder / "sample.las")
    files = {}
    for i, (what, source) in enumerate(sources.items()):
        las = bench.repeat(source, folder / "repeated.las", points, steps=100_000, seconds=86_400.0)
        files[what] = bench.laz_copy(options.build, las, folder / f"{i}.laz")
        las.unlink()
    return files


def measure(options, folder, files, peers):
    """{what: {of which program: [points per second of each run]}}"""
    rates = {what: {} for what in files}
    for _ in range(ROUNDS):
        for what, file in files.items():
            ours = bench.run_json(options.build / "tests/bench/albtpu_laz_rate", file, options.runs)
            seconds = {name: ours[name] for name in ("decode", "encode", "decode_two", "encode_two")}
            for peer in peers:
                answer, = independent_decoders.decode(options.decoders, peer, [file], folder, options.runs + 1)
                if len(answer["records"]) == 0 or answer["points"] != ours["points"]:
                    sys.exit(f"laz_rates.py: {peer} cannot decode {file}: {answer.get('error')}")
                seconds[peer] = answer["seconds"][1:]  # The first run compiles it.
            for name, values in seconds.items():
                rates[what].setdefault(name, []).extend(ours["points"] / value for value in values)
    return rates


def rows(rates, peers):
    for what, of_program in rates.items():
        medians = {name: statistics.median(values) / 1e6 for name, values in of_program.items()}
        for name, text in (("decode", "decoded"), ("encode", "encoded"), ("decode_two", "decoded on two cores"),
                           ("encode_two", "encoded on two cores")):
            cells = [f"{what}, {text}", f"{medians[name]:.2f}"]
            for peer in peers:
                rate, ratio = f"{medians[peer]:.2f}", f"{medians[name] / medians[peer]:.2f}"
                cells += [rate, ratio] if name == "decode" else ["", ""]
            yield cells


def main():
    parser = bench.parser(__doc__, millions=2.2, runs=3)
    parser.add_argument("--samples", type=pathlib.Path, default=bench.SOURCE.parent / "shared/data/laz")
    parser.add_argument("--decoders", type=pathlib.Path, help="folder that keeps the peers")
    options = parser.parse_args()
    options.decoders = options.decoders or options.build / "tests/laz/laz_decoders"
    peers = list(independent_decoders.PACKAGES)
    try:
        independent_decoders.fetch(options.decoders)
    except independent_decoders.Unavailable as reason:
        print(f"laz_rates.py: no peers: {reason}", file=sys.stderr)
        peers = []
    with tempfile.TemporaryDirectory() as folder:
        rates = measure(options, pathlib.Path(folder), make_files(options, pathlib.Path(folder)), peers)
    bench.print_table(("million points/s", "ours", *(head for peer in peers for head in (peer, "ratio"))),
                      rows(rates, peers))


if __name__ == "__main__":
    main()
