"""Runs every gate of a release on one commit, and writes its table.

Usage: release.py [--fuzz SECONDS] [--soak MINUTES] [--output TABLE.md] [GATE...]

As root on Debian 12, in a clone without changes, with nothing else on the machine: some ten hours for all gates. A gate
that passed on this commit is not run again, also if only TABLE.md says so, as after a change of the machine; what it
printed stays in build/release_gates/COMMIT. Exits with 1 if a gate failed or was not run.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]

# What a newcomer does, in a bare root that mmdebstrap makes: a clone of the commit, and no cache of the compiler.
BARE_ROOT = """
mkdir -p "$1/srv"
git clone --quiet "$here" "$1/srv/albtpu"
[ ! -d "$here/../shared" ] || cp --recursive "$here/../shared" "$1/srv/shared"
cp /etc/resolv.conf "$1/etc/resolv.conf"
exec env -i HOME=/root PATH="$PATH" chroot "$1" sh -ec 'cd /srv/albtpu && ./quickstart.sh && ./test.sh'
"""


def bare_root(suite):
    return ["mmdebstrap", "--variant=minbase", f"--customize-hook={BARE_ROOT}", suite, "/dev/null"]


TESTS = (r"\d+% tests passed.*", r"Total Test time.*", r"GoogleTest: .*")
# Name: (command, patterns of the lines with its figures). FUZZ and SOAK stand for the options.
GATES = {
    "debian-12": (bare_root("bookworm"), TESTS),
    "debian-13": (bare_root("trixie"), TESTS),
    "packages": (["tests/e2e/packages.sh"], (r"Ran \d+ tests.*",)),
    "portable": (["tests/e2e/portable.sh"], (r"Ran \d+ tests.*",)),
    "reproducible": (["tests/e2e/reproducible.sh"], (r"[0-9a-f]{64}  .*",)),
    "containers": (["tests/e2e/containers.sh"], (r"Ran \d+ tests.*",)),
    "sanitizers": (["tests/sanitizers/run.sh"], (r"[at]san: .*",)),
    "aarch64": (["tests/generator/aarch64.sh"], (r"\[  PASSED  \].*",)),
    "fuzz": (["tests/fuzz/run.sh", "--at-least", "1000000", "FUZZ"], (r"\w+: \d+ executions.*", r"\w+: FOUND.*")),
    "soak": (["tests/faults/soak.sh", "SOAK"], (r"\w+: \d+", r"resident memory .*", r"at rest: .*")),
}
# Gates that use the programs in build/release, which must be of this commit.
USE_PROGRAMS = ("containers", "soak")
BUILD = 'cmake --preset release && cmake --build --preset release -j "$(nproc)"'


def git(*arguments):
    return subprocess.run(["git", "-C", SOURCE, *arguments], capture_output=True, text=True, check=True).stdout.strip()


def run(name, command, folder):
    """Runs a gate, with its output in a file; what is known of it."""
    start = time.monotonic()
    with open(folder / f"{name}.log", "w") as log:
        code = subprocess.run(command, cwd=SOURCE, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                              env={**os.environ, "here": str(SOURCE)}, check=False).returncode
    return {"code": code, "minutes": (time.monotonic() - start) / 60}


def figures_of(log, patterns):
    lines = log.read_text(errors="replace").splitlines()
    return [line.strip() for line in lines if any(re.fullmatch(pattern, line.strip()) for pattern in patterns)]


def title(commit):
    return f"# Release of commit {commit}"


def rows_of_passed(written, commit):
    """The rows of the gates that passed, by the table that was written for this commit, if it was."""
    lines = written.read_text().splitlines() if written.exists() else []
    if not lines or lines[0] != title(commit):
        return {}
    rows = {line.split(" | ")[0].removeprefix("| "): line for line in lines if line.startswith("| ")}
    return {name: row for name, row in rows.items() if row.split(" | ")[2] == "passed"}


def table(commit, chosen, known, earlier, folder):
    yield f"{title(commit)}\n\nMade by `tests/e2e/release.py`, all on this commit.\n"
    yield "| gate | command | result | minutes | figures |\n|---|---|---|---|---|"
    for name, (command, patterns) in chosen.items():
        shown = "bare root: `./quickstart.sh`, `./test.sh`" if command[0] == "mmdebstrap" else f"`{' '.join(command)}`"
        if name in earlier and name not in known:
            yield earlier[name]
            continue
        if name not in known:
            yield f"| {name} | {shown} | not run | | |"
            continue
        result = "passed" if known[name]["code"] == 0 else f"failed ({known[name]['code']})"
        found = "<br>".join(figures_of(folder / f"{name}.log", patterns))
        yield f"| {name} | {shown} | {result} | {known[name]['minutes']:.0f} | {found} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fuzz", default="600", metavar="SECONDS", help="for each target (default: 600)")
    parser.add_argument("--soak", default="120", metavar="MINUTES", help="(default: 120)")
    parser.add_argument("--output", type=pathlib.Path, default=SOURCE / "build/release_gates/release.md")
    parser.add_argument("gates", nargs="*", metavar="GATE", help=f"{', '.join(GATES)} (default: all)")
    options = parser.parse_args()
    unknown = [name for name in options.gates if name not in GATES]
    if unknown:
        parser.error(f"unknown gate '{unknown[0]}'; the gates are {', '.join(GATES)}")
    words = {"FUZZ": options.fuzz, "SOAK": options.soak}
    chosen = {name: ([words.get(word, word) for word in command], figures)
              for name, (command, figures) in GATES.items()}
    if git("status", "--porcelain"):
        parser.error("the clone has changes; commit them, because a release is of one commit")
    commit = git("rev-parse", "--short=12", "HEAD")
    folder = SOURCE / "build/release_gates" / commit
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder / "gates.json"
    known = json.loads(kept.read_text()) if kept.exists() else {}
    earlier = rows_of_passed(options.output, commit)
    passed = {name for name in chosen if name in earlier or known.get(name, {}).get("code") == 0}
    to_run = [name for name in chosen if (not options.gates or name in options.gates) and name not in passed]
    if any(name in USE_PROGRAMS for name in to_run) and run("build", ["bash", "-c", BUILD], folder)["code"] != 0:
        sys.exit(f"the programs could not be built; see {folder / 'build.log'}")
    for name in to_run:
        command, _ = chosen[name]
        print(f"{name}: running; its output is in {folder / name}.log", flush=True)
        known[name] = run(name, command, folder)
        kept.write_text(json.dumps(known, indent=2) + "\n")
        print(f"{name}: exit code {known[name]['code']} after {known[name]['minutes']:.0f} minutes", flush=True)
        if known[name]["code"] == 0:
            passed.add(name)
    options.output.write_text("\n".join(table(commit, chosen, known, earlier, folder)) + "\n")
    print(f"the table is in {options.output}")
    if len(passed) < len(chosen):
        sys.exit(f"{len(passed)} of {len(chosen)} gates passed")


if __name__ == "__main__":
    main()
