"""What changed for users between two builds of this tree: run it before and after a change that should change nothing.

Usage: compare_builds.py OLD_BUILD NEW_BUILD [--pulses N]

Both are installed into temporary folders and used from there, so that their trees may be laid out differently. One of
them must have built the target albtpu_simulated_survey, too. Compares, old with new: the table of quick.toml and a unit
of survey.toml byte for byte, the version and the commit in their provenance aside; `albtpu-generate point --json` of
random conditions; the answers to random pulses by CSV through a table file and through a server, and in Python through
both; what compare_surveys.py says; help texts and exit codes; names, labels and help of metrics; the wire; and the list
of installed files. Prints each difference and ends with exit code 1 when results differ. Differences of texts are
printed for the reader to judge.
"""

import argparse
import difflib
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import compare_surveys  # noqa: E402
import serving  # noqa: E402

PROGRAMS = ("albtpu-generate", "albtpu-serve", "albtpu-query")
BAD_USAGE = (("albtpu-generate",), ("albtpu-generate", "nonsense"), ("albtpu-generate", "point", "--wind-speed", "x"),
             ("albtpu-generate", "plan", "--campaign", "absent.toml"), ("albtpu-generate", "point", "--help"),
             ("albtpu-query",), ("albtpu-query", "nonsense"), ("albtpu-query", "pulse", "--wind-speed", "7"),
             ("albtpu-query", "pulse", "--no-such-flag"), ("albtpu-query", "csv", "absent.csv", "out.csv"),
             ("albtpu-query", "las", "absent.las", "out.las", "--scanner", "across-track", "--water-level", "0",
              "--wind-speed", "5"),
             ("albtpu-query", "tables", "--table", "absent.h5"), ("albtpu-query", "--version"),
             ("albtpu-serve", "--tables", "absent"), ("albtpu-serve", "--listen", "nowhere"),
             ("albtpu-serve", "--no-such-flag"), ("albtpu-serve", "--version"))
PYTHON = """
import sys, numpy as np, albtpu
pulses = np.load(sys.argv[1])
def save(source, path):
    with source as opened:
        answer = opened.query(**{name: pulses[name] for name in pulses.files}, standard_errors=True)
    columns = [getattr(answer, name) for name in albtpu.QUANTITIES]
    errors = [answer.standard_errors[name] for name in albtpu.QUANTITIES]
    np.save(path, np.stack([np.asarray(column, np.float32) for column in [*columns, *errors]]).view(np.uint32))
save(albtpu.open_table(sys.argv[2]), sys.argv[4])
save(albtpu.connect(sys.argv[3]), sys.argv[5])
"""


class Build:
    """One side of the comparison, installed into `prefix`."""

    def __init__(self, build, prefix):
        self.build, self.prefix = build, prefix
        subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True, capture_output=True)
        self.programs = {name: prefix / "bin" / name for name in PROGRAMS}
        data = prefix / "share/albtpu"
        self.tables, self.campaigns, self.python = data / "tables", data / "campaigns", data / "python"
        self.table, self.protos = self.tables / "survey.h5", data / "proto"
        self.installed = "\n".join(sorted(path.relative_to(prefix).as_posix() for path in prefix.rglob("*")
                                          if path.is_file()))
        version = self.run("albtpu-generate", "--version").stdout
        self.version, self.commit = re.fullmatch(r"\S+ (\S+)(?:\ncommit | \()([^\n)]+)\)?\n", version).groups()

    def run(self, program, *arguments, **options):
        return subprocess.run([self.programs[program], *arguments], capture_output=True, text=True,
                              env={**os.environ, "SOURCE_DATE_EPOCH": "0", "COLUMNS": "120"}, **options)

    def without_origin(self, content):
        """The bytes of a file without the program's version and commit."""
        for text in (self.commit, self.version):
            content = content.replace(text.encode(), b"")
        return content


def report(differs, what, judged=False):
    print(f"{'differs' if differs else 'same   '} {what}", flush=True)
    return bool(differs) and not judged


def text_difference(old, new, what):
    """Prints how texts differ; a reader judges them."""
    report(old != new, what, judged=True)
    for line in difflib.unified_diff(old.splitlines(), new.splitlines(), "old", "new", lineterm="", n=0):
        if not line.startswith(("---", "+++", "@@")):
            print("   ", line)


def equal_but_for_a_checksum(a, b):
    """Whether tables differ by nothing but HDF5's checksum, of 4 bytes, of the block that holds the commit."""
    if a == b or len(a) != len(b):
        return a == b
    places = [i for i in range(len(a)) if a[i] != b[i]]
    return places[-1] - places[0] < 4


def compare_tables(old, new, folder):
    differs = False
    quick, survey, unit = [], [], []
    for name, build in (("old", old), ("new", new)):
        path = folder / f"{name}.h5"
        done = build.run("albtpu-generate", "table", "--campaign", build.campaigns / "quick.toml", "--output", path)
        assert done.returncode == 0, done.stderr
        seal = 512  # bytes, among them the digest of all others
        quick.append(build.without_origin(path.read_bytes()[seal:]))
        work = folder / f"{name}_units"
        build.run("albtpu-generate", "table", "--campaign", build.campaigns / "survey.toml", "--work", work, "--shard",
                  "17/400", check=True)
        units = sorted(work.glob("*.unit"))
        digest = 32  # bytes at the end of a unit
        survey.append([path.name for path in units])
        unit.append([build.without_origin(path.read_bytes()[:-digest]) for path in units])
    differs |= report(not equal_but_for_a_checksum(*quick),
                      f"quick.h5, {len(quick[0])} bytes but version, commit and their digests")
    differs |= report(survey[0] != survey[1] or unit[0] != unit[1], f"{len(unit[0])} units of a shard of survey.toml")
    return differs


def compare_points(old, new, count=20):
    draw = random.Random(7)
    different = 0
    for _ in range(count):
        arguments = ["point", "--json", "--seed", str(draw.randrange(1000)), "--wind-speed",
                     f"{draw.uniform(2, 15):.2f}", "--incidence", f"{draw.uniform(0, 30):.2f}", "--footprint",
                     f"{draw.choice([0.1, 0.25, 0.5, 1, 2, 5])}", "--depth", "0,1,5,20", "--relative-error", "0.05"]
        if draw.random() < 0.7:
            arguments += ["--azimuth", f"{draw.uniform(0, 360):.1f}"]
        if draw.random() < 0.5:
            arguments += ["--fetch", f"{10 ** draw.uniform(3, 5.5):.0f}"]
        if draw.random() < 0.3:
            arguments += ["--profile", "gaussian"]
        if draw.random() < 0.3:
            arguments += ["--spectrum", "elfouhaily"]
        if draw.random() < 0.2:
            arguments += ["--estimator", "plain"]
        answers = [re.sub(r'"seconds":\s*[^,}]+', "", build.run("albtpu-generate", *arguments, check=True).stdout)
                   for build in (old, new)]
        different += answers[0] != answers[1]
    return report(different, f"point --json, {count} random conditions")


def random_pulses(count):
    """Columns of pulses, some of them outside the table's domain on each axis, some not numbers."""
    import numpy as np
    generator = np.random.default_rng(5)
    ranges = {"wind_speed": (1.5, 15.5), "fetch": (500, 3e6), "incidence": (-0.5, 26), "azimuth": (-400, 400),
              "footprint": (0.09, 5.2), "depth": (-0.5, 61)}
    columns = {name: generator.uniform(low, high, count).astype(np.float32) for name, (low, high) in ranges.items()}
    columns["fetch"][generator.random(count) < 0.3] = np.inf
    columns["depth"][generator.random(count) < 0.001] = np.nan
    return columns


def compare_answers(old, new, folder, count):
    import numpy as np
    columns = random_pulses(count)
    names = list(columns)
    rows = zip(*(columns[name] for name in names))
    (folder / "in.csv").write_text("\n".join([",".join(names), *(",".join(f"{x:.9g}" for x in row) for row in rows)])
                                   + "\n")
    np.savez(folder / "pulses.npz", **columns)
    differs, answers = False, {}
    for name, build in (("old", old), ("new", new)):
        tables = folder / f"{name}_tables"
        tables.mkdir()
        (tables / "survey.h5").symlink_to(build.table.resolve())
        with serving.Server(build.programs["albtpu-serve"], "--tables", tables) as server:
            for way, flags in (("file", ("--table", build.table)), ("server", ("--server", server.address))):
                output = folder / f"{name}_{way}.csv"
                done = build.run("albtpu-query", "csv", folder / "in.csv", output, *flags, "--standard-errors")
                assert done.returncode == 0, done.stderr
                answers[name, "CSV", way] = output.read_bytes()
            paths = [folder / f"{name}_{way}.npy" for way in ("file", "server")]
            subprocess.run([sys.executable, "-c", PYTHON, folder / "pulses.npz", build.table, server.address, *paths],
                           env={**os.environ, "PYTHONPATH": build.python}, check=True)
            for way, path in zip(("file", "server"), paths):
                answers[name, "Python", way] = path.read_bytes()
    for how in ("CSV", "Python"):
        for way in ("file", "server"):
            differs |= report(answers["old", how, way] != answers["new", how, way],
                              f"answers to {count} pulses, {how} through a {way}")
    differs |= report(answers["new", "CSV", "file"] != answers["new", "CSV", "server"], "file and server, CSV")
    differs |= report(answers["new", "Python", "file"][128:] != answers["new", "Python", "server"][128:]
                      and not np.allclose(np.load(folder / "new_file.npy").view(np.float32),
                                          np.load(folder / "new_server.npy").view(np.float32), rtol=1e-5,
                                          equal_nan=True),
                      "file and server, Python (whose reader is in double precision)")
    return differs


def compare_help_and_exits(old, new):
    for program in PROGRAMS:
        top = "".join(build.run(program, "--help").stdout for build in (old, new))
        listed = [re.findall(r"^  ([a-z-]+) ", part, re.MULTILINE)
                  for part in re.findall(r"^Subcommands:\n((?:  .*\n)+)", top, re.MULTILINE)]
        for arguments in ((), *((command,) for command in sorted(set(sum(listed, []))))):
            helps = [build.run(program, *arguments, "--help").stdout for build in (old, new)]
            text_difference(*helps, f"{' '.join((program, *arguments))} --help")
    differs = False
    for program, *arguments in BAD_USAGE:
        done = [build.run(program, *arguments, cwd="/") for build in (old, new)]
        differs |= report(done[0].returncode != done[1].returncode,
                          f"exit code {done[1].returncode} of {program} {' '.join(arguments)}")
    return differs


def metrics_of(build):
    with serving.Server(build.programs["albtpu-serve"], "--tables", build.table.parent, "--metrics",
                        "127.0.0.1:0") as server:
        page = server.metrics()
    return "\n".join(sorted({re.sub(r"(\}|\w) [-+.\deInfNa]+$", r"\1", line) for line in page.splitlines()
                             if not line.startswith("albtpu_build_info") and 'le="' not in line}))


def wire_of(build, folder):
    path = folder / "wire"
    protos = sorted(path.relative_to(build.protos) for path in build.protos.rglob("*.proto"))
    subprocess.run(["protoc", "-I", build.protos, f"--descriptor_set_out={path}", *protos], check=True)
    return path.read_bytes()


def simulated_survey_of(*builds):
    for build in builds:
        for path in build.rglob("albtpu_simulated_survey"):
            if path.is_file():
                return path
    sys.exit("compare_builds.py: no build has albtpu_simulated_survey; build that target in one of them")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("old_build", "new_build"):
        parser.add_argument(name, type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--pulses", type=int, default=100_000)
    options = parser.parse_args()
    simulated_survey = simulated_survey_of(options.old_build, options.new_build)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        old, new = Build(options.old_build, folder / "old"), Build(options.new_build, folder / "new")
        differs = report(wire_of(old, folder) != wire_of(new, folder), "descriptors of the protos")
        text_difference(old.installed, new.installed, "installed files")
        text_difference(metrics_of(old), metrics_of(new), "metrics: names, labels, help")
        differs |= compare_help_and_exits(old, new)
        (folder / "surveys").mkdir()
        differs |= compare_surveys.compare(old, new, folder / "surveys", simulated_survey, options.pulses, report,
                                           equal_but_for_a_checksum)
        differs |= compare_answers(old, new, folder, options.pulses)
        differs |= compare_points(old, new)
        differs |= compare_tables(old, new, folder)
    sys.exit(1 if differs else 0)


if __name__ == "__main__":
    main()
