"""The images work, with no more privileges than they need.

Usage: containers_test.py ENGINE BUILD_FOLDER SOURCE_FOLDER [TEST]
"""

import json
import os
import pathlib
import queue
import shutil
import signal
import sys
import tempfile
import threading
import unittest
import urllib.request

import grpc
import numpy as np

import albtpu
from albtpu.v1 import uncertainty_service_pb2 as wire
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from authority import Authority
from containers import GENERATE, PATIENCE, QUERY, RESTRICTED, SERVE, ContainerTest, engine, inspect, run, wait_for

BUILD, SOURCE = pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
GENERATOR, CLIENT = BUILD / "bin/albtpu-generate", BUILD / "bin/albtpu-query"  # Built outside of the images.
CAMPAIGN = SOURCE / "tests/generator/six_seas.toml"
IMAGES = (SERVE, QUERY, GENERATE)
PULSE = dict(wind_speed=7, incidence=12, footprint=0.5, depth=8)
PULSE_FLAGS = [word for name, value in PULSE.items() for word in (f"--{name.replace('_', '-')}", str(value))]
# Of the server and the client; the generator has MPI. The library of netCDF brings 34 MB of Unicode with its XML.
MOST_BYTES = 145_000_000


def query(*arguments):
    """A query of one pulse by the program outside of the images."""
    return json.loads(run(CLIENT, "pulse", "--json", *PULSE_FLAGS, *arguments))


class Images(unittest.TestCase):
    def shell(self, image, script):
        return engine("run", "--rm", *RESTRICTED, "--entrypoint", "sh", image, "-c", script)

    def test_state_version_and_commit(self):
        commit = run("git", "-C", SOURCE, "describe", "--always", "--dirty", "--abbrev=12").strip()
        for image in IMAGES:
            labels, name = inspect("image", image)["Config"]["Labels"], image.partition(":")[0]
            version = labels["org.opencontainers.image.version"]
            self.assertEqual(labels["org.opencontainers.image.revision"], commit, name)
            self.assertEqual(labels["org.opencontainers.image.title"], name)
            stated = engine("run", "--rm", image, "--version").splitlines()
            self.assertEqual(stated[:2], [f"{name} {version}", f"commit {commit}"])

    def test_run_as_an_unprivileged_user(self):
        for name in IMAGES:
            user, capabilities = self.shell(name, "id -u; grep CapEff /proc/self/status").split("\n")[:2]
            self.assertGreaterEqual(int(user), 1000)
            self.assertEqual(int(capabilities.split()[1], 16), 0)
            self.assertEqual(inspect("image", name)["Config"]["User"], f"{user}:{user}")

    def test_contain_no_setuid_or_setgid_programs(self):
        for name in IMAGES:
            found = engine("run", "--rm", "--user", "root", "--entrypoint", "find", name,
                           "/", "-xdev", "-type", "f", "-perm", "/6000")
            self.assertEqual(found, "", name)

    def test_contain_no_tools_sources_history_or_keys(self):
        tools = "for tool in g++ gcc cc ld make ninja cmake git ccache protoc python3; do command -v $tool; done; true"
        files = ("*_history", "*.key", ".git", "*.cc", "CMakeLists.txt")
        names = " -o ".join(f"-name '{file}'" for file in files)
        keys = "grep -rl 'PRIVATE KEY-----' /etc /home /opt /root /srv /tables /usr/share/albtpu /var 2>/dev/null"
        for name in IMAGES:
            self.assertEqual(self.shell(name, tools), "", name)
            found = self.shell(name, f"find / -xdev \\( {names} \\) -print 2>/dev/null; {keys}; true")
            self.assertEqual(found, "", name)

    def test_are_at_most_145_mb(self):
        sizes = {name: inspect("image", name)["Size"] for name in IMAGES}
        print(", ".join(f"{name}: {size / 1e6:.0f} MB" for name, size in sizes.items()))
        self.assertLessEqual(sizes[SERVE], MOST_BYTES)
        self.assertLessEqual(sizes[QUERY], MOST_BYTES)

    def test_stop_with_sigterm(self):
        self.assertEqual(inspect("image", SERVE)["Config"]["StopSignal"], "SIGTERM")


class Service(ContainerTest):
    def test_answers_through_a_published_port_from_its_table(self):
        server = self.serve()
        self.assertEqual(query("--server", server.address()), query("--table", SOURCE / "tables/shipped/survey.h5"))

    def test_answers_the_query_image(self):
        server = self.serve()
        text = engine("run", "--rm", *RESTRICTED, "--network", f"container:{server.name}", QUERY, "pulse", "--json",
                      *PULSE_FLAGS, "--server", "127.0.0.1:50051")
        self.assertEqual(json.loads(text), query("--server", server.address()))

    def test_is_healthy_and_publishes_metrics(self):
        server = self.serve()
        self.assertTrue(server.is_healthy())
        query("--server", server.address())
        with urllib.request.urlopen(f"http://{server.address(9464)}/metrics", timeout=PATIENCE) as metrics:
            self.assertRegex(metrics.read(), rb'albtpu_pulses_total\{axis="",outcome="INTERPOLATED"\} [1-9]')

    def test_computes_totals_on_a_sea_and_in_a_water(self):
        server = self.serve()
        sea = albtpu.Sea.jonswap(hs=0.42, tp=2.7, waves_from=225)
        water = albtpu.Water(secchi=5, detector="half", field_of_view=8, pulse_length=1.5, bias="none")
        with albtpu.connect(server.address()) as service:
            budget = service.query_budget(sea=sea, water=water, incidence=12, footprint=0.5, depth=[3, 6], altitude=400,
                                          beam_azimuth=90, located="level", errors=dict(scan=0.001, bottom_range=0.02),
                                          quantities=("tvu_sea", "tvu_water", "total_tvu"))
        self.assertTrue((budget.outcomes == 1).all())
        self.assertTrue((budget.total_tvu > np.hypot(budget.tvu_sea, budget.tvu_water)).all())
        self.assertGreater(budget.tvu_water.min(), 0)

    def test_answers_from_the_tables_of_a_volume(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        folder.chmod(0o755)
        shutil.copy(SOURCE / "tables/shipped/birkebak2018_model.h5", folder / "mine.h5")
        server = self.serve(flags=("--volume", f"{folder}:/tables:ro"))
        self.assertIn("mine (default)", run(CLIENT, "tables", "--server", server.address()))
        shutil.copy(SOURCE / "tables/shipped/survey.h5", folder / ".survey.new")
        os.rename(folder / ".survey.new", folder / "survey.h5")
        engine("kill", "--signal", "HUP", server.name)
        wait_for(lambda: "survey (default)" in run(CLIENT, "tables", "--server", server.address()), "the new table")

    def test_uses_tls(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        authority = Authority(folder, "authority")
        certificate, key = authority.issue("server", hosts="DNS:albtpu.example,IP:127.0.0.1")
        folder.chmod(0o755)
        authority.folder.chmod(0o755)
        key.chmod(0o644)
        # Like the probes of overlays/public: uses the name in the certificate, and trusts only that certificate.
        server = self.serve("--listen", "0.0.0.0:50051", "--tls-cert", "/tls/server.pem",
                            "--tls-key", "/tls/server.key",
                            flags=("--volume", f"{authority.folder}:/tls:ro", "--add-host", "albtpu.example:127.0.0.1",
                                   "--env", "ALBTPU_HEALTH=--server albtpu.example:50051 --tls-ca /tls/server.pem"))
        self.assertTrue(server.is_healthy(), server.log())
        answer = query("--server", server.address(), "--tls-ca", authority.certificate)
        self.assertEqual(answer["outcome"], "INTERPOLATED")

    def test_stays_within_its_memory_limit(self):
        server = self.serve(flags=("--memory", "256m", "--memory-swap", "256m"))
        with albtpu.connect(server.address()) as service:
            for _ in range(5):
                answer = service.query(wind_speed=7, incidence=12, footprint=0.5, depth=np.linspace(0, 60, 1_000_000))
                self.assertTrue((answer.outcomes == 1).all())
        print(f"albtpu-serve: {(server.memory_peak() or 0) / 1e6:.0f} MB at most during 5 million pulses")
        self.assertTrue(server.running())

    def test_lets_calls_finish_when_it_is_stopped(self):
        server = self.serve()
        pulse = {name: np.float32(value).tobytes() for name, value in PULSE.items()}
        requests = queue.SimpleQueue()
        with grpc.insecure_channel(server.address(), [("grpc.enable_http_proxy", 0)]) as channel:
            answers = UncertaintyServiceStub(channel).StreamColumns(iter(requests.get, None))
            requests.put(wire.StreamColumnsRequest(query=dict(pulses=pulse)))
            next(answers)
            stopping = threading.Thread(target=server.stop)
            stopping.start()
            wait_for(lambda: "draining after SIGTERM" in server.log(), "the signal")
            requests.put(wire.StreamColumnsRequest(query=dict(pulses=pulse)))
            self.assertEqual(next(answers).answer.outcomes, b"\1")
            requests.put(None)
            self.assertEqual(answers.code(), grpc.StatusCode.OK)
        stopping.join(PATIENCE)
        self.assertEqual(server.exit_code(), 0)
        self.assertIn("stopped", server.log())


class FolderTest(ContainerTest):
    """A folder that belongs to another user than that of the containers, but is writable for all."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.folder.chmod(0o777)


class Stopped(FolderTest):
    def test_a_client_ends_at_once_and_leaves_no_output(self):
        source = self.folder / "in.csv"
        os.mkfifo(source, 0o666)
        source.chmod(0o666)
        client = self.start(QUERY, "csv", "in.csv", "out.csv", "--table", "/tables/survey.h5",
                            flags=("--volume", f"{self.folder}:/data"))

        def is_being_read():
            try:
                self.addCleanup(os.close, os.open(source, os.O_WRONLY | os.O_NONBLOCK))
            except OSError:  # No process has opened it for reading yet.
                return False
            return True

        wait_for(is_being_read, "the client")
        client.stop()
        self.assertEqual(client.exit_code(), 128 + signal.SIGTERM, client.log())
        self.assertEqual(list(self.folder.iterdir()), [source])

    def test_a_generator_ends_at_once(self):
        generator = self.start(GENERATE, "table", "--output", "survey.h5", "--campaign",
                               "/usr/share/albtpu/campaigns/survey.toml",
                               flags=("--volume", f"{self.folder}:/data"))
        wait_for(lambda: "units of 'survey'" in generator.log(), "the first units")
        generator.stop()
        self.assertEqual(generator.exit_code(), 128 + signal.SIGTERM, generator.log())
        self.assertFalse((self.folder / "survey.h5").exists())


class Generator(FolderTest):
    def setUp(self):
        super().setUp()
        shutil.copy(CAMPAIGN, self.folder / "small.toml")

    def generate(self, *command):
        engine("run", "--rm", *RESTRICTED, "--volume", f"{self.folder}:/data", "--env", "SOURCE_DATE_EPOCH=1700000000",
               *command)

    def test_makes_the_same_table_with_two_ranks_as_outside(self):
        run(GENERATOR, "table", "--campaign", self.folder / "small.toml", "--output", self.folder / "outside.h5",
            env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"})
        self.generate("--tmpfs", "/tmp", "--entrypoint", "mpirun", GENERATE, "--oversubscribe", "-n", "2",
                      "albtpu-generate", "table", "--campaign", "small.toml", "--output", "inside.h5", "--threads", "1")
        self.assertTrue((self.folder / "inside.h5").read_bytes() == (self.folder / "outside.h5").read_bytes())

    def test_makes_the_same_table_with_shards_and_a_merge_as_in_one_run(self):
        self.generate(GENERATE, "table", "--campaign", "small.toml", "--output", "whole.h5")
        for shard in range(2):
            self.generate(GENERATE, "table", "--campaign", "small.toml", "--work", "units",
                          "--shard", f"{shard}/2")
        self.generate(GENERATE, "merge", "--work", "units", "--output", "merged.h5")
        self.assertTrue((self.folder / "merged.h5").read_bytes() == (self.folder / "whole.h5").read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
