"""Shared by tests of access to albtpu-serve: certificates, clients and checks of refusals.

The script that imports this gets the paths of the programs as arguments: ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE
ALBTPU_QUERY.
"""

import secrets
import sys

import albtpu
from authority import Authority
from commands import make_folder, run
from served import TablesTest
from serving import PATIENCE

QUERY = sys.argv[3]
PULSE = dict(wind_speed=5, incidence=10, footprint=0.5, depth=8)
BUDGET = dict(PULSE, altitude=400, beam_azimuth=90, located="level")
PULSE_FLAGS = [word for name, value in PULSE.items() for word in (f"--{name.replace('_', '-')}", str(value))]


class SecurityTest(TablesTest):
    @classmethod
    def setUpClass(cls):
        folder = make_folder(cls.addClassCleanup)
        cls.authority, cls.stranger = (Authority(folder, name) for name in ("authority", "stranger"))
        cls.certificate, cls.key = cls.authority.issue("server")
        cls.client = dict(zip(("cert", "key"), cls.authority.issue("client")))
        cls.ca = cls.authority.certificate
        cls.token = secrets.token_hex(32)

    def copy(self, source, name):
        return self.write(name, source.read_text())

    def tls(self, *more, certificate=None, key=None):
        return ("--tls-cert", certificate or self.certificate, "--tls-key", key or self.key, *more)

    def connect(self, server, **credentials):
        service = albtpu.connect(server.address, patience=0, timeout=PATIENCE, **credentials)
        self.addCleanup(service.close)
        return service

    def query(self, server, *flags):
        return run(QUERY, "pulse", *PULSE_FLAGS, "--server", server.address, *flags)

    def clients(self, server, token=None, **files):
        """The service in Python, and the result of albtpu-query, with these credentials."""
        flags = [word for name, path in files.items() for word in (f"--tls-{name}", path)]
        if token:
            flags += ["--token-file", self.write("token.client", token + "\n")]
        return self.connect(server, **files, token=token), self.query(server, *flags)

    def assert_answers(self, server, **credentials):
        """The server answers both the Python package and albtpu-query."""
        service, result = self.clients(server, **credentials)
        for answer in (service.query(**PULSE), service.query_budget(**BUDGET)):
            self.assertEqual(str(answer.outcome), "INTERPOLATED")
        self.assertIn("INTERPOLATED", self.assert_succeeds(result))

    def assert_refuses(self, server, code, problem, **credentials):
        service, result = self.clients(server, **credentials)
        for call in (service.tables, lambda: service.query_budget(**BUDGET)):
            with self.assertRaises(albtpu.ServiceError) as failure:
                call()
            self.assertEqual(failure.exception.code, code, failure.exception)
            self.assertIn(problem, str(failure.exception))
        self.assert_refused(result, 1, "albtpu-query: server ", problem)
        for text in (str(failure.exception), result.stderr):
            self.assertNotIn(str(self.folder), text)
