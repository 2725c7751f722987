"""What albtpu-query shows while it works: one line of a terminal, and nothing that redraws elsewhere."""

import contextlib
import fcntl
import os
import pathlib
import pty
import re
import struct
import subprocess
import sys
import termios

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "query"))
import programs  # noqa: E402
from commands import make_folder  # noqa: E402
from las_file import repeat  # noqa: E402
from programs import query  # noqa: E402
from reported_survey import annotate  # noqa: E402
from simulated_survey import SimulatedSurvey  # noqa: E402

FILES, TIMES, COLUMNS = 5, 20, 72
LONG = "a_name_of_a_line_that_is_wider_than_all_of_the_terminal_so_that_it_has_to_be_cut"
DRAWN = re.compile(r"\[(#*)(\.*)\] (\d+) %, [\d.]+ (?:million )?points/s, \d+ s left")


def on_terminal(*arguments):
    """What a program writes to a terminal of COLUMNS columns as its standard error; slowly, on one processor."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, COLUMNS, 0, 0))
    process = subprocess.Popen([programs.PATHS["query"], *map(str, arguments)], stdout=subprocess.DEVNULL,
                               stderr=theirs,
                               preexec_fn=lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
    os.close(theirs)
    written = b""
    with contextlib.suppress(OSError):  # The end of a terminal is an error of reading.
        while part := os.read(ours, 65536):
            written += part
    os.close(ours)
    if process.wait() != 0:
        raise AssertionError(written.decode())
    return written.decode().replace("\r\n", "\n")


class Progress(programs.Test):
    """Five files with so many points that the bar is redrawn in each command."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = make_folder(cls.addClassCleanup)
        table = programs.make_table(folder / "quick.h5")
        flight = SimulatedSurvey(folder / "flight", "--lines", FILES - 1, "--cross-lines", 1, "--seconds", 5,
                                 "--pulse-rate", 2500, "--file-for-each-line").folder
        for path in list(flight.glob("*.las")):
            repeat(path, path.with_name(f"{LONG}_{path.name}"), TIMES)
            path.unlink()
        cls.annotation = annotate(flight, folder / "annotated", table)
        (folder / "again").mkdir()
        flags = {"las": ("--output-dir", folder / "again", "--survey", folder / "annotated.toml", "--table", table),
                 "report": ("--output", folder / "report", "--no-page"), "surface": ("--output", folder / "surface")}
        cls.commands = {name: (flight if name == "las" else folder / "annotated", *flags[name], "--overwrite")
                        for name in flags}

    def test_is_one_line_of_a_terminal(self):
        self.assertGreater(len(LONG), COLUMNS)
        redrawn = 0
        for name, arguments in self.commands.items():
            with self.subTest(name):
                written, seen = on_terminal(name, *arguments), []
                for line in written.split("\n"):
                    # Each drawing begins at the first column, erases what was there, and fits.
                    for drawn in line.split("\r")[1:]:
                        shown, erased, left = drawn.partition("\033[K")
                        self.assertEqual(erased, "\033[K", line)
                        if shown == "":  # What stays is a message, not a bar.
                            self.assertNotRegex(left, DRAWN)
                            continue
                        self.assertEqual(left, "")
                        self.assertLess(len(shown), COLUMNS)
                        bar, rest, percent = DRAWN.match(shown).groups()
                        self.assertAlmostEqual(len(bar) / len(bar + rest), int(percent) / 100, delta=0.06)
                        seen.append(int(percent))
                # A surface may be made before the first bar is due.
                self.assertTrue(seen or name == "surface", written)
                redrawn += len(seen)
        self.assertGreater(redrawn, 5)

    def test_is_not_shown_elsewhere_and_five_files_print_few_lines(self):
        for name, arguments in self.commands.items():
            with self.subTest(name):
                result = self.annotation if name == "las" else query(name, *arguments, check=0)
                self.assertNotRegex(result.stderr, r"[\r\033]|points/s, \d+ s left")
                self.assertLessEqual(len((result.stdout + result.stderr).splitlines()), 45, name)


if __name__ == "__main__":
    programs.main()
