"""Seas for tests of albtpu-query, and what it says of them."""

import datetime
import json
import pathlib

import programs
from las_file import LasFile
from programs import query

PULSE = ("--incidence", 15, "--footprint", 0.6, "--depth", 8)
WAVES = ("--hs", 0.6, "--tp", 3.2, "--waves-from", 230, "--wind-speed", 6, "--wind-from", 225)
FLIGHT = ("--scanner", "across-track", "--flight-direction", 0, "--water-level", 0, "--footprint", 0.6)
FLIGHT_START = 1646724782  # s since 1970, UTC: 2022-03-08T07:33:02Z; albtpu_simulated_flight lasts 5.5 s
SAMPLES = pathlib.Path(programs.PATHS["sea_samples"])


def utc(seconds):
    text = datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    return text.replace(":00Z", "Z")  # As albtpu-query writes it.


def pulse(*flags):
    """The answer to `albtpu-query pulse` as JSON."""
    return json.loads(query("pulse", *PULSE, "--json", *flags, check=0).stdout)


def numbers(answer):
    return [answer[name] for name in ("refraction_along_wind", "refraction_cross_wind", "thu", "tvu",
                                      "bias_along_beam", "bias_vertical")]


def uncertainties(path):
    """sea_thu and sea_tvu of all points."""
    columns = LasFile(path).columns()
    return [columns[name] for name in ("sea_thu", "sea_tvu")]


class Test(programs.Test):
    def sea_csv(self, *states, name="sea.csv"):
        """Spectra with a peak at 0.2 Hz: `states` are (s since 1970, energy, direction)."""
        lines = ["time,f,E,r2,alpha2"]
        for time, energy, direction in states:
            for i in range(1, 11):
                f = 0.05 * i
                lines.append(f"{utc(time)},{f:.2f},{energy * min(f / 0.2, (0.2 / f) ** 4):.6g},0.4,{direction}")
        path = self.folder / name
        path.write_text("\n".join(lines) + "\n")
        return path
