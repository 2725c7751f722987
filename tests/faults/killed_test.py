"""The server or the client is killed (SIGKILL) repeatedly; the files are byte for byte those made in process.
ALBTPU_EVERY_CASE kills more often, in longer files.

Usage: killed_test.py NAME=PATH..., see programs.py
"""

import os
import random
import shutil
import signal

import faults
import many_files_e2e_test as many_files
import programs
import serving

SERVER_KILLS, CLIENT_KILLS, LENGTH = (20, 12, 10) if os.environ.get("ALBTPU_EVERY_CASE") else (8, 6, 3)

LINES = 4  # Of the survey that a killed client annotates.


def wait_for_written(process, size):
    """Waits until the process has written `size` bytes. False if it ended before."""
    def is_written():
        so_far = faults.written(process)
        return so_far is None or so_far >= size
    faults.wait_until(is_written, f"{size} bytes are written")
    return process.poll() is None


class Killed(faults.FaultTest):
    def setUp(self):
        super().setUp()
        self.random = random.Random(faults.SEED)
        self.flight = programs.make_flight(self.folder / "flight.las")

    def make_csv(self, path, count):
        pulses = faults.random_pulses(count)
        rows = zip(*(pulses[axis].tolist() for axis in faults.AXES))
        path.write_text("\n".join([",".join(faults.AXES), *(",".join(map(repr, row)) for row in rows), ""]))
        return path

    def assert_survives_kills_of_the_server(self, command, source, flags):
        expected, target = (self.folder / name / f"out{source.suffix}" for name in ("expected", "out"))
        for path in (expected, target):
            path.parent.mkdir()
        programs.query(command, source, expected, "--table", self.tables / "survey.h5", *flags, check=0)
        server = self.serve()
        client = self.start_query(command, source, target, "--server", server.address, *flags)
        size, kills = expected.stat().st_size, 0
        for i in range(SERVER_KILLS):
            if not wait_for_written(client, size * (i + self.random.random()) / (SERVER_KILLS + 1)):
                break
            server.process.kill()
            server.process.wait()
            server, kills = self.serve(listen=server.address), kills + 1
        errors = client.communicate(timeout=2 * serving.PATIENCE)[1]
        self.assertEqual(client.returncode, 0, errors)
        self.assertEqual(target.read_bytes(), expected.read_bytes())
        summaries = [path.with_name(path.name + ".json").read_bytes() for path in (target, expected)]
        self.assertEqual(*summaries)
        self.assertEqual(len(list(target.parent.iterdir())), 2)
        print(f"{command}: {size >> 20} MiB, the server was killed {kills} times")
        self.assertGreaterEqual(kills, SERVER_KILLS - 1)

    def test_killed_server_does_not_change_las_files(self):
        source = many_files.repeat(self.flight, self.folder / "long.las", 15 * LENGTH)
        self.assert_survives_kills_of_the_server("las", source, programs.FLAGS)

    def test_killed_server_does_not_change_laz_files(self):
        source = faults.compress(many_files.repeat(self.flight, self.folder / "long.las", 10 * LENGTH))
        self.assert_survives_kills_of_the_server("las", source, programs.FLAGS)

    def test_killed_server_does_not_change_csv_files(self):
        self.assert_survives_kills_of_the_server("csv", self.make_csv(self.folder / "long.csv", 80_000 * LENGTH), ())

    def assert_survives_kills_of_the_client(self, command, flags):
        survey = self.folder / "survey"
        expected, out = self.folder / "expected", self.folder / "out"
        for folder in (expected, out):
            folder.mkdir()
        flags = ("--server", self.serve().address, *flags)
        programs.query(command, survey, "--output-dir", expected, *flags, check=0)
        complete = {path.name: path.read_bytes() for path in expected.iterdir()}
        most = 2 * max(map(len, complete.values()))  # Two files may be written at a time.
        kills = seen = 0
        for _ in range(CLIENT_KILLS):
            client = self.start_query(command, survey, "--output-dir", out, *flags, "--resume")
            if wait_for_written(client, most * self.random.random()):
                kills += 1
            client.send_signal(signal.SIGKILL)
            client.wait()
            for path in out.iterdir():  # A file that has its name is complete.
                self.assertEqual(path.read_bytes(), complete.get(path.name), path.name)
                seen += 1
        programs.query(command, survey, "--output-dir", out, *flags, "--resume", check=0)
        self.assertEqual({path.name: path.read_bytes() for path in out.iterdir()}, complete)
        print(f"{command}: the client was killed {kills} times, and left {seen} files")
        self.assertGreater(kills, CLIENT_KILLS // 2)
        self.assertGreater(seen, 0)

    def test_client_leaves_only_complete_las_files(self):
        (self.folder / "survey").mkdir()
        for i in range(LINES):
            many_files.repeat(self.flight, self.folder / "survey" / f"line{i}.las", 20)
        self.assert_survives_kills_of_the_client("las", programs.FLAGS)

    def test_client_leaves_only_complete_laz_files(self):
        (self.folder / "survey").mkdir()
        line = faults.compress(many_files.repeat(self.flight, self.folder / "line.las", 20))
        for i in range(LINES):
            shutil.copy(line, self.folder / "survey" / f"line{i}.laz")
        self.assert_survives_kills_of_the_client("las", programs.FLAGS)

    def test_client_leaves_only_complete_csv_files(self):
        (self.folder / "survey").mkdir()
        line = self.make_csv(self.folder / "line.csv", 100_000)
        for i in range(LINES):
            shutil.copy(line, self.folder / "survey" / f"line{i}.csv")
        self.assert_survives_kills_of_the_client("csv", ())


if __name__ == "__main__":
    programs.main()
