"""Simulated surveys of which the truth is known, for tests of albtpu-query (tests/flights)."""

import atexit
import json
import shutil
import subprocess
import tempfile

import numpy as np

import programs
from las_file import LasFile

BOTTOM, SURFACE, COLUMN, LAND = range(4)  # Kinds of returns in the truth.
DIVERGENCE = 1.0  # mrad; albtpu_simulated_survey's own unless another is given
SBET_FIELDS = ("time", "latitude", "longitude", "height", "velocity_x", "velocity_y", "velocity_z", "roll", "pitch",
               "heading", "wander")


_made = {}  # Folders by flags: the tests of a script often begin with the same survey.


def _make(folder, flags):
    if flags in _made:
        shutil.copytree(_made[flags], folder, dirs_exist_ok=True)
        return
    made = tempfile.TemporaryDirectory(prefix="albtpu_survey_")
    atexit.register(made.cleanup)
    subprocess.run([programs.PATHS["simulated_survey"], made.name, *flags], check=True)
    shutil.copytree(made.name, folder, dirs_exist_ok=True)
    _made[flags] = made.name


class SimulatedSurvey:
    """A folder with what albtpu_simulated_survey writes with `flags`."""

    def __init__(self, folder, *flags):
        self.folder = folder
        _make(folder, tuple(map(str, flags)))
        self.about = json.loads((folder / "survey.json").read_text())
        self.water_level = self.about["water_level"]  # In the unit and datum of the points.
        self.names = self.about["files"]
        self.las = folder / f"{self.names[0]}.las"
        self.sbet = folder / "sbet.out"
        self.errors = folder / "smrmsg.out"
        self.ascii = folder / "trajectory.txt"

    def truth(self, name=None):
        """The columns of the truth of a file, by their names."""
        columns = self.about["truth_columns"]
        rows = np.fromfile(self.folder / f"{name or self.names[0]}.truth", "<f8").reshape(-1, len(columns))
        return dict(zip(columns, rows.T))

    def records(self):
        """The SBET: a row for each record, of 17 numbers."""
        return np.fromfile(self.sbet, "<f8").reshape(-1, 17)

    def write_sbet(self, name, records=None, **changes):
        """Another SBET: `records` or the right ones, with fields replaced by functions of the field."""
        records = (self.records() if records is None else records).copy()
        for field, change in changes.items():
            at = SBET_FIELDS.index(field)
            records[:, at] = change(records[:, at])
        path = self.folder / name
        records.astype("<f8").tofile(path)
        return path


def degrees_apart(first, second):
    return (first - second + 180) % 360 - 180


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


class Details:
    """What `albtpu-query las --details` wrote for each point, in double precision."""

    def __init__(self, path):
        columns = LasFile(path).columns()
        for name in ("sea_thu", "sea_tvu", "incidence", "beam_azimuth", "footprint", "water_depth", "slant_range"):
            setattr(self, name, columns[name])
