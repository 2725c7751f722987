"""Runs the images with podman or docker as docker/compose.yaml and docker/kubernetes describe.

Usage: orchestration_test.py ENGINE BASE_IMAGE SOURCE_FOLDER [TEST]
"""

import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest
import urllib.request

from containers import ENGINE, IS_PODMAN, PATIENCE, QUERY, RESTRICTED, TAG, engine, run, wait_for

BASE, SOURCE = sys.argv[2], pathlib.Path(sys.argv[3]).resolve()
COMPOSE = ["podman-compose"] if IS_PODMAN else [ENGINE, "compose"]
PROJECT = f"albtpu-test-{os.getpid()}"  # Differs from any project in use on this machine.
PROMETHEUS = "albtpu-test-prometheus"  # From Debian's package, which needs no registry.
PROMETHEUS_IMAGE = f"""FROM {BASE}
RUN apt-get -qq update && apt-get -qq install --yes --no-install-recommends prometheus >/dev/null
RUN mkdir /prometheus && chown 65534:65534 /prometheus
USER 65534:65534
VOLUME /prometheus
ENTRYPOINT ["prometheus"]
"""


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        return taken.getsockname()[1]


def fetch(url):
    with urllib.request.urlopen(url, timeout=PATIENCE) as page:
        return json.load(page)


@unittest.skipUnless(shutil.which(COMPOSE[0]), "podman-compose is missing; apt-get install podman-compose")
class Compose(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "Dockerfile").write_text(PROMETHEUS_IMAGE)
            run(ENGINE, "build", "--tag", PROMETHEUS, folder)
        cls.addClassCleanup(engine, "rmi", "--force", PROMETHEUS)
        cls.prometheus = f"http://127.0.0.1:{free_port()}"
        cls.environment = {**os.environ, "PROMETHEUS_IMAGE": PROMETHEUS, "ALBTPU_PORT": str(free_port()),
                           "PROMETHEUS_PORT": cls.prometheus.rpartition(":")[2]}
        cls.addClassCleanup(cls.compose, "down", "--volumes")
        cls.compose("up", "--detach")

    @classmethod
    def compose(cls, *command):
        return run(*COMPOSE, "--project-name", PROJECT, "--file", SOURCE / "docker/compose.yaml", *command,
                   env=cls.environment)

    def test_the_job_gets_an_answer(self):
        wait_for(lambda: "INTERPOLATED" in self.compose("logs", "query"), "the job")

    def test_prometheus_monitors_the_server(self):
        def healthy():
            try:
                targets = fetch(self.prometheus + "/api/v1/targets")["data"]["activeTargets"]
            except OSError:
                return False
            return [target["labels"]["job"] for target in targets if target["health"] == "up"] == ["albtpu"]

        wait_for(healthy, "Prometheus")
        groups = fetch(self.prometheus + "/api/v1/rules")["data"]["groups"]
        self.assertIn("AlbtpuDown", [rule["name"] for group in groups for rule in group["rules"]])


@unittest.skipUnless(IS_PODMAN, "only podman has kube play")
@unittest.skipUnless(shutil.which("kubectl"), "kubectl is missing; apt-get install kubernetes-client")
class KubePlay(unittest.TestCase):
    def setUp(self):
        rendered = run("kubectl", "kustomize", SOURCE / "docker/kubernetes/overlays/volume")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.manifest = pathlib.Path(folder.name, "albtpu.yaml")
        # Only the objects that work on a single machine. A volume with one table stands for the claim.
        kinds = ("kind: ConfigMap", "kind: Deployment")
        played = [part for part in rendered.split("\n---\n") if any(kind in part for kind in kinds)]
        self.assertEqual(len(played), len(kinds))
        manifest = "\n---\n".join(played).replace("replicas: 3", "replicas: 1")
        self.manifest.write_text(re.sub(r"(image: albtpu-serve):.*", rf"\1:{TAG}", manifest))
        engine("volume", "create", "albtpu-tables")
        self.addCleanup(engine, "volume", "rm", "--force", "albtpu-tables")
        self.addCleanup(engine, "kube", "down", self.manifest, check=False)

    def test_the_deployment_answers_from_the_volume(self):
        engine("run", "--rm", "--user", "root", "--entrypoint", "cp", "--volume", "albtpu-tables:/volume",
               QUERY, "/tables/survey.h5", "/volume/")
        engine("kube", "play", self.manifest)
        pod = engine("pod", "ps", "--format", "{{.Name}}", "--filter", "name=albtpu-serve").split()[0]

        def query(*arguments):
            result = subprocess.run([ENGINE, "run", "--rm", *RESTRICTED, "--pod", pod, QUERY, *arguments,
                                     "--server", "127.0.0.1:50051"], capture_output=True, text=True, timeout=PATIENCE)
            return result.stdout

        wait_for(lambda: query("health") == "SERVING\n" or "error" in engine("pod", "logs", pod), "the pod")
        self.assertTrue(query("tables").startswith("survey (default)\n"))
        self.assertEqual(query("tables").count("digest"), 1)  # Only the table of the volume, not those of the image.
        self.assertIn("INTERPOLATED", query("pulse", "--wind-speed", "7", "--incidence", "12", "--footprint", "0.5",
                                          "--depth", "8"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
