"""Manual pages and completion for bash, made by the programs, have what --help has; the unit of the server is valid.

Usage: manual_test.py SOURCE ALBTPU_GENERATE ALBTPU_SERVE ALBTPU_QUERY
"""

import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])
PROGRAMS = {pathlib.Path(path).name: path for path in sys.argv[2:]}
SECTIONS = {"albtpu-generate": "1", "albtpu-serve": "8", "albtpu-query": "1"}
UNIT = SOURCE / "packaging/albtpu/albtpu-serve.service"
MOST_EXPOSURE = 2.0  # Of systemd-analyze, from 0 (confined) to 10.


@functools.cache
def printed(program, *arguments):
    return subprocess.run([PROGRAMS[program], *arguments], capture_output=True, text=True, check=True).stdout


def commands_of(program):
    listed = printed(program, "--help").partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  ([a-z-]+)\b", listed, re.MULTILINE)


def flags_of(program, *command):
    options = printed(program, *command, "--help").partition("\nExamples:\n")[0]
    return set(re.findall(r"^  (?:-h,)?(--[\w-]+)", options, re.MULTILINE))


def completions(*words):
    """What bash offers at the end of the last word; --flag=value is three words."""
    program = words[0]
    script = f"""{printed(program, "--bash-completion")}
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_{program.replace("-", "_")}
printf '%s\\n' "${{COMPREPLY[@]}}" """
    offered = subprocess.run(["bash", "-euc", script, "bash", *words], capture_output=True, text=True)
    assert offered.stderr == "" and offered.returncode == 0, offered
    return offered.stdout.split()


class Pages(unittest.TestCase):
    def formatted(self, page):
        if not shutil.which("man"):
            self.skipTest("man is missing; apt-get install man-db")
        with tempfile.NamedTemporaryFile("w", suffix=".1") as file:
            file.write(page)
            file.flush()
            environment = {**os.environ, "MANWIDTH": "4000", "LC_ALL": "C.UTF-8", "MANPAGER": "cat"}
            result = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", file.name], env=environment,
                                    capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return re.sub(r".\x08", "", result.stdout)

    def test_have_every_command_and_option_with_its_help(self):
        for program, section in SECTIONS.items():
            page = self.formatted(printed(program, "--man-page", section))
            self.assertTrue(page.startswith(f"{program.upper()}({section})"), page[:80])
            for command in [[], *([name] for name in commands_of(program))]:
                with self.subTest(program=program, command=command):
                    name = " ".join([program, *command])
                    part = page.partition(f"\n{name}\n")[2] if command else page
                    part = part.partition("\nalbtpu-")[0] if command else part
                    self.assertLessEqual(flags_of(program, *command), set(re.findall(r"--[a-z][\w-]*", part)))
                    for example in re.findall(r"^  (albtpu-.+)$", printed(program, *command, "--help"), re.MULTILINE):
                        self.assertIn(example, page)

    def test_survey_page_has_every_key_with_its_meaning(self):
        page = self.formatted(printed("albtpu-query", "keys", "--man-page"))
        self.assertTrue(page.startswith("ALBTPU-SURVEY(5)"), page[:80])
        for key in json.loads(printed("albtpu-query", "keys", "--json"))["keys"]:
            with self.subTest(section=key["section"], key=key["key"]):
                self.assertRegex(page, rf"(?m)^\s+{key['key']}\s+{re.escape(key['help'])} \(")


class Completion(unittest.TestCase):
    def test_offers_the_commands_of_a_program(self):
        for program in ("albtpu-query", "albtpu-generate"):
            self.assertEqual(completions(program, ""), commands_of(program))
        self.assertEqual(completions("albtpu-query", "tr"), ["trajectory"])

    def test_offers_every_flag_of_a_command(self):
        for program in PROGRAMS:
            for command in [[], *([name] for name in commands_of(program))]:
                with self.subTest(program=program, command=command):
                    self.assertEqual(set(completions(program, *command, "-")), flags_of(program, *command))

    def test_offers_the_words_of_a_flag(self):
        self.assertEqual(completions("albtpu-query", "las", "--trajectory-time", ""), ["gps", "utc"])
        self.assertEqual(completions("albtpu-query", "las", "--trajectory-time", "u"), ["utc"])
        self.assertEqual(completions("albtpu-query", "las", "--trajectory-time", "=", "g"), ["gps"])
        self.assertEqual(completions("albtpu-query", "las", "--trajectory-time", "="), ["gps", "utc"])

    def test_leaves_files_to_bash(self):
        self.assertEqual(completions("albtpu-query", "las", "--survey", ""), [])
        self.assertEqual(completions("albtpu-query", "las", "li"), [])
        self.assertIn("complete -o bashdefault -o default -F", printed("albtpu-query", "--bash-completion"))


@unittest.skipUnless(shutil.which("systemd-analyze"), "systemd-analyze is missing; apt-get install systemd")
class Unit(unittest.TestCase):
    def test_is_valid(self):
        with tempfile.TemporaryDirectory() as folder:
            # The program where it was built; its manual page is not installed.
            text = UNIT.read_text().replace("/usr/bin/albtpu-serve", PROGRAMS["albtpu-serve"])
            unit = pathlib.Path(folder, UNIT.name)
            unit.write_text(re.sub(r"(?m)^Documentation=.*\n", "", text))
            result = subprocess.run(["systemd-analyze", "verify", "--man=no", unit], capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_is_confined(self):
        result = subprocess.run(["systemd-analyze", "security", "--offline=true", UNIT], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLessEqual(float(re.search(r"exposure level for \S+: ([\d.]+)", result.stdout)[1]), MOST_EXPOSURE)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
