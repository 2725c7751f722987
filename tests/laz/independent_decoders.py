"""Decoders of LAZ files that others wrote: laz-perf (C++) and laz-rs (Rust), as WebAssembly from npm packages."""

import json
import pathlib
import shutil
import subprocess
import tarfile

HERE = pathlib.Path(__file__).resolve().parent
PACKAGES = {"laz-perf": "laz-perf@0.0.7", "laz-rs": "@loaders.gl/las@4.5.1"}  # The latter has laz-rs 0.5.2.
# Point formats that they can decode: none has wave packets.
FORMATS = (0, 1, 2, 3, 6, 7, 8)


class Unavailable(Exception):
    """Says why there are no decoders."""


def fetch(folder):
    """Gets the packages from npm into `folder`, unless they are there. Installs nothing."""
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            raise Unavailable(f"{program}, which runs laz-perf and laz-rs, is missing")
    for name, package in PACKAGES.items():
        target = folder / name
        if target.exists():
            continue
        download = folder / f"download of {name}"
        shutil.rmtree(download, ignore_errors=True)
        download.mkdir(parents=True)
        result = subprocess.run(["npm", "pack", "--silent", package, "--pack-destination", download],
                                capture_output=True, text=True, timeout=300)
        if result.returncode != 0:
            raise Unavailable(f"npm cannot get {package} (needs a network or a cache)")
        (archive,) = download.glob("*.tgz")
        with tarfile.open(archive) as file:
            file.extractall(download)
        (download / "package").rename(target)
        shutil.rmtree(download)


def decode(folder, decoder, sources, target_folder, runs=1):
    """What the decoder says of each file: {"records": bytes, "points": int, "seconds": [float]} or {"error": str}."""
    targets = [target_folder / f"{i}.records" for i in range(len(sources))]
    files = [str(path) for pair in zip(sources, targets) for path in pair]
    result = subprocess.run(["node", HERE / "independent_decoders.mjs", decoder, folder / decoder, str(runs), *files],
                            capture_output=True, text=True, timeout=600, check=True)
    answers = [json.loads(line) for line in result.stdout.splitlines()]
    for answer, target in zip(answers, targets):
        if target.exists():
            answer["records"] = target.read_bytes()
            target.unlink()
    assert len(answers) == len(sources), result.stderr
    return answers
