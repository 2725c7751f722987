"""Packages of PyPI that a test takes as peers: in an environment of their own, which is kept."""

import pathlib
import shutil
import subprocess
import sys
import unittest


def interpreter(folder, packages, modules, without_others=()):
    """The interpreter of the environment in `folder`, where the modules can be imported. The packages `without_others`
    come without those that they need. Skips where PyPI is not reached."""
    folder = pathlib.Path(folder)
    python = folder / "bin/python"
    try:
        if subprocess.run([python, "-c", f"import {modules}"], capture_output=True).returncode == 0:
            return python
    except FileNotFoundError:
        pass
    shutil.rmtree(folder, ignore_errors=True)
    install = [python, "-m", "pip", "install", "-q"]
    commands = [[sys.executable, "-m", "venv", folder], [*install, *packages]]
    if without_others:
        commands.append([*install, "--no-deps", *without_others])
    for command in commands:
        made = subprocess.run(command, capture_output=True, text=True, timeout=600)
        if made.returncode != 0:
            raise unittest.SkipTest(f"{packages[0]} cannot be installed: {made.stderr.strip()[-200:]}")
    return python
