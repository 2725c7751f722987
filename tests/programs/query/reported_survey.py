"""A simulated flight of some lines and a cross line, annotated and reported once for all tests of a script."""

import json
import pathlib
import tempfile
import unittest

import numpy as np

import programs
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

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
sigma = {datum}
name = "Chart datum of Mine"
[extra]
horizontal = 0.06
vertical = 0.04
[output]
classes = [40]
coverage = "{coverage}"
details = true
[project]
name = "Harbour of Mine"
number = "17"
client = "The port's <office>"
"""
LINES = 4  # And a cross line.


def annotate(flight, output, table, datum=0.05, coverage="p95"):
    output.mkdir(exist_ok=True)
    survey = output.with_suffix(".toml")
    survey.write_text(SURVEY.format(flight=flight, datum=datum, coverage=coverage))
    return query("las", flight, "--output-dir", output, "--survey", survey, "--table", table, check=0)


class Survey:
    """A flight of a few lines, annotated and reported once for all tests."""

    def __init__(self, folder, *flags):
        self.flight = SimulatedSurvey(folder / "flight", "--lines", LINES, "--cross-lines", 1, "--seconds", 5,
                                      "--pulse-rate", 1000, "--file-for-each-line").folder
        self.annotated = folder / "annotated"
        self.one_table = programs.make_table(folder / "quick.h5")
        self.annotation = annotate(self.flight, self.annotated, self.one_table).stderr
        self.made = folder / "report"
        self.said = query("report", self.annotated, "--output", self.made, *flags, check=0).stdout
        self.json = json.loads((self.made / "report.json").read_text())
        self.points = self.read(self.annotated)

    @staticmethod
    def read(folder):
        """The points of the bottom: x, y, and the numbers by name."""
        columns = {}
        for path in sorted(folder.glob("*.las")):
            las = LasFile(path)
            bottom = las.classes == 40
            for axis, name in enumerate("xyz"):
                values = las.field(4 * axis, "<i4") * las.scale[axis] + las.offset[axis]
                columns.setdefault(name, []).append(values[bottom])
            columns.setdefault("line", []).append(las.field(20, "<u2")[bottom])
            for name, values in las.columns().items():
                columns.setdefault(name, []).append(values[bottom])
        return {name: np.concatenate(parts) for name, parts in columns.items()}


class Report(programs.Test):
    def __getattr__(self, name):
        return getattr(SURVEYS[0], name)


SURVEYS = []


def make(*flags):
    """Makes the survey, for a script's setUpModule; the flags are those of `report`."""
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    SURVEYS.append(Survey(pathlib.Path(folder.name), *flags))
