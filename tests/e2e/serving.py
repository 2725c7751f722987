"""Runs albtpu-serve for a test, and connects to it."""

import json
import os
import queue
import re
import subprocess
import threading
import urllib.request

import grpc

READY = re.compile(r"ready on (\S+), \d+ tables?, (default '.+'|no default)")
ALLOWANCE = int(os.environ.get("ALBTPU_ALLOWANCE", "1"))  # Factor for time and memory, which sanitizers need.
PATIENCE = 60 * ALLOWANCE  # Seconds: on a loaded machine, milliseconds may become that long.


def connect(address, own_connection=False):
    """A channel. It shares its connection with others to the same server unless it is to have its own."""
    # A proxy from the environment cannot reach our loopback.
    return grpc.insecure_channel(address, options=[("grpc.enable_http_proxy", 0),
                                                   ("grpc.use_local_subchannel_pool", int(own_connection))])


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

    def metrics(self):
        """The page that Prometheus receives from a server with --metrics."""
        url = self.wait_for("metrics on").split()[-1]
        no_proxy = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with no_proxy.open(url, timeout=PATIENCE) as page:
            return page.read().decode()

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
