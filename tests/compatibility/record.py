"""Records what the programs of a version make, as a folder that later versions are tested against.

Usage: record.py SOURCE_FOLDER BUILD_FOLDER SIMULATED_SURVEY VERSION_FOLDER

The first three are of the version: its tree, its build and its albtpu_simulated_survey. PYTHONPATH names its package in
clients/python/src. VERSION_FOLDER does not exist yet; README.md describes what it then holds.
"""

import json
import pathlib
import shutil
import sys
import tempfile
import zipfile

from albtpu.v1 import uncertainty_service_pb2 as pb
from runs import ANNOTATE, JUDGE, PRINT, SERVED, HERE, copy_input, make, python_answers, run
from serving import Server, connect
from wire import Between, save

FLIGHT = ("--lines", 2, "--cross-lines", 1, "--seconds", 2, "--pulse-rate", 500, "--file-for-each-line",
          "--sbet-rate", 50, "--margin", 1, "--trajectory-errors")
CAMPAIGN = """id = "winds"
version = "1"
title = "Winds for tests"
[axes]
wind_speed = [3, 6]
fetch = [5000, inf]
incidence = [0, 25]
azimuth = [0, 90]
footprint = [0.3, 1]
depth = [0, 20]
[interpolation]
checked_pulses = 4
[effort]
realizations = 40
"""
SENSOR = """title = "Green scanner"
[scan]
value = 0.005
unit = "degree"
source = "calibration"
[bottom_range]
value = 0.025
unit = "m"
source = "calibration"
[divergence]
value = 1
unit = "mrad"
source = "data sheet"
"""
SURVEY = """[sensor]
name = "sensor.toml"
lever_arm = [0.3, -0.2, 0.5]
[trajectory]
files = ["sbet.out"]
errors = ["smrmsg.out"]
[surface]
classes = [41]
level = -25
[sea]
wind_speed = 5
wind_from = 250
[water]
column = "none"
[datum]
sigma = 0.08
[sigma]
boresight = [0.001, 0.001, 0.004]
[output]
classes = [40]
coverage = "p95"
s44_order = "1b"
details = true
"""
TOTALS = """[sensor]
name = "sensor.toml"
[surface]
located = "local"
[sea]
wind_speed = 5
wind_from = 250
[water]
column = "none"
[datum]
sigma = 0.08
"""
PULSES = """id,wind_speed,fetch,incidence,azimuth,footprint,depth
1,5,,10,30,0.6,8
2,4,6000,20,,0.5,3.25
3,6,inf,0,90,1,20
4,5,,10,30,0.6,21
"""
POINTS = """id,incidence,footprint,depth,altitude,beam_azimuth,roll
1,10,0.6,8,400,90,1
2,20,0.5,3.25,410,,0
"""
PULSES_REQUEST = pb.QueryPulsesRequest(
    options=dict(table="winds", coverage="COVERAGE_P95", standard_errors=True, best_s44_order=True,
                 s44_order="S44_ORDER_1B"),
    pulses=[dict(wind_speed=5, fetch=6000, incidence=20, azimuth=30, footprint=0.5, depth=8),
            dict(wind_speed=4, incidence=10, footprint=0.5, depth=25), dict(wind_speed=4)])


def write_input(build, simulated_survey, version):
    folder = version / "input"
    for name in ("input", "lines", "tables"):
        (version / name).mkdir(parents=True)
    for name, text in (("campaign.toml", CAMPAIGN), ("sensor.toml", SENSOR), ("survey.toml", SURVEY),
                       ("totals.toml", TOTALS), ("pulses.csv", PULSES), ("totals.csv", POINTS)):
        (folder / name).write_text(text)
    run(build / "bin/albtpu-generate", "table", "--campaign", folder / "campaign.toml", "--output",
        version / "tables/winds.h5").check_returncode()
    with tempfile.TemporaryDirectory() as flight:
        run(simulated_survey, flight, *FLIGHT).check_returncode()
        for path in pathlib.Path(flight).glob("*.las"):
            shutil.copy(path, version / "lines")
        for name in ("sbet.out", "smrmsg.out"):
            shutil.copy(pathlib.Path(flight, name), folder)


def record_calls(build, version, folder):
    """What albtpu-query and the package ask a server and are answered; the answers agree with those without one."""
    with Server(build / "bin/albtpu-serve", "--tables", version / "tables") as server, \
            Between(server.address) as between:
        served = folder / "served"
        copy_input(version, served)
        make(build / "bin/albtpu-query", served, SERVED, "--server", between.address)
        answers = python_answers(between.address, {})
        streamed = next(request for path, request, _ in between.kept if path.endswith("/StreamColumns"))
        with connect(between.address) as channel:
            for path, request in (("UncertaintyService/QueryPulses", PULSES_REQUEST.SerializeToString()),
                                  ("UncertaintyService/QueryColumns",
                                   pb.StreamColumnsRequest.FromString(streamed).query.SerializeToString()),
                                  ("AdminService/ReloadTables", b"")):  # No client has these.
                channel.unary_unary(f"/albtpu.v1.{path}")(request)
        (version / "python.json").write_text(json.dumps(answers, indent=1) + "\n")
        save(between.kept, version / "wire")


def main():
    source, build, simulated_survey, version = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    write_input(build, simulated_survey, version)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch, "made")
        copy_input(version, folder)
        make(build / "bin/albtpu-query", folder, ANNOTATE + PRINT + JUDGE)
        record_calls(build, version, pathlib.Path(scratch))
        for path in folder.rglob("*"):
            made = path.relative_to(folder)
            known = (version / made).exists() or (version / "input" / made).exists()
            if path.is_file() and path.suffix != ".nc" and not known:
                (version / made).parent.mkdir(exist_ok=True)
                shutil.copy(path, version / made)
    run("protoc", "-I", source / "proto", "--include_imports", f"--descriptor_set_out={version / 'wire.descriptors'}",
        *(source / "proto/albtpu/v1").glob("*.proto")).check_returncode()
    with zipfile.ZipFile(version / "python_client.zip", "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path in sorted((source / "clients/python/src").rglob("*.py")):
            archive.write(path, path.relative_to(source / "clients/python/src"))
    print(f"{version.relative_to(HERE)}: recorded")


if __name__ == "__main__":
    main()
