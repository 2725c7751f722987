"""Containers for a test: the engine's commands, and servers that are removed when the test ends."""

import json
import os
import pathlib
import subprocess
import sys
import time
import unittest

PATIENCE = 600  # s; a loaded machine may be slow.
ENGINE = sys.argv[1]
IS_PODMAN = pathlib.Path(ENGINE).name == "podman"
TAG = os.environ.get("ALBTPU_TAG", "latest")  # Tag of the images; docker/build.sh reads the same variable.
SERVE, QUERY, GENERATE = (f"albtpu-{name}:{TAG}" for name in ("serve", "query", "generate"))

# As docs/operations.md recommends. By default, podman leaves /tmp writable.
RESTRICTED = ("--read-only", *(("--read-only-tmpfs=false",) if IS_PODMAN else ()), "--cap-drop", "all",
              "--security-opt", "no-new-privileges")


def run(*command, check=True, **options):
    """Returns the standard output of the command."""
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=PATIENCE,
                            stdin=subprocess.DEVNULL, **options)
    if check and result.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}: {result.stdout}{result.stderr}")
    return result.stdout


def engine(*command, **options):
    return run(ENGINE, *command, **options)


def inspect(kind, name):
    return json.loads(engine(kind, "inspect", name))[0]


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"timed out waiting for {what}")
        time.sleep(0.2)


class Container:
    def __init__(self, image, *arguments, flags=()):
        self.name = engine("run", "--detach", *RESTRICTED, *flags, image, *arguments).strip()

    def log(self):
        result = subprocess.run([ENGINE, "logs", self.name], capture_output=True, text=True, timeout=PATIENCE)
        return result.stdout + result.stderr

    def running(self):
        return inspect("container", self.name)["State"]["Running"]

    def exit_code(self):
        return inspect("container", self.name)["State"]["ExitCode"]

    def stop(self):
        """Sends the image's stop signal, and SIGKILL after one minute."""
        engine("stop", "--time", "60", self.name)

    def remove(self):
        engine("rm", "--force", "--volumes", self.name, check=False)


class Server(Container):
    """albtpu-serve, with its ports published on free ports of this machine."""

    def __init__(self, *arguments, flags=()):
        super().__init__(SERVE, *arguments,
                         flags=("--publish", "127.0.0.1::50051", "--publish", "127.0.0.1::9464", *flags))
        try:
            wait_for(lambda: "ready on" in self.log() or not self.running(), "the server")
        except AssertionError:
            self.remove()
            raise

    def address(self, port=50051):
        return engine("port", self.name, port).split()[0]

    def is_healthy(self):
        """The result of the image's HEALTHCHECK."""
        if IS_PODMAN:  # Podman runs it periodically only under systemd.
            return subprocess.run([ENGINE, "healthcheck", "run", self.name], capture_output=True,
                                  timeout=PATIENCE).returncode == 0
        wait_for(lambda: inspect("container", self.name)["State"]["Health"]["Status"] != "starting", "its health")
        return inspect("container", self.name)["State"]["Health"]["Status"] == "healthy"

    def memory_peak(self):
        """Peak memory of the control group in bytes, or None if the kernel does not report it."""
        pid = inspect("container", self.name)["State"]["Pid"]
        for line in pathlib.Path(f"/proc/{pid}/cgroup").read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            for file in (f"/sys/fs/cgroup/memory{path}/memory.max_usage_in_bytes", f"/sys/fs/cgroup{path}/memory.peak"):
                if ("memory" in controllers or not controllers) and os.path.exists(file):
                    return int(pathlib.Path(file).read_text())
        return None


class ContainerTest(unittest.TestCase):
    def start(self, image, *arguments, flags=()):
        container = Container(image, *arguments, flags=flags)
        self.addCleanup(container.remove)
        return container

    def serve(self, *arguments, flags=()):
        server = Server(*arguments, flags=flags)
        self.addCleanup(server.remove)
        return server
