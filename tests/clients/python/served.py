"""An albtpu-serve with a synthetic table, for tests whose first arguments are ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import albtpu
from serving import Server

SERVE, SYNTHETIC_TABLE = sys.argv[1:3]


def make_table(path, *flags):
    subprocess.run([SYNTHETIC_TABLE, path, *flags], check=True)


class Served(unittest.TestCase):
    FLAGS = ()

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.make_tables()
        cls.server = Server(SERVE, "--tables", cls.folder, *cls.FLAGS)
        cls.addClassCleanup(cls.server.__exit__)
        cls.service = albtpu.connect(cls.server.address)
        cls.addClassCleanup(cls.service.close)

    @classmethod
    def make_tables(cls):
        make_table(cls.folder / "synthetic.h5")
