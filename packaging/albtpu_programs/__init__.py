"""The programs of albtpu as pip installs them. Each function is one of pip's scripts, and becomes the program.

The folder holds the tree of the relocatable archive: bin/, lib/ and share/. It is no part of the package `albtpu`,
whose import would delay the programs.
"""

import os
import sys
from typing import NoReturn


def _become(name: str) -> NoReturn:
    # The report's page is drawn by Python, with the packages of pip.
    os.environ.setdefault("ALBTPU_PYTHON", sys.executable)
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", name)
    os.execv(program, [name, *sys.argv[1:]])


def query() -> NoReturn:
    _become("albtpu-query")


def serve() -> NoReturn:
    _become("albtpu-serve")
