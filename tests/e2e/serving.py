"""Runs albtpu-serve for a test, and makes clients for it from the .proto files alone."""

import atexit
import json
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import threading

import grpc

READY = re.compile(r"ready on (\S+), \d+ tables?, (default '.+'|no default)")
ALLOWANCE = int(os.environ.get("ALBTPU_ALLOWANCE", "1"))  # Factor for time and memory, which sanitizers need.
PATIENCE = 60 * ALLOWANCE  # Seconds: on a loaded machine, milliseconds may become that long.


def make_stubs(*protos):
    """Generates importable modules from `protos`, pairs of an import folder and a path in it.

    Returns the folder of the modules.
    """
    output = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, output)
    for folder, path in protos:
        subprocess.run(["protoc", "-I", folder, f"--python_out={output}", f"--grpc_out={output}",
                        "--plugin=protoc-gen-grpc=/usr/bin/grpc_python_plugin", path], check=True)
    sys.path.insert(0, output)
    return output


def connect(address):
    # A proxy from the environment cannot reach our loopback.
    return grpc.insecure_channel(address, options=[("grpc.enable_http_proxy", 0)])


def message_of(line):
    """The message of a log line in either style."""
    if line.startswith("{"):
        return json.loads(line)["message"]
    return line.removeprefix("albtpu-serve: ")


class Server:
    """A running albtpu-serve on a free port. `prefix` is a command that executes the server."""

    def __init__(self, program, *flags, listen="127.0.0.1:0", environment=None, prefix=()):
        self.process = subprocess.Popen([*prefix, program, "--listen", listen, *flags], stderr=subprocess.PIPE,
                                        text=True, env={**os.environ, **(environment or {})})
        self.lines = []
        self.logged = threading.Condition()
        first_line = queue.Queue()
        self._reader = threading.Thread(target=self._read, args=(first_line,), daemon=True)
        self._reader.start()
        try:
            line = first_line.get(timeout=PATIENCE)
            ready = READY.fullmatch(message_of(line))
            if not ready:
                self.process.wait(PATIENCE)
                raise RuntimeError(line)
        except BaseException:
            self.__exit__()
            raise
        self.address = ready[1]

    def _read(self, first_line):
        for line in self.process.stderr:
            with self.logged:
                self.lines.append(line.rstrip("\n"))
                self.logged.notify_all()
            if len(self.lines) == 1:
                first_line.put(self.lines[0])
        first_line.put("albtpu-serve wrote nothing")

    def wait_for(self, text, times=1):
        """Waits until `times` lines of the log contain `text`; returns the first of them."""
        def found():
            return [line for line in self.lines if text in line]
        with self.logged:
            if not self.logged.wait_for(lambda: len(found()) >= times, PATIENCE):
                raise RuntimeError(f"no '{text}' in the log: {self.lines}")
            return found()[0]

    def stop(self, signal):
        """Sends `signal`; returns the exit code."""
        self.process.send_signal(signal)
        return self.process.wait(PATIENCE)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self._reader.join()
        self.process.stderr.close()
