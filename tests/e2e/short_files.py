"""Many short LAS files, each with a short SBET of its own a minute after the one before, for tests and benchmarks."""

import struct

import numpy as np

STEP = 60  # s
POINTS = 1000
MOST = 10_000  # The times of a week.


def make(survey, folder, count):
    """Writes `count` files into the folders las and sbet of `folder`, and returns the paths of the LAS files.

    `survey` is the LAS of a simulated survey, of point format 6 and adjusted times, beside its sbet.out.
    """
    assert count <= MOST
    data = survey.read_bytes()
    offset, = struct.unpack_from("<I", data, 96)
    length, = struct.unpack_from("<H", data, 105)
    rows = np.frombuffer(data, np.uint8, (len(data) - offset) // length * length, offset).reshape(-1, length)
    rows = rows[len(rows) // 2:][:POINTS].copy()
    head = bytearray(data[:offset])
    struct.pack_into("<QIQ", head, 235, 0, 0, len(rows))
    times = rows[:, 22:30].copy().view("<f8")
    of_week = (times + 1e9) % 604800
    records = np.fromfile(survey.with_name("sbet.out"), "<f8").reshape(-1, 17)
    records = records[(records[:, 0] > of_week.min() - 1) & (records[:, 0] < of_week.max() + 1)]
    for name in ("las", "sbet"):
        (folder / name).mkdir(exist_ok=True)
    paths = []
    for i in range(count):
        rows[:, 22:30] = (times + STEP * i).view(np.uint8)
        paths.append(folder / "las" / f"{i:05}.las")
        paths[-1].write_bytes(bytes(head) + rows.tobytes())
        moved = records.copy()
        moved[:, 0] += STEP * i
        moved.tofile(folder / "sbet" / f"{i:05}.sbet")
    return paths
