"""What is recorded of a version, and asked of later ones: runs of albtpu-query, calls by the wire and by Python.

Files are named relative to the folder of a run, which begins with `input/`, `lines/` and `tables/` of a version.
"""

import json
import os
import pathlib
import shutil
import sys

for folder in ("e2e", "programs/query"):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / folder))
from commands import run  # noqa: E402
from las_file import LasFile  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
VERSIONS = sorted(path.parent for path in HERE.glob("*/input"))
PULSE = ("--incidence", "10", "--footprint", "0.6", "--depth", "8")
WIND = ("--wind-speed", "5", "--azimuth", "30", "--table-name", "winds")
WAVES = ("--hs", "0.6", "--tp", "3.2", "--waves-from", "230", "--swell", "1.1,9.5,295", "--sea-depth", "12",
         "--wind-speed", "6")
THEN = ("--coverage", "2sigma")  # What 0.1.0 takes where nothing is said.
LINE = ("--trajectory", "sbet.out", "--lever-arm", "0.3,-0.2,0.5", "--water-classes", "41", "--water-level", "-25",
        "--wind-speed", "5", "--divergence", "1", "--details", "--table-name", "winds")

# Arguments of albtpu-query. What a run prints is kept under the name before it, if it has one.
ANNOTATE = (
    ("", "las", "lines", "--output-dir", "annotated", "--survey", "survey.toml", "--table-name", "winds"),
    ("", "las", "lines/flight_1.las", "sea.laz", *LINE, *THEN, "--standard-errors"),
    ("", "csv", "pulses.csv", "answers.csv", "--standard-errors", "--s44-order", "1b", "--table-name", "winds",
     *THEN),
    ("", "csv", "totals.csv", "total_answers.csv", "--survey", "totals.toml", "--details", "--table-name", "winds",
     *THEN))
PRINT = (
    ("pulse.json", "pulse", *PULSE, *WIND, *THEN, "--standard-errors", "--s44-order", "1b", "--json"),
    ("waves.json", "pulse", *PULSE, *WAVES, *THEN, "--json"),
    ("total.json", "pulse", "--survey", "totals.toml", "--table-name", "winds", *PULSE, "--beam-azimuth", "90",
     "--altitude", "400", *THEN, "--json"),
    ("sea.json", "sea", *WAVES, "--json"),
    ("trajectory.json", "trajectory", "sbet.out", "--json"),
    ("sensor.json", "sensors", "sensor.toml", "--json"),
    ("plan.json", "plan", "--survey", "totals.toml", "--table-name", "winds", "--altitude", "400", "--order", "1b",
     "--altitudes", "300,400", "--winds", "3,5", "--json"))
JUDGE = (
    ("", "report", "annotated", "--output", "report", "--no-page", "--s44-order", "1b"),
    ("crosscheck.json", "crosscheck", "annotated", "--json"))
# What is in place of `column = "none"` where the water column counts.
WATER = """kd = 0.15
kd_kind = "diffuse532"
detector = "peak"
field_of_view = 6
pulse_length = 1.5
bias = "none"
"""
# Through a server, with the files and texts of the same runs without.
SERVED = (ANNOTATE[1], ANNOTATE[2], ANNOTATE[3], *PRINT[:3])


def copy_input(version, folder):
    """The files of a survey, older than anything that is made of them."""
    shutil.copytree(version / "input", folder, dirs_exist_ok=True)
    for name in ("lines", "tables"):
        shutil.copytree(version / name, folder / name)
    for path in folder.rglob("*"):
        os.utime(path, (1e9, 1e9))
    (folder / "annotated").mkdir()


def write_check_points(folder):
    """Some annotated points of the bottom, each with an elevation 1 cm off."""
    las = LasFile(folder / "annotated/flight_1.las")
    xyz = [las.field(4 * axis, "<i4") * las.scale[axis] + las.offset[axis] for axis in range(3)]
    bottom = [i for i, each in enumerate(las.classes) if each == 40]
    rows = [f"{xyz[0][i]:.3f},{xyz[1][i]:.3f},{xyz[2][i] + 0.01:.3f},NVA" for i in bottom[::len(bottom) // 20]]
    (folder / "points.csv").write_text("\n".join(["x,y,elevation,class", *rows]) + "\n")


def make(query, folder, runs, *flags):
    """Runs albtpu-query in the folder, where `tables` has the tables."""
    for output, *arguments in runs:
        result = run(query, *arguments, *flags, cwd=folder, environment={"ALBTPU_TABLES": str(folder / "tables")})
        if result.returncode != 0:
            raise AssertionError(f"albtpu-query {' '.join(arguments)}: {result.stderr}")
        if output:
            (folder / output).write_text(result.stdout)


def python_answers(address, environment):
    """The answers that the package of Python on the path gets from a server, as python_calls.py prints them."""
    result = run(sys.executable, "-B", HERE / "python_calls.py", address, environment=environment)
    if result.returncode != 0:
        raise AssertionError(f"python_calls.py: {result.stderr}")
    return json.loads(result.stdout)
