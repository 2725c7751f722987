"""The help of every command ends with two examples that work, and every flag in them exists.

Usage: help_test.py ALBTPU_GENERATE ALBTPU_SERVE ALBTPU_QUERY
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = {pathlib.Path(path).name: path for path in sys.argv[1:]}
PATIENCE = 300  # seconds
LESS = {"point": " --relative-error 0.2", "water-point": " --photons 10000"}  # Of what they compute.


def help_of(program, *command):
    shown = subprocess.run([PROGRAMS[program], *command, "--help"], capture_output=True, text=True, check=True)
    assert shown.stderr == "", shown.stderr
    return shown.stdout


def commands():
    """(program, help) and (program, command, help) of all programs."""
    for program in PROGRAMS:
        text = help_of(program)
        yield program, "", text
        listed = text.partition("\nSubcommands:\n")[2].partition("\n\n")[0]
        for command in re.findall(r"^  ([a-z-]+)\b", listed, re.MULTILINE):
            yield program, command, help_of(program, command)


def examples(text):
    return re.findall(r"^  (.+)$", text.partition("\nExamples:\n")[2], re.MULTILINE)


class Help(unittest.TestCase):
    def test_is_there_for_all_commands(self):
        self.assertEqual({(program, command) for program, command, _ in commands() if command},
                         {("albtpu-generate", command)
                          for command in ("table", "merge", "plan", "keys", "point", "water-point", "validate")} |
                         {("albtpu-query", command)
                          for command in ("init", "pulse", "csv", "las", "plan", "report", "surface", "crosscheck",
                                         "checkpoints", "sea", "trajectory", "sensors", "keys", "tables", "health")})

    def test_ends_with_two_examples_of_flags_that_exist(self):
        for program, command, text in commands():
            with self.subTest(program=program, command=command):
                self.assertRegex(text, r"\nExamples:\n  .+\n  .+\n\Z")
                for example in examples(text):
                    words = shlex.split(example)
                    self.assertEqual(words[:2] if command else words[:1], [program, command] if command else [program])
                    listed = text if command or words[1].startswith("-") else help_of(program, words[1])
                    for flag in (word for word in words if word.startswith("--")):
                        self.assertIn(flag, re.findall(r"--[\w-]+", listed.partition("\nExamples:\n")[0]), example)

    def test_shows_options_in_groups(self):
        for program, command, text in commands():
            with self.subTest(program=program, command=command):
                options = re.search(r"^Options:\n((?:  .*\n)*)", text, re.MULTILINE)[1]
                self.assertLessEqual(set(re.findall(r"--[\w-]+", options)), {"--help", "--version"})

    def test_examples_are_good_usage(self):
        """In a folder without their files they fail (exit 1), but their arguments are taken (exit 2 otherwise)."""
        for program, command, text in commands():
            for example in examples(text):
                with self.subTest(example=example), tempfile.TemporaryDirectory() as folder:
                    pathlib.Path(folder, "report").write_text("")  # `validate` fails at once, not after minutes.
                    environment = {**os.environ, "ALBTPU_TABLES": os.path.join(folder, "no_tables"),
                                   "PATH": os.path.dirname(PROGRAMS[program]) + os.pathsep + os.environ["PATH"]}
                    line = example + LESS.get(shlex.split(example)[1], "")
                    result = subprocess.run(line, shell=True, cwd=folder, env=environment, capture_output=True,
                                            text=True, timeout=PATIENCE)
                    self.assertIn(result.returncode, (0, 1), result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
