"""The archive and the wheel of packaging/portable.sh run on bare Debian 12 and 13, read-only and from any folder.

Usage: portable_test.py ARCHIVE WHEEL SIMULATED_SURVEY ROOTS [TEST...]

Needs root and mmdebstrap, which makes the Debians in the folder ROOTS. What needs PyPI is skipped where PyPI cannot be
reached.
"""

import json
import pathlib
import re
import secrets
import shlex
import signal
import subprocess
import sys
import tempfile
import unittest

from authority import Authority
from commands import run
from serving import Server

ARCHIVE, WHEEL, SIMULATED_SURVEY, ROOTS = map(pathlib.Path, sys.argv[1:5])
VERSION = re.search(r"albtpu-(.+)-linux-", ARCHIVE.name)[1]
PLACE = pathlib.Path("/tmp/über uns")  # In each root, a folder with a space and an umlaut.
FIRST, SECOND = PLACE / "albtpu 1", PLACE / "albtpu 2"
PULSE = ("--wind-speed", "6", "--incidence", "12.5", "--azimuth", "0", "--footprint", "0.7", "--depth", "5")
LAS = ("las", "/data/flight.las", "--overwrite", "--trajectory", "/data/sbet.out", "--lever-arm", "0.3,-0.2,0.5",
       "--sensor", "riegl-vq-880-g", "--water-classes", "41", "--water-level", "-25", "--wind-speed", "5",
       "--wind-from", "250", "--water-column", "none", "--datum-sigma", "0", "--coverage", "p95", "--details")
# What other software may have set; none of it is for these programs.
HOSTILE = {"PROJ_DATA": "/data/other", "PROJ_LIB": "/data/other", "LD_LIBRARY_PATH": "/data/other"}
PATIENCE = 1800  # s; downloads and installations on a loaded machine
EXTRAS = "client,tables,datasets,report,progress"
QUERY = """import sys, albtpu, numpy, xarray
with albtpu.connect(sys.argv[1]) as service:
    answer = service.query(wind_speed=6, incidence=12.5, footprint=0.7, depth=[2, 8, 99])
    budget = service.query_budget(wind_speed=5, incidence=20, azimuth=30, footprint=0.5, depth=[2, 8], sea_axis=70,
                                  altitude=400, beam_azimuth=118, located="level", datum=0.08)
    sea = service.query(sea=albtpu.Sea.jonswap(hs=0.4, tp=3, waves_from=225), incidence=12, azimuth=0, footprint=0.5,
                        depth=8)
file = albtpu.open_table(sys.argv[2]).query(wind_speed=6, incidence=12.5, footprint=0.7, depth=[2, 8, 99])
numpy.testing.assert_allclose(file.thu, answer.thu, rtol=1e-5)
print(*answer.outcome, *budget.outcome, sea.outcome)
print(xarray.open_dataset(sys.argv[2]).thu.attrs["units"], answer.to_xarray().sizes["pulse"])
"""
WITHOUT_EXTRAS = """import albtpu
for name in ("connect", "open_table"):
    try:
        getattr(albtpu, name)
    except ImportError as error:
        print(error)
"""


class Root:
    """A bare Debian; each command has mounts of its own, which end with it."""

    def __init__(self, suite, mounts):
        self.folder = ROOTS.resolve() / suite
        self.mounts = mounts
        if not self.folder.exists():
            new = self.folder.with_suffix(".new")
            subprocess.run(["rm", "-rf", new], check=True)
            # python3-venv for the wheel; what the programs need is to be in the archive.
            subprocess.run(["mmdebstrap", "--quiet", "--variant=minbase", "--include=python3-venv", suite, new],
                           check=True)
            new.rename(self.folder)

    def command(self, network=True, environment=(), mounts=()):
        lines = ["mount -t proc proc proc"]
        for source, target, options in (*self.mounts, *mounts):
            inside = shlex.quote(f".{target}")
            if pathlib.Path(source).is_dir():
                lines.append(f"mkdir -p {inside}")
            else:
                lines.append(f"mkdir -p {shlex.quote(f'.{target.parent}')} && touch {inside}")
            lines.append(f"mount --bind {shlex.quote(str(source))} {inside}")
            lines.append(f"mount -o remount,bind,{options} {inside}")
        if not network:
            lines.append("ip link set lo up")
        variables = [f"{name}={value}" for name, value in {"HOME": "/tmp", "PATH": "/usr/bin", "LANG": "C.UTF-8",
                                                          **dict(environment)}.items()]
        return ("unshare", "--mount", *([] if network else ["--net"]), "bash", "-euc",
                f"cd {shlex.quote(str(self.folder))}; {'; '.join(lines)}; exec chroot . \"$@\"", "bash",
                "env", "-i", "-C", "/tmp", *variables)

    def run(self, *command, **options):
        result = run(*self.command(**options), *command, timeout=PATIENCE)
        assert result.returncode == 0, f"{command}: {result.stdout}{result.stderr}"
        return result.stdout


class Portable:
    """The tests of one Debian, which a class below names."""

    @classmethod
    def setUpClass(cls):
        cls.output = cls.folder / cls.suite
        cls.output.mkdir()
        mounts = [(cls.folder / name, place, "ro") for name, place in (("1", FIRST), ("2", SECOND))]
        mounts += [(cls.folder / "data", pathlib.Path("/data"), "ro"), (cls.output, pathlib.Path("/out"), "rw")]
        cls.root = Root(cls.suite, mounts)

    def annotate(self, program, name, **options):
        """The bytes of the simulated survey with its uncertainty."""
        self.root.run(program, LAS[0], LAS[1], f"/out/{name}", *LAS[2:], **options)
        return (self.output / name).read_bytes()

    def download(self, name, *requirements):
        """The folder of the newest wheels of PyPI for the Python of this Debian."""
        folder = self.output / name
        result = run(sys.executable, "-m", "pip", "download", "--quiet", "--only-binary=:all:", "--dest", folder,
                     "--python-version", self.python, *requirements, timeout=PATIENCE)
        if "No matching distribution" in result.stderr:
            self.skipTest(f"PyPI cannot be reached: {result.stderr.splitlines()[-1]}")
        self.assertEqual(result.returncode, 0, result.stderr)
        return folder

    def install(self, name, requirement, wheels):
        """The bin/ of a virtual environment, installed without a network."""
        environment = PLACE / name
        mounts = ((wheels, pathlib.Path("/wheels"), "ro"), (WHEEL.resolve(), pathlib.Path("/dist", WHEEL.name), "ro"))
        self.root.run("python3", "-m", "venv", "--clear", environment)
        pip = (environment / "bin/python", "-m", "pip")
        self.root.run(*pip, "install", "--quiet", "--no-index", "--find-links", "/wheels", "--find-links", "/dist",
                      requirement, network=False, mounts=mounts)
        self.assertIn("No broken requirements", self.root.run(*pip, "check"))
        return environment / "bin"

    def test_programs_run_read_only_whatever_the_environment_names(self):
        for name in ("albtpu-query", "albtpu-serve", "albtpu-generate"):
            self.assertIn(f"{name} {VERSION}\n", self.root.run(FIRST / "bin" / name, "--version", network=False))
        points = self.annotate(FIRST / "bin/albtpu-query", "first.las", network=False)
        self.assertEqual(self.annotate(FIRST / "bin/albtpu-query", "hostile.las", environment=HOSTILE), points)
        self.assertEqual(self.annotated.setdefault("points", points), points, "another Debian has other bytes")
        report = self.root.run(FIRST / "bin/albtpu-query", "report", "/out/first.las", "--output", "/out/report",
                               "--no-page", "--s44-order", "1b", network=False)
        self.assertIn("IHO S-44 1b: THU and TVU are within the limits", report)
        self.assertTrue((self.output / "report/grid.nc").stat().st_size)  # NetCDF, without what it would download by.
        self.root.run(FIRST / "bin/albtpu-generate", "plan", "--campaign", FIRST / "share/albtpu/campaigns/quick.toml")

    def test_two_versions_beside_each_other_load_their_own_libraries(self):
        expected = self.root.run(FIRST / "bin/albtpu-query", "pulse", *PULSE)
        for place in (FIRST, SECOND):
            with Server(place / "bin/albtpu-serve", prefix=self.root.command()) as server:
                maps = pathlib.Path(f"/proc/{server.process.pid}/maps").read_text()
                loaded = set(re.findall(r"(/[^\n]*)/([^/\n]*\.so[.\d]*)$", maps, re.MULTILINE))
                own = {name for folder, name in loaded if folder.endswith(f"/{place.name}/lib")}
                self.assertLessEqual({"libjemalloc.so.2", "libgrpc.so.29"}, own)
                system = {name for _, name in loaded} - own
                self.assertLessEqual({re.sub(r"[.-].*", "", name) for name in system},
                                     {"ld", "libc", "libm", "libgcc_s", "libstdc++"}, system)
                asked = self.root.run(place / "bin/albtpu-query", "pulse", *PULSE, "--server", server.address)
                self.assertEqual(asked, expected)
                self.assertEqual(server.stop(signal.SIGTERM), 0)

    def test_trusts_the_certificates_of_the_system(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.output))
        authority = Authority(folder, "authority")
        certificate, key = authority.issue("server")
        token = folder / "token"
        token.write_text(secrets.token_hex(32))
        inside = {path: pathlib.Path("/out", path.relative_to(self.output)) for path in (certificate, key, token)}
        known = ((authority.certificate, pathlib.Path("/etc/ssl/certs/ca-certificates.crt"), "ro"),)
        with Server(FIRST / "bin/albtpu-serve", "--tls-cert", inside[certificate], "--tls-key", inside[key],
                    "--token-file", inside[token], prefix=self.root.command()) as server:
            query = (FIRST / "bin/albtpu-query", "health", "--server", server.address, "--token-file", inside[token])
            self.assertEqual(self.root.run(*query, mounts=known), "SERVING\n")
            with self.assertRaisesRegex(AssertionError, "albtpu-query: "):
                self.root.run(*query)

    def test_wheel_brings_the_programs_with_nothing_but_numpy(self):
        binaries = self.install("numpy only", "albtpu", self.download("numpy", "numpy"))
        messages = self.root.run(binaries / "python", "-c", WITHOUT_EXTRAS, network=False).splitlines()
        self.assertEqual([message.split("; ")[-1] for message in messages],
                         ["pip install 'albtpu[client]'", "pip install 'albtpu[tables]'"])
        points = self.annotate(binaries / "albtpu-query", "wheel.las", network=False)
        self.assertEqual(points, self.annotate(FIRST / "bin/albtpu-query", "archive.las"))

    def test_wheel_works_with_the_newest_packages_of_pypi(self):
        wheels = self.download("newest", f"albtpu[{EXTRAS}] @ {WHEEL.resolve().as_uri()}")
        binaries = self.install("newest", f"albtpu[{EXTRAS}]", wheels)
        table = FIRST / "share/albtpu/tables/survey.h5"
        with Server(binaries / "albtpu-serve", prefix=self.root.command()) as server:
            outcomes, opened = self.root.run(binaries / "python", "-c", QUERY, server.address, table).splitlines()
        self.assertEqual(outcomes, "INTERPOLATED INTERPOLATED OUT_OF_DOMAIN:depth:above" + 3 * " INTERPOLATED")
        self.assertEqual(opened, "m 3")
        self.annotate(binaries / "albtpu-query", "newest.las")
        self.root.run(binaries / "albtpu-query", "report", "/out/newest.las", "--output", "/out/page")
        self.assertIn("</html>", (self.output / "page/report.html").read_text())
        versions = self.root.run(binaries / "python", "-m", "pip", "list", "--format", "json")
        print(self.suite, *(f"{each['name']} {each['version']}" for each in json.loads(versions)), sep="; ", flush=True)


class Debian12(Portable, unittest.TestCase):
    suite, python = "bookworm", "3.11"

    def test_auditwheel_states_the_platform(self):
        folder = self.download("auditwheel", "auditwheel")
        run(sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--find-links", folder, "--target",
            folder / "site", "auditwheel")
        shown = run(sys.executable, "-m", "auditwheel", "show", WHEEL, timeout=PATIENCE,
                    environment={"PYTHONPATH": str(folder / "site")})
        self.assertRegex(" ".join(shown.stdout.split()),
                         f'{WHEEL.name} is consistent with the following platform tag: "manylinux_2_3[0-6]_x86_64"')


class Debian13(Portable, unittest.TestCase):
    suite, python = "trixie", "3.13"


def setUpModule():
    temporary = tempfile.TemporaryDirectory(prefix="albtpu portable ")
    unittest.addModuleCleanup(temporary.cleanup)
    Portable.folder, Portable.annotated = pathlib.Path(temporary.name), {}
    for name in ("1", "2"):
        place = Portable.folder / name
        place.mkdir()
        subprocess.run(["tar", "--extract", "--strip-components=1", f"--file={ARCHIVE}", f"--directory={place}"],
                       check=True)
    data = Portable.folder / "data"
    (data / "other").mkdir(parents=True)
    for name in ("libproj.so.25", "libz.so.1", "proj.db"):  # Neither a library nor a database.
        (data / "other" / name).touch()
    subprocess.run([SIMULATED_SURVEY, data, "--seconds", "2"], check=True, stdout=subprocess.DEVNULL)
    ROOTS.mkdir(parents=True, exist_ok=True)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]], verbosity=2)
