"""The jobs of docker/slurm and docker/kubernetes/survey annotate a folder and make the surface that one process makes.

Usage: surface_jobs_test.py query=PATH simulated_survey=PATH tables=FOLDER docker=FOLDER
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "programs/query"))
import programs  # noqa: E402
import reported_survey  # noqa: E402
import slurm  # noqa: E402
from simulated_survey import SimulatedSurvey  # noqa: E402

DOCKER = pathlib.Path(programs.PATHS["docker"]).resolve()
QUERY = pathlib.Path(programs.PATHS["query"]).resolve()


def setUpModule():
    global shared, flight, survey, whole, environment
    shared = pathlib.Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, shared)
    shared.chmod(0o755)
    flight = SimulatedSurvey(shared / "flight", "--lines", 2, "--cross-lines", 1, "--seconds", 3, "--pulse-rate", 2000,
                             "--file-for-each-line").folder
    survey, whole = shared / "survey.toml", shared / "whole"
    survey.write_text(reported_survey.SURVEY.format(flight=flight, datum=0.05, coverage="p95"))
    (shared / "annotated").mkdir()
    environment = {"PATH": f"{QUERY.parent}:/usr/bin:/bin:/usr/sbin:/sbin",
                   "ALBTPU_TABLES": str(pathlib.Path(programs.PATHS["tables"]).resolve())}
    os.environ.update(environment)
    programs.query("las", flight, "--output-dir", shared / "annotated", "--survey", survey, check=0)
    programs.query("surface", shared / "annotated", "--output", whole, check=0)


class Jobs(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp(dir=shared))
        self.work.chmod(0o755)

    def assert_same_surface(self, folder):
        for name in ("surface.nc", "surface.json"):
            self.assertEqual((folder / name).read_bytes(), (whole / name).read_bytes(), name)


@unittest.skipIf(slurm.MISSING, f"{', '.join(slurm.MISSING)} missing; apt-get install slurm-wlm")
class Slurm(Jobs):
    def test_an_array_of_parts_and_a_merge_that_depends_on_it(self):
        (self.work / "slurm").mkdir()
        try:
            cluster = slurm.Slurm(self.work / "slurm")
        except slurm.CannotStart as error:
            self.skipTest(f"Slurm cannot start here: {error}")
        self.addCleanup(cluster.stop)

        def submit(*command):
            return cluster.run("sbatch", "--parsable", f"--chdir={self.work}", *command, **environment)

        # Three tasks have a file each, one has none.
        array = submit("--array=0-3", DOCKER / "slurm/surface_parts.sbatch", flight, survey, "work")
        submit(f"--dependency=afterok:{array}", DOCKER / "slurm/surface.sbatch", "work", "surface")
        ended = cluster.wait_for_jobs()
        said = "\n".join(path.read_text() for path in self.work.glob("slurm-*.out"))
        self.assertEqual(ended, {"albtpu-surface-parts": {"COMPLETED"}, "albtpu-surface": {"COMPLETED"}}, said)
        self.assertEqual(len(list((self.work / "work/parts").iterdir())), 3)
        self.assert_same_surface(self.work / "surface")


class Kubernetes(Jobs):
    """The commands of the containers, by a shell of this machine."""

    def run_container(self, manifest, **variables):
        job = yaml.safe_load((DOCKER / "kubernetes/survey" / manifest).read_text())
        container = job["spec"]["template"]["spec"]["containers"][0]
        self.assertEqual(container["workingDir"], "/survey")
        init, dashes, shell, options = container["command"]
        self.assertEqual([init, dashes], ["tini", "--"])
        shell = [shutil.which("busybox"), shell] if shutil.which("busybox") else [shell]
        script = container["args"][0].replace("/settings/survey.toml", str(survey))
        result = subprocess.run([*shell, options, script], cwd=self.work, env={**os.environ, **variables},
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return job["spec"]

    def test_an_indexed_job_of_parts_and_a_merge(self):
        (self.work / "flight").mkdir()
        for file in flight.glob("*.las"):
            (self.work / "flight" / file.name).symlink_to(file)
        for index in range(2):
            spec = self.run_container("parts/parts.yaml", INDEX=str(index), COUNT="2")
        variables = {each["name"]: each.get("value") for each in
                     spec["template"]["spec"]["containers"][0]["env"]}
        self.assertEqual(int(variables["COUNT"]), spec["completions"])
        self.run_container("merge/merge.yaml")
        self.assertEqual(len(list((self.work / "parts").iterdir())), 2)
        self.assert_same_surface(self.work / "surface")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
