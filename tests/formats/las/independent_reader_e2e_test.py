"""laspy reads our copies of LAS 1.5 and of files with several Extra Bytes records. Skipped where PyPI is not reached.

Usage: independent_reader_e2e_test.py NAME=PATH..., see programs.py; laspy=FOLDER keeps it.
"""

import pathlib
import shutil
import struct
import subprocess
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "programs/query"))

import programs  # noqa: E402
from las_file import LasFile  # noqa: E402
from python_packages import interpreter  # noqa: E402
from reported_survey import annotate  # noqa: E402
from simulated_survey import SimulatedSurvey  # noqa: E402

PACKAGES = ("laspy==2.7.0", "lazrs==0.8.2")
READ = """
import sys, laspy, numpy
las = laspy.read(sys.argv[1])
names = list(las.point_format.extra_dimension_names)
fields = {"x": "x", "y": "y", "z": "z", "gps_time": "gps_time", "classes": "classification"}
numpy.savez(sys.argv[2], version=str(las.header.version), names=names,
            **{name: numpy.array(las[field]) for name, field in fields.items()},
            **{"extra " + name: numpy.array(las[name]) for name in names})
"""


def as_las15(source, target, offset, flag=True):
    """A LAS 1.4 file as LAS 1.5 whose times have this offset, 10^6 s."""
    las = LasFile(source)
    assert las.version_minor == 4 and las.header_size == 375 and las.evlr_count == 0
    times = las.field(22, "<f8") + (1e9 - 1e6 * offset if flag else 0)
    records = las.records.copy()
    records[:, 22:30] = times.astype("<f8").view(np.uint8).reshape(-1, 8)
    header = bytearray(las.bytes[:375])
    header += struct.pack("<ddH", times.max(), times.min(), offset if flag else 0)
    header[25] = 5
    header[6] |= 0x41 if flag else 0x01
    struct.pack_into("<HI", header, 94, len(header), las.offset_to_points + 18)
    target.write_bytes(bytes(header) + las.bytes[375:las.offset_to_points] + records.tobytes()
                       + las.bytes[las.end_of_points:])
    return times


def extra_bytes_vlr(names):
    data = b"".join(struct.pack("<HBB32s", 0, 9, 0, name.encode()).ljust(192, b"\0") for name in names)
    return struct.pack("<H16sHH32s", 0, b"LASF_Spec", 4, len(data), b"made by a test") + data


def with_records(source, target, lists, values):
    """The LAS file with floats in extra bytes, and an Extra Bytes record for each list of names."""
    las = LasFile(source)
    vlrs = b"".join(extra_bytes_vlr(names) for names in lists)
    header = bytearray(las.bytes[:las.header_size])
    struct.pack_into("<II", header, 96, las.offset_to_points + len(vlrs), las.vlr_count + len(lists))
    struct.pack_into("<H", header, 105, las.record_length + 4 * values.shape[1])
    records = np.hstack([las.records, values.astype("<f4").view(np.uint8).reshape(len(values), -1)])
    target.write_bytes(bytes(header) + las.bytes[las.header_size:las.end_of_vlrs] + vlrs
                       + las.bytes[las.end_of_vlrs:las.offset_to_points] + records.tobytes())


class IndependentReader(programs.Test):
    @classmethod
    def setUpClass(cls):
        cls.python = interpreter(programs.PATHS["laspy"], PACKAGES, "laspy, lazrs")

    def setUp(self):
        super().setUp()
        self.survey = SimulatedSurvey(self.folder / "flight", "--lines", 1, "--cross-lines", 0, "--seconds", 4,
                                      "--pulse-rate", 1000)

    def annotated(self, make, suffix=".las"):
        """The copy of the file that `make` writes, beside the trajectory of the flight."""
        flight, output = self.folder / "changed", self.folder / "annotated"
        for folder in (flight, output):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
        for path in self.survey.folder.iterdir():
            if path.suffix == ".out":
                shutil.copy(path, flight)
        made = make(flight / "flight.las")
        if suffix == ".laz":
            programs.laz_copy(flight / "flight.las", flight / "flight.laz")
            (flight / "flight.las").unlink()
        annotate(flight, output, self.table)
        return made, output / f"flight{suffix}"

    def read(self, path):
        subprocess.run([self.python, "-c", READ, path, self.folder / "read.npz"], check=True)
        with np.load(self.folder / "read.npz") as arrays:
            return dict(arrays)

    def test_of_las_15(self):
        _, path = self.annotated(lambda target: shutil.copy(self.survey.las, target))
        right = self.read(path)
        self.assertEqual(right["version"], "1.4")
        self.assertGreater((right["extra total_tvu"] > 0).sum(), 1000)
        for offset, flag in ((1000, True), (1400, True), (1500, True), (0, True), (0, False)):
            for suffix in (".las", ".laz"):
                with self.subTest(offset=offset, flag=flag, suffix=suffix):
                    times, path = self.annotated(lambda target, o=offset, f=flag:
                                                 as_las15(self.survey.las, target, o, f), suffix)
                    found = self.read(path)
                    self.assertEqual(found["version"], "1.5")
                    np.testing.assert_array_equal(found["gps_time"], times)
                    for name in ("x", "y", "z", "classes"):
                        np.testing.assert_array_equal(found[name], right[name])
                    data = path.read_bytes()
                    self.assertEqual(struct.unpack_from("<H", data, 94), (393,))
                    self.assertEqual(struct.unpack_from("<ddH", data, 375),
                                     (times.max(), times.min(), offset if flag else 0))
                    # Times have steps of 2.4e-7 s at most, in which the aircraft moves by 0.02 mm.
                    for name in ("total_thu", "total_tvu", "incidence"):
                        np.testing.assert_allclose(found[f"extra {name}"], right[f"extra {name}"], rtol=1e-4)

    def test_of_several_extra_bytes_records(self):
        count = LasFile(self.survey.las).point_count
        values = np.random.default_rng(1).normal(size=(count, 3)).astype(np.float32)
        for lists in ((["a", "b", "c"],), (["a"], ["b", "c"]), (["a"], ["b"], ["c"]), (["a", "b"], ["a", "b", "c"]),
                      (["a", "b", "c"], ["a", "b", "c"])):
            for suffix in (".las", ".laz"):
                with self.subTest(lists=lists, suffix=suffix):
                    _, path = self.annotated(lambda target, of=lists:
                                             with_records(self.survey.las, target, of, values), suffix)
                    found = self.read(path)
                    self.assertEqual(list(found["names"][:5]), ["a", "b", "c", "total_thu", "total_tvu"])
                    for column, name in enumerate("abc"):
                        np.testing.assert_array_equal(found[f"extra {name}"], values[:, column])
                    self.assertGreater((found["extra total_tvu"] > 0).sum(), 1000)


if __name__ == "__main__":
    programs.main()
