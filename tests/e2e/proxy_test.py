"""Clients behind a proxy: none for this machine, the one of the environment for others, and none that no_proxy lists.

Usage: proxy_test.py ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE ALBTPU_QUERY
"""

import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

from serving import PATIENCE, Server

SERVE, SYNTHETIC_TABLE, QUERY = sys.argv[1:4]
PULSE = ("--wind-speed", "5", "--incidence", "10", "--footprint", "0.5", "--depth", "8")
PYTHON = """
import sys, albtpu
with albtpu.connect(sys.argv[1], patience=0.5, timeout=20) as service:
    print(len(service.tables()))
"""
VARIABLES = ("http_proxy", "https_proxy", "grpc_proxy", "HTTP_PROXY", "HTTPS_PROXY")
CLEAN = {name: value for name, value in os.environ.items() if "proxy" not in name.lower()}


def own_address():
    """An address of this machine that is not its loopback; None if it has none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # Sends nothing.
            address = probe.getsockname()[0]
        except OSError:
            return None
    return None if address.startswith("127.") else address


def unused_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class ConnectProxy:
    """An HTTP proxy that takes CONNECT alone. Keeps the targets, and leads all of them to `address`."""

    def __init__(self, address):
        self.address, self.targets, self.headers = address, [], []
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self.listener.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:  # Closed.
                return
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client):
        with client:
            self._tunnel(client)

    def _tunnel(self, client):
        request = b""
        while b"\r\n\r\n" not in request:
            request += client.recv(4096)
        first, *headers = request.decode().split("\r\n")
        method, target, _ = first.split()
        self.targets.append(target)
        self.headers.append(headers)
        if method != "CONNECT" or self.address is None:
            client.sendall(b"HTTP/1.1 403 Forbidden\r\n\r\n")
            return
        host, _, port = self.address.rpartition(":")
        with socket.create_connection((host, int(port))) as server:
            client.sendall(b"HTTP/1.1 200 OK\r\n\r\n")
            upwards = threading.Thread(target=self._copy, args=(client, server), daemon=True)
            upwards.start()
            self._copy(server, client)
            upwards.join()

    @staticmethod
    def _copy(source, target):
        try:
            while data := source.recv(65536):
                target.sendall(data)
            target.shutdown(socket.SHUT_WR)
        except OSError:  # The other side is gone.
            pass

    def close(self):
        self.listener.close()


class ProxyTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        subprocess.run([SYNTHETIC_TABLE, pathlib.Path(folder.name) / "quick.h5"], check=True)
        self.folder = folder.name

    def serve(self, *flags, **options):
        server = Server(SERVE, "--tables", self.folder, *flags, **options)
        self.addCleanup(server.__exit__)
        return server.address

    def proxy(self, address):
        proxy = ConnectProxy(address)
        self.addCleanup(proxy.close)
        return proxy

    def clients(self, address):
        """The commands of all clients."""
        return {"health": (QUERY, "health", "--server", address),
                "pulse": (QUERY, "pulse", "--server", address, *PULSE),
                "tables": (QUERY, "tables", "--server", address),
                "Python": (sys.executable, "-c", PYTHON, address)}

    def run_client(self, command, environment):
        return subprocess.run(command, env={**CLEAN, **environment}, capture_output=True, text=True, timeout=PATIENCE)

    def assert_all_work(self, address, environment):
        for name, command in self.clients(address).items():
            with self.subTest(client=name, address=address):
                result = self.run_client(command, environment)
                self.assertEqual(result.returncode, 0, result.stderr)


class Loopback(ProxyTest):
    def test_is_reached_past_a_proxy_that_is_not_there(self):
        address = self.serve()
        dead = dict.fromkeys(VARIABLES, f"http://127.0.0.1:{unused_port()}")
        self.assert_all_work(address, dead)
        port = address.rpartition(":")[2]
        others = [f"dns:///127.0.0.1:{port}", f"ipv4:127.0.0.1:{port}"]
        if os.path.exists("/etc/hosts"):  # A bare root has none, and then nothing there knows the name.
            others.append(f"localhost:{port}")
        for other in others:
            result = self.run_client((QUERY, "health", "--server", other), dead)
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_is_never_asked_of_a_proxy_that_is_there(self):
        address = self.serve()
        proxy = self.proxy(address)
        self.assert_all_work(address, dict.fromkeys(VARIABLES, proxy.url))
        self.assertEqual(proxy.targets, [])


class OtherMachines(ProxyTest):
    def test_are_reached_through_the_proxy(self):
        proxy = self.proxy(self.serve())
        for variable in ("grpc_proxy", "https_proxy", "http_proxy"):
            proxy.targets.clear()
            self.assert_all_work("lidar.example:50051", {variable: proxy.url.replace("//", "//me:secret@")})
            self.assertEqual(set(proxy.targets), {"lidar.example:50051"})
            self.assertTrue(any(line.startswith("Proxy-Authorization: Basic ") for line in proxy.headers[0]))

    def test_an_error_names_the_proxy_without_its_password(self):
        closed = self.proxy(None)
        dead = f"127.0.0.1:{unused_port()}"
        for proxy in (closed.url.removeprefix("http://"), dead):
            for name, command in self.clients("lidar.example:50051").items():
                with self.subTest(client=name, proxy=proxy):
                    result = self.run_client(command, {"https_proxy": f"http://me:secret@{proxy}"})
                    self.assertNotEqual(result.returncode, 0)
                    self.assertIn(f"(through the proxy http://{proxy}, from https_proxy)", result.stderr)
                    self.assertNotIn("secret", result.stderr)

    def test_are_reached_without_it_where_no_proxy_lists_them(self):
        own = own_address()
        if own is None:
            self.skipTest("this machine has no address but its loopback")
        address = self.serve("--insecure", listen=f"{own}:0")
        proxy = self.proxy(address)
        self.assert_all_work(address, {"http_proxy": proxy.url})
        self.assertEqual(set(proxy.targets), {address})
        for listed in ({"no_proxy": own}, {"no_grpc_proxy": f"other, {own}"}, {"no_proxy": f"{own}/30"},
                       {"no_proxy": "*"}):
            proxy.targets.clear()
            self.assert_all_work(address, {"http_proxy": proxy.url, **listed})
            self.assertEqual(proxy.targets, [], listed)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
