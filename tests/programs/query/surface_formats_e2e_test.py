"""albtpu-query surface as GeoTIFF and BAG, opened by GDAL's own tools, by HDF5 and as XML."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

import h5py
import netCDF4
import numpy as np

import programs
import reported_survey
from programs import query
from simulated_survey import SimulatedSurvey

CELL = 2
EPSG = "32617"
UPWARDS = re.compile(r'CS\[vertical,1\],\s*AXIS\["[^"]*",up,\s*LENGTHUNIT\["metre",1')
MISSING = [name for name in ("gdalinfo", "gdallocationinfo") if not shutil.which(name)]
NAMESPACES = {"gmi": "http://www.isotc211.org/2005/gmi", "gmd": "http://www.isotc211.org/2005/gmd",
              "gco": "http://www.isotc211.org/2005/gco", "gml": "http://www.opengis.net/gml/3.2",
              "bag": "http://www.opennavsurf.org/schema/bag"}
# The members of the BAG profile that its library requires (api/bag_metadatatypes.h of the Open Navigation Surface).
REQUIRED = """gmd:fileIdentifier gmd:language gmd:characterSet gmd:hierarchyLevel gmd:contact//gmd:organisationName
gmd:contact//gmd:role gmd:dateStamp/gco:Date gmd:metadataStandardName gmd:metadataStandardVersion
gmd:spatialRepresentationInfo//gmd:dimensionSize gmd:spatialRepresentationInfo//gmd:resolution/gco:Measure
gmd:spatialRepresentationInfo//gmd:cellGeometry gmd:spatialRepresentationInfo//gmd:transformationParameterAvailability
gmd:spatialRepresentationInfo//gmd:checkPointAvailability gmd:spatialRepresentationInfo//gml:coordinates
gmd:referenceSystemInfo//gmd:code gmd:referenceSystemInfo//gmd:codeSpace
gmd:identificationInfo//gmd:citation//gmd:title gmd:identificationInfo//gmd:citation//gmd:date//gco:Date
gmd:identificationInfo//gmd:abstract gmd:identificationInfo//gmd:language gmd:identificationInfo//gmd:characterSet
gmd:identificationInfo//gmd:topicCategory gmd:identificationInfo//gmd:westBoundLongitude
gmd:identificationInfo//bag:verticalUncertaintyType gmd:dataQualityInfo//gmd:scope
gmd:dataQualityInfo//bag:BAG_ProcessStep/gmd:description gmd:dataQualityInfo//bag:trackingId
gmd:dataQualityInfo//gmd:source//gmd:description gmd:metadataConstraints//gmd:useConstraints
gmd:metadataConstraints//gmd:classification gmd:metadataConstraints//gmd:userNote""".split()


def setUpModule():
    global flight, annotated, made
    folder = pathlib.Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, folder)
    flight = SimulatedSurvey(folder / "flight", "--lines", 2, "--cross-lines", 1, "--seconds", 4, "--pulse-rate", 2500,
                             "--file-for-each-line", "--range-noise", 0.02).folder
    annotated, made = folder / "annotated", folder / "surface"
    reported_survey.annotate(flight, annotated, programs.PATHS["shipped_table"])
    result = query("surface", annotated, "--output", made, "--cell", CELL, "--format", "netcdf,geotiff,bag",
                   "--organisation", "Office & Sons", environment={"SOURCE_DATE_EPOCH": "1700000000"})
    if "need GDAL" in result.stderr:
        raise unittest.SkipTest(result.stderr)
    assert result.returncode == 0, result.stderr


def output_of(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


class Raster(programs.Test):
    def setUp(self):
        super().setUp()
        self.grid = netCDF4.Dataset(made / "surface.nc")
        self.addCleanup(self.grid.close)
        self.x, self.y = self.grid["x"][:].data, self.grid["y"][:].data

    def values(self, name):
        """Of a layer, NaN where there is no node."""
        return np.where(self.grid["points"][:].data > 0, self.grid[name][:].astype(float).filled(np.nan), np.nan)

    def nodes(self, count):
        """Rows and columns of some nodes."""
        places = np.argwhere(np.isfinite(self.values("elevation")))
        return places[:: max(len(places) // count, 1)]

    @unittest.skipIf(MISSING, f"{', '.join(MISSING)} missing; apt-get install gdal-bin")
    def assert_has_nodes_at_points(self, path, bands):
        """A point anywhere in the cell of a node, up to 1 mm from its sides, has the values of the node."""
        values = [self.values(band) for band in bands]
        places, expected = [], []
        for row, column in self.nodes(6):
            for side in (CELL / 2 - 1e-3, 0, 1e-3 - CELL / 2):
                places.append(f"{self.x[column] + side} {self.y[row] - side}\n")
                expected += [layer[row, column] for layer in values]
        self.assertGreaterEqual(len(places), 18)
        found = subprocess.run(["gdallocationinfo", "-valonly", "-geoloc", path], input="".join(places), check=True,
                               capture_output=True, text=True).stdout
        np.testing.assert_allclose([float(value) for value in found.split()], expected, rtol=1e-6)

    def assert_placed(self, info):
        west, step, _, north, _, down = info["geoTransform"]
        np.testing.assert_allclose([west + step / 2, north + down / 2], [self.x[0], self.y[0]], atol=1e-3)
        np.testing.assert_allclose([west + step * (len(self.x) - 0.5), north + down * (len(self.y) - 0.5)],
                                   [self.x[-1], self.y[-1]], atol=1e-3)
        self.assertEqual(info["size"], [len(self.x), len(self.y)])
        self.assertIn(f'ID["EPSG",{EPSG}]', info["coordinateSystem"]["wkt"])


class GeoTiff(Raster):
    @unittest.skipIf(MISSING, f"{', '.join(MISSING)} missing; apt-get install gdal-bin")
    def test_says_what_it_is(self):
        info = json.loads(output_of("gdalinfo", "-json", made / "surface.tif"))
        self.assert_placed(info)
        self.assertEqual(info["metadata"]["IMAGE_STRUCTURE"]["LAYOUT"], "COG")
        self.assertEqual([band["description"] for band in info["bands"][:2]], ["elevation", "uncertainty"])
        self.assertEqual({band["noDataValue"] for band in info["bands"]}, {"NaN"})
        self.assertEqual(info["bands"][0]["unit"], "m")
        said = info["metadata"][""]["TIFFTAG_IMAGEDESCRIPTION"]
        for part in ("95 %", "1 sigma", "Neighbouring pulses share waves", "Chart datum of Mine", "albtpu-query"):
            self.assertIn(part, said)
            self.assertIn(part, self.grid.comment)

    def test_has_the_nodes_where_points_lie(self):
        info = json.loads(output_of("gdalinfo", "-json", made / "surface.tif"))
        self.assert_has_nodes_at_points(made / "surface.tif", [band["description"] for band in info["bands"]])

    def test_has_all_values_of_all_layers(self):
        """By the bindings of the system's Python, in a process of their own: they bring a HDF5 of their own, too."""
        script = ("import sys, numpy; from osgeo import gdal; f = gdal.Open(sys.argv[1]);"
                  "numpy.savez(sys.argv[2], **{f.GetRasterBand(i).GetDescription(): f.GetRasterBand(i).ReadAsArray()"
                  " for i in range(1, f.RasterCount + 1)})")
        result = subprocess.run([sys.executable, "-c", script, made / "surface.tif", self.folder / "bands.npz"],
                                capture_output=True, text=True)
        if "No module named 'osgeo'" in result.stderr:
            self.skipTest("python3-gdal is missing")
        self.assertEqual(result.returncode, 0, result.stderr)
        bands = np.load(self.folder / "bands.npz")
        layers = set(self.grid.variables) - {"crs", "x", "y", "depth", "uncertainty_1sigma", "left_out"}
        self.assertEqual(set(bands), layers)
        for name in layers:
            np.testing.assert_array_equal(bands[name], self.values(name), name)


class Bag(Raster):
    def setUp(self):
        super().setUp()
        self.file = h5py.File(made / "surface.bag")
        self.addCleanup(self.file.close)
        self.root = self.file["BAG_root"]
        self.text = self.root["metadata"][:].tobytes().decode().rstrip("\0")
        self.metadata = xml.fromstring(self.text)

    def find(self, path):
        return self.metadata.find(path, NAMESPACES)

    def said(self, path):
        return "".join(self.find(path).itertext()).strip()

    def test_has_the_datasets_and_attributes_of_the_format(self):
        self.assertEqual(self.root.attrs["Bag Version"], b"2.0.1")
        self.assertLessEqual({"elevation", "uncertainty", "metadata", "tracking_list"}, set(self.root))
        self.assertEqual(self.root["tracking_list"].attrs["Tracking List Length"], 0)
        for name in ("elevation", "uncertainty"):
            values, expected = self.root[name][:][::-1], self.values(name)  # Rows begin in the south.
            self.assertEqual(values.dtype, np.float32)
            np.testing.assert_array_equal(np.where(values == 1e6, np.nan, values), expected)
            for what, of in (("Minimum", np.nanmin), ("Maximum", np.nanmax)):
                self.assertAlmostEqual(self.root[name].attrs[f"{what} {name.capitalize()} Value"], of(expected), 5)
        self.assertTrue((self.root["uncertainty"][:] > 0).all())

    def test_has_the_metadata_of_the_profile(self):
        self.assertEqual(self.metadata.tag, f"{{{NAMESPACES['gmi']}}}MI_Metadata")
        self.assertNotIn("${", self.text)
        for path in REQUIRED:
            with self.subTest(path):
                self.assertTrue(self.said(path))
        self.assertEqual(len(self.metadata.findall("gmd:referenceSystemInfo", NAMESPACES)), 2)
        self.assertEqual(self.said(".//bag:verticalUncertaintyType"), "productUncert")
        self.assertIn("1.96 standard deviations", self.said(".//gmd:abstract"))
        self.assertEqual(self.said("gmd:contact//gmd:organisationName"), "Office & Sons")
        self.assertEqual(self.said("gmd:dateStamp"), "2023-11-14")

    def test_has_elevations_upwards_in_metres_of_a_datum_that_is_not_stated(self):
        codes = self.metadata.findall("gmd:referenceSystemInfo//gmd:code", NAMESPACES)
        self.assertEqual("".join(codes[1].itertext()).strip(),
                         'VERT_CS["unknown",VERT_DATUM["unknown",2000],UNIT["metre",1],AXIS["Up",UP]]')

    def test_states_the_places_of_its_first_and_last_nodes(self):
        corners = [[float(each) for each in corner.split(",")] for corner in self.said(".//gml:coordinates").split()]
        np.testing.assert_allclose(corners, [[self.x[0], self.y[-1]], [self.x[-1], self.y[0]]], atol=1e-3)

    def test_states_when_the_survey_was_flown(self):
        surveyed = json.loads((made / "surface.json").read_text())["surveyed"]
        if surveyed is None:
            self.assertIsNone(self.find(".//gmd:temporalElement"))
        else:
            self.assertEqual(self.said(".//gml:beginPosition"), surveyed["first"])

    @unittest.skipIf(MISSING, f"{', '.join(MISSING)} missing; apt-get install gdal-bin")
    def test_is_opened_by_gdal(self):
        info = json.loads(output_of("gdalinfo", "-json", made / "surface.bag"))
        self.assert_placed(info)
        self.assertRegex(info["coordinateSystem"]["wkt"], UPWARDS)

    def test_has_the_nodes_where_points_lie(self):
        self.assert_has_nodes_at_points(made / "surface.bag", ["elevation", "uncertainty"])


class VerticalDatum(programs.Test):
    def test_is_in_all_formats_where_it_is_stated(self):
        folder = self.folder / "annotated"
        folder.mkdir()
        file = sorted(flight.glob("*.las"))[0]
        query("las", file, "--output-dir", folder, "--survey", annotated.with_suffix(".toml"), "--table",
              programs.PATHS["shipped_table"], "--crs", f"EPSG:{EPSG}+5703", check=0)
        new = self.folder / "new"
        query("surface", folder, "--output", new, "--cell", CELL, "--format", "netcdf,geotiff,bag", check=0)
        self.assertEqual(json.loads((new / "surface.json").read_text())["vertical_crs"], "NAVD88 height")
        with netCDF4.Dataset(new / "surface.nc") as grid:
            self.assertIn("vertical datum: NAVD88 height", grid.comment)
            self.assertTrue(grid["crs"].vertical_crs_wkt.startswith('VERT_CS["NAVD88 height"'))
        if MISSING:
            self.skipTest(f"{', '.join(MISSING)} missing; apt-get install gdal-bin")
        for name in ("surface.tif", "surface.bag"):
            wkt = json.loads(output_of("gdalinfo", "-json", new / name))["coordinateSystem"]["wkt"]
            self.assertIn(f'ID["EPSG",{EPSG}]', wkt)
            self.assertIn('VERTCRS["NAVD88 height"', wkt)
            self.assertRegex(wkt, UPWARDS)

    def test_is_in_metres_where_heights_are_in_feet(self):
        if MISSING:
            self.skipTest(f"{', '.join(MISSING)} missing; apt-get install gdal-bin")
        feet, folder, new = self.folder / "flight", self.folder / "feet", self.folder / "new"
        SimulatedSurvey(feet, "--lines", 2, "--seconds", 2, "--pulse-rate", 1000, "--grid", "florida-east-ft")
        reported_survey.annotate(feet, folder, programs.PATHS["shipped_table"])
        for datum in (b"North American Vertical Datum 1988", b"Vertical Datum that has no code 88"):
            for path in folder.glob("*.las"):
                path.write_bytes(path.read_bytes().replace(b"North American Vertical Datum 1988", datum))
            said = query("surface", folder, "--output", new, "--format", "geotiff", "--overwrite", check=0).stderr
            wkt = json.loads(output_of("gdalinfo", "-json", new / "surface.tif"))["coordinateSystem"]["wkt"]
            self.assertIn('ID["EPSG",2236]', wkt)
            if datum.startswith(b"North"):
                self.assertRegex(wkt, r'VERTCRS\["NAVD88 height"[^"]*(?s:.*)ID\["EPSG",5703\]')
                self.assertRegex(wkt, UPWARDS)
                self.assertNotIn("surface.tif", said)
            else:
                # GDAL 3.10 keeps such a system, and 3.6 does not.
                self.assertEqual("surface.tif: GDAL keeps no vertical system without a code, as Vertical Datum that has"
                                 " no code 88 height is" in said, 'VERTCRS["Vertical Datum that has no code' not in wkt)


class Formats(programs.Test):
    def test_are_written_alone(self):
        query("surface", annotated, "--output", self.folder / "new", "--cell", CELL, "--format", "geotiff", check=0)
        self.assertEqual(sorted(path.name for path in (self.folder / "new").iterdir()), ["surface.json", "surface.tif"])
        self.assertEqual((self.folder / "new/surface.tif").read_bytes(), (made / "surface.tif").read_bytes())
        query("surface", annotated, "--output", self.folder / "new", "--overwrite", check=0)  # None of the earlier one.
        self.assertEqual(sorted(path.name for path in (self.folder / "new").iterdir()), ["surface.json", "surface.nc"])

    def test_of_other_names_are_refused(self):
        self.assert_fails(query("surface", annotated, "--output", self.folder / "new", "--format", "netcdf,tiff"), 2,
                          "netcdf, geotiff, bag")
        self.assertFalse((self.folder / "new").exists())

    def assert_leaves_nothing(self, room, *command):
        """On a file system of so many bytes, where the command is to write `new`."""
        disk = self.folder / "disk"
        disk.mkdir(exist_ok=True)
        script = ('mount -t tmpfs -o size="$1" tmpfs "$2" || exit 99; disk="$2"; shift 2; "$@" --output "$disk/new"; '
                  'code=$?; find "$disk" >&3; exit $code')
        with open(self.folder / "left", "w") as left:
            result = subprocess.run(["unshare", "--mount", "bash", "-c", script, "bash", str(room // 4096 * 4096), disk,
                                     programs.PATHS["query"], *map(str, command)], capture_output=True, text=True,
                                    preexec_fn=lambda: os.dup2(left.fileno(), 3), pass_fds=(3,))
        if result.returncode == 99 or "unshare" in result.stderr:
            self.skipTest("no file system of a given size can be mounted")
        self.assert_fails(result, 1, "cannot be written")
        self.assertEqual((self.folder / "left").read_text(), f"{disk}\n")

    def test_leave_nothing_on_a_full_disk(self):
        part = self.folder / "all.part"
        query("surface", annotated, "--partial", part, "--cell", CELL, check=0)
        for name in ("geotiff", "bag"):
            file = made / {"geotiff": "surface.tif", "bag": "surface.bag"}[name]
            for share in (0.2, 0.9):
                room = (made / "surface.nc").stat().st_size + int(share * file.stat().st_size)
                self.assert_leaves_nothing(room, "surface", "merge", part, "--format", name)
        for room in (4096, 12288, 20480, 32768, 61440):
            self.assert_leaves_nothing(room, "surface", "merge", part)
            self.assert_leaves_nothing(room, "report", annotated, "--no-page")


if __name__ == "__main__":
    programs.main()
