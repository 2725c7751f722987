"""Tests who may call albtpu-serve: TLS, mutual TLS, tokens, and changes of their files.

The clients are the Python package and albtpu-query.

Usage: security_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE ALBTPU_QUERY
"""

import re
import secrets
import socket
import ssl
import subprocess
import sys
import unittest
from concurrent import futures

import grpc

import albtpu
from albtpu.v1 import uncertainty_service_pb2 as pb
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from authority import openssl
from commands import run
from secured import PULSE_FLAGS, QUERY, SecurityTest
from serving import PATIENCE

HEALTH = "/grpc.health.v1.Health/Check"
REFLECTION = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo"


class Starting(SecurityTest):
    def test_requires_flags_that_belong_together(self):
        for problem, *flags in (("--tls-cert requires --tls-key", "--tls-cert", self.certificate),
                                ("--tls-key requires --tls-cert", "--tls-key", self.key),
                                ("--tls-client-ca requires --tls-cert", "--tls-client-ca", self.ca),
                                ("--token-file requires --tls-cert", "--token-file", self.key),
                                ("--tls-cert: is empty", "--tls-cert", "", "--tls-key", self.key)):
            self.assert_does_not_start(2, (problem,), *flags)

    def test_requires_usable_files(self):
        expired, key_of_expired = self.authority.issue("expired", days=-1)
        nothing, junk = self.folder / "nothing.pem", self.write("junk.pem", "junk")
        weak, key_of_weak = self.folder / "weak.pem", self.folder / "weak.key"
        openssl("req", "-x509", "-newkey", "rsa:1024", "-nodes", "-subj", "/CN=weak", "-keyout", key_of_weak,
                "-out", weak)
        for flag, problem, *flags in (
                ("--tls-cert: ", "nothing.pem: No such file", *self.tls(certificate=nothing)),
                ("--tls-key: ", "tables: is a folder", *self.tls(key=self.tables)),
                ("--tls-cert: ", "junk.pem: holds no certificate", *self.tls(certificate=junk)),
                ("--tls-key: ", "junk.pem: holds no key", *self.tls(key=junk)),
                ("client.key: is not the key of the certificate in ", "server.pem", *self.tls(key=self.client["key"])),
                ("expired.pem: ", "the certificate expired on", *self.tls(certificate=expired, key=key_of_expired)),
                ("--tls-client-ca: ", "junk.pem", *self.tls("--tls-client-ca", junk)),
                ("--tls-cert: ", "expected RSA with 2048 bits or more", *self.tls(certificate=weak, key=key_of_weak)),
                ("--token-file: ", "bad.tokens: holds no token",
                 *self.tls("--token-file", self.write("bad.tokens", "")))):
            self.assert_does_not_start(1, (flag, problem), *flags)

    def test_allows_addresses_beyond_this_machine_with_tls(self):
        server = self.serve(*self.tls(), listen="0.0.0.0:0")
        server.address = server.address.replace("0.0.0.0", "127.0.0.1")
        self.assert_answers(server, ca=self.ca)


class OneWay(SecurityTest):
    """TLS in which only the server shows a certificate."""

    def test_answers_clients_that_trust_the_server(self):
        self.assert_answers(self.serve(*self.tls()), ca=self.ca)

    def test_refuses_plain_text(self):
        server = self.serve(*self.tls())
        self.assert_refuses(server, "UNAVAILABLE", "speaks TLS")
        self.assert_answers(server, ca=self.ca)

    def test_is_not_trusted_by_clients_of_another_authority(self):
        server = self.serve(*self.tls())
        self.assert_refuses(server, "UNAVAILABLE", "", ca=self.stranger.certificate)
        with self.assertRaises(albtpu.UnreachableError):
            self.connect(server, tls=True).tables()  # Of the authorities that the system trusts.

    def test_is_not_trusted_for_another_host_name(self):
        certificate, key = self.authority.issue("elsewhere", hosts="DNS:elsewhere.example")
        server = self.serve(*self.tls(certificate=certificate, key=key))
        self.assert_refuses(server, "UNAVAILABLE", "", ca=self.ca)

    def test_is_not_trusted_after_its_certificate_has_expired(self):
        certificate, key = self.authority.issue("late", days=-1)
        server = grpc.server(futures.ThreadPoolExecutor(1))  # albtpu-serve refuses to start with one.
        pair = key.read_bytes(), certificate.read_bytes()
        port = server.add_secure_port("127.0.0.1:0", grpc.ssl_server_credentials([pair]))
        server.address = f"127.0.0.1:{port}"
        server.start()
        self.addCleanup(server.stop, None)
        self.assert_refuses(server, "UNAVAILABLE", "", ca=self.ca)

    def test_refuses_old_versions_of_tls(self):
        host, port = self.serve(*self.tls()).address.split(":")
        context = ssl.create_default_context(cafile=self.ca)
        context.minimum_version, context.maximum_version = ssl.TLSVersion.TLSv1, ssl.TLSVersion.TLSv1_1
        context.set_ciphers("ALL:@SECLEVEL=0")
        with socket.create_connection((host, int(port)), PATIENCE) as plain:
            with self.assertRaises(OSError):
                context.wrap_socket(plain, server_hostname=host)


class Asking(SecurityTest):
    """Errors of albtpu-query about flags and files."""

    def test_requires_flags_that_belong_together(self):
        server = "--server", "localhost:1"
        for problem, *flags in (("--tls-ca requires --server", "--tls-ca", self.ca),
                                ("--tls-cert requires --tls-key", *server, "--tls-cert", self.client["cert"]),
                                ("--tls-key requires --tls-cert", *server, "--tls-key", self.client["key"])):
            self.assert_refused(run(QUERY, "pulse", *PULSE_FLAGS, *flags), 2, problem)


class BothWays(SecurityTest):
    """Mutual TLS: clients show certificates as well."""

    def setUp(self):
        super().setUp()
        self.server = self.serve(*self.tls("--tls-client-ca", self.ca))

    def test_answers_clients_with_a_certificate(self):
        self.assert_answers(self.server, ca=self.ca, **self.client)

    def test_refuses_all_other_clients(self):
        others = {"no certificate": {}}
        for what, issued in (("certificate of another authority", self.stranger.issue("client")),
                             ("expired certificate", self.authority.issue("expired_client", days=-1))):
            others[what] = dict(zip(("cert", "key"), issued))
        for what, shown in others.items():
            with self.subTest(what):
                self.assert_refuses(self.server, "UNAVAILABLE", "", ca=self.ca, **shown)
        with self.subTest("plain text"):
            self.assert_refuses(self.server, "UNAVAILABLE", "")
        self.assert_answers(self.server, ca=self.ca, **self.client)


class Tokens(SecurityTest):
    def setUp(self):
        super().setUp()
        self.tokens = self.write("tokens", self.token + "\n")
        self.server = self.serve(*self.tls("--token-file", self.tokens), "--metrics", "127.0.0.1:0")

    def test_grant_access(self):
        self.assert_answers(self.server, ca=self.ca, token=self.token)

    def test_are_required(self):
        self.assert_refuses(self.server, "UNAUTHENTICATED", "has no token", ca=self.ca)

    def test_must_match(self):
        for wrong in (secrets.token_hex(32), self.token[:-1], self.token + "0", self.token.upper()):
            self.assert_refuses(self.server, "UNAUTHENTICATED", "the token is not accepted", ca=self.ca, token=wrong)

    def test_are_logged_and_counted_when_refused(self):
        wrong = secrets.token_hex(32)
        with self.channel() as channel:
            for metadata in ((), (("authorization", f"Bearer {wrong}"), ("x-request-id", "flight-7"))):
                with self.assertRaises(grpc.RpcError):
                    UncertaintyServiceStub(channel).ListTables(pb.ListTablesRequest(), timeout=PATIENCE,
                                                               metadata=metadata)
        self.server.wait_for("call refused: the call has no token")
        line = self.server.wait_for("call refused: the token is not accepted")
        self.assertIn("method=ListTables code=UNAUTHENTICATED request_id=flight-7", line)
        self.assertNotIn(wrong, "\n".join(self.server.lines))
        metrics = self.server.metrics()
        self.assertIn('albtpu_refused_calls_total{reason="no token"} 1\n', metrics)
        self.assertIn('albtpu_refused_calls_total{reason="wrong token"} 1\n', metrics)

    def test_are_required_for_streams_and_reflection(self):
        with self.channel() as channel:
            stream = UncertaintyServiceStub(channel).StreamColumns(iter([]), timeout=PATIENCE)
            reflection = channel.stream_stream(REFLECTION)(iter([]), timeout=PATIENCE)
            for call in (stream, reflection):
                with self.assertRaises(grpc.RpcError) as failure:
                    next(call)
                self.assertEqual(failure.exception.code(), grpc.StatusCode.UNAUTHENTICATED)

    def test_are_not_required_for_health(self):
        with self.channel() as channel:
            self.assertEqual(channel.unary_unary(HEALTH)(b"", timeout=PATIENCE), b"\x08\x01")  # SERVING

    def test_follow_changes_of_their_file(self):
        other = secrets.token_hex(32)
        self.write("tokens", f"{self.token}\n{other}\n")
        self.assert_answers(self.server, ca=self.ca, token=self.token)
        self.assert_answers(self.server, ca=self.ca, token=other)
        self.write("tokens", other)
        self.assert_refuses(self.server, "UNAUTHENTICATED", "the token is not accepted", ca=self.ca, token=self.token)
        self.write("tokens", "")  # Invalid: the previous tokens stay in use.
        self.assert_answers(self.server, ca=self.ca, token=other)
        self.server.wait_for("tokens: holds no token")
        self.assertNotIn(other, "\n".join(self.server.lines))

    def channel(self):
        credentials = grpc.ssl_channel_credentials(self.ca.read_bytes())
        return grpc.secure_channel(self.server.address, credentials, [("grpc.enable_http_proxy", 0)])


class Rotation(SecurityTest):
    """Files are replaced while the server runs, without any failed call."""

    def setUp(self):
        super().setUp()
        self.copies = {name: self.copy(path, f"rotating.{name}") for name, path in (
            ("certificate", self.certificate), ("key", self.key), ("ca", self.ca))}
        self.server = self.serve(
            *self.tls("--tls-client-ca", self.copies["ca"], certificate=self.copies["certificate"],
                      key=self.copies["key"]), "--metrics", "127.0.0.1:0")

    def shown(self):
        """The certificate that the server shows on a new connection."""
        host, port = self.server.address.split(":")
        context = ssl.create_default_context(cafile=self.ca)
        context.load_cert_chain(self.client["cert"], self.client["key"])
        context.set_alpn_protocols(["h2"])
        with socket.create_connection((host, int(port)), PATIENCE) as plain:
            with context.wrap_socket(plain, server_hostname=host) as secure:
                return ssl.DER_cert_to_PEM_cert(secure.getpeercert(binary_form=True))

    def test_of_the_certificate_needs_no_restart(self):
        old = self.connect(self.server, ca=self.ca, **self.client)
        old.tables()
        self.assertEqual(self.shown(), self.certificate.read_text())
        certificate, key = self.authority.issue("renewed")
        self.copy(key, "rotating.key")
        self.assertEqual(self.shown(), self.certificate.read_text())  # Half replaced: the old pair stays in use.
        self.server.wait_for("is not the key of")
        self.copy(certificate, "rotating.certificate")
        self.assertEqual(self.shown(), certificate.read_text())
        old.tables()
        self.assert_answers(self.server, ca=self.ca, **self.client)

    def test_updates_the_expiry_in_the_metrics(self):
        def expiry():
            return float(re.search(r"^albtpu_certificate_expiry_timestamp_seconds (\S+)$",
                                   self.server.metrics(), re.MULTILINE)[1])
        def end(certificate):
            text = subprocess.run(["openssl", "x509", "-noout", "-enddate", "-in", certificate],
                                  capture_output=True, text=True, check=True).stdout.strip()
            return ssl.cert_time_to_seconds(text.removeprefix("notAfter="))
        self.assertEqual(expiry(), end(self.certificate))
        certificate, key = self.authority.issue("later", days=700)
        self.copy(key, "rotating.key")
        self.copy(certificate, "rotating.certificate")
        self.shown()
        self.assertEqual(expiry(), end(certificate))
        self.assertGreater(end(certificate), end(self.certificate))

    def test_survives_missing_and_invalid_files(self):
        self.copies["certificate"].unlink()
        self.assert_answers(self.server, ca=self.ca, **self.client)
        self.write("rotating.certificate", "junk")
        self.assert_answers(self.server, ca=self.ca, **self.client)
        self.assertEqual(self.shown(), self.certificate.read_text())

    def test_of_the_client_authority_shuts_out_old_clients(self):
        self.assert_answers(self.server, ca=self.ca, **self.client)
        self.copy(self.stranger.certificate, "rotating.ca")
        self.assert_refuses(self.server, "UNAVAILABLE", "", ca=self.ca, **self.client)
        theirs = dict(zip(("cert", "key"), self.stranger.issue("newcomer")))
        self.assert_answers(self.server, ca=self.ca, **theirs)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
