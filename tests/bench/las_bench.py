"""`albtpu-query las` from file to file, in its own process and through a server, compared with a plain copy.

Usage: las_bench.py BUILD [--millions N] [--laz] [--sample IN.las --flags "FLAGS"] [--folder DIR]

The input repeats the points of a simulated survey, times included. The beams come from its SBET over the local surface
of its water returns; with --details, their geometry is written, too. With --laz, input and output are
compressed. A sample of another survey needs its own flags,
such as "--trajectory-from-returns --water-level -23.09 --classes 26". Prints a Markdown table: points per second of
elapsed time, processor seconds of client and server, and the peak memory of each.
"""

import argparse
import contextlib
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import threading
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "e2e"))
import serving  # noqa: E402

PIECE = 64 << 20
FLAGS = ("--wind-speed", "6.5", "--fetch", "30000", "--divergence", "1.5", "--wind-from", "100", "--overwrite")


def repeat(sample, target, points):
    """Repeats the records of `sample` until there are `points` of them, with nothing after them."""
    data = bytearray(sample.read_bytes())
    offset, = struct.unpack_from("<I", data, 96)
    length, legacy_count = struct.unpack_from("<HI", data, 105)
    count = struct.unpack_from("<Q", data, 247)[0] if data[25] >= 4 else legacy_count
    records = bytes(data[offset:offset + count * length])
    head = data[:offset]
    struct.pack_into("<I", head, 107, points if legacy_count and points < 1 << 32 else 0)
    if data[25] >= 4:
        struct.pack_into("<QI", head, 235, 0, 0)
        struct.pack_into("<Q", head, 247, points)
    piece = records * max(1, PIECE // len(records))
    with open(target, "wb") as file:
        file.write(head)
        left = points * length
        while left > 0:
            left -= file.write(piece[:left])
        file.flush()
        os.fsync(file.fileno())


def run(command):
    """Elapsed seconds, processor seconds and peak MB of a command."""
    start = time.monotonic()
    process = subprocess.Popen([str(part) for part in command], stderr=subprocess.PIPE)
    peak = 0.0

    def watch():  # The memory that `wait4` reports includes that of this process before exec.
        nonlocal peak
        with contextlib.suppress(OSError):
            while (now := peak_memory(process.pid)) > 0:
                peak = now
                time.sleep(0.02)

    watcher = threading.Thread(target=watch)
    watcher.start()
    messages = process.stderr.read().decode()
    watcher.join()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{command}: {messages}")
    return time.monotonic() - start, usage.ru_utime + usage.ru_stime, peak


def compress(source, options, query):
    """The points of `source` as LAZ, by the program itself: with its two columns under other names."""
    table = ("--table", options.table)
    target = source.with_suffix(".laz")
    run((query, "las", source, target, *table, "--incidence", "10", "--water-level", "0", "--footprint", "1",
         "--wind-speed", "5", "--classes", "0,1,2,7,9,18,26,40,41"))
    source.unlink()
    data = target.read_bytes()
    head = bytearray(data[:struct.unpack_from("<I", data, 96)[0]])
    for name in (b"sea_thu", b"sea_tvu"):  # Otherwise they could not be appended again.
        head[:] = head.replace(name, b"old" + name[3:])
    with open(target, "r+b") as file:
        file.write(head)
    return target


def processor_seconds(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def peak_memory(pid):
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmHWM"):
            return int(line.split()[1]) / 1024
    return 0.0  # The process has ended.


def row(what, points, seconds, client, memory, server="", server_memory=""):
    print(f"| {what} | {points / seconds / 1e6:.2f} | {seconds:.1f} | {client:.1f} | {server} | {memory:.0f} | "
          f"{server_memory} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--millions", type=float, default=50)
    parser.add_argument("--sample", type=pathlib.Path)
    parser.add_argument("--flags", default="", help="that say where the beams of the sample went")
    parser.add_argument("--details", action="store_true")
    parser.add_argument("--laz", action="store_true", help="compress the input, and write LAZ")
    parser.add_argument("--table", type=pathlib.Path, default=SOURCE / "tables" / "shipped" / "survey.h5")
    parser.add_argument("--folder", help="where to write the files, which need three times the size of the input")
    options = parser.parse_args()
    programs = options.build / "bin"
    points = int(options.millions * 1e6)
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        folder = pathlib.Path(folder)
        sample, flags = options.sample, options.flags.split()
        if sample is None:
            simulate = options.build / "tests/flights/albtpu_simulated_survey"
            subprocess.run([simulate, folder, "--seconds", "60"], check=True)
            sample = folder / "flight.las"
            flags += ["--trajectory", folder / "sbet.out", "--lever-arm", "0.3,-0.2,0.5", "--water-classes", "41"]
        source, target = folder / "in.las", folder / "out.las"
        repeat(sample, source, points)
        flags += [*FLAGS, *(["--details"] if options.details else [])]
        if options.laz:
            source, target = compress(source, options, programs / "albtpu-query"), folder / "out.laz"
        query = (programs / "albtpu-query", "las", source, target, *flags)
        print("| what | million points/s | s | CPU s, client | CPU s, server | MB, client | MB, server |\n"
              "|---|---|---|---|---|---|---|")
        copy = ("dd", f"if={source}", f"of={folder / 'copy.las'}", "bs=4M", "conv=fsync")
        row("copied by `dd conv=fsync`", points, *run(copy))
        (folder / "copy.las").unlink()
        row("in process (`--table`)", points, *run((*query, "--table", options.table)))
        local = target.read_bytes() if points <= 5e6 else None
        tables = folder / "tables"
        tables.mkdir()
        (tables / "survey.h5").symlink_to(options.table.resolve())
        with serving.Server(programs / "albtpu-serve", "--tables", tables) as server:
            before = processor_seconds(server.process.pid)
            seconds, client, memory = run((*query, "--server", server.address))
            row("through a server", points, seconds, client, memory,
                f"{processor_seconds(server.process.pid) - before:.1f}", f"{peak_memory(server.process.pid):.0f}")
        if local is not None and target.read_bytes() != local:
            raise SystemExit("las_bench.py: the output through the server differs from that of the table file")


if __name__ == "__main__":
    main()
