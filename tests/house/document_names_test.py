"""The commands, flags, files and headings that the documents name exist, and each command that is not run has a reason.

Usage: document_names_test.py SOURCE ALBTPU_GENERATE ALBTPU_SERVE ALBTPU_QUERY
"""

import functools
import pathlib
import re
import subprocess
import sys
import unittest

import documents

SOURCE = pathlib.Path(sys.argv[1]).resolve()
PROGRAMS = {pathlib.Path(path).name: path for path in sys.argv[2:5]}

# Commands of ```sh blocks, by how they begin.
NOT_RUN = {
    "./quickstart.sh": "builds the programs; its command las is in the README, with its result",
    "./test.sh": "runs this test",
    "./package.sh": "tests/e2e/packages.sh, which needs root and takes long",
    "apt": "tests/e2e/packages_test.py installs and purges the packages in a bare root",
    "man": "tests/programs/command_line/manual_test.py formats the pages",
    "systemctl": "needs systemd; tests/programs/command_line/manual_test.py verifies the unit",
    "journalctl": "needs systemd",
    "cmake": "tests/clients/cpp/package_test.py configures and builds the examples",
    "build/": "tests/clients/cpp/package_test.py runs the examples",
    "docker": "tests/e2e/containers.sh, which needs an engine",
    "tar --extract": "tests/e2e/portable_test.py unpacks the archive on bare systems",
    "albtpu-*-linux-x86_64/bin/": "tests/e2e/portable_test.py runs the programs of the archive",
    "mpirun": "tests/programs/generate/scale_out_test.py runs ranks, where there is MPI",
    "albtpu-generate table": "takes minutes; tests/programs/generate/generate_test.py makes smaller tables",
    "albtpu-generate merge": "needs the shards of all machines; tests/programs/generate/generate_test.py merges some",
    "albtpu-generate plan": "measures this machine",
    "albtpu-generate validate": "takes ten minutes",
    "/usr/bin/python3 tests/bench": "takes minutes and measures this machine",
    "b/tests/bench": "measures this machine",
    "python3 -m venv": "tests/clients/python/install_test.py and tests/e2e/portable_test.py install the package",
    "grpcurl": "is not installed; tests/e2e/reload_test.py reloads tables",
    "kill": "needs the server of an installation",
    "cp": "needs the folder of an installation",
    "albtpu-query tables --server HOST:PORT": "needs the server of an installation",
    "albtpu_simulated_survey F --seconds 150": "makes 6 million points to measure this machine",
    "albtpu_laz_copy F/flight.las": "compresses 6 million points to measure this machine",
    "albtpu-query las F/flight.laz": "annotates 6 million points to measure this machine",
}
# Of docker, podman, pip, benchmarks and this test.
FLAGS_OF_OTHERS = {"--entrypoint", "--laz", "--millions", "--no-build-isolation", "--no-deps",
                   "--no-install-recommends", "--stop-timeout", "--tmpfs", "--user", "--userns", "--write"}


@functools.cache
def help_of(program, *command):
    return subprocess.run([PROGRAMS[program], *command, "--help"], capture_output=True, text=True, check=True).stdout


def flags_of(program, *command):
    return set(re.findall(r"--[\w-]+", help_of(program, *command)))


def commands_of_program(program):
    return re.findall(r"^  ([a-z-]+)\b", help_of(program).partition("\nSubcommands:\n")[2].partition("\n\n")[0], re.M)


class Commands(unittest.TestCase):
    def test_are_run_or_have_a_reason(self):
        used = set()
        for name in documents.pages(SOURCE):
            for command in documents.commands_not_run((SOURCE / name).read_text()):
                with self.subTest(page=name, command=command):
                    begins = [begin for begin in NOT_RUN if command.startswith(begin)]
                    self.assertTrue(begins, "show what it prints, in a ```console block")
                    used.update(begins)
        self.assertEqual(set(NOT_RUN) - used, set())
        for test in re.findall(r"tests/[\w/.]+", " ".join(NOT_RUN.values())):
            self.assertTrue((SOURCE / test).exists(), test)

    def test_name_commands_and_flags_that_exist(self):
        every_flag = set().union(*(flags_of(program, *command) for program in ("albtpu-generate", "albtpu-query")
                                   for command in [[], *([name] for name in commands_of_program(program))]),
                                 flags_of("albtpu-serve"))
        for name in documents.pages(SOURCE):
            text = (SOURCE / name).read_text()
            spans = [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", documents.BLOCK.sub("", text))]
            spans += documents.commands_not_run(text)
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
        for name in documents.pages(SOURCE):
            page = SOURCE / name
            for link in re.findall(r"\]\(([^)\s]+)\)", documents.BLOCK.sub("", page.read_text())):
                path, _, heading = link.partition("#")
                if "://" not in link:
                    with self.subTest(page=name, link=link):
                        target = page.parent / path if path else page
                        self.assertTrue(target.exists())
                        self.assertTrue(not heading or heading in documents.headings(target))

    def test_name_files_that_exist(self):
        skipped = ("build", "out")
        files = [path for path in SOURCE.rglob("*.*") if path.relative_to(SOURCE).parts[0] not in skipped]
        names = {path.name for path in files}
        for page in (path for path in files if path.suffix == ".md"):
            prose = documents.BLOCK.sub("", page.read_text())
            for name in set(re.findall(r"`([\w./-]+\.(?:cc|cmake|h|md|proto|py|sh|yaml))`", prose)):
                with self.subTest(page=page.relative_to(SOURCE), name=name):
                    folders = (SOURCE, page.parent, page.parent.parent)
                    self.assertTrue(any((folder / name).exists() for folder in folders)
                                    or "/" not in name and name in names)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
