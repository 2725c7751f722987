"""The commands of the documents run, and print what stands below them.

In a ```console block, the lines after "$ " are commands, and all others are their output (of both streams), which is
compared with what a run prints. A line of "..." stands for lines that are left out, "..." in a line for text. A command
that ends with "# exit code N" exits with N, every other with 0. A ```toml or ```csv block that begins with "# NAME" is
the file NAME of the commands that follow. A ```python block runs by itself; a ```text block after it is what it prints.
A ```sh block is not run, and NOT_RUN has the reason for each of its commands.

The commands of a page run in a folder with simulated surveys, whose files have the names that SURVEYS gives, and with
links to folders of the source. 127.0.0.1:50051 is a server that runs for the page.

Usage: documents_test.py SOURCE ALBTPU_GENERATE ALBTPU_SERVE ALBTPU_QUERY ALBTPU_SIMULATED_SURVEY [--write PAGE...]
(--write puts what is printed now into the pages, with the same lines left out)
"""

import difflib
import functools
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
PROGRAMS = {pathlib.Path(path).name: pathlib.Path(path).resolve() for path in sys.argv[2:6]}
PAGES = sorted(path.relative_to(SOURCE).as_posix()
               for pattern in ("*.md", "docs/**/*.md", "clients/**/*.md", "tables/*.md", "tests/bench/*.md")
               for path in SOURCE.glob(pattern))
ADDRESS = "127.0.0.1:50051"
PATIENCE = 300  # seconds
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
MARK = "..."  # Something is left out.

# Commands of ```sh blocks, by how they begin.
NOT_RUN = {
    "./quickstart.sh": "builds the programs; its command las is in the README, with its result",
    "./test.sh": "runs this test",
    "cmake": "tests/clients/cpp/package_test.py configures and builds the examples",
    "build/": "tests/clients/cpp/package_test.py runs the examples",
    "docker": "tests/e2e/containers.sh, which needs an engine",
    "mpirun": "tests/generator/ranks runs ranks, where there is MPI",
    "albtpu-generate table": "takes minutes; tests/generator/commands/generate_test.py makes smaller tables",
    "albtpu-generate merge": "needs the shards of all machines; tests/generator/commands/generate_test.py merges some",
    "albtpu-generate plan": "measures this machine",
    "albtpu-generate validate": "takes ten minutes",
    "/usr/bin/python3 tests/bench": "takes minutes and measures this machine",
    "b/tests/bench": "measures this machine",
    "python3 -m venv": "tests/clients/python/install_test.py installs the package",
    "grpcurl": "is not installed; tests/service reloads tables",
    "kill": "needs the server of an installation",
    "cp": "needs the folder of an installation",
    "(umask 077; openssl": "makes secrets",
    "albtpu-serve": "needs the certificates of an installation; tests/service/security_test.py makes some",
    "albtpu-query tables --server lidar.example": "needs the certificates of an installation",
    "albtpu-query tables --server HOST:PORT": "needs the server of an installation",
    "albtpu_simulated_survey F --seconds 150": "makes 6 million points to measure this machine",
    "albtpu-query las F/flight.las": "annotates 6 million points to measure this machine",
}
# Of docker, podman, pip and benchmarks.
FLAGS_OF_OTHERS = {"--entrypoint", "--laz", "--millions", "--no-build-isolation", "--no-deps", "--stop-timeout",
                   "--tmpfs", "--user", "--userns"}
# Simulated surveys, and the names that their files have in the documents: a line without errors, and overlapping lines
# whose points have the errors that survey files in the documents declare.
SURVEYS = [
    (["--surface-share", "1"], {"flight.las": "line.las"}),
    (["--start", "330000", "--lines", "5", "--cross-lines", "2", "--seconds", "12", "--pulse-rate", "2000",
      "--file-for-each-line", "--surface-share", "1", "--column-share", "0", "--trajectory-errors",
      "--scan-noise", "0.02", "--range-noise", "0.025", "--wave-slopes", "0.09,0.078", "--wind-from", "250"],
     {f"flight_{i}.las": f"lines/line_{i}.las" for i in range(1, 8)}),
]
PULSES = "id,depth,incidence\n1,2.5,12\n2,8,0\n"
# The record of a buoy: energy (m2/Hz), the first and second directions (degree) and r1, r2, by frequency (Hz).
BUOY = [
    (0.05, 0.00, 90, 0.5, 0.2), (0.07, 0.22, 62, 0.9, 0.6), (0.09, 0.04, 65, 0.8, 0.5), (0.12, 0.28, 84, 0.8, 0.4),
    (0.14, 0.64, 88, 0.8, 0.5), (0.17, 1.21, 97, 0.8, 0.5), (0.20, 0.29, 110, 0.7, 0.4), (0.25, 0.16, 131, 0.7, 0.3),
    (0.30, 0.11, 140, 0.6, 0.3), (0.36, 0.06, 146, 0.6, 0.3), (0.42, 0.03, 150, 0.5, 0.2), (0.48, 0.02, 152, 0.5, 0.2),
]


def write_buoy(folder):
    """A buoy's spectrum as NDBC writes it: buoy.data_spec, and its directions beside it."""
    for suffix, name, at in ((".data_spec", "spec", 1), (".swdir", "alpha1", 2), (".swdir2", "alpha2", 2),
                             (".swr1", "r1", 3), (".swr2", "r2", 4)):
        first = "Sep_Freq  < " if at == 1 else ""
        head = f"#YY  MM DD hh mm {first}{name}_1 (freq_1) {name}_2 (freq_2) {name}_3 (freq_3) ... >"
        record = "2020 06 08 03 50 " + ("0.225 " if at == 1 else "")
        pairs = " ".join(f"{row[at]:.3f} ({row[0]:.3f})" for row in BUOY)
        (folder / f"buoy{suffix}").write_text(f"{head}\n{record}{pairs}\n")


def make_inputs(folder):
    for number, (flags, names) in enumerate(SURVEYS):
        made = folder / f"survey_{number}"
        subprocess.run([PROGRAMS["albtpu_simulated_survey"], made, *flags], check=True)
        trajectory = {"sbet.out": f"sbet/sbet_{number}.out", "smrmsg.out": f"smrmsg/smrmsg_{number}.out"}
        for name, given in {**names, **trajectory}.items():
            (folder / "inputs" / given).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(made / name, folder / "inputs" / given)
    write_buoy(folder / "inputs")
    (folder / "inputs/pulses.csv").write_text(PULSES)


@functools.cache
def help_of(program, *command):
    return subprocess.run([PROGRAMS[program], *command, "--help"], capture_output=True, text=True, check=True).stdout


def flags_of(program, *command):
    return set(re.findall(r"--[\w-]+", help_of(program, *command)))


def commands_of_program(program):
    return re.findall(r"^  ([a-z-]+)\b", help_of(program).partition("\nSubcommands:\n")[2].partition("\n\n")[0], re.M)


def blocks(text):
    """(kind, content) of each code block."""
    return BLOCK.findall(text)


def headings(page):
    """The names by which links reach the headings of a page."""
    found = re.findall(r"^#+ (.+)$", BLOCK.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in found}


def commands_of(content):
    """The commands of an ```sh block, without comments; lines that end in a backslash joined."""
    for line in content.replace("\\\n", " ").splitlines():
        if command := re.sub(r"(^|\s)#.*", "", line).strip():
            yield command


def shown(content):
    """[(command as shown, lines shown below it)] of a ```console block."""
    found = []
    for line in content.splitlines():
        if line.startswith("$ "):
            found.append(([line[2:]], []))
        elif found and not found[-1][1] and found[-1][0][-1].endswith("\\"):
            found[-1][0].append(line)
        else:
            assert found, f"no command prints '{line}'"
            found[-1][1].append(line)
    return [("\n".join(command), output) for command, output in found]


def matches(expected, printed):
    any_lines, any_text = r"(?s:.*\n)??", ".*"
    pattern = "".join(any_lines if line == MARK else any_text.join(map(re.escape, line.split(MARK))) + "\n"
                      for line in expected)
    return re.fullmatch(pattern, "".join(line + "\n" for line in printed)) is not None


def renewed(expected, printed):
    """The lines of `printed` that stand where `expected` has lines, with the same lines left out."""
    if matches(expected, printed) or MARK not in expected:
        return expected if matches(expected, printed) else printed
    parts = [[]]
    for line in expected:
        parts.append([]) if line == MARK else parts[-1].append(line)
    lines, at = [], 0
    for number, part in enumerate(parts):
        last = max(len(printed) - len(part), 0)
        places = [0] if number == 0 else [last] if number == len(parts) - 1 else range(min(at, last), last + 1)
        at = max(places, key=lambda place: difflib.SequenceMatcher(
            None, "\n".join(part), "\n".join(printed[place:place + len(part)])).ratio())
        lines += [MARK] * (number > 0) + printed[at:at + len(part)]
        at += len(part)
    return lines


class Page:
    """The folder in which the commands of one page run."""

    def __init__(self, folder, inputs):
        self.folder, self.server = folder, None
        shutil.copytree(inputs, folder, dirs_exist_ok=True)
        for name in ("generator", "tables", "clients", "tests"):
            (folder / name).symlink_to(SOURCE / name)
        programs = {str(path.parent) for path in PROGRAMS.values()}
        self.environment = {**os.environ, "PATH": os.pathsep.join([*programs, os.environ["PATH"]]), "LC_ALL": "C.UTF-8",
                            "PYTHONPATH": str(SOURCE / "clients/python/src"), "PYTHONDONTWRITEBYTECODE": "1",
                            "ALBTPU_TABLES": str(SOURCE / "tables/shipped")}

    def serve(self, *flags):
        """Starts a server; returns the line that says that it is ready."""
        self.close()
        self.server = subprocess.Popen([PROGRAMS["albtpu-serve"], *flags, "--listen", "127.0.0.1:0"], cwd=self.folder,
                                       stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        line = self.server.stderr.readline().rstrip("\n")
        self.address = re.search(r"ready on ([^\s,]+)", line)[1]
        return line

    def close(self):
        if self.server:
            self.server.terminate()
            self.server.communicate(timeout=PATIENCE)
            self.server = None

    def run(self, command):
        """(exit code, printed lines)"""
        words = shlex.split(command, comments=True)
        if words[0] == "albtpu-serve":
            flags = " ".join(words[1:]).replace(f"--listen {ADDRESS}", "").split()
            return 0, self.serve(*flags).replace(self.address, ADDRESS).splitlines()
        return self.execute(["bash", "-c", command], command)

    def execute(self, arguments, text):
        if ADDRESS in text and not self.server:
            self.serve("--tables", SOURCE / "tables/shipped")
        address = self.address if self.server else ADDRESS
        result = subprocess.run([argument.replace(ADDRESS, address) for argument in arguments], cwd=self.folder,
                                env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, timeout=PATIENCE)
        return result.returncode, result.stdout.replace(address, ADDRESS).splitlines()


def checked(page, text, fail):
    """Runs all of a page's blocks; calls `fail` with what differs; returns the page with what is printed now."""
    printed = None  # By the last ```python block.

    def check(command, expected_code, result, expected):
        code, lines = result
        lines = [line.rstrip() for line in lines]
        if code != expected_code:
            fail(f"exit code {code}: {command}\n" + "\n".join(lines))
        elif not matches(expected, lines):
            difference = difflib.unified_diff(expected, lines, "shown", "printed", lineterm="")
            fail(f"{command}\n" + "\n".join(difference))
        return renewed(expected, lines)

    def replace(match):
        nonlocal printed
        kind, content = match[1], match[2]
        if kind == "console":
            lines = []
            for command, output in shown(content):
                code = int((re.search(r"# exit code (\d+)$", command) or [0, 0])[1])
                lines += [f"$ {command}", *check(command, code, page.run(command), output)]
            content = "".join(line + "\n" for line in lines)
        elif kind == "python":
            printed = page.execute([sys.executable, "-c", content], content)
            if printed[0] != 0:
                fail("\n".join([content, *printed[1]]))
        elif kind == "text":
            content = "".join(line + "\n" for line in check("python", 0, printed, content.splitlines()))
        elif kind in ("toml", "csv") and (name := re.match(r"# (\S+\.\w+)\b.*\n", content)):
            (page.folder / name[1]).write_text(content if kind == "toml" else content[name.end():])
        return f"```{kind}\n{content}```"

    return BLOCK.sub(replace, text)


class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="albtpu_documents_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        make_inputs(cls.folder)

    def run_page(self, name, fail):
        folder = self.folder / name.replace("/", "_")
        folder.mkdir()
        page = Page(folder, self.folder / "inputs")
        self.addCleanup(page.close)
        return checked(page, (SOURCE / name).read_text(), fail)

    def test_show_what_their_commands_print(self):
        for name in PAGES:
            problems = []
            self.run_page(name, problems.append)
            for problem in problems:
                with self.subTest(page=name):
                    self.fail(problem)

    def test_say_of_no_command_without_a_reason_that_it_is_not_run(self):
        used = set()
        for name in PAGES:
            for kind, content in blocks((SOURCE / name).read_text()):
                for command in commands_of(content) if kind == "sh" else []:
                    with self.subTest(page=name, command=command):
                        begins = [begin for begin in NOT_RUN if command.startswith(begin)]
                        self.assertTrue(begins, "show what it prints, in a ```console block")
                        used.update(begins)
        self.assertEqual(set(NOT_RUN) - used, set())

    def test_name_commands_and_flags_that_exist(self):
        every_flag = set().union(*(flags_of(program, *command) for program in ("albtpu-generate", "albtpu-query")
                                   for command in [[], *([name] for name in commands_of_program(program))]),
                                 flags_of("albtpu-serve"))
        for name in PAGES:
            text = (SOURCE / name).read_text()
            spans = [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", BLOCK.sub("", text))]
            spans += [command for kind, content in blocks(text) if kind == "sh" for command in commands_of(content)]
            for span in spans:
                if match := re.match(r"(?:.*\s)?(albtpu-(?:query|serve|generate))\s(.*)", span):
                    span = match[2]
                    known = flags_of(match[1], *re.findall(r"^[a-z][a-z-]*$", span.split()[0]))
                elif span.startswith("--"):
                    known = every_flag | FLAGS_OF_OTHERS
                else:
                    continue
                with self.subTest(page=name, command=span):
                    self.assertLessEqual(set(re.findall(r"(?<!\S)--[a-z][\w-]*", span)), known)

    def test_link_to_files_and_headings_that_exist(self):
        for name in PAGES:
            page = SOURCE / name
            for link in re.findall(r"\]\(([^)\s]+)\)", BLOCK.sub("", page.read_text())):
                path, _, heading = link.partition("#")
                if "://" not in link:
                    with self.subTest(page=name, link=link):
                        target = page.parent / path if path else page
                        self.assertTrue(target.exists())
                        self.assertTrue(not heading or heading in headings(target))

    def test_name_files_that_exist(self):
        skipped = ("build", "out")
        files = [path for path in SOURCE.rglob("*.*") if path.relative_to(SOURCE).parts[0] not in skipped]
        names = {path.name for path in files}
        for page in (path for path in files if path.suffix == ".md"):
            prose = BLOCK.sub("", page.read_text())
            for name in set(re.findall(r"`([\w./-]+\.(?:cc|cmake|h|md|proto|py|sh|yaml))`", prose)):
                with self.subTest(page=page.relative_to(SOURCE), name=name):
                    folders = (SOURCE, page.parent, page.parent.parent)
                    self.assertTrue(any((folder / name).exists() for folder in folders)
                                    or "/" not in name and name in names)


if __name__ == "__main__":
    if "--write" in sys.argv:
        Documents.setUpClass()
        for written in sys.argv[sys.argv.index("--write") + 1:] or PAGES:
            new = Documents().run_page(written, lambda problem: print(f"{written}: {problem}\n"))
            (SOURCE / written).write_text(new)
        Documents.doClassCleanups()
    else:
        unittest.main(argv=[sys.argv[0], *sys.argv[6:]], verbosity=2)
