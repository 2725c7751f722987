"""The names that docs/stable.md promises are there. promised.txt lists them, one a line.

Usage: promised_test.py SOURCE_FOLDER NAME=PATH... [--print]      albtpu_generate, albtpu_query, albtpu_serve, laz_copy
`--print` writes the list of this tree, which becomes promised.txt at a release.
"""

import csv
import json
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "programs/query"))
from runs import ANNOTATE, JUDGE, PRINT, VERSIONS, WATER, copy_input, make, write_check_points  # noqa: E402

import albtpu  # noqa: E402
from commands import run  # noqa: E402
from las_file import LasFile  # noqa: E402

SOURCE = pathlib.Path(sys.argv[1])
PATHS = dict(argument.split("=", 1) for argument in sys.argv[2:] if "=" in argument)
PROGRAMS = {f"albtpu-{name}": PATHS[f"albtpu_{name}"] for name in ("generate", "query", "serve")}
QUERY = PROGRAMS["albtpu-query"]
PROMISED = pathlib.Path(__file__).resolve().with_name("promised.txt")
TYPES = {1: "uint8", 9: "float32"}
LEVELS = 2  # Of members of JSON objects; the tests of recorded files compare all.


def flags():
    for name, path in PROGRAMS.items():
        text = run(path, "--help").stdout
        listed = text.partition("\nSubcommands:\n")[2].partition("\n\n")[0]
        commands = re.findall(r"^  ([a-z-]+)\b", listed, re.MULTILINE)
        for command in ("", *commands):
            shown = run(path, *command.split(), "--help").stdout.partition("\nExamples:\n")[0]
            for flag in re.findall(r"^  (?:-\w,)?(--[\w-]+)", shown, re.MULTILINE):
                yield " ".join(f"flag {name} {command} {flag}".split())


def keys():
    for key in json.loads(run(QUERY, "keys", "--json").stdout)["keys"]:
        yield f"key [{key['section']}] {key['key']}: " + " ".join(filter(None, (key["type"], key["unit"])))


def exit_codes():
    for name, path in PROGRAMS.items():
        failing = {"albtpu-generate": ("plan", "--campaign", "/nowhere.toml"), "albtpu-serve": ("--tables", "/nowhere"),
                   "albtpu-query": ("tables", "--table", "/nowhere.h5")}[name]
        for what, arguments in (("success", ("--version",)), ("bad usage", ("--nonsense",)), ("failure", failing)):
            yield f"exit code of {name}, {what}: {run(path, *arguments).returncode}"


def members(value, where, levels=LEVELS):
    if isinstance(value, list) and value and isinstance(value[0], dict):
        value = {key: each for element in value for key, each in element.items()}
        where += "[]"
    if not isinstance(value, dict) or levels == 0:
        yield where
    else:
        for key, each in value.items():
            yield from members(each, f"{where}.{key}", levels - 1)


def names_in_files():
    """Columns of CSV files, dimensions of LAS files and members of JSON files that albtpu-query writes."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        copy_input(VERSIONS[-1], folder)
        wet = (folder / "totals.toml").read_text().replace('column = "none"\n', WATER)
        (folder / "wet.toml").write_text(wet)
        make(QUERY, folder, (*ANNOTATE, *PRINT, *JUDGE, ("", "csv", "totals.csv", "wet.csv", "--survey", "wet.toml",
                                                         "--details", "--table-name", "winds")))
        for path, source in (("answers.csv", "pulses.csv"), ("wet.csv", "totals.csv")):
            columns = [next(csv.reader((folder / name).read_text().splitlines())) for name in (path, source)]
            yield from (f"column of csv: {name}" for name in columns[0] if name not in columns[1])
        write_check_points(folder)
        make(QUERY, folder, [("checkpoints.json", "checkpoints", "annotated", "points.csv", "--radius", "20",
                              "--json")])
        run(PATHS["laz_copy"], folder / "sea.laz", folder / "sea.las").check_returncode()
        for path in ("annotated/flight_1.las", "sea.las"):
            for name, (_, kind, no_data, _) in LasFile(folder / path).extra_dimensions().items():
                yield f"dimension of las: {name} {TYPES[kind]}, no data {no_data or 0:g}"
        for path, what in (("annotated/flight_1.las.json", "summary of las with a total"),
                           ("sea.laz.json", "summary of las"), ("answers.csv.json", "summary of csv"),
                           ("wet.csv.json", "summary of csv with a total"),
                           ("report/report.json", "report.json"), ("crosscheck.json", "crosscheck --json"),
                           ("checkpoints.json", "checkpoints --json"),
                           *((name, f"{arguments[0]} --json") for name, *arguments in PRINT)):
            yield from members(json.loads((folder / path).read_text()), f"member of {what}: ")


def headers():
    """Where albtpu_package() of cmake/package.cmake installs them."""
    for path in SOURCE.glob("*/**/CMakeLists.txt"):
        for arguments in re.findall(r"^albtpu_package\(([^)]*)\)", path.read_text(), re.MULTILINE):
            room = path.parent.relative_to(SOURCE).as_posix()
            for header in arguments.partition("HEADERS")[2].split():
                yield f"header <albtpu/{room}/{pathlib.PurePath(header).name}>"


def now():
    found = {*flags(), *keys(), *exit_codes(), *names_in_files(), *headers(),
             *(f"python albtpu.{name}" for name in albtpu.__all__)}
    return {" ".join(line.split()) for line in found}


class Promised(unittest.TestCase):
    def test_names_are_there(self):
        promised = set(PROMISED.read_text().splitlines())
        self.assertGreater(len(promised), 500)
        gone = "\n".join(sorted(promised - now()))
        self.assertEqual(gone, "", "this is promised in docs/stable.md")


if __name__ == "__main__":
    if "--print" in sys.argv:
        print("\n".join(sorted(now())))
    else:
        unittest.main(argv=sys.argv[:1], verbosity=2)
