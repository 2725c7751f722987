"""`albtpu-query surface` and `report` of a survey of many points: time, memory and what reading takes.

Usage: surface_bench.py BUILD [--millions N] [--format netcdf,geotiff,bag] [--folder DIR]

Five lines of a simulated survey, 4.4 million points of the bottom, are annotated and then copied, each time 1.5 km
further, until there are enough. `surface --partial` reads as much and makes no nodes; `report` has the verdict of the
nodes, too, with and without its page. Prints a Markdown table.
"""

import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

import bench
import las_bench

POINTS = 4.42e6  # of the bottom, in one block
STEP = 1500.0  # m
COLUMNS = 4
SURVEY = """
[sensor]
name = "riegl-vq-880-g"
lever_arm = [0.3, -0.2, 0.5]
[trajectory]
files = ["{flight}/sbet.out"]
errors = ["{flight}/smrmsg.out"]
[surface]
classes = [41]
[sea]
wind_speed = 5
wind_from = 250
[water]
column = "none"
[datum]
sigma = 0.05
[output]
classes = [40]
coverage = "p95"
details = true
"""


def annotate(build, folder):
    flight, annotated = folder / "flight", folder / "annotated"
    subprocess.run([build / "tests/flights/albtpu_simulated_survey", flight, "--lines", "4", "--cross-lines", "1",
                    "--seconds", "10", "--pulse-rate", "100000", "--file-for-each-line", "--range-noise", "0.02"],
                   check=True)
    annotated.mkdir()
    survey = folder / "survey.toml"
    survey.write_text(SURVEY.format(flight=flight))
    las_bench.run((build / "bin/albtpu-query", "las", flight, "--output-dir", annotated, "--survey", survey, "--table",
                   bench.TABLES / "survey.h5"))
    shutil.rmtree(flight)
    return annotated


def move(source, target, east, north):
    """A copy of a LAS file whose header places it elsewhere."""
    shutil.copyfile(source, target)
    shutil.copyfile(f"{source}.json", f"{target}.json")
    with open(target, "r+b") as file:
        head = bytearray(file.read(227))
        for at, shifts in ((155, (east, north)), (179, (east, east, north, north))):
            values = struct.unpack_from(f"<{len(shifts)}d", head, at)
            struct.pack_into(f"<{len(shifts)}d", head, at, *(a + b for a, b in zip(values, shifts)))
        file.seek(0)
        file.write(head)


def rows(options, folder):
    one, survey = annotate(options.build, folder), folder / "survey"
    survey.mkdir()
    for block in range(max(round(options.millions * 1e6 / POINTS), 1)):
        for file in sorted(one.glob("*.las")):
            move(file, survey / f"{block:02}_{file.name}", block % COLUMNS * STEP, block // COLUMNS * STEP)
    command = (options.build / "bin/albtpu-query", "surface", survey)
    part, output, made = folder / "survey.part", folder / "surface", folder / "report"
    report = (command[0], "report", survey, "--output", made, "--surface", output, "--overwrite")
    for what, run, files in (("read alone (`--partial`)", (*command, "--partial", part), ()),
                             ("surface", (*command, "--output", output, "--format", options.format), (output,)),
                             ("report with nodes, without page", (*report, "--no-page"), (made,)),
                             ("report with nodes", report, (made,)),
                             ("its page alone", (sys.executable, "-m", "albtpu.report", made), ())):
        elapsed, processor, peak = las_bench.run(run)
        files = " ".join(f"{path.name} {path.stat().st_size / 1e6:.0f}" for each in files
                         for path in sorted(each.iterdir()))
        yield what, f"{elapsed:.0f}", f"{processor:.0f}", f"{peak:.0f}", files
        part.unlink(missing_ok=True)


def main():
    parser = bench.parser(__doc__, millions=20.0)
    parser.add_argument("--format", default="netcdf")
    parser.add_argument("--folder", help="where to write the files, 320 bytes for each point")
    options = parser.parse_args()
    os.environ["PYTHONPATH"] = str(pathlib.Path(__file__).resolve().parents[2] / "clients/python/src")
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        bench.print_table(("what", "s", "CPU s", "MB", "MB written"), rows(options, pathlib.Path(folder)))


if __name__ == "__main__":
    main()
