"""Shared by tests of access to albtpu-serve: certificates, clients and checks of refusals.

The script that imports this gets the paths of the programs as arguments: ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
ALBTPU_QUERY.
"""

import os
import pathlib
import secrets
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

import albtpu
from authority import Authority
from serving import PATIENCE, Server

SERVE, SYNTHETIC_TABLE, QUERY = sys.argv[1:4]
PULSE = dict(wind_speed=5, incidence=10, footprint=0.5, depth=8)
BUDGET = dict(PULSE, altitude=400, beam_azimuth=90, located="level")
PULSE_FLAGS = [word for name, value in PULSE.items() for word in (f"--{name.replace('_', '-')}", str(value))]


class SecurityTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "tables").mkdir()
        subprocess.run([SYNTHETIC_TABLE, cls.folder / "tables" / "quick.h5"], check=True)
        cls.authority, cls.stranger = (Authority(cls.folder, name) for name in ("authority", "stranger"))
        cls.certificate, cls.key = cls.authority.issue("server")
        cls.client = dict(zip(("cert", "key"), cls.authority.issue("client")))
        cls.ca = cls.authority.certificate
        cls.token = secrets.token_hex(32)

    def file(self, name, text):
        """Writes a file atomically."""
        path = self.folder / name
        (self.folder / "new").write_text(text)
        os.replace(self.folder / "new", path)
        return path

    def copy(self, source, name):
        return self.file(name, source.read_text())

    def tls(self, *more, certificate=None, key=None):
        return ("--tls-cert", certificate or self.certificate, "--tls-key", key or self.key, *more)

    def serve(self, *flags, **options):
        server = Server(SERVE, "--tables", self.folder / "tables", *flags, **options)
        self.addCleanup(server.__exit__)
        return server

    def connect(self, server, **credentials):
        service = albtpu.connect(server.address, patience=0, timeout=PATIENCE, **credentials)
        self.addCleanup(service.close)
        return service

    def query(self, server, *flags, address=None):
        return subprocess.run([QUERY, "pulse", *PULSE_FLAGS, "--server", address or server.address, *flags],
                              capture_output=True, text=True, timeout=PATIENCE)

    def metrics(self, server):
        """The text that Prometheus receives from `server`."""
        url = server.wait_for("metrics on").split()[-1]
        no_proxy = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with no_proxy.open(url, timeout=PATIENCE) as answer:
            return answer.read().decode()

    def wait_for_line(self, server, text):
        """Waits until the log of `server` contains `text`."""
        end = time.monotonic() + PATIENCE
        while not any(text in line for line in server.lines):
            self.assertLess(time.monotonic(), end, server.lines)
            time.sleep(0.01)

    def assert_answers(self, server, **credentials):
        """The server answers both the Python package and albtpu-query."""
        token = credentials.pop("token", None)
        flags = [word for name, path in credentials.items() for word in (f"--tls-{name}", path)]
        if token:
            flags += ["--token-file", self.file("token.client", token + "\n")]
        service = self.connect(server, **credentials, token=token)
        for answer in (service.query(**PULSE), service.query_budget(**BUDGET)):
            self.assertEqual(str(answer.outcome), "INTERPOLATED")
        result = self.query(server, *flags)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("INTERPOLATED", result.stdout)

    def assert_refuses(self, server, code, problem, **credentials):
        token = credentials.pop("token", None)
        flags = [word for name, path in credentials.items() for word in (f"--tls-{name}", path)]
        if token:
            flags += ["--token-file", self.file("token.client", token)]
        service = self.connect(server, **credentials, token=token)
        for call in (service.tables, lambda: service.query_budget(**BUDGET)):
            with self.assertRaises(albtpu.ServiceError) as failure:
                call()
            self.assertEqual(failure.exception.code, code, failure.exception)
            self.assertIn(problem, str(failure.exception))
        result = self.query(server, *flags)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\Aalbtpu-query: server [^\n]+\n\Z")
        self.assertIn(problem, result.stderr)
        for text in (str(failure.exception), result.stderr):
            self.assertNotIn(str(self.folder), text)
