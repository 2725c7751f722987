"""The Debian packages, in a bare root of their Debian, install, do the jobs of the README, upgrade and leave nothing.

Usage: packages_test.py SUITE SOURCE ALBTPU_SIMULATED_SURVEY    (as root; the packages are in build/packages/SUITE)
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SUITE, SOURCE, SIMULATED_SURVEY = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
sys.path.insert(0, str(SOURCE / "tests/house"))
from document_inputs import make_inputs  # noqa: E402  The surveys of the README.

PACKAGES = ("albtpu", "albtpu-generate", "libalbtpu-dev", "python3-albtpu")
FILES = {name: next((SOURCE / "build/packages" / SUITE).glob(f"{name}_*.deb")) for name in PACKAGES}
SAMPLE = SOURCE / "../shared/data/florida_topobathy_snippet.las"  # Of a real survey; optional.
MOST_SECONDS = 60  # To install, without download, on an idle machine.
# What apt and dpkg themselves write, the job and what the kernel shows.
NOT_COMPARED = re.compile(r"/(proc|sys|dev|run|tmp|job|root)(/|$)|/var/(log|cache|backups|lib/(apt|dpkg))(/|$)|"
                          r"/etc/ld.so.cache")
APT = "apt-get -qq -o Dpkg::Use-Pty=0 --yes"
PULSE = "--wind-speed 7 --incidence 12 --footprint 0.6 --depth 8"

PYTHON = """
import albtpu, importlib.metadata, sys, xarray
with albtpu.connect(sys.argv[1]) as service:
    answer = service.query(wind_speed=7, incidence=12, footprint=0.6, depth=8, coverage="p95")
print(float(answer.thu), importlib.metadata.version("albtpu"))
xarray.open_dataset("/usr/share/albtpu/tables/survey.h5")  # By the engine that the package registers.
"""


def older(package, folder):
    """The same package with a version below all others."""
    subprocess.run(["dpkg-deb", "-R", package, folder], check=True)
    control = folder / "DEBIAN/control"
    control.write_text(re.sub(r"(?m)^Version: .*", "Version: 0.0.1+deb1u0", control.read_text()))
    subprocess.run(["dpkg-deb", "-Zgzip", "-z1", "--root-owner-group", "-b", folder, folder.with_suffix(".deb")],
                   check=True, capture_output=True)
    shutil.rmtree(folder)


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="albtpu_packages_")
        cls.addClassCleanup(folder.cleanup)
        cls.root = pathlib.Path(folder.name, "root")
        bare = os.environ.get("ALBTPU_BARE_ROOT")  # A root to copy, in place of a download.
        if bare:
            cls.root.mkdir()
            subprocess.run(["tar", "-C", cls.root, "-xpf", bare], check=True)
        else:
            subprocess.run(["mmdebstrap", "--quiet", "--variant=minbase", SUITE, cls.root], check=True)
        shutil.copy("/etc/resolv.conf", cls.root / "etc/resolv.conf")
        cls.job = cls.root / "job"
        make_inputs(pathlib.Path(folder.name), SIMULATED_SURVEY)
        shutil.copytree(pathlib.Path(folder.name, "inputs"), cls.job)
        survey = re.search(r"```toml\n(# survey.toml\n.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)[1]
        (cls.job / "survey.toml").write_text(survey)
        for name, package in FILES.items():
            shutil.copy(package, cls.job)
            older(package, cls.job / f"old_{name}")
        cls.in_root(f"{APT} update")
        cls.bare = cls.files()

    @classmethod
    def in_root(cls, script, code=0):
        """Runs a script of bash in the root, in /job; returns what it prints."""
        mounts = f"mount -t proc proc {cls.root}/proc && exec chroot {cls.root} bash -euc \"$1\""
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8",
                       "DEBIAN_FRONTEND": "noninteractive"}
        result = subprocess.run(["unshare", "--mount", "--pid", "--fork", "--kill-child", "sh", "-c", mounts, "sh",
                                 f"cd /job; {script}"], env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                                text=True)
        assert result.returncode == code, f"{script}: exit code {result.returncode}\n{result.stdout}{result.stderr}"
        return result.stdout

    @classmethod
    def with_server(cls, script):
        """Runs a script of bash that finds the address of a server in $address."""
        return cls.in_root("rm -f log; albtpu-serve --listen 127.0.0.1:0 2>log& server=$!; "
                           "trap 'kill $server; wait' EXIT; "
                           "until address=$(grep -oPm1 'ready on \\K[^,]+' log); do kill -0 $server; sleep 0.1; done; "
                           f"{script}")

    @classmethod
    def files(cls):
        found = set()
        for folder, folders, names in os.walk(cls.root):
            at = "/" + os.path.relpath(folder, cls.root)
            folders[:] = [name for name in folders if not NOT_COMPARED.match(os.path.normpath(f"{at}/{name}"))]
            found.update(os.path.normpath(f"{at}/{name}").removeprefix("/.") for name in folders + names)
        return {path for path in found if not NOT_COMPARED.match(path)}

    def test_1_install_in_a_minute(self):
        self.in_root(f"{APT} --download-only install ./albtpu*.deb")
        start = time.monotonic()
        self.in_root(f"{APT} install ./albtpu*.deb")
        seconds = time.monotonic() - start
        print(f"{SUITE}: installed in {seconds:.0f} s without download, load {os.getloadavg()[0]:.0f}", flush=True)
        self.assertLess(seconds, MOST_SECONDS * max(1, os.getloadavg()[0] / os.cpu_count()))

    def test_2_annotate_and_report_a_line(self):
        printed = self.in_root("albtpu-query las --survey survey.toml line.las annotated.las 2>&1")
        self.assertIn("interpolated", printed)
        self.in_root(f"{APT} install --no-install-recommends python3-matplotlib python3-netcdf4")
        self.assertIn("IHO S-44 1b", self.in_root("albtpu-query report annotated.las --output report --s44-order 1b"))
        self.assertIn("<img", (self.job / "report/report.html").read_text())
        self.assertEqual([str(path) for path in self.root.glob("usr/share/albtpu/**/__pycache__")], [])

    @unittest.skipUnless(SAMPLE.exists(), f"{SAMPLE} is missing")
    def test_2_annotate_and_report_a_real_line(self):
        shutil.copy(SAMPLE, self.job / "real.las")
        self.in_root("albtpu-query las real.las real_annotated.las --trajectory-from-returns --classes 26 "
                     "--water-level -23.09 --sensor riegl-vq-880-g --datum-sigma 0 --wind-speed 5 --water-column none "
                     "--details")
        self.assertIn("IHO S-44", self.in_root("albtpu-query report real_annotated.las --output real_report"))

    def test_3_make_a_table(self):
        campaign = "/usr/share/albtpu/campaigns/quick.toml"
        self.assertIn("cells", self.in_root(f"albtpu-generate plan --campaign {campaign}"))

    def test_4_serve_python(self):
        self.in_root(f"{APT} install ./python3-albtpu*.deb python3-xarray")
        pulse = json.loads(self.in_root(f"albtpu-query pulse {PULSE} --json"))
        (self.job / "query.py").write_text(PYTHON)
        thu, version = self.with_server('python3 query.py "$address"').split()
        self.assertAlmostEqual(float(thu), pulse["thu"], delta=1e-5 * pulse["thu"])
        self.assertIn(f"_{version}+deb", FILES["python3-albtpu"].name.replace("~", ""))

    def test_5_serve_the_folder_of_the_unit(self):
        listed = self.in_root("ALBTPU_TABLES=/var/lib/albtpu/tables albtpu-query tables")
        self.assertIn("survey (default)", listed)

    def test_6_build_a_program_with_the_library(self):
        self.in_root(f"{APT} install --no-install-recommends ./libalbtpu-dev*.deb cmake g++ make")
        self.in_root("cmake -S /usr/share/doc/albtpu/clients/cpp -B build && cmake --build build")
        self.assertIn("INTERPOLATED", self.in_root("build/table /usr/share/albtpu/tables/survey.h5"))
        self.assertIn("thu", self.with_server('build/ask "$address"'))

    def test_7_complete_and_document_commands(self):
        for page in ("man1/albtpu-query.1", "man1/albtpu-generate.1", "man5/albtpu-survey.5", "man8/albtpu-serve.8"):
            self.assertTrue((self.root / "usr/share/man" / f"{page}.gz").exists(), page)
        self.in_root("source /usr/share/bash-completion/completions/albtpu-query; complete -p albtpu-query")

    def test_8_upgrade_and_purge_leave_nothing(self):
        purge = f"{APT} purge {' '.join(PACKAGES)}"
        self.in_root(purge)
        first = self.files()
        self.assertEqual({path for path in first - self.bare if "albtpu" in path}, set())
        self.in_root(f"{APT} install ./old_*.deb")
        self.in_root("echo '# mine' >>/etc/default/albtpu-serve")
        self.in_root(f"{APT} install {' '.join('./' + path.name for path in FILES.values())}")
        self.assertIn("# mine", self.in_root("cat /etc/default/albtpu-serve"))
        versions = self.in_root("dpkg-query -W -f '${Version}\\n' " + " ".join(PACKAGES)).split()
        self.assertEqual(versions, [path.name.split("_")[1] for path in FILES.values()])
        self.in_root("albtpu-query pulse " + PULSE)
        self.in_root(purge)
        self.assertEqual(self.files() ^ first, set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
