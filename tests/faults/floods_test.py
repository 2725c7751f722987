"""Valid frames, but far too many or too large, neither exhaust the memory of the server nor stop it.

Usage: floods_test.py NAME=PATH..., see programs.py
"""

import concurrent.futures
import contextlib
import struct

import albtpu
import faults
import http2
import programs
import serving

# From limits.h, in bytes.
MEMORY_GROWTH = 16 << 20
MAX_READ_BYTES = 64 << 10

MOST = 4 << 20  # Bytes of a flood, unless the server ends it.
MOST_CALLS, CONNECTIONS = 40 << 20, 4  # The same for a flood of calls, on each of so many connections at a time.
LARGEST = 2**31 - 1  # The largest window, and the largest stream number.

# The bytes of memory that a flood may cost the server: its growth before the server checks connections, the calls that
# one processor begins within a tenth of a second, which a busy machine may take to let the server check, and the calls
# in the last read of each connection before it is ended.
CALL_BYTES, SHORTEST_CALL, CALLS_IN_TIME = 12 << 10, 15, 10_000
GROWTH = MEMORY_GROWTH + CALL_BYTES * (CALLS_IN_TIME + CONNECTIONS * MAX_READ_BYTES // SHORTEST_CALL)


def odd(i):
    """The stream number of a client's call `i`."""
    return 2 * i + 1


def reset(i):
    return http2.frame(http2.RST_STREAM, stream=odd(i), payload=struct.pack(">I", 8))


def after(first, further):
    """A flood that begins with one frame, and goes on with others."""
    return lambda i: further(i) if i else first


def of_header(first, further):
    """A header block without end."""
    return after(http2.frame(http2.HEADERS, 0, 1, first), lambda i: http2.frame(http2.CONTINUATION, 0, 1, further))


def of_stream(frame):
    """The same frame again and again after a call."""
    return after(http2.call(1, b"StreamColumns"), lambda i: frame)


def line(i):
    return http2.field(b"x%d" % i, b"y" * 1000)


# What a client sends as its piece `i`, by name. Of the first, many more than of the others.
MANY_CALLS = {
    # Calls that are cancelled at once.
    "resets": lambda i: http2.call(odd(i), b"StreamColumns") + reset(i),
    # The same in a seventh of the bytes: as many calls as a server can be made to begin.
    "short_resets": lambda i: http2.short_call(odd(i), b"QueryPulses") + reset(i),
    # Calls that do not end, from a client that never acknowledges the limit of concurrent calls.
    "unacknowledged": lambda i: http2.short_call(odd(i), b"QueryColumns"),
}
FLOODS = MANY_CALLS | {
    # Many more calls than a connection may have; their messages do not end.
    "calls": lambda i: (http2.call(odd(i), b"QueryColumns")
                        + http2.frame(http2.DATA, stream=odd(i), payload=b"\0\0\0\xff\xff")),
    # Calls whose answers are never read: the window is closed.
    "unread_answers": after(http2.settings(_4=0), lambda i: (http2.call(odd(i), b"ListTables")
                                                             + http2.message(odd(i), b"", http2.END_STREAM))),
    "continuations": after(http2.frame(http2.HEADERS, 0, 1, http2.header_block(b"QueryColumns") + line(0)),
                           lambda i: http2.frame(http2.CONTINUATION, 0, 1, line(i))),
    "empty_continuations": of_header(b"", b""),
    # A length in a header block that does not end (RFC 7541, 5.1).
    "long_number": of_header(b"\0\x7f" + b"\x80" * 100, b"\x80" * 16384),
    # A header field of two gigabytes that is really sent.
    "promised_header": of_header(b"\0\x7f\x80\xff\xff\xff\x07", b"x" * 16384),
    "settings": lambda i: http2.settings(_1=i, _3=i),
    "huge_settings": lambda i: http2.frame(http2.SETTINGS,
                                           payload=struct.pack(">HI", 1 + i % 6, 2**32 - 1 - i) * 2730),
    "pings": lambda i: http2.frame(http2.PING, payload=struct.pack(">Q", i)),
    # Window updates that overflow.
    "windows": lambda i: http2.window_update(0, LARGEST),
    "windows_of_a_stream": of_stream(http2.window_update(1, LARGEST)),
    "empty_data": of_stream(http2.frame(http2.DATA, 0, 1)),
    "priorities": lambda i: http2.frame(http2.PRIORITY, stream=odd(i),
                                        payload=struct.pack(">IB", 1 if i else 3, i % 256)),
    "unknown_frames": lambda i: http2.frame(200, 255, odd(i), b"x" * 1000),
}


def pour(address, flood):
    """Sends a flood and reads nothing, until all is sent or the server ends it; returns the bytes sent."""
    sent, i = 0, 0
    with contextlib.closing(http2.Connection(address)) as caller:
        if flood != "unacknowledged":
            caller.finish_handshake()
        connection = caller.socket
        connection.settimeout(10)  # A server that stops reading has reached its limit.
        try:
            while sent < (MOST_CALLS if flood in MANY_CALLS else MOST) and (flood in MANY_CALLS or i < 200_000):
                piece = b"".join(FLOODS[flood](i + more) for more in range(500))
                i += 500
                connection.sendall(piece)
                sent += len(piece)
        except OSError:
            pass
    return sent


class Floods(faults.FaultTest):
    def test_neither_exhaust_memory_nor_stop_the_server(self):
        for flood in FLOODS:
            with self.subTest(flood):
                server = self.serve("--metrics", "127.0.0.1:0")
                before = faults.memory(server.process)
                floods = (CONNECTIONS if flood in MANY_CALLS else 1) * [flood]
                with faults.UnaryWitness(self, server.address), concurrent.futures.ThreadPoolExecutor() as pool:
                    sent = sum(pool.map(pour, len(floods) * [server.address], floods))
                grown = faults.memory(server.process, "VmHWM") - before
                print(f"{flood}: {sent >> 10} KiB sent, memory grew by {grown >> 10} KiB", flush=True)
                self.assertLess(grown, GROWTH)
                if flood == "unacknowledged":  # Its calls end only with their connections.
                    ended = "albtpu_ended_connections_total"
                    faults.wait_until(lambda: self.metric(server, ended) == CONNECTIONS, "all connections are ended")
                with albtpu.connect(server.address, patience=serving.PATIENCE) as service:
                    self.assert_answers(service)  # In a stream: calls of the flood no longer count towards the limit.
                self.assert_drains(server)


if __name__ == "__main__":
    programs.main()
