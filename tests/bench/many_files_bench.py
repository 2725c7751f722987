"""`albtpu-query las` over many short files, each with a trajectory of its own: the time of one does not grow with them.

Usage: many_files_bench.py BUILD [--counts 2500,5000,10000] [--folder DIR]

Prints a Markdown table: milliseconds of elapsed and of processor time for each file, and those of `--resume` over all.
"""

import pathlib
import shutil
import subprocess
import tempfile

import bench
import las_bench
import short_files


def rows(options, folder):
    survey = folder / "survey"
    subprocess.run([options.build / "tests/flights/albtpu_simulated_survey", survey, "--seconds", "4", "--seed", "3",
                    "--start", "1000", "--sbet-rate", "50"], check=True)
    counts = [int(count) for count in options.counts.split(",")]
    files = short_files.make(next(survey.glob("*.las")), folder, max(counts))
    for count in counts:
        for name, suffix in (("in", "las"), ("trajectories", "sbet")):
            shutil.rmtree(folder / name, ignore_errors=True)
            (folder / name).mkdir()
            for file in files[:count]:
                source = folder / suffix / f"{file.stem}.{suffix}"
                (folder / name / source.name).hardlink_to(source)
        shutil.rmtree(folder / "out", ignore_errors=True)
        (folder / "out").mkdir()
        command = (options.build / "bin/albtpu-query", "las", folder / "in", "--output-dir", folder / "out",
                   "--trajectory", folder / "trajectories", "--lever-arm", "0.3,-0.2,0.5", "--water-level", "-25",
                   "--classes", "40", "--divergence", "1", "--wind-speed", "6", "--table", options.table, "--details")
        elapsed, processor, peak = las_bench.run(command)
        resumed, _, _ = las_bench.run((*command, "--resume"))
        yield (str(count), f"{1e3 * elapsed / count:.1f}", f"{1e3 * processor / count:.1f}", f"{peak:.0f}",
               f"{1e3 * resumed / count:.2f}")


def main():
    parser = bench.parser(__doc__)
    parser.add_argument("--counts", default="2500,5000,10000")
    parser.add_argument("--table", type=pathlib.Path, default=bench.TABLES / "survey.h5")
    parser.add_argument("--folder", help="where to write the files, 150 kB each")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        bench.print_table(("files", "ms a file", "CPU ms a file", "MB", "ms a file to resume"),
                          rows(options, pathlib.Path(folder)))


if __name__ == "__main__":
    main()
