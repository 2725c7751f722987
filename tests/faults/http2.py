"""A client of albtpu-serve that sends HTTP/2 frame by frame, valid or not."""

import socket
import struct

import serving

PREFACE = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"
DATA, HEADERS, PRIORITY, RST_STREAM, SETTINGS, PUSH_PROMISE, PING, GOAWAY, WINDOW_UPDATE, CONTINUATION = range(10)
END_STREAM, ACK, END_HEADERS = 1, 1, 4
INITIAL_WINDOW_SIZE = 4  # A setting.


def frame(kind, flags=0, stream=0, payload=b""):
    return struct.pack(">I", len(payload))[1:] + struct.pack(">BBI", kind, flags, stream) + payload


def settings(**values):
    """A SETTINGS frame; settings are given by number: settings(_4=0)."""
    return frame(SETTINGS, payload=b"".join(struct.pack(">HI", int(name[1:]), value)
                                            for name, value in values.items()))


def window_update(stream, increment):
    return frame(WINDOW_UPDATE, stream=stream, payload=struct.pack(">I", increment))


def field(name, value):
    """A field of a header block, literal, without index or Huffman code (RFC 7541, 6.2.2)."""
    def text(string):
        length = len(string)
        if length < 127:
            return bytes([length]) + string
        head, rest = b"\x7f", length - 127  # An integer with a 7-bit prefix (RFC 7541, 5.1).
        while rest > 127:
            head, rest = head + bytes([rest % 128 + 128]), rest // 128
        return head + bytes([rest]) + string
    return b"\0" + text(name) + text(value)


def fields(method):
    return ((b":method", b"POST"), (b":scheme", b"http"), (b":authority", b"localhost"),
            (b":path", b"/albtpu.v1.UncertaintyService/" + method), (b"content-type", b"application/grpc"),
            (b"te", b"trailers"))


def header_block(method, *more):
    return b"".join(field(name, value) for name, value in (*fields(method), *more))


def call(stream, method, *more):
    return frame(HEADERS, END_HEADERS, stream, header_block(method, *more))


def short_call(stream, method):
    """A call in 15 bytes, using the table that the first call of a connection fills (RFC 7541, 6.1 and 6.2.1)."""
    if stream == 1:
        block = b"".join(b"\x40" + field(name, value)[1:] for name, value in fields(method))
    else:
        block = bytes(0x80 + 61 + len(fields(method)) - i for i in range(len(fields(method))))
    return frame(HEADERS, END_HEADERS, stream, block)


def message(stream, content, flags=0):
    """A gRPC message in DATA frames."""
    content = b"\0" + struct.pack(">I", len(content)) + content
    pieces = [content[at:at + 16384] for at in range(0, len(content), 16384)]
    return b"".join(frame(DATA, flags if i == len(pieces) - 1 else 0, stream, piece)
                    for i, piece in enumerate(pieces))


def dial(address):
    host, _, port = address.rpartition(":")
    return socket.create_connection((host, int(port)), serving.PATIENCE)


class Connection:
    """A connection that reads frames; the user decides what to send."""

    def __init__(self, address, first=PREFACE + settings()):
        self.socket = dial(address)
        self.socket.sendall(first)
        self.received = b""
        self.windows = {0: 65535}  # Bytes that the server accepts, by stream; stream 0 is the connection.

    def read(self):
        """The next frame, (kind, flags, stream, payload); None when the server has closed the connection."""
        while len(self.received) < 9 or len(self.received) < 9 + self._length():
            try:
                more = self.socket.recv(1 << 16)
            except ConnectionResetError:
                return None
            if not more:
                return None
            self.received += more
        end = 9 + self._length()
        (kind, flags, stream), payload = struct.unpack_from(">BBI", self.received, 3), self.received[9:end]
        self.received = self.received[end:]
        if kind == WINDOW_UPDATE:
            self.windows[stream] = self.windows.get(stream, 65535) + struct.unpack(">I", payload)[0]
        return kind, flags, stream, payload

    def make_call(self, stream, method, content):
        """Makes a unary call as fast as the server opens its window. Returns the other frames received meanwhile."""
        self.socket.sendall(call(stream, method))
        content, frames = b"\0" + struct.pack(">I", len(content)) + content, []
        self.windows.setdefault(stream, 65535)
        while content:
            size = min(16384, len(content), self.windows[0], self.windows[stream])
            if size > 0:
                piece, content = content[:size], content[size:]
                self.socket.sendall(frame(DATA, 0 if content else END_STREAM, stream, piece))
                self.windows[0] -= size
                self.windows[stream] -= size
                continue
            got = self.read()
            if got is None or (got[0] == RST_STREAM and got[2] == stream):
                return [*frames, got]
            if got[:2] == (SETTINGS, 0):
                self.socket.sendall(frame(SETTINGS, ACK))
            elif got[:2] == (PING, 0):
                self.socket.sendall(frame(PING, ACK, payload=got[3]))
            frames.append(got)
        return frames

    def _length(self):
        return int.from_bytes(self.received[:3], "big")

    def finish_handshake(self):
        """Reads until the server has acknowledged the settings."""
        while (got := self.read())[:2] != (SETTINGS, ACK):
            if got[0] == SETTINGS:
                self.socket.sendall(frame(SETTINGS, ACK))

    def close(self):
        self.socket.close()
