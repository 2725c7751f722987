"""The manifests of docker/kubernetes, as rendered by kubectl, are consistent and meet strict security rules.

This needs no cluster: names, ports, selectors, shards and privileges are compared with each other.

Usage: kubernetes_test.py KUBERNETES_FOLDER VERSION
"""

import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import yaml

FOLDER, VERSION = pathlib.Path(sys.argv[1]), sys.argv[2]
OPERATIONS = FOLDER.parent.parent / "docs/operations.md"
ROOTS = ("base", "overlays/volume", "overlays/volume/fill", "overlays/public", "campaign/shards", "campaign/merge",
         "survey/parts", "survey/merge")
MADE_BY_THE_USER = {"albtpu-tls", "albtpu-tokens", "albtpu-campaign", "albtpu-survey"}  # As the comments there say.

# Where the volume that a root mounts is defined.
VOLUMES = {"campaign/merge": "campaign/shards", "survey/merge": "survey/parts",
           "overlays/volume/fill": "overlays/volume"}


def render(root):
    rendered = subprocess.run(["kubectl", "kustomize", FOLDER / root], check=True, capture_output=True, text=True)
    return list(yaml.safe_load_all(rendered.stdout))


@unittest.skipUnless(shutil.which("kubectl"), "kubectl is missing; apt-get install kubernetes-client")
class Rendered(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.objects = {root: render(root) for root in ROOTS}

    def of_kind(self, *kinds):
        return [(root, each) for root, objects in self.objects.items() for each in objects if each["kind"] in kinds]

    def named(self, root, kind):
        return {each["metadata"]["name"] for each in self.objects[root] if each["kind"] == kind}

    def deployment(self, root):
        return next(each for each in self.objects[root] if each["kind"] == "Deployment")["spec"]

    def service(self, name):
        return next(each for each in self.objects["base"]
                    if each["kind"] == "Service" and each["metadata"]["name"] == name)["spec"]

    def containers(self):
        """Each container with its root and its pod."""
        for root, workload in self.of_kind("Deployment", "Job", "Pod"):
            pod = workload["spec"] if workload["kind"] == "Pod" else workload["spec"]["template"]["spec"]
            for container in pod["containers"]:
                yield root, pod, container

    def test_pods_have_no_privileges(self):
        for _, pod, container in self.containers():
            self.assertTrue(pod["securityContext"]["runAsNonRoot"])
            self.assertGreaterEqual(pod["securityContext"]["runAsUser"], 1000)
            self.assertEqual(pod["securityContext"]["seccompProfile"], {"type": "RuntimeDefault"})
            self.assertFalse(pod["automountServiceAccountToken"])
            self.assertEqual(container["securityContext"], {
                "allowPrivilegeEscalation": False, "readOnlyRootFilesystem": True, "capabilities": {"drop": ["ALL"]}})

    def test_pods_declare_their_resources(self):
        for _, _, container in self.containers():
            self.assertIn("cpu", container["resources"]["requests"])
            self.assertIn("memory", container["resources"]["requests"])
            self.assertIn("memory", container["resources"]["limits"])

    def test_images_have_the_current_version(self):
        for _, _, container in self.containers():
            self.assertEqual(container["image"].partition(":")[2], VERSION)

    def test_referenced_objects_are_defined_or_made_by_the_user(self):
        for root, pod, container in self.containers():
            there = MADE_BY_THE_USER | set().union(*(self.named(root, kind) for kind in
                                              ("ConfigMap", "PersistentVolumeClaim", "Secret")))
            if root in VOLUMES:
                there |= self.named(VOLUMES[root], "PersistentVolumeClaim")
            volumes = {volume["name"] for volume in pod.get("volumes", [])}
            self.assertEqual({mount["name"] for mount in container.get("volumeMounts", [])}, volumes)
            for volume in pod.get("volumes", []):
                source = next(value for key, value in volume.items() if key != "name")
                self.assertIn(source.get("claimName") or source.get("secretName") or source.get("name"), there)
            for variable in container.get("env", []):
                if "configMapKeyRef" in variable.get("valueFrom", {}):
                    self.assertIn(variable["valueFrom"]["configMapKeyRef"]["name"], there)
            for source in container.get("envFrom", []):
                self.assertIn(source["configMapRef"]["name"], there)

    def test_services_budgets_and_policies_select_the_servers(self):
        for root, each in self.of_kind("Service", "PodDisruptionBudget", "NetworkPolicy"):
            spec = each["spec"]
            selector = spec.get("podSelector") or spec["selector"]
            deployment = self.deployment(root)
            self.assertEqual(selector.get("matchLabels", selector), deployment["selector"]["matchLabels"])
            self.assertEqual(deployment["template"]["metadata"]["labels"], deployment["selector"]["matchLabels"])

    def test_ports_of_services_are_those_of_the_servers(self):
        for root, each in self.of_kind("Service"):
            container = self.deployment(root)["template"]["spec"]["containers"][0]
            ports = {port["name"]: port["containerPort"] for port in container["ports"]}
            for port in each["spec"]["ports"]:
                self.assertEqual(ports[port["name"]], ports.get(port.get("targetPort"), port["port"]))
            for name, flag in (("grpc", "--listen"), ("metrics", "--metrics")):
                address = container["args"][container["args"].index(flag) + 1]
                self.assertEqual(address, f"0.0.0.0:{ports[name]}")

    def test_clients_can_balance_over_the_addresses_of_a_name(self):
        spec = self.service("albtpu-serve")
        self.assertEqual(spec["clusterIP"], "None")
        self.assertFalse(spec.get("publishNotReadyAddresses", False))

    def test_prometheus_finds_servers_that_are_not_ready(self):
        scraped = re.search(r"names: \[([a-z-]+)\.NAMESPACE\.svc.*port: (\d+)", OPERATIONS.read_text())
        spec = self.service(scraped[1])
        self.assertEqual(spec["clusterIP"], "None")
        self.assertTrue(spec["publishNotReadyAddresses"])
        self.assertEqual([port["port"] for port in spec["ports"]], [int(scraped[2])])

    def test_probes_query_the_health_of_the_servers(self):
        for _, _, container in self.containers():
            if container["name"] == "serve":
                secured = "--tls-cert" in container["args"]
                for probe in ("startupProbe", "readinessProbe", "livenessProbe"):
                    by_tls = "tcpSocket" if probe == "livenessProbe" else "exec"
                    self.assertEqual(by_tls in container[probe], secured)
                    self.assertEqual("grpc" in container[probe], not secured)

    def test_the_number_of_shards_is_the_number_of_completions(self):
        for root, job in self.of_kind("Job"):
            if root == "campaign/shards":
                self.assertEqual(job["spec"]["completionMode"], "Indexed")
                args = job["spec"]["template"]["spec"]["containers"][0]["args"]
                self.assertEqual(args[args.index("--shard") + 1], f"$(SHARD)/{job['spec']['completions']}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
