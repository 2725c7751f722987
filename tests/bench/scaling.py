"""The cost of a table as a function of its axes and its error: prints the tables of docs/scaling.md.

Usage: scaling.py BUILD_FOLDER

Times are those of one core, by `albtpu-generate table --threads 1` on small campaigns about a moderate case.
"""

import itertools
import pathlib
import subprocess
import tempfile
import time

import bench

GENERATE = bench.parser(__doc__).parse_args().build / "bin/albtpu-generate"
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


def print_costs(title, cases):
    costs = ((label, cost(**case)) for label, case in cases)
    first = next(costs)
    print()
    bench.print_table((title, "one core, per sea case", "relative to the first"),
                      ((label, f"{seconds:.2f} s", f"{seconds / first[1]:.2f}")
                       for label, seconds in itertools.chain([first], costs)))


EIGHT = [0, 2, 5, 10, 15, 19, 22, 25]
print_costs("beams (incidences x azimuths)",
            [("4 x 1", {"azimuth": [45]}), ("4 x 3", {}), ("8 x 3", {"incidence": EIGHT}),
             ("8 x 6", {"incidence": EIGHT, "azimuth": [0, 18, 36, 54, 72, 90]})])
print_costs("depths", [("3", {"depth": [0, 1, 60]}), ("12", {"depth": [0, 1, 2, 3, 5, 8, 12, 18, 25, 35, 45, 60]})])
print_costs("wind, m/s", [(str(wind), {"wind_speed": [wind, wind + 0.1], "fetch": ["2000", "inf"]})
                          for wind in (2, 5, 15)])
print_costs("footprint, m", [(str(d), {"footprint": [d, round(d * 1.02, 4)]}) for d in (0.1, 0.5, 2, 5)])
print_costs("footprint, m, at 2 m/s and 1 km of fetch",
            [(str(d), {"wind_speed": [2, 2.1], "fetch": ["1000", "1100", "inf"], "footprint": [d]})
             for d in (0.5, 2, 5)])
print_costs("requested standard error", [(f"{100 * error:g} %", {"relative_error": error, "most": 100000,
                                                                 "depth": [1, 60]}) for error in (0.01, 0.003, 0.001)])
