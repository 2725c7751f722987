"""Connections that violate HTTP/2 harm only themselves.

Usage: malformed_frames_test.py NAME=PATH..., see programs.py
"""

import contextlib
import random
import socket
import struct
import threading

import albtpu
import faults
import http2
import programs
import serving

CASES = 4000
GROWTH = 32 << 20  # The bytes of memory that all cases together may cost the server.


class Recorder:
    """Relays the one connection of a client to the server, and records what the client sends."""

    def __init__(self, address):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self.listener.getsockname()[1]
        self.server = http2.dial(address)
        self.sent = b""
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self):
        self.client = self.listener.accept()[0]
        threading.Thread(target=self._answer, daemon=True).start()
        with contextlib.suppress(OSError):  # Closed.
            while piece := self.client.recv(1 << 16):
                self.sent += piece
                self.server.sendall(piece)

    def _answer(self):
        with contextlib.suppress(OSError):
            while piece := self.server.recv(1 << 16):
                self.client.sendall(piece)

    def close(self):
        self.listener.close()
        self.client.close()
        self.server.close()


def split(sent):
    """The frames that a client sent on a connection."""
    at, frames = len(http2.PREFACE), []
    while at < len(sent):
        end = at + 9 + int.from_bytes(sent[at:at + 3], "big")
        frames.append(sent[at:end])
        at = end
    return frames


def any_frame(chance):
    """A frame of any kind; often shorter or longer than the length it states."""
    payload = chance.randbytes(chance.choice((0, 1, 4, 5, 8, 9, 64, 1000, 16384, 20000)))
    stream = chance.choice((0, 1, 2, 3, 5, 2**31 - 1, 2**32 - 1))
    made = http2.frame(chance.randrange(12), chance.randrange(256), stream, payload)
    return made if chance.random() < 0.7 else struct.pack(">I", chance.randrange(1 << 24))[1:] + made[3:]


def flip(sent, frames, chance):
    changed = bytearray(sent)
    for _ in range(chance.randint(1, 8)):
        changed[chance.randrange(len(sent))] ^= 1 << chance.randrange(8)
    return bytes(changed)


def cut(sent, frames, chance):
    return sent[:chance.randrange(len(sent))]


def lose(sent, frames, chance):
    at = chance.randrange(len(sent))
    return sent[:at] + sent[at + chance.randint(1, 100):]


def with_frames(change):
    """A mutation that applies `change` to the list of frames."""
    def changed(sent, frames, chance):
        frames = list(frames)
        change(frames, chance)
        return http2.PREFACE + b"".join(frames)
    return changed


def double(frames, chance):
    frames.insert(chance.randint(0, len(frames)), chance.choice(frames))


def swap(frames, chance):
    i, j = (chance.randrange(len(frames)) for _ in range(2))
    frames[i], frames[j] = frames[j], frames[i]


def shuffle(frames, chance):
    chance.shuffle(frames)


def intrude(frames, chance):
    for _ in range(chance.randint(1, 5)):
        frames.insert(chance.randint(0, len(frames)), any_frame(chance))


def mislabel(frames, chance):
    i = chance.randrange(len(frames))
    frames[i] = frames[i][:3] + chance.randbytes(6) + frames[i][9:]


CHANGES = (flip, cut, lose, *map(with_frames, (double, swap, shuffle, intrude, mislabel)))


class MalformedFrames(faults.FaultTest):
    def record(self, server):
        recorder = Recorder(server.address)
        with albtpu.connect(recorder.address) as service:
            self.assert_answers(service)
            service.tables()
            service.table()
            service.query(**faults.random_pulses(3), standard_errors=True)
        recorder.close()
        return recorder.sent

    def send(self, server, sent, aborts):
        """Sends bytes. Returns when the server has closed the connection, or after aborting it."""
        with http2.dial(server.address) as connection:
            try:
                connection.sendall(sent)
                if aborts:
                    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                    return
                connection.shutdown(socket.SHUT_WR)
                while connection.recv(1 << 16):
                    pass
            except TimeoutError:
                raise
            except OSError:  # Closed or reset by the server.
                pass

    def test_of_any_kind_do_not_harm_other_connections(self):
        server = self.serve()
        sent = self.record(server)
        frames = split(sent)
        self.assertEqual(http2.PREFACE + b"".join(frames), sent)
        # Streams of closed connections count towards the limit until the server notices; the witness retries meanwhile.
        with faults.Witness(self, server.address, patience=serving.PATIENCE):
            for i in range(CASES):
                chance = random.Random(faults.SEED + i)
                change = CHANGES[i % len(CHANGES)]
                with self.subTest(change.__qualname__, seed=faults.SEED + i):
                    self.send(server, change(sent, frames, chance), aborts=chance.random() < 0.2)
                if i == CASES // 4:
                    before = faults.memory(server.process)
        growth = faults.memory(server.process) - before
        print(f"{CASES} cases of {len(frames)} frames, memory grew by {growth >> 10} KiB in the last three quarters")
        self.assertLess(growth, GROWTH)
        self.assert_drains(server)


if __name__ == "__main__":
    programs.main()
