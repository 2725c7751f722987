"""A surface as programs of others see it: by xarray and rasterio, and the metadata of BAG by the schemas of ISO 19139
and of the format, as hyo2.bag has them. Skipped where PyPI is not reached.

Usage: surface_peers_e2e_test.py NAME=PATH..., see programs.py; peers=FOLDER keeps the packages.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import netCDF4
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "programs/query"))

import programs  # noqa: E402
import reported_survey  # noqa: E402
from programs import query  # noqa: E402
from python_packages import interpreter  # noqa: E402
from simulated_survey import SimulatedSurvey  # noqa: E402

CELL = 2
PACKAGES = ("xarray==2026.9.0", "netCDF4==1.7.5.1.post1", "rasterio==1.4.4", "lxml==6.1.3")
SCHEMA_PACKAGE = "hyo2.bag==1.2.12"  # Without what it needs itself, which is for windows and maps.
XARRAY = """
import sys, numpy, xarray
with xarray.open_dataset(sys.argv[1]) as surface:
    layers = {name: layer for name, layer in surface.data_vars.items() if layer.ndim == 2}
    assert all(layer.dims == ("y", "x") for layer in layers.values())
    row, column = numpy.argwhere(surface.points.values > 0)[7]
    place = surface.sel(x=float(surface.x[column]) + 0.3, y=float(surface.y[row]) - 0.3, method="nearest")
    numpy.savez(sys.argv[2], x=surface.x, y=surface.y, at=(row, column), there=float(place.elevation),
                wkt=surface.crs.attrs["crs_wkt"], units=surface.elevation.attrs["units"],
                **{"of " + name: layer.values for name, layer in layers.items()})
"""
RASTERIO = """
import sys, numpy, rasterio
with rasterio.open(sys.argv[1]) as raster:
    x, y = raster.xy(0, 0)
    numpy.savez(sys.argv[2], first=(x, y), epsg=str(raster.crs), names=raster.descriptions,
                **{"of " + name: raster.read(i + 1, masked=True).filled(numpy.nan)
                   for i, name in enumerate(raster.descriptions)})
"""
SCHEMAS = """
import importlib.util, pathlib, sys
from lxml import etree, isoschematron
folder = pathlib.Path(importlib.util.find_spec("hyo2").submodule_search_locations[0]) / "bag"
rules = (etree.XMLSchema(etree.parse(str(folder / "iso19139/bag/bag.xsd"))),
         isoschematron.Schematron(etree.parse(str(folder / "iso19757-3/bag_metadata_profile.sch"))))
metadata = etree.parse(sys.argv[1])
for rule in rules:
    if not rule.validate(metadata):
        sys.exit(str(rule.error_log))
lists = (folder / "iso19139/bag/bagCodelists.xml").read_text()
for code in metadata.iter("{http://www.opennavsurf.org/schema/bag}*"):
    word = code.get("codeListValue")
    if word is not None and f">{word}<" not in lists:
        sys.exit(f"{word} is in no list")
"""


def setUpModule():
    global python, annotated, made
    python = interpreter(programs.PATHS["peers"], PACKAGES, "xarray, netCDF4, rasterio, lxml, hyo2", [SCHEMA_PACKAGE])
    folder = pathlib.Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, folder)
    flight = SimulatedSurvey(folder / "flight", "--lines", 2, "--cross-lines", 1, "--seconds", 4, "--pulse-rate", 2500,
                             "--file-for-each-line").folder
    annotated, made = folder / "annotated", folder / "surface"
    reported_survey.annotate(flight, annotated, programs.PATHS["shipped_table"])
    result = query("surface", annotated, "--output", made, "--cell", CELL, "--format", "netcdf,geotiff,bag",
                   "--organisation", "Office & Sons")
    if "need GDAL" in result.stderr:
        raise unittest.SkipTest(result.stderr)
    assert result.returncode == 0, result.stderr


class Peer(programs.Test):
    def setUp(self):
        super().setUp()
        with netCDF4.Dataset(made / "surface.nc") as grid:
            self.x, self.y = grid["x"][:].data, grid["y"][:].data
            self.layers = {name: np.ma.filled(variable[:].astype(float), np.nan)
                           for name, variable in grid.variables.items() if variable.ndim == 2}

    def run_script(self, script, *arguments):
        return subprocess.run([python, "-c", script, *map(str, arguments)], capture_output=True, text=True)

    def read(self, script, path):
        values = self.folder / "values.npz"
        result = self.run_script(script, path, values)
        self.assertEqual(result.returncode, 0, result.stderr)
        return np.load(values)

    def assert_layers(self, values, names, layers=None):
        layers = layers or self.layers
        read = {name.removeprefix("of "): values[name] for name in values.files if name.startswith("of ")}
        self.assertEqual(set(read), set(names))
        for name in names:
            np.testing.assert_array_equal(read[name], layers[name], name)


class Xarray(Peer):
    def test_sees_the_nodes_by_their_places(self):
        values = self.read(XARRAY, made / "surface.nc")
        self.assert_layers(values, self.layers)
        np.testing.assert_array_equal(values["x"], self.x)
        np.testing.assert_array_equal(values["y"], self.y)
        self.assertEqual(values["there"], self.layers["elevation"][tuple(values["at"])])
        self.assertIn("WGS 84 / UTM zone 17N", str(values["wkt"]))
        self.assertEqual(str(values["units"]), "m")


class Rasterio(Peer):
    def assert_placed(self, values):
        np.testing.assert_allclose(values["first"], (self.x[0], self.y[0]), atol=1e-6)
        self.assertIn("32617", str(values["epsg"]))

    def test_sees_all_layers_of_the_geotiff(self):
        values = self.read(RASTERIO, made / "surface.tif")
        self.assert_placed(values)
        nodes = self.layers["points"] > 0  # Where there is none, counts of NetCDF are 0.
        self.assert_layers(values, set(self.layers) - {"depth", "uncertainty_1sigma", "left_out"},
                           {name: np.where(nodes, layer, np.nan) for name, layer in self.layers.items()})

    def test_sees_the_bag(self):
        values = self.read(RASTERIO, made / "surface.bag")
        self.assert_placed(values)
        self.assert_layers(values, {"elevation", "uncertainty"})


class BagMetadata(Peer):
    def metadata(self, path):
        with h5py.File(path) as file:
            return file["BAG_root/metadata"][:].tobytes().decode().rstrip("\0")

    def check(self, text):
        path = self.folder / "metadata.xml"
        path.write_text(text)
        return self.run_script(SCHEMAS, path)

    def test_obey_the_schemas(self):
        result = self.check(self.metadata(made / "surface.bag"))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_obey_the_schemas_with_a_vertical_datum_and_without_dates(self):
        folder, new = self.folder / "annotated", self.folder / "new"
        folder.mkdir()
        source = SimulatedSurvey(self.folder / "flight", "--lines", 1, "--cross-lines", 0, "--seconds", 2,
                                 "--pulse-rate", 2500, "--time", "week").las
        query("las", source, "--output-dir", folder, "--survey", annotated.with_suffix(".toml"), "--trajectory",
              source.parent / "sbet.out", "--table", programs.PATHS["shipped_table"], "--crs", "EPSG:32617+5703",
              check=0)
        query("surface", folder, "--output", new, "--cell", CELL, "--format", "bag", check=0)
        text = self.metadata(new / "surface.bag")
        self.assertIn("NAVD88", text)
        self.assertNotIn("gmd:temporalElement", text)
        result = self.check(text)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_with_a_fault_do_not(self):
        text = self.metadata(made / "surface.bag")
        for what, faulty in (("no citation", re.sub(r"<gmd:citation>.*?</gmd:citation>", "", text, flags=re.DOTALL)),
                             ("no number", re.sub(r"<gco:Integer>\d+", "<gco:Integer>x", text)),
                             ("no grid", text.replace('"grid"', '"vector"')),
                             ("no word of a list", text.replace("productUncert", "anything"))):
            with self.subTest(what):
                self.assertNotEqual(faulty, text)
                self.assertNotEqual(self.check(faulty).returncode, 0)


if __name__ == "__main__":
    programs.main()
