"""Servers of synthetic tables, for tests whose first arguments are ALBTPU_SERVE ALBTPU_SYNTHETIC_TABLE."""

import subprocess
import sys
import unittest

import numpy as np

import albtpu
from albtpu.v1 import uncertainty_service_pb2 as pb
from albtpu.v1.uncertainty_service_pb2_grpc import UncertaintyServiceStub
from commands import FolderTest, make_folder, run
from serving import Server, connect

SERVE, SYNTHETIC_TABLE = sys.argv[1:3]


def make_table(path, *flags):
    path.parent.mkdir(exist_ok=True)
    subprocess.run([SYNTHETIC_TABLE, path, *flags], check=True)


def columns(depths, **options):
    """A query of pulses that differ in their depth."""
    pulses = dict(wind_speed=5, incidence=10, footprint=1, depth=depths)
    return pb.QueryColumnsRequest(options=options, pulses={
        name: np.array(values, "<f4").tobytes() for name, values in pulses.items()})


def budget(depths, quantities=(), **options):
    """A query of the budget of the same pulses."""
    aircraft = dict(altitude=np.float32(400).tobytes(), beam_azimuth=np.float32(90).tobytes())
    return pb.QueryBudgetRequest(options=dict(located="SURFACE_LOCATION_LEVEL", **options), quantities=quantities,
                                 pulses=columns(depths).pulses, aircraft=aircraft)


class TablesTest(FolderTest):
    """A test with a folder of tables, of which `quick` is one, and with servers of them, which end with the test."""

    def setUp(self):
        super().setUp()
        self.tables = self.folder / "tables"
        make_table(self.tables / "quick.h5")

    def serve(self, *flags, **options):
        server = Server(SERVE, "--tables", self.tables, *flags, **options)
        self.addCleanup(server.__exit__)
        return server

    def stub_of(self, server):
        self.channel = connect(server.address)
        self.addCleanup(self.channel.close)
        return UncertaintyServiceStub(self.channel)

    def assert_does_not_start(self, code, parts, *flags):
        """The server ends with one line with all `parts`. It has the tables and a free port unless flags say other."""
        given = [flag for flag in ("--tables", "--listen") if flag not in flags]
        usual = {"--tables": self.tables, "--listen": "127.0.0.1:0"}
        self.assert_refused(run(SERVE, *(word for flag in given for word in (flag, usual[flag])), *flags), code, *parts)


class Served(unittest.TestCase):
    """Tests that share a server, and a connection to it."""

    FLAGS = ()

    @classmethod
    def setUpClass(cls):
        cls.folder = make_folder(cls.addClassCleanup)
        cls.make_tables()
        cls.server = Server(SERVE, "--tables", cls.folder, *cls.FLAGS)
        cls.addClassCleanup(cls.server.__exit__)
        cls.service = albtpu.connect(cls.server.address)
        cls.addClassCleanup(cls.service.close)

    @classmethod
    def make_tables(cls):
        make_table(cls.folder / "synthetic.h5")
