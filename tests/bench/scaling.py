"""The cost of a table as a function of its axes and its error: prints the tables of docs/scaling.md.

Usage: scaling.py BUILD_FOLDER

Times are those of one core, by `albtpu-generate table --threads 1` on small campaigns about a moderate case.
"""

import pathlib
import subprocess
import sys
import tempfile
import time

GENERATE = pathlib.Path(sys.argv[1]) / "bin/albtpu-generate"
MODERATE = {"wind_speed": [6, 8], "fetch": ["20000", "inf"], "incidence": [0, 5, 15, 25], "azimuth": [0, 45, 90],
            "footprint": [0.5, 1], "depth": [0, 1, 60], "relative_error": None, "most": 64}


def campaign(folder, **changes):
    values = {**MODERATE, **changes}
    axes = "\n".join(f"{name} = [{', '.join(map(str, values[name]))}]" for name in
                     ("wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth"))
    error = f"relative_error = {values['relative_error']}\n" if values["relative_error"] else ""
    path = folder / "campaign.toml"
    path.write_text(f'id = "scaling"\nversion = "1"\ntitle = "Scaling"\n[axes]\n{axes}\n[effort]\nrealizations = 64\n'
                    f'most_realizations = {values["most"]}\n{error}[interpolation]\nchecked_pulses = 1\n')
    sea_cases = len(values["wind_speed"]) * len(values["fetch"]) * len(values["footprint"])
    return path, sea_cases


def cost(**changes):
    """Seconds of one core per sea case."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path, sea_cases = campaign(folder, **changes)
        times = []
        for _ in range(3):
            start = time.monotonic()
            subprocess.run([GENERATE, "table", "--campaign", path, "--output", folder / "table.h5", "--overwrite",
                            "--threads", "1"], check=True, capture_output=True)
            times.append(time.monotonic() - start)
        return sorted(times)[1] / sea_cases


def rows(title, name, values):
    print(f"\n| {title} | one core, per sea case | relative to the first |\n|---|---:|---:|")
    first = None
    for label, value in values:
        seconds = cost(**(value if isinstance(value, dict) else {name: value}))
        first = first or seconds
        print(f"| {label} | {seconds:.2f} s | {seconds / first:.2f} |", flush=True)


rows("beams (incidences x azimuths)", None, [
    ("4 x 1", {"azimuth": [45]}), ("4 x 3", {}), ("8 x 3", {"incidence": [0, 2, 5, 10, 15, 19, 22, 25]}),
    ("8 x 6", {"incidence": [0, 2, 5, 10, 15, 19, 22, 25], "azimuth": [0, 18, 36, 54, 72, 90]})])
rows("depths", "depth", [("3", [0, 1, 60]), ("12", [0, 1, 2, 3, 5, 8, 12, 18, 25, 35, 45, 60])])
rows("wind, m/s", None,
     [(str(wind), {"wind_speed": [wind, wind + 0.1], "fetch": ["2000", "inf"]}) for wind in (2, 5, 15)])
rows("footprint, m", "footprint", [(str(d), [d, round(d * 1.02, 4)]) for d in (0.1, 0.5, 2, 5)])
rows("footprint, m, at 2 m/s and 1 km of fetch", None,
     [(str(d), {"wind_speed": [2, 2.1], "fetch": ["1000", "1100", "inf"], "footprint": [d]}) for d in (0.5, 2, 5)])
rows("requested standard error", None,
     [(f"{100 * error:g} %", {"relative_error": error, "most": 100000, "depth": [1, 60]}) for error in
      (0.01, 0.003, 0.001)])
