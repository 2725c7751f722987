"""Each key of the survey file, by file and by flag: the same refusal from every command, which names what was used.
Each key is given to `pulse` and, in turn, to one of the other commands; with ALBTPU_EVERY_CASE to all of them.

Usage: keys_e2e_test.py query=PROGRAM synthetic_table=PROGRAM
"""

import concurrent.futures
import json
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "programs/query"))
import programs  # noqa: E402
from programs import query  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/survey.md"
COMMANDS = {"pulse": (), "csv": ("in.csv", "out.csv"), "las": ("in.las", "out.las"), "plan": (), "sea": ()}


def wrong_text(key):
    """A text of the flag that is beyond the range of a key, or no word that it takes. key_test.cc has all of them."""
    if key["type"] == "3 numbers":
        return f"0,0,{key['least'] * 2}"
    if key["least"] is not None:
        return f"{key['least'] - max(1, abs(key['least'])):g}"
    return "no-such-word" if key["words"] else None


class EachKey(programs.Test):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.keys = json.loads(query("keys", "--json", check=0).stdout)["keys"]
        cls.helps = {command: query(command, "--help", check=0).stdout for command in COMMANDS}

    def test_is_on_the_page(self):
        self.assertEqual(query("keys", check=0).stdout, PAGE.read_text(),
                         "docs/survey.md is the output of `albtpu-query keys`")
        self.assertGreater(len(self.keys), 60)

    def some(self, number, commands):
        """The first of the commands, and in turn one of the others."""
        first, *others = commands
        if os.environ.get("ALBTPU_EVERY_CASE") or not others:
            return commands
        return [first, others[number % len(others)]]

    def messages(self, calls):
        """The one line on standard error and the exit code of each call."""
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            results = list(pool.map(lambda call: query(*call), calls))
        return {(result.returncode, result.stderr) for result in results}

    def test_is_refused_in_the_file_by_all_commands_alike(self):
        for number, key in enumerate(self.keys):
            head = f"[{key['section']}]"
            if key["section"] in ("sea.waves", "sensor.channel"):
                head = f"[{head}]"
            name = f"'{key['section']}.{key['key']}' "
            survey = self.folder / f"{number}.toml"
            survey.write_text(f"{head}\n{key['key']} = 2020-06-08\n")  # No key takes a date.
            with self.subTest(key=name):
                (code, message), = self.messages((command, *COMMANDS[command], "--survey", survey)
                                                 for command in self.some(number, list(COMMANDS)))
                self.assertEqual(code, 1)
                self.assertIn(f"{survey}: line 2: {name}is 2020-06-08 (expected ", message)
                self.assertEqual(message.count("\n"), 1)

    def test_is_refused_by_its_flag_by_all_commands_alike(self):
        for number, key in enumerate(self.keys):
            if key["flag"]:
                self.assertTrue(any(key["flag"] in text for text in self.helps.values()), key["flag"])
            takers = [command for command, text in self.helps.items() if f"{key['flag']} " in text]
            text = wrong_text(key)
            if key["flag"] and text:
                with self.subTest(flag=key["flag"], text=text):
                    (code, message), = self.messages((command, *COMMANDS[command], f"{key['flag']}={text}")
                                                     for command in self.some(number, takers))
                    self.assertEqual(code, 2)
                    self.assertTrue(message.startswith(f"albtpu-query: {key['flag']}: is '{text}' (expected "), message)


if __name__ == "__main__":
    programs.main()
