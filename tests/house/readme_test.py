"""What README.md tells people to type exists: each command, each flag, each file it links to.

Usage: readme_test.py SOURCE_FOLDER PROGRAM... (albtpu-generate and the others, as built)
"""

import pathlib
import re
import shlex
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
PROGRAMS = {pathlib.Path(path).name: path for path in sys.argv[2:]}
README = (SOURCE / "README.md").read_text()


def commands():
    """Each call of a program in a code block, lines that end in a backslash joined."""
    for block in re.findall(r"^```\w*\n(.*?)^```", README, re.MULTILINE | re.DOTALL):
        for line in block.replace("\\\n", " ").splitlines():
            if match := re.search(r"(?:^|/|\s)(albtpu-\w+)((?:\s.*)?)$", line.split("#")[0]):
                if match[1] in PROGRAMS:
                    yield match[1], shlex.split(match[2])


class Readme(unittest.TestCase):
    def test_names_commands_and_flags_that_exist(self):
        found = list(commands())
        self.assertTrue(found)
        for program, arguments in found:
            verbs = [argument for argument in arguments[:1] if not argument.startswith("-")]
            shown = subprocess.run([PROGRAMS[program], *verbs, "--help"], capture_output=True, text=True)
            self.assertEqual(shown.returncode, 0, f"{program} {verbs}: {shown.stderr}")
            for flag in (argument.split("=")[0] for argument in arguments if argument.startswith("--")):
                self.assertIn(flag, re.findall(r"--[\w-]+", shown.stdout), f"{program} {' '.join(verbs)}")

    def test_links_to_files_that_exist(self):
        links = [link for link in re.findall(r"\]\(([^)#]+)\)", README) if "://" not in link]
        for link in links:
            self.assertTrue((SOURCE / link).exists(), link)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
