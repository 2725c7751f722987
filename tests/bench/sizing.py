"""The resources of one albtpu-serve: processor time by kind of query, bytes on the wire, memory, time to start.

Usage: sizing.py BUILD_FOLDER          prints a Markdown table of medians, within some minutes

Only the server's processor time is counted, so clients on the same machine do not matter.
"""

import os
import pathlib
import shutil
import statistics
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("clients/python/src", "tests/e2e")]

import grpc  # noqa: E402
import numpy as np  # noqa: E402

import albtpu  # noqa: E402
from albtpu.v1 import uncertainty_service_pb2 as wire  # noqa: E402
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub  # noqa: E402
from authority import Authority  # noqa: E402
from serving import Server  # noqa: E402

SERVE = pathlib.Path(sys.argv[1], "bin/albtpu-serve")
TABLE = ROOT / "tables/shipped/survey.h5"
REPETITIONS, PULSES, CALLS, COPIES, CONNECTIONS = 5, 10_000_000, 5000, 9, 400
TICKS = os.sysconf("SC_CLK_TCK")
OWN_CONNECTION = (("grpc.enable_http_proxy", 0), ("grpc.use_local_subchannel_pool", 1))
ONE_PULSE = wire.QueryPulsesRequest(pulses=[dict(wind_speed=5, incidence=10, footprint=0.5, depth=8)])
THU_TVU = ("thu", "tvu")


def of_process(server, file):
    return pathlib.Path(f"/proc/{server.process.pid}/{file}").read_text()


def processor_seconds(server):
    fields = of_process(server, "stat").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


def resident_megabytes(server):
    return int(of_process(server, "statm").split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


def serve(tables, tls=()):
    """A server with `tables` copies of the table, and the seconds until it was ready."""
    folder = tempfile.mkdtemp()
    for copy in range(tables):
        shutil.copy(TABLE, pathlib.Path(folder, f"survey{copy or ''}.h5"))
    begin = time.monotonic()
    server = Server(SERVE, "--tables", folder, *tls)
    seconds = time.monotonic() - begin
    shutil.rmtree(folder)
    return server, seconds


def flight_line(count):
    scan = np.abs(np.linspace(-20, 20, 5000, dtype=np.float32))
    return dict(wind_speed=5.0, footprint=0.5, azimuth=90.0, incidence=np.resize(scan, count),
                depth=(5 + 4 * np.sin(np.linspace(0, 3000, count))).astype(np.float32))


def at_random(count):
    random = np.random.default_rng(1)
    ranges = dict(wind_speed=(2, 15), fetch=(1e3, 3e5), incidence=(0, 25), azimuth=(0, 90), footprint=(0.1, 5),
                  depth=(0, 60))
    return {axis: random.uniform(*ends, count).astype(np.float32) for axis, ends in ranges.items()}


def bytes_a_pulse(pulses, quantities, count=32768):
    """Bytes per pulse of the request and the response messages."""
    columns = {axis: np.atleast_1d(column)[:count].astype(np.float32).tobytes() for axis, column in pulses.items()}
    request = wire.StreamColumnsRequest(query=dict(pulses=columns, quantities=range(1, quantities + 1)))
    return request.ByteSize() / count, quantities * 4 + 2


def columns(name, pulses, tls=(), trust=None, **options):
    server, _ = serve(1, tls)
    quantities = len(options.get("quantities", albtpu.QUANTITIES))
    with server, albtpu.connect(server.address, ca=trust) as service:
        service.query(**pulses, **options)
        spent = []
        for _ in range(REPETITIONS):
            before = processor_seconds(server)
            service.query(**pulses, **options)
            spent.append(processor_seconds(server) - before)
    there, back = bytes_a_pulse(pulses, quantities)
    print(f"| {name} | {PULSES / statistics.median(spent) / 1e6:.0f} M pulses a second | {there:.0f} + {back} |")


def columns_by_tls(name, pulses):
    with tempfile.TemporaryDirectory() as folder:
        authority = Authority(folder, "authority")
        certificate, key = authority.issue("server")
        columns(name, pulses, ("--tls-cert", certificate, "--tls-key", key), authority.certificate)


def single_calls():
    server, _ = serve(1)
    with server, grpc.insecure_channel(server.address, OWN_CONNECTION) as channel:
        ask = UncertaintyServiceStub(channel).QueryPulses
        spent = []
        for _ in range(REPETITIONS):
            before = processor_seconds(server)
            for _ in range(CALLS):
                ask(ONE_PULSE)
            spent.append(processor_seconds(server) - before)
    print(f"| `QueryPulses`, one pulse a call, one after the other | {CALLS / statistics.median(spent):.0f} calls a "
          "second | |")


def memory_and_start():
    one, seconds = serve(1)
    many, seconds_of_many = serve(COPIES)
    with one, many:
        alone, together = resident_megabytes(one), resident_megabytes(many)
        channels = [grpc.insecure_channel(one.address, OWN_CONNECTION) for _ in range(CONNECTIONS)]
        for channel in channels:
            UncertaintyServiceStub(channel).QueryPulses(ONE_PULSE)
        connected = resident_megabytes(one)
        for channel in channels:
            channel.close()
    print(f"\n| memory, with `survey` alone ({TABLE.stat().st_size / 1e6:.1f} MB of file) | {alone:.0f} MB |")
    print("|---|---:|")
    print(f"| for each table of that size more | {(together - alone) / (COPIES - 1):.0f} MB |")
    print(f"| for each connection that asks now and then | {(connected - alone) / CONNECTIONS * 1000:.0f} kB |")
    print(f"| until it is ready | {seconds:.2f} s |")
    print(f"| for each table of that size more | {(seconds_of_many - seconds) / (COPIES - 1):.2f} s |")


def main():
    print("| asked | for a second of the server's processor | bytes a pulse, there + back |\n|---|---:|---:|")
    columns("`StreamColumns`, a flight line, THU and TVU", flight_line(PULSES), quantities=THU_TVU)
    columns("the same, all six quantities", flight_line(PULSES))
    columns_by_tls("the same, by TLS", flight_line(PULSES))
    columns("all six at random in the table", at_random(PULSES))
    single_calls()
    memory_and_start()


if __name__ == "__main__":
    main()
