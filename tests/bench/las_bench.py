"""`albtpu-query las` from file to file, in its own process and through a server, compared with a plain copy.

Usage: las_bench.py BUILD [--millions N] [--laz] [--sample IN.las --flags "FLAGS"] [--folder DIR]

The input repeats the points of a simulated survey, times included. The beams come from its SBET over the local surface
of its water returns; with --details, their geometry is written, too. With --laz, input and output are compressed. A
sample of another survey needs its own flags, such as "--trajectory-from-returns --water-level -23.09 --classes 26".
Prints a Markdown table: points per second of elapsed time, processor seconds of client and server, and the peak memory
of each.
"""

import contextlib
import os
import pathlib
import subprocess
import tempfile
import threading
import time

import bench
import serving

FLAGS = ("--wind-speed", "6.5", "--fetch", "30000", "--divergence", "1.5", "--wind-from", "100", "--overwrite")


def run(command):
    """Elapsed seconds, processor seconds and peak MiB of a command."""
    start = time.monotonic()
    process = subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    peak = 0.0

    def watch():  # The memory that `wait4` reports includes that of this process before exec.
        nonlocal peak
        with contextlib.suppress(OSError):
            while (now := bench.memory(process.pid, "VmHWM")) > 0:
                peak = now / 2**20
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


def row(what, points, seconds, client, memory, server="", server_memory=""):
    return (what, f"{points / seconds / 1e6:.2f}", f"{seconds:.1f}", f"{client:.1f}", server, f"{memory:.0f}",
            server_memory)


def rows(options, folder):
    points, programs = int(options.millions * 1e6), options.build / "bin"
    sample, flags = options.sample, options.flags.split()
    if sample is None:
        sample = bench.simulated_survey(options.build, folder)
        flags += ["--trajectory", folder / "sbet.out", "--lever-arm", "0.3,-0.2,0.5", "--water-classes", "41"]
    source, target = bench.repeat(sample, folder / "in.las", points), folder / "out.las"
    if options.laz:
        las, source, target = source, bench.laz_copy(options.build, source, folder / "in.laz"), folder / "out.laz"
        las.unlink()
    query = (programs / "albtpu-query", "las", source, target, *flags, *FLAGS,
             *(["--details"] if options.details else []))
    copy = folder / "copy.las"
    yield row("copied by `dd conv=fsync`", points, *run(("dd", f"if={source}", f"of={copy}", "bs=4M", "conv=fsync")))
    copy.unlink()
    yield row("in process (`--table`)", points, *run((*query, "--table", options.table)))
    local = target.read_bytes() if points <= 5e6 else None
    tables = folder / "tables"
    tables.mkdir()
    (tables / "survey.h5").symlink_to(options.table.resolve())
    with serving.Server(programs / "albtpu-serve", "--tables", tables) as server:
        pid = server.process.pid
        before = bench.processor_seconds(pid)
        measured = run((*query, "--server", server.address))
        yield row("through a server", points, *measured, f"{bench.processor_seconds(pid) - before:.1f}",
                  f"{bench.memory(pid, 'VmHWM') / 2**20:.0f}")
    if local is not None and target.read_bytes() != local:
        raise SystemExit("las_bench.py: the output through the server differs from that of the table file")


def main():
    parser = bench.parser(__doc__, millions=50.0)
    parser.add_argument("--sample", type=pathlib.Path)
    parser.add_argument("--flags", default="", help="that say where the beams of the sample went")
    parser.add_argument("--details", action="store_true")
    parser.add_argument("--laz", action="store_true", help="compress the input, and write LAZ")
    parser.add_argument("--table", type=pathlib.Path, default=bench.TABLES / "survey.h5")
    parser.add_argument("--folder", help="where to write the files, which need three times the size of the input")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        heads = ("what", "million points/s", "s", "CPU s, client", "CPU s, server", "MB, client", "MB, server")
        bench.print_table(heads, rows(options, pathlib.Path(folder)), words=7)


if __name__ == "__main__":
    main()
