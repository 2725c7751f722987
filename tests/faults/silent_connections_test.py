"""A thousand silent connections do not disturb other clients, and too many connections do no lasting harm."""

import os
import resource
import time

import albtpu
import faults
import http2
import programs
import serving

CONNECTIONS = 1000
MAX_HANDSHAKE = 10  # s, kMaxHandshake in limits.h.
BYTES_EACH = 64 << 10  # The most memory that a silent connection may cost the server.


def open_files(server):
    return len(os.listdir(f"/proc/{server.process.pid}/fd"))


class SilentConnections(faults.FaultTest):
    def setUp(self):
        super().setUp()
        before = resource.getrlimit(resource.RLIMIT_NOFILE)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, before)
        if before[1] < 2 * CONNECTIONS:
            self.skipTest(f"this test needs {2 * CONNECTIONS} open files (the hard limit is {before[1]}); "
                          "raise it (ulimit -Hn)")
        self.hard = before[1]
        self.limit_files(self.hard)

    def limit_files(self, soft, hard=None):
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard or self.hard))

    def serve_with_files(self, soft, hard=None, flags=()):
        """Starts a server with these limits of open files, as if it inherited them."""
        self.limit_files(soft)
        prefix = ("prlimit", f"--nofile={soft}:{hard or self.hard}")
        try:
            return self.serve(*flags, prefix=prefix)
        finally:
            self.limit_files(self.hard)

    def connect(self, server, speaks):
        """Opens CONNECTIONS silent connections; with `speaks`, after the HTTP/2 handshake."""
        made = []
        for _ in range(CONNECTIONS):
            if speaks:
                made.append(http2.Connection(server.address))
                made[-1].finish_handshake()
            else:
                made.append(http2.dial(server.address))
            self.addCleanup(made[-1].close)
        return made

    def test_that_never_send_are_closed_in_time(self):
        server = self.serve_with_files(256)  # Fewer than connections; the server raises its soft limit to the hard one.
        with faults.Witness(self, server.address) as witness:
            idle, before = open_files(server), faults.memory(server.process)
            begin = time.monotonic()
            silent = self.connect(server, speaks=False)
            faults.wait_until(lambda: open_files(server) >= idle + CONNECTIONS - 5, "all connections are open")
            each = (faults.memory(server.process) - before) / CONNECTIONS
            answered = witness.answered
            for connection in silent:
                while connection.recv(4096):  # The server sends its settings and then closes the connection.
                    pass
            took = time.monotonic() - begin
            self.assertGreater(witness.answered, answered)
        print(f"{CONNECTIONS} silent connections: {each / 1024:.0f} KiB each, closed after {took:.1f} s")
        self.assertLess(each, BYTES_EACH)
        self.assertLess(took, 2 * MAX_HANDSHAKE * serving.ALLOWANCE)
        faults.wait_until(lambda: open_files(server) < idle + 20, "the server has closed its side")
        self.assert_drains(server)

    def test_that_stop_after_the_handshake_take_little_memory(self):
        server = self.serve_with_files(256)
        with faults.Witness(self, server.address) as witness:
            before = faults.memory(server.process)
            self.connect(server, speaks=True)
            each = (faults.memory(server.process) - before) / CONNECTIONS
            answered = witness.answered
            faults.wait_until(lambda: witness.answered > answered + 10 or witness.failure, "other clients are answered")
        print(f"{CONNECTIONS} connections without a call: {each / 1024:.0f} KiB each")
        self.assertLess(each, BYTES_EACH)
        self.assert_drains(server)

    def test_beyond_the_limit_of_files_are_refused_until_others_close(self):
        server = self.serve_with_files(256, 256, ("--metrics", "127.0.0.1:0"))
        with albtpu.connect(server.address, patience=0) as old:
            self.assert_answers(old)
            silent = self.connect(server, speaks=False)
            server.wait_for("too many connections")
            self.assert_answers(old)
            self.assertGreater(self.metric(server, "albtpu_refused_connections_total"), 0)
            for connection in silent:
                connection.close()
            with albtpu.connect(server.address, patience=30) as new:
                self.assert_answers(new)
        self.assert_drains(server)


if __name__ == "__main__":
    programs.main()
