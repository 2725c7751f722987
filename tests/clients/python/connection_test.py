"""Connections to a server: in plain text and with TLS, certificates and tokens.

Usage: connection_test.py TABLE.h5
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import grpc

import albtpu
from fake_service import FakeService, Running

TABLE = sys.argv[1]
HOSTS = pathlib.Path("/etc/hosts")  # Missing in some minimal containers, where no name can be resolved.
LOCALHOST = HOSTS.is_file() and "localhost" in HOSTS.read_text().split()


class PlainText(unittest.TestCase):
    def test_connects_to_names_and_addresses(self):
        service = FakeService(TABLE)
        with Running(service) as running:
            port = running.address.rpartition(":")[2]
            names = (f"localhost:{port}", f"dns:///localhost:{port}") if LOCALHOST else ()
            for target in (running.address, f"dns:///{running.address}", f"ipv4:{running.address}", *names):
                with albtpu.connect(target, patience=5) as client:
                    self.assertEqual([table.reference.name for table in client.tables()], ["fake"], target)
                    self.assertTrue(client.tables()[0].is_default)


@unittest.skipUnless(shutil.which("openssl"), "openssl is missing; apt-get install openssl")
class Tls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for name in ("server", "client"):
            subprocess.run(
                ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
                 "-subj", f"/CN={name}", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1",
                 "-keyout", cls.folder / f"{name}.key", "-out", cls.folder / f"{name}.pem"],
                check=True, capture_output=True)

    def read(self, name):
        return (self.folder / name).read_bytes()

    def run_service(self, **options):
        service = FakeService(TABLE)
        pair = self.read("server.key"), self.read("server.pem")
        credentials = grpc.ssl_server_credentials([pair], **options)
        running = Running(service, credentials=credentials)
        self.addCleanup(running.stop)
        return service, running.address

    def test_connects_only_to_trusted_servers(self):
        _, address = self.run_service()
        with albtpu.connect(address, ca=self.folder / "server.pem") as client:
            self.assertEqual(len(client.tables()), 1)
        for trust in ({"ca": self.folder / "client.pem"}, {"tls": True}, {}):
            with albtpu.connect(address, **trust, patience=0.1) as client:
                with self.assertRaises(albtpu.UnreachableError):
                    client.tables()

    def test_presents_the_certificate_of_the_client(self):
        _, address = self.run_service(root_certificates=self.read("client.pem"), require_client_auth=True)
        ca = self.folder / "server.pem"
        ours = dict(cert=self.folder / "client.pem", key=self.folder / "client.key")
        with albtpu.connect(address, ca=ca, **ours) as client:
            self.assertEqual(len(client.tables()), 1)
        with albtpu.connect(address, ca=ca, patience=0.1) as client:
            with self.assertRaises(albtpu.UnreachableError):
                client.tables()

    def test_sends_the_token(self):
        service, address = self.run_service()
        with albtpu.connect(address, ca=self.folder / "server.pem", token="open sesame") as client:
            client.tables()
        self.assertEqual(service.metadata["authorization"], "Bearer open sesame")

    def test_refuses_files_that_are_missing_or_invalid(self):
        for files, hint in (({"ca": self.folder / "nowhere.pem"}, "'ca', .*nowhere.pem: No such file"),
                            ({"ca": TABLE}, "should be a PEM file"),
                            ({"cert": self.folder / "client.pem"}, "give both 'cert' and 'key'"),
                            ({"key": self.folder / "client.key"}, "give both 'cert' and 'key'")):
            with self.assertRaisesRegex(albtpu.ArgumentError, hint):
                albtpu.connect("localhost:1", **files)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
