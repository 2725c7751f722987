"""The JSON that all commands write has the members, types and units of docs/json.md, and no others.

Usage: json_test.py SOURCE_FOLDER NAME=PATH... [--write]      albtpu_generate, albtpu_query, albtpu_serve
(--write puts meaning, unit and range of keys of survey files into the page, from `albtpu-query keys`)
"""

import json
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import numpy as np
import json_keys
from runs import ANNOTATE, JUDGE, PRINT, PULSE, THEN, VERSIONS, WATER, WAVES, copy_input, make, write_check_points

from commands import run  # Where runs.py found it.
from las_file import LasFile
from serving import Server

PATHS = dict(argument.split("=", 1) for argument in sys.argv[2:] if "=" in argument)
QUERY, GENERATE = PATHS["albtpu_query"], PATHS["albtpu_generate"]
PATH = pathlib.Path(sys.argv[1]) / "docs/json.md"
PAGE = PATH.read_text()
SIMPLE = {"number": (int, float), "integer": int, "string": str, "boolean": bool, "null": type(None)}
COOPS = "Date Time, Water Level, Sigma, O or I (for verified), F, R, L, Quality\n"
LEVELS = 'level = "levels.csv"\nlevel_datum = "NAVD"\nlevel_offset = 0.01\nlevel_hours_from_utc = 1\n'
CONE = f"incidence = 15\nfootprint = 0.6\nuser_data = {[*range(256)]}"
EXTRA = "[extra]\nhorizontal = 0.01\nvertical = 0.02\n"
BARE = ("--water-level", "-25", "--classes", "40")
# More runs than those of earlier versions, and the types of all that is printed or written.
MORE = (
    ("wet.json", "pulse", "--survey", "wet.toml", "--table-name", "winds", *PULSE, "--beam-azimuth", "90",
     "--altitude", "400", *THEN, "--json"),
    ("deep.json", "pulse", "--survey", "wet.toml", "--table-name", "winds", *PULSE[:-1], "19", "--beam-azimuth", "90",
     "--altitude", "400", "--json"),
    ("hours.json", "plan", "--survey", "hours.toml", "--order", "1b", "--altitudes", "300,400", "--sea-gap", "3",
     "--json"),
    ("series.json", "sea", "--survey", "hours.toml", "--json"),
    ("", "csv", "totals.csv", "wet.csv", "--survey", "wet.toml", "--details", "--table-name", "winds"),
    ("", "las", "noisy", "--output-dir", "sloped", "--survey", "sloped.toml", "--table-name", "winds", "--csv",
     "sloped"),
    ("", "las", "lines/flight_1.las", "channel.las", "--survey", "channels.toml", "--table-name", "winds"),
    ("", "las", "lines/flight_1.las", "returns.las", "--trajectory-from-returns", "--water-level", "-25",
     "--wind-speed", "5", "--divergence", "1", "--table-name", "winds"),
    ("", "las", "lines/flight_1.las", "constant.las", *BARE, "--incidence", "15", "--beam-azimuth", "90",
     "--footprint", "0.6", "--use-withheld", "--units", "m", "--sea", "sea.csv", "--sea-time", "2020-06-08T01:30Z",
     "--format", "las"),
    ("", "las", "lines/flight_1.las", "swung.las", *BARE, "--scanner", "across-track", "--flight-direction", "90",
     "--altitude", "300", "--divergence", "1", *WAVES),
    ("", "las", "annotated/flight_1.las", "track.las", "--survey", "track.toml", "--replace",
     "--crs", "EPSG:32617", "--table-name", "winds"),
    ("", "las", "lines/flight_1.las", "scanner.las", "--survey", "scanner.toml", "--beam-azimuth", "90", "--altitude",
     "300", "--table-name", "winds"),
    ("", "csv", "totals.csv", "green.csv", "--survey", "green.toml", "--table-name", "winds"),
    ("sensors.json", "sensors", "--json"), ("keys.json", "keys", "--json"), ("tables.json", "tables", "--json"),
    ("surface.json", "surface", "annotated", "--output", "surface", "--json"),
    ("report.json", "report", "annotated", "--output", "with_nodes", "--no-page", "--surface", "surface", "--json"),
    ("strict.json", "report", "annotated", "--output", "strict", "--no-page", "--s44-order", "exclusive", "--json"),
    ("noisy.json", "report", "sloped", "--output", "of_noisy", "--no-page", "--survey", "sloped.toml", "--json"),
    ("alone.json", "report", "annotated/flight_1.las", "--output", "alone", "--no-page", "--json"),
    ("", "las", "lines/flight_1.las", "swell.las", "--survey", "sloped.toml", *WAVES),
    ("swell.json", "report", "swell.las", "--output", "of_swell", "--no-page", "--survey", "sloped.toml", *WAVES,
     "--json"),
    ("checkpoints.json", "checkpoints", "annotated", "points.csv", "--radius", "20", "--json"))
WRITTEN = {
    "summary": ("annotated/flight_1.las.json", "sea.laz.json", "answers.csv.json", "total_answers.csv.json",
                "wet.csv.json", "sloped/flight_1.las.json", "channel.las.json", "returns.las.json",
                "constant.las.json", "swung.las.json", "track.las.json", "scanner.las.json", "green.csv.json"),
    "report": ("report/report.json", "report.json", "strict.json", "noisy.json", "alone.json", "swell.json"),
    "surface": ("surface/surface.json", "surface.json"), "plan": ("plan.json", "hours.json"),
    "crosscheck": ("crosscheck.json",), "checkpoints": ("checkpoints.json",), "pulse": ("pulse.json", "waves.json"),
    "total": ("total.json", "wet.json", "deep.json"), "seas": ("sea.json", "series.json"),
    "trajectories": ("trajectory.json", "unreadable.json"), "sensors": ("sensors.json",), "sensor": ("sensor.json",),
    "keys": ("keys.json",), "tables": ("tables.json",), "health": ("health.json",), "point": ("point.json",),
    "water-point": ("water_point.json",)}

# Types of what was set, of which every member is in some run.
SETTINGS = ("parameters", "settings of channel", "settings of sea", "settings of waves", "numbers of total",
            "made from", "conditions")


def rows(text):
    """The cells of the rows of tables that begin with a name."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()
            if line.startswith("| `")]


class Schema:
    """The types of the page: {type: {member: (type, unit, present)}}."""

    def __init__(self):
        head, _, rest = PAGE.partition("\n## ")
        self.commands = {row[0].replace("`", ""): row[1].strip("`") for row in rows(head)}
        self.types, self.seen, self.problems = {}, set(), set()
        for name, text in re.findall(r"^### `(.+?)`\n(.*?)(?=^##|\Z)", rest, re.MULTILINE | re.DOTALL):
            assert name not in self.types, name
            self.types[name] = {member: tuple(row[1:4]) for row in rows(text)
                                for member in re.findall("`(.+?)`", row[0])}

    def check(self, value, kind, where):
        """Notes what of the value is not of the type."""
        options = split(kind)
        if len(options) > 1:
            self.check(value, self.chosen(value, options), where)
        elif kind in SIMPLE:
            right = isinstance(value, SIMPLE[kind]) and (kind == "boolean" or not isinstance(value, bool))
            self.expect(right, f"{where} is {json.dumps(value)[:40]}, not {kind}")
        elif kind[0] in "[{":
            is_list = kind[0] == "["
            if self.expect(isinstance(value, list if is_list else dict), f"{where} is not {kind}"):
                for key, each in enumerate(value) if is_list else value.items():
                    self.check(each, kind[1:-1], f"{where}[]" if is_list else f"{where}.{{{key}}}")
        elif self.expect(isinstance(value, dict), f"{where} is {json.dumps(value)[:40]}, not {kind}"):
            members = self.types[kind]
            for name in value.keys() - members.keys():
                self.problems.add(f"{where}.{name} is not in docs/json.md ({kind})")
            for name, (of_member, _, present) in members.items():
                if name in value:
                    self.seen.add((kind, name))
                    self.check(value[name], of_member, f"{where}.{name}")
                else:
                    self.expect(present, f"{where}.{name} is missing ({kind})")

    def chosen(self, value, options):
        """Of several types, that which the value looks like; of objects, the one with most of its members."""
        alike = [kind for kind in options if isinstance(value, SIMPLE.get(kind, list if kind[0] == "[" else dict))]
        return max(alike or options, key=lambda kind: len(self.types.get(kind, {}).keys() & value.keys())
                   if isinstance(value, dict) else 0)

    def expect(self, right, problem):
        if not right:
            self.problems.add(problem)
        return right


def split(kind):
    """The alternatives of a type, not those within brackets."""
    kinds, depth = [[]], 0
    for word in kind.split():
        kinds.append([]) if word == "or" and depth == 0 else kinds[-1].append(word)
        depth += sum(word.count(each) for each in "[{") - sum(word.count(each) for each in "]}")
    return [" ".join(each) for each in kinds]


def names_in(kind):
    return {name for name in re.split(r" or |[\[\]{}]", kind) if name and name not in SIMPLE}


def write_surveys(folder, survey, channel, wet):
    """Survey files with what is in the others only by default: of the trajectory, the levels, a scanner, the water."""
    track = survey.replace("[trajectory]\n", '[trajectory]\nvelocity_axes = "wander"\n')
    (folder / "track.toml").write_text(track.replace("[datum]\n", "[datum]\ngeoid_separation = 0\n"))
    rows_of = [f"2022-03-09 {hour}:00,-25,0.003,0,0,0,0,v\n" for hour in (17, 18, 19)]
    (folder / "levels.csv").write_text("".join([COOPS, *rows_of]))
    cone = channel.replace("lever_arm = [0.3, -0.2, 0.5]", CONE)
    scanner = re.sub(r"\[(?:trajectory|sensor)\]\n(?:\w.*\n)*", "", survey).replace("level = -25\n", LEVELS)
    (folder / "scanner.toml").write_text(scanner + cone + '[trajectory]\ntime_format = "adjusted"\n')
    wet = wet.replace("[surface]\n", '[surface]\nchannel = "green"\n').replace("[water]\n", "[water]\nphotons = 900\n")
    (folder / "green.toml").write_text(wet.replace('located = "local"', 'located = "pulse"') + EXTRA)


def make_all(folder):
    copy_input(VERSIONS[-1], folder)
    totals, survey = (folder / "totals.toml").read_text(), (folder / "survey.toml").read_text()
    (folder / "wet.toml").write_text(totals.replace('column = "none"\n', WATER))
    sloped = survey.replace("[output]\n", "[output]\nterrain_slope = true\n")
    sloped = sloped.replace("[datum]\n", "[datum]\nname = 'MLLW'\n")
    (folder / "sloped.toml").write_text(f"{sloped}[project]\nname = 'Harbour'\n")
    channel = '[[sensor.channel]]\nscanner_channels = [0]\nname = "sensor.toml"\nlever_arm = [0.3, -0.2, 0.5]\n'
    (folder / "channels.toml").write_text(re.sub(r"\[sensor\]\n(?:\w.*\n)*", channel, survey))
    write_surveys(folder, survey, channel, (folder / "wet.toml").read_text())
    bins = [0.05 * i for i in range(1, 13)]
    rows_of = [f"2020-06-08T{hour:02}:00Z,{f:.2f},{hour * min(f / 0.2, (0.2 / f)**4) / 100:.6g},0.4,250"
               for hour in (1, 2, 3) for f in bins]
    (folder / "sea.csv").write_text("\n".join(["time,f,E,r2,alpha2", *rows_of]) + "\n")
    sea = '[sea]\nfile = "sea.csv"\nwind_speed = 4\nwind_from = 250\n'
    (folder / "hours.toml").write_text(re.sub(r"\[sea\]\n(?:\w.*\n)*", sea, totals))
    (folder / "sloped").mkdir()
    shutil.copytree(folder / "lines", folder / "noisy")
    las = LasFile(folder / "noisy/flight_1.las")
    data, bottom = bytearray(las.bytes), np.flatnonzero(las.classes == 40)
    # Vegetation under water, noise, withheld and synthetic points.
    for points, at, value in ((bottom[:5], 16, 5), (bottom[5:9], 16, 7), (bottom[9:12], 15, 4), (bottom[12:14], 15, 1)):
        for i in points:
            byte = las.offset_to_points + i * las.record_length + at
            data[byte] = value if at == 16 else data[byte] | value
    (folder / "noisy/flight_1.las").write_bytes(data)
    make(QUERY, folder, (*ANNOTATE, *PRINT, *JUDGE))
    write_check_points(folder)
    make(QUERY, folder, MORE)
    (folder / "empty.out").touch()
    (folder / "unreadable.json").write_text(run(QUERY, "trajectory", "empty.out", "--json", cwd=folder).stdout)
    with Server(PATHS["albtpu_serve"], "--tables", folder / "tables") as server:
        (folder / "health.json").write_text(run(QUERY, "health", "--server", server.address, "--json").stdout)
    point = ("point", "--wind-speed", "5", "--incidence", "10", "--footprint", "0.6", "--depth", "2,8")
    water = ("water-point", "--absorption", "0.108", "--scattering", "0.28", "--depth", "7", "--incidence", "15",
             "--field-of-view", "5", "--pulse-length", "2.2", "--footprint", "0.6", "--photons", "8000")
    for name, arguments in (("point.json", (*point, "--relative-error", "0.1")), ("water_point.json", water)):
        (folder / name).write_text(run(GENERATE, *arguments, "--json").stdout)


class Json(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = Schema()
        with tempfile.TemporaryDirectory() as folder:
            make_all(pathlib.Path(folder))
            cls.values = {(kind, name): json.loads((pathlib.Path(folder) / name).read_text())
                          for kind, names in WRITTEN.items() for name in names}

    def test_of_all_commands_is_of_the_schema(self):
        schema = self.schema
        for (kind, name), value in self.values.items():
            schema.check(value, kind, name)
        self.assertEqual(schema.problems, set(), "\n" + "\n".join(sorted(schema.problems)))
        # No row of the page is there for nothing.
        unseen = {(kind, name) for kind, members in schema.types.items() for name, (_, _, present) in members.items()
                  if not present} - schema.seen
        self.assertEqual(unseen, set())

    def test_every_command_has_a_type(self):
        listed = run(QUERY, "--help").stdout.partition("\nSubcommands:\n")[2].partition("\n\n")[0]
        commands = set(re.findall(r"^  ([a-z-]+)\b", listed, re.MULTILINE)) - {"init"}
        self.assertEqual({name.split()[0] for name in self.schema.commands if "albtpu" not in name}, commands)
        self.assertEqual(set(self.schema.commands.values()), set(WRITTEN))
        for command in commands:
            self.assertIn("--json", run(QUERY, command, "--help").stdout, command)

    def test_every_type_is_described_and_every_number_has_a_unit(self):
        used = set(self.schema.commands.values())
        for members in self.schema.types.values():
            for name, (kind, unit, _) in members.items():
                used |= names_in(kind)
                if re.search(r"\b(?:number|integer)\b", kind):
                    self.assertTrue(unit, name)
        self.assertEqual(used, set(self.schema.types))

    def test_settings_are_described_by_the_keys(self):
        keys = self.values["keys", "keys.json"]["keys"]
        self.assertEqual(json_keys.unnamed(PAGE, self.schema.types, keys), set(), "keys without their row")
        self.assertEqual(json_keys.renewed(PAGE, keys), PAGE, "write docs/json.md with --write")
        # Each of these members is written by some run, also those that are not always there.
        schema = Schema()
        for (kind, name), value in self.values.items():
            schema.check(value, kind, name)
        self.assertEqual({(kind, name) for kind in SETTINGS for name in schema.types[kind]} - schema.seen, set())

    def test_no_object_is_open(self):
        for kind, members in self.schema.types.items():
            for name, (of_member, _, _) in members.items():
                self.assertNotIn("any", names_in(of_member), f"{kind}.{name}")
        schema = Schema()
        summary = self.values["summary", "annotated/flight_1.las.json"]
        for more in ("parameters", "total", "numbers"):
            wrong = json.loads(json.dumps(summary))
            parameters = wrong["parameters"]
            {"parameters": parameters, "total": parameters["total"],
             "numbers": parameters["total"]["numbers"]}[more]["more"] = None
            schema.check(wrong, "summary", more)
        self.assertEqual(len(schema.problems), 3, schema.problems)

    def test_finds_what_is_wrong(self):
        value = self.values["tables", "tables.json"]["tables"][0]
        for wrong in ({**value, "more": 1}, {**value, "name": 1}, {**value, "default": 1}, {**value, "axes": {}},
                      {name: each for name, each in value.items() if name != "digest"},
                      {**value, "axes": [{**value["axes"][0], "first": "0"}]}):
            schema = Schema()
            schema.check(wrong, "listed table", "wrong")
            self.assertEqual(len(schema.problems), 1, schema.problems)


def write_page():
    page = json_keys.renewed(PAGE, json.loads(run(QUERY, "keys", "--json").stdout)["keys"])
    PATH.write_text(page)


if __name__ == "__main__" and "--write" in sys.argv:
    write_page()
elif __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
