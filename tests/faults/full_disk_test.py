"""On a full disk no output is left behind, and the server continues.

Usage: full_disk_test.py NAME=PATH..., see programs.py
"""

import atexit
import ctypes
import errno
import os
import pathlib
import subprocess
import tempfile

import albtpu
import faults
import many_files_e2e_test as many_files
import programs
import serving

CLONE_NEWNS = 0x20000
MS_REC_PRIVATE = 0x4000 | 1 << 18
ROOM, LEFT = 256 << 10, 8 << 10  # Bytes: size of the disk, and space left on it for a log.
LIBC = ctypes.CDLL(None, use_errno=True)


def check(result, action):
    """Raises an OSError that says why a system call failed, and what it needs."""
    if result == 0:
        return
    number = ctypes.get_errno()
    if number == errno.EINVAL:
        need = "/ must be a mount point (before a chroot, bind-mount its folder on itself)"
    else:
        need = "run as root with CAP_SYS_ADMIN (in a container: --cap-add SYS_ADMIN)"
    raise OSError(number, f"cannot {action} ({os.strerror(number)}); {need}")


def make_small_disk():
    """Mounts a tmpfs that only this process and its children see. Returns its folder, or None and the reason."""
    folder = tempfile.mkdtemp()
    try:
        check(LIBC.unshare(CLONE_NEWNS), "create a mount namespace")
        check(LIBC.mount(b"none", b"/", None, MS_REC_PRIVATE, None), "make the mounts below / private")
        check(LIBC.mount(b"tmpfs", os.fsencode(folder), b"tmpfs", 0, b"size=%d" % ROOM), "mount a tmpfs")
    except OSError as error:
        os.rmdir(folder)
        return None, f"this test needs a small disk: {error.strerror}"
    atexit.register(os.rmdir, folder)
    atexit.register(subprocess.run, ["umount", "--lazy", folder], check=False)  # Runs first: last in, first out.
    return pathlib.Path(folder), None


DISK, WHY_NOT = make_small_disk()


class FullDisk(faults.FaultTest):
    """Runs programs where at most ROOM bytes can be written."""

    prefix = ()

    def setUp(self):
        super().setUp()
        if DISK is None:
            self.skipTest(WHY_NOT)
        self.room = DISK
        self.addCleanup(self.clear)

    def clear(self):
        for path in self.room.iterdir():
            path.unlink()

    def assert_writes_nothing(self, name, *command):
        command = [*self.prefix, *map(str, command)]
        result = subprocess.run(command, capture_output=True, text=True, timeout=serving.PATIENCE, check=False)
        self.assertEqual(result.returncode, 1, result.stderr)
        errors = [line for line in result.stderr.splitlines() if "albtpu-query: table synthetic" not in line]
        self.assertEqual(len(errors), 1, result.stderr)
        self.assertRegex(errors[0], f"{name}.*(No space left|File too large)")
        self.assertEqual(list(self.room.iterdir()), [])

    def test_leaves_no_output(self):
        flight = programs.make_flight(self.folder / "flight.las")
        csv = self.folder / "pulses.csv"
        csv.write_text("wind_speed,incidence,footprint,depth\n" + "5,12,0.5,8\n" * 20000)
        long = many_files.repeat(flight, self.folder / "long.las", 20)
        laz = faults.compress(long)
        self.assertGreater(laz.stat().st_size, 2 * ROOM)
        server = self.serve()
        for source in ("--table", self.tables / "survey.h5"), ("--server", server.address):
            for command, path, flags in (("las", flight, programs.FLAGS), ("las", laz, programs.FLAGS),
                                         ("csv", csv, ())):
                with self.subTest(path.suffix, source=source[0]):
                    name = f"out{path.suffix}"
                    self.assert_writes_nothing(name, programs.PATHS["query"], command, path, self.room / name,
                                               *source, *flags)
        self.assert_drains(server)

    def test_leaves_no_table(self):
        self.assert_writes_nothing("table.h5", programs.PATHS["synthetic_table"], self.room / "table.h5")

    def test_for_the_log_does_not_stop_the_server(self):
        log = self.room / "log"
        log.write_bytes(b"\n" * (ROOM - LEFT))
        with open(log, "ab") as file:
            process = subprocess.Popen([*self.prefix, programs.PATHS["serve"], "--tables", self.tables,
                                        "--listen", "127.0.0.1:0"], stderr=file)
        self.addCleanup(process.kill)
        faults.wait_until(lambda: b"\n" in log.read_bytes().lstrip(b"\n"), "the server is ready")
        address = serving.READY.search(log.read_text())[1]
        with albtpu.connect(address) as service:
            for _ in range(2 * LEFT // 100):  # Each call logs a line of more than 100 bytes.
                with self.assertRaises(albtpu.ServiceError):
                    service.query(**self.pulses, table="unknown" * 12)
                self.assert_answers(service)
        self.assertEqual(log.stat().st_size, ROOM)
        process.terminate()
        self.assertEqual(process.wait(serving.PATIENCE), 0)


class FileLimit(FullDisk):
    """The same where the system limits the size of a file (ulimit -f)."""

    prefix = ("prlimit", f"--fsize={ROOM}")
    test_leaves_no_table = None  # The limit would end the program of the tests that writes tables.

    def setUp(self):
        faults.FaultTest.setUp(self)
        self.room = self.folder / "room"
        self.room.mkdir()


if __name__ == "__main__":
    programs.main()
