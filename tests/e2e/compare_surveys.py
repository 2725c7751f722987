"""For compare_builds.py: what two builds make of a simulated survey, in every way that a survey can be given.

Inputs are made once. Each build runs in a folder of its own, under the same relative names. Tables, points and columns
must be equal byte by byte, the version and the commit aside. Texts (standard output, summaries, pages) are printed
where they differ, for the reader to judge; the numbers in them must be equal, one by one.
"""

import difflib
import json
import os
import pathlib
import re
import subprocess
import sys

import serving

COUNTED = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
SHOWN = 12  # lines of the differences of a text
TEXTS = (".json", ".html", ".txt", ".toml")
CMAKE = """
cmake_minimum_required(VERSION 3.25)
project(probe LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(albtpu REQUIRED CONFIG COMPONENTS client)
add_executable(probe {source})
target_link_libraries(probe PRIVATE albtpu::client)
"""
PYTHON = """
import sys, numpy as np, albtpu
pulses = dict(np.load(sys.argv[1]))
aircraft = {name: pulses.pop(name) for name in list(pulses) if name in ("roll", "pitch", "heading", "heading_sigma",
            "velocity_north", "velocity_east", "velocity_down", "position_sigma_north", "position_sigma_down")}
def numbers(budget):
    return b"".join(np.asarray(budget.values[name]).tobytes() for name in albtpu.BUDGET_QUANTITIES)
errors = dict(position=(0.03, 0.03, 0.05), attitude=(0.0025, 0.0025, 0.005), boresight=(0.001, 0.001, 0.004),
              lever_arm=0.02, scan=0.001, time=1e-5, range_offset=0.01, bottom_range=0.025, surface_range=0.02,
              surface_height=0.05, index=0.001)
with albtpu.connect(sys.argv[2]) as service, open(sys.argv[3], "wb") as output:
    for located in ("pulse", "local", "level"):
        for coverage in ("2sigma", "p95"):
            output.write(numbers(service.query_budget(**pulses, aircraft=aircraft, errors=errors, located=located,
                lever_arm=(0.3, -0.2, 0.5), datum=0.08, sea_axis=250, coverage=coverage,
                quantities=albtpu.BUDGET_QUANTITIES)))
    bare = service.query_budget(**pulses, aircraft=aircraft, located="local", datum=0.08, sea_axis=250,
                                quantities=("total_thu", "total_tvu"))
    open(sys.argv[4], "wb").write(bare.total_thu.tobytes() + bare.total_tvu.tobytes())
"""

FLIGHT = """
[sensor]
name = "riegl-vq-880-g"
lever_arm = [0.3, -0.2, 0.5]
[trajectory]
files = ["flight/sbet.out"]
errors = ["flight/smrmsg.out"]
[surface]
classes = [41]
[sea]
wind_speed = 6.5
wind_from = 100
[datum]
sigma = 0.08
[output]
classes = [40]
details = true
"""
DRY = '[water]\ncolumn = "none"\n'
WET = """[water]
temperature = 24
salinity = 36
kd = 0.15
kd_kind = "diffuse532"
detector = "peak"
field_of_view = 6
pulse_length = 1.5
"""
NUMBERS = """
[sensor]
name = "riegl-vq-880-g"
lever_arm = [0.3, -0.2, 0.5]
[surface]
located = "{located}"
[sea]
wind_speed = 6.5
wind_from = 100
[datum]
sigma = 0.08
"""
SIGMA = """[sigma]
position = [0.03, 0.03, 0.05]
attitude = [0.0025, 0.0025, 0.005]
boresight = [0.001, 0.001, 0.004]
lever_arm = 0.02
scan = 0.001
time = 1e-5
range_offset = 0.01
bottom_range = 0.025
surface_height = 0.05
index = 0.001
"""
WAVES = NUMBERS.replace("[datum]", "[[sea.waves]]\nhs = 0.6\ntp = 3.2\nwaves_from = 230\n[datum]")
TREATED = {"correct": 'bias = "correct"\n', "vendor": 'bias = "vendor"\nresidual_fraction = 0.1\n',
           "photons": 'bias = "none"\nphotons = 100\n', "processed": 'bias = "none"\nprocessed_with = 1.33\n',
           "calibrated": 'bias = "calibrated"\ncalibration = {depth = 5, offset = -0.03, sigma = 0.005}\n'}
SETTINGS = {
    "flight_dry": FLIGHT + DRY, "flight_wet": FLIGHT + WET + 'bias = "none"\n',
    "flight_2sigma": FLIGHT.replace("details", 'coverage = "2sigma"\ns44_order = "1a"\ndetails') + DRY + SIGMA,
    "returns": FLIGHT.replace('files = ["flight/sbet.out"]\nerrors = ["flight/smrmsg.out"]',
                              "from_returns = true") + DRY,
    **{f"pulse_{located}": NUMBERS.format(located=located) + DRY + SIGMA for located in ("pulse", "local", "level")},
    "pulse_assumed": NUMBERS.format(located="local") + DRY,
    "pulse_wet": NUMBERS.format(located="local") + WET + 'bias = "none"\n',
    **{f"pulse_{name}": NUMBERS.format(located="local") + WET + text for name, text in TREATED.items()},
    "pulse_waves": WAVES.format(located="local") + DRY,
    # Refused by a range, a unit, an unknown key, a missing decision or a contradiction; at least by some commands.
    "bad_index": NUMBERS.format(located="local") + '[water]\ncolumn = "none"\nindex = 1.7\n',
    "bad_scan": NUMBERS.format(located="local") + DRY + "[sigma]\nscan = 1e-6\n",
    "bad_key": NUMBERS.format(located="local") + DRY + "[sigma]\nscann = 0.001\n",
    "bad_sensor": NUMBERS.format(located="local").replace("riegl-vq-880-g", "riegl") + DRY,
    "bad_no_water": NUMBERS.format(located="local"),
    "bad_no_datum": NUMBERS.format(located="local").replace("sigma = 0.08", "") + DRY,
    "bad_two_waters": NUMBERS.format(located="local") + WET + "secchi = 5\n",
}
SERVED = ("pulse_wet.csv", "details.csv", "flight_wet.las", "flight_2sigma.laz")  # Made again through a server.
PULSE = ("--incidence", "20", "--beam-azimuth", "90", "--altitude", "400", "--depth", "10", "--json")


def runs(lines):
    """Arguments of albtpu-query; outputs of earlier ones are inputs of later ones. `lines`: the names of LAS files."""
    first = f"in/flight/{lines[0]}.las"
    for name in SETTINGS:
        if not name.startswith(("flight", "returns")):
            yield "pulse", "--survey", f"in/{name}.toml", *PULSE
    yield ("pulse", "--survey", "in/pulse_pulse.toml", *PULSE, "--attitude", "3,4,30", "--velocity", "60,35,0",
           "--rates", "0.5,1,1.5")
    yield "pulse", "--wind-speed", "7", "--incidence", "12", "--footprint", "0.5", "--depth", "8", "--standard-errors"
    for name in ("pulse_local", "pulse_level", "pulse_wet", "pulse_waves"):
        yield "csv", "in/totals.csv", f"{name}.csv", "--survey", f"in/{name}.toml"
    for name in (name for name in SETTINGS if name.startswith("bad_")):
        yield "csv", "in/totals.csv", f"{name}.csv", "--survey", f"in/{name}.toml"
        yield "las", first, f"{name}.las", "--survey", f"in/{name}.toml", "--trajectory", "in/flight/sbet.out"
    yield "csv", "in/totals.csv", "details.csv", "--survey", "in/pulse_wet.toml", "--details", "--s44-order", "1b"
    yield ("las", first, "sea.las", "--trajectory", "in/flight/sbet.out", "--lever-arm", "0.3,-0.2,0.5",
           "--water-classes", "41", "--wind-speed", "6", "--wind-from", "250", "--divergence", "1", "--classes", "40",
           "--details", "--standard-errors")
    for name, suffix in (("flight_dry", "las"), ("flight_wet", "las"), ("flight_wet", "laz"), ("flight_2sigma", "laz"),
                         ("returns", "las")):
        yield "las", first, f"{name}.{suffix}", "--survey", f"in/{name}.toml"
    yield "las", "flight_wet.laz", "again.las", "--survey", "in/flight_dry.toml", "--replace"
    yield "las", "in/flight", "--output-dir", "annotated", "--survey", "in/flight_wet.toml", "--coverage", "p95"
    yield "report", "annotated", "--output", "report", "--s44-order", "1b"
    yield "report", "annotated", "--output", "report_usgs", "--spec", "usgs", "--class", "QL2B", "--cell", "5"
    yield "crosscheck", "annotated", "--json"
    yield "crosscheck", "annotated", "--patch", "3"
    yield "plan", "--survey", "in/pulse_assumed.toml", "--altitudes", "300", "--json"
    yield "trajectory", "in/flight/sbet.out", "in/flight/trajectory.txt"
    yield "sea", "in/sea.csv", "--json"
    yield "sea", "in/sea.csv", "--sea-time", "2022-03-08T08:00Z", "--output", "sea.h5"
    yield ("las", first, "of_a_sea.las", "--survey", "in/flight_dry.toml", "--sea", "in/sea.csv", "--sea-time",
           "2022-03-08T08:00Z")
    yield "sensors",
    yield "sensors", "riegl-vq-880-g"
    yield "tables",


def write_sea(path):
    """Two spectra of waves with a peak at 0.2 Hz."""
    lines = ["time,f,E,r2,alpha2"]
    for time, energy, direction in (("2022-03-08T07:00Z", 0.08, 230), ("2022-03-08T08:00Z", 0.12, 240)):
        for f in (0.05 * i for i in range(1, 11)):
            lines.append(f"{time},{f:.2f},{energy * min(f / 0.2, (0.2 / f) ** 4):.6g},0.4,{direction}")
    path.write_text("\n".join(lines) + "\n")


def totals_of_pulses(count):
    """Columns of pulses with what totals need; some beyond the table."""
    import numpy as np
    generator = np.random.default_rng(9)
    ranges = {"incidence": (0, 26), "footprint": (0.3, 2), "depth": (0, 30), "altitude": (100, 800),
              "beam_azimuth": (0, 360), "roll": (-20, 20), "pitch": (-5, 5), "heading": (0, 360),
              "velocity_north": (-80, 80), "velocity_east": (-80, 80), "velocity_down": (-3, 3)}
    return {name: generator.uniform(low, high, count).astype(np.float32) for name, (low, high) in ranges.items()}


def make_inputs(folder, simulated_survey, count):
    """Returns the names of the files of points."""
    import numpy as np
    folder.mkdir()
    subprocess.run([simulated_survey, folder / "flight", "--lines", "2", "--cross-lines", "1", "--seconds", "6",
                    "--pulse-rate", "3000", "--file-for-each-line"], check=True)
    for name, text in SETTINGS.items():
        (folder / f"{name}.toml").write_text(text)
    write_sea(folder / "sea.csv")
    columns = totals_of_pulses(count)
    np.savetxt(folder / "totals.csv", np.stack(list(columns.values()), 1), "%.9g", ",", header=",".join(columns),
               comments="")
    generator = np.random.default_rng(10)
    extra = {"wind_speed": (3, 10), "azimuth": (-180, 180), "heading_sigma": (0, 0.1), "position_sigma_north": (0, 0.1),
             "position_sigma_down": (0, 0.1)}
    columns |= {name: generator.uniform(low, high, count).astype(np.float32) for name, (low, high) in extra.items()}
    np.savez(folder / "budget.npz", **columns)
    np.concatenate([columns[name] for name in (
        "wind_speed", "incidence", "azimuth", "footprint", "depth", "altitude", "beam_azimuth", "roll", "pitch",
        "heading", "velocity_north", "velocity_east", "velocity_down", "position_sigma_north", "position_sigma_down",
        "heading_sigma")]).tofile(folder / "budget.f32")
    return json.loads((folder / "flight/survey.json").read_text())["files"]


class Side:
    """One build at work in a folder, with a server."""

    def __init__(self, build, folder):
        self.build, self.folder = build, folder
        (folder / "annotated").mkdir(parents=True)
        (folder / "in").symlink_to("../in")
        self.server = serving.Server(build.programs["albtpu-serve"], "--tables", build.tables)

    def query(self, command, served):
        """The exit code and the texts of a command, in `served` with a server."""
        where = ("--server", self.server.address) if served else ()
        done = self.build.run("albtpu-query", *command, *where, cwd=self.folder)
        return done.returncode, *(text_of(self.build, text.replace(self.server.address, "SERVER"))
                                  for text in (done.stdout, done.stderr))

    def ask_in_python(self):
        subprocess.run([sys.executable, "-c", PYTHON, "in/budget.npz", self.server.address, "python.f32",
                        "bare_python.f32"], cwd=self.folder, env={**os.environ, "PYTHONPATH": self.build.python},
                       check=True)

    def ask_in_cpp(self):
        """Returns what the compiler says if it refuses."""
        folder = self.folder / "probe"
        folder.mkdir()
        (folder / "CMakeLists.txt").write_text(CMAKE.format(source=pathlib.Path(__file__).resolve().parent /
                                                            "budget_probe.cc"))
        for command in (["cmake", "-S", folder, "-B", folder / "out", f"-DCMAKE_PREFIX_PATH={self.build.prefix}",
                         "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", folder / "out"]):
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode:
                return done.stdout[-2000:] + done.stderr[-2000:]
        subprocess.run([folder / "out/probe", self.server.address, "in/budget.f32", "bare_cpp.f32"], cwd=self.folder,
                       check=True)
        return ""

    def made(self):
        paths = [path.relative_to(self.folder) for path in self.folder.rglob("*") if path.is_file()]
        return {path.as_posix() for path in paths if path.parts[0] not in ("in", "probe")}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.server.__exit__()


def text_of(build, text):
    """A text without version, commit, the place of the build and the times that work took."""
    text = build.without_origin(text.encode()).decode().replace(str(build.prefix), "PREFIX")
    return re.sub(r"^albtpu-query: .*(?: left|/s)\n", "", text, flags=re.MULTILINE)


def compare_texts(report, texts, what):
    """Prints how texts differ. Their numbers must not."""
    differs = report(COUNTED.findall(texts[0]) != COUNTED.findall(texts[1]), what)
    if texts[0] == texts[1]:
        return differs
    changed = [line for line in difflib.unified_diff(*(text.splitlines() for text in texts), lineterm="", n=0)
               if not line.startswith(("---", "+++", "@@"))]
    for line in changed[:SHOWN]:
        print("   ", line[:200])
    if len(changed) > SHOWN:
        print(f"    and {len(changed) - SHOWN} more lines")
    return differs


def compare_commands(sides, names, report):
    differs = False
    commands = [(command, False) for command in runs(names)]
    commands += [((*command[:2], f"served_{command[2]}", *command[3:]), True) for command, _ in commands
                 if command[0] in ("csv", "las") and command[2] in SERVED]
    for command, served in commands:
        shown = f"albtpu-query {' '.join(command)}{' --server SERVER' * served}"
        old, new = (side.query(command, served) for side in sides)
        untried = old[0] != 0 and "in/bad_" not in shown
        differs |= report(old[0] != new[0] or untried, f"exit code {new[0]} of {shown}")
        for of_old, of_new, name in zip(old[1:], new[1:], ("output", "errors")):
            if of_old != of_new or untried:
                differs |= compare_texts(report, (of_old, of_new), f"{name} of {shown}")
    return differs


def compare_files(sides, report, equal_tables):
    made = [side.made() for side in sides]
    differs = report(made[0] != made[1], f"names of {len(made[1])} files {sorted(made[0] ^ made[1])}")
    for name in sorted(made[0] & made[1]):
        contents = [side.build.without_origin((side.folder / name).read_bytes()) for side in sides]
        if name.endswith(TEXTS):
            differs |= compare_texts(report, [text_of(side.build, content.decode())
                                              for side, content in zip(sides, contents)], name)
        else:
            equal = equal_tables(*contents) if name.endswith((".h5", ".nc")) else contents[0] == contents[1]
            differs |= report(not equal, f"{name}, {len(contents[0])} bytes")
    return differs


def compare(old, new, folder, simulated_survey, count, report, equal_tables):
    """Returns whether results differ. `report` prints and returns whether something differs."""
    names = make_inputs(folder / "in", simulated_survey, count)
    with Side(old, folder / "old") as before, Side(new, folder / "new") as after:
        differs = compare_commands((before, after), names, report)
        for side in (before, after):
            side.ask_in_python()
            refused = side.ask_in_cpp()
            differs |= report(refused, f"budget_probe.cc compiles with {side.folder.name}{refused}")
        differs |= compare_files((before, after), report, equal_tables)
    ways = [("bare_python.f32", "bare_cpp.f32"), *((name, f"served_{name}") for name in SERVED)]
    for one, other in ways:
        files = [after.folder / name for name in (one, other)]
        equal = all(file.is_file() for file in files) and files[0].read_bytes() == files[1].read_bytes()
        differs |= report(not equal, f"{one} and {other} of the new build")
    return differs
