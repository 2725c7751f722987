"""How a server is reached: in plain text, by TLS, with certificates and tokens.

Usage: channel_test.py TABLE.h5
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
HOSTS = pathlib.Path("/etc/hosts")  # a machine made from nothing may have none, and then no name without a name server
LOCALHOST = HOSTS.is_file() and "localhost" in HOSTS.read_text().split()


class PlainText(unittest.TestCase):
    def test_reaches_names_and_addresses(self):
        service = FakeService(TABLE)
        with Running(service) as running:
            port = running.address.rpartition(":")[2]
            names = (f"localhost:{port}", f"dns:///localhost:{port}") if LOCALHOST else ()
            for target in (running.address, f"dns:///{running.address}", f"ipv4:{running.address}", *names):
                with albtpu.connect(target, patience=5) as client:
                    self.assertEqual([table.reference.name for table in client.tables()], ["fake"], target)
                    self.assertTrue(client.tables()[0].is_default)

    def test_says_that_it_is_closed(self):
        with Running(FakeService(TABLE)) as running:
            client = albtpu.connect(running.address)
            client.close()
            pulse = dict(wind_speed=5, incidence=5, footprint=1, depth=5)
            for ask in (client.tables, client.table, lambda: client.query(**pulse)):
                with self.assertRaisesRegex(albtpu.ArgumentError, "is closed: connect again"):
                    ask()

    def test_refuses_what_is_no_address(self):
        for target in ("", "localhost", "two words:1", None, 50051):
            with self.assertRaisesRegex(albtpu.ArgumentError, "it should be HOST:PORT"):
                albtpu.connect(target)


@unittest.skipUnless(shutil.which("openssl"), "there is no openssl to make certificates with")
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

    def file(self, name):
        return self.folder / name

    def read(self, name):
        return self.file(name).read_bytes()

    def run_service(self, **options):
        service = FakeService(TABLE)
        pair = self.read("server.key"), self.read("server.pem")
        credentials = grpc.ssl_server_credentials([pair], **options)
        running = Running(service, credentials=credentials)
        self.addCleanup(running.stop)
        return service, running.address

    def test_is_spoken_with_who_is_trusted(self):
        _, address = self.run_service()
        with albtpu.connect(address, ca=self.file("server.pem")) as client:
            self.assertEqual(len(client.tables()), 1)
        for trust in ({"ca": self.file("client.pem")}, {"tls": True}, {}):
            with albtpu.connect(address, **trust, patience=0.1) as client:
                with self.assertRaises(albtpu.UnreachableError):
                    client.tables()

    def test_shows_its_certificate(self):
        _, address = self.run_service(root_certificates=self.read("client.pem"), require_client_auth=True)
        ca = self.file("server.pem")
        ours = dict(cert=self.file("client.pem"), key=self.file("client.key"))
        with albtpu.connect(address, ca=ca, **ours) as client:
            self.assertEqual(len(client.tables()), 1)
        with albtpu.connect(address, ca=ca, patience=0.1) as client:
            with self.assertRaises(albtpu.UnreachableError):
                client.tables()

    def test_sends_its_token(self):
        service, address = self.run_service()
        with albtpu.connect(address, ca=self.file("server.pem"), token="open sesame") as client:
            client.tables()
        self.assertEqual(service.metadata["authorization"], "Bearer open sesame")

    def test_refuses_files_that_are_none(self):
        for files, hint in (({"ca": self.file("nowhere.pem")}, "'ca', .*nowhere.pem: No such file"),
                            ({"ca": TABLE}, "should be a PEM file"),
                            ({"cert": self.file("client.pem")}, "give both 'cert' and 'key'"),
                            ({"key": self.file("client.key")}, "give both 'cert' and 'key'")):
            with self.assertRaisesRegex(albtpu.ArgumentError, hint):
                albtpu.connect("localhost:1", **files)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
