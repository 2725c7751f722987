"""The commands of the documents run, and print what stands below them.

In a ```console block, the lines after "$ " are commands, and all others are their output (of both streams), which is
compared with what a run prints. A line of "..." stands for lines that are left out, "..." in a line for text. A command
that ends with "# exit code N" exits with N, every other with 0. A ```toml or ```csv block that begins with "# NAME" is
the file NAME of the commands that follow. A ```python block runs by itself; a ```text block after it is what it prints.
A ```bash block runs as a whole, and must succeed. A ```sh block is not run; document_names_test.py has the reason for
each of its commands.

The commands of a page run in a folder with simulated surveys, whose files document_inputs.py names, and with links to
folders of the source. 127.0.0.1:50051 is a server that runs for the page.

Usage: documents_test.py SOURCE ALBTPU_GENERATE ALBTPU_SERVE ALBTPU_QUERY ALBTPU_SIMULATED_SURVEY [--write PAGE...]
(--write puts what is printed now into the pages, with the same lines left out)
"""

import difflib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

import documents
from document_inputs import make_inputs

SOURCE = pathlib.Path(sys.argv[1]).resolve()
PROGRAMS = {pathlib.Path(path).name: pathlib.Path(path).resolve() for path in sys.argv[2:6]}
ADDRESS = "127.0.0.1:50051"
PATIENCE = 300  # seconds
MARK = "..."    # Something is left out.
PROGRESS = re.compile(r" %, .*/s, \d+ s left$|: \d+ \w+ in [\d.]+ s: .*/s$")  # Printed where a command takes long.


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
        lines = result.stdout.replace(address, ADDRESS).splitlines()
        return result.returncode, [line for line in lines if not PROGRESS.search(line)]


def checked(page, text, fail):
    """Runs all of a page's blocks; calls `fail` with what differs; returns the page with what is printed now."""
    printed = None  # By the last ```python or ```bash block.

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
            for command, output in documents.shown(content):
                code = int((re.search(r"# exit code (\d+)$", command) or [0, 0])[1])
                lines += [f"$ {command}", *check(command, code, page.run(command), output)]
            content = "".join(line + "\n" for line in lines)
        elif kind in ("python", "bash"):
            printed = page.execute([sys.executable, "-c", content] if kind == "python" else ["bash", "-euc", content],
                                   content)
            if printed[0] != 0:
                fail("\n".join([content, *printed[1]]))
        elif kind == "text":
            content = "".join(line + "\n" for line in check("python", 0, printed, content.splitlines()))
        elif kind in ("toml", "csv") and (name := re.match(r"# (\S+\.\w+)\b.*\n", content)):
            (page.folder / name[1]).write_text(content if kind == "toml" else content[name.end():])
        return f"```{kind}\n{content}```"

    return documents.BLOCK.sub(replace, text)


class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="albtpu_documents_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        make_inputs(cls.folder, PROGRAMS["albtpu_simulated_survey"])

    def run_page(self, name, fail):
        folder = self.folder / name.replace("/", "_")
        folder.mkdir()
        page = Page(folder, self.folder / "inputs")
        try:
            return checked(page, (SOURCE / name).read_text(), fail)
        finally:
            page.close()

    def test_show_what_their_commands_print(self):
        for name in documents.pages(SOURCE):
            problems = []
            self.run_page(name, problems.append)
            for problem in problems:
                with self.subTest(page=name):
                    self.fail(problem)


if __name__ == "__main__":
    if "--write" in sys.argv:
        Documents.setUpClass()
        for written in sys.argv[sys.argv.index("--write") + 1:] or documents.pages(SOURCE):
            new = Documents().run_page(written, lambda problem: print(f"{written}: {problem}\n"))
            (SOURCE / written).write_text(new)
        Documents.doClassCleanups()
    else:
        unittest.main(argv=[sys.argv[0], *sys.argv[6:]], verbosity=2)
