"""The resources of one albtpu-serve: processor time by kind of query, bytes on the wire, memory, time to start.

Usage: sizing.py BUILD_FOLDER          prints a Markdown table of medians, within some minutes

Only the server's processor time is counted, so clients on the same machine do not matter.
"""

import pathlib
import shutil
import statistics
import tempfile
import time

import bench  # Finds the modules of other folders.

import albtpu
import grpc
import numpy as np
from albtpu.v1 import uncertainty_service_pb2 as wire
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from authority import Authority
from serving import Server

SERVE = bench.parser(__doc__).parse_args().build / "bin/albtpu-serve"
TABLE = bench.TABLES / "survey.h5"
REPETITIONS, PULSES, CALLS, COPIES, CONNECTIONS = 5, 10_000_000, 5000, 9, 400
OWN_CONNECTION = (("grpc.enable_http_proxy", 0), ("grpc.use_local_subchannel_pool", 1))
ONE_PULSE = wire.QueryPulsesRequest(pulses=[dict(wind_speed=5, incidence=10, footprint=0.5, depth=8)])
THU_TVU = ("thu", "tvu")


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
    return bench.flight_line(count) | {"azimuth": 90.0}


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


def spent_by(server, ask):
    """The median of the processor time that the server spends on `ask`."""
    spent = []
    for _ in range(REPETITIONS):
        before = bench.processor_seconds(server.process.pid)
        ask()
        spent.append(bench.processor_seconds(server.process.pid) - before)
    return statistics.median(spent)


def columns(name, pulses, tls=(), trust=None, **options):
    server, _ = serve(1, tls)
    quantities = len(options.get("quantities", albtpu.QUANTITIES))
    with server, albtpu.connect(server.address, ca=trust) as service:
        service.query(**pulses, **options)
        spent = spent_by(server, lambda: service.query(**pulses, **options))
    there, back = bytes_a_pulse(pulses, quantities)
    return name, f"{PULSES / spent / 1e6:.0f} M pulses a second", f"{there:.0f} + {back}"


def columns_by_tls(name, pulses):
    with tempfile.TemporaryDirectory() as folder:
        authority = Authority(folder, "authority")
        certificate, key = authority.issue("server")
        return columns(name, pulses, ("--tls-cert", certificate, "--tls-key", key), authority.certificate)


def single_calls():
    server, _ = serve(1)
    with server, grpc.insecure_channel(server.address, OWN_CONNECTION) as channel:
        ask = UncertaintyServiceStub(channel).QueryPulses
        spent = spent_by(server, lambda: [ask(ONE_PULSE) for _ in range(CALLS)])
    return "`QueryPulses`, one pulse a call, one after the other", f"{CALLS / spent:.0f} calls a second", ""


def queries():
    yield columns("`StreamColumns`, a flight line, THU and TVU", flight_line(PULSES), quantities=THU_TVU)
    yield columns("the same, all six quantities", flight_line(PULSES))
    yield columns_by_tls("the same, by TLS", flight_line(PULSES))
    yield columns("all six at random in the table", at_random(PULSES))
    yield single_calls()


def print_memory_and_start():
    one, seconds = serve(1)
    many, seconds_of_many = serve(COPIES)
    with one, many:
        alone, together = (bench.memory(server.process.pid) / 1e6 for server in (one, many))
        channels = [grpc.insecure_channel(one.address, OWN_CONNECTION) for _ in range(CONNECTIONS)]
        for channel in channels:
            UncertaintyServiceStub(channel).QueryPulses(ONE_PULSE)
        connected = bench.memory(one.process.pid) / 1e6
        for channel in channels:
            channel.close()
    of_one = f"memory, with `survey` alone ({TABLE.stat().st_size / 1e6:.1f} MB of file)"
    bench.print_table((of_one, f"{alone:.0f} MB"), [
        ("for each table of that size more", f"{(together - alone) / (COPIES - 1):.0f} MB"),
        ("for each connection that asks now and then", f"{(connected - alone) / CONNECTIONS * 1000:.0f} kB"),
        ("until it is ready", f"{seconds:.2f} s"),
        ("for each table of that size more", f"{(seconds_of_many - seconds) / (COPIES - 1):.2f} s")])


if __name__ == "__main__":
    bench.print_table(("asked", "for a second of the server's processor", "bytes a pulse, there + back"), queries())
    print()
    print_memory_and_start()
