"""LASzip and lazrs read our LAZ files as what we wrote, and we read theirs. Skipped where PyPI is not reached.

Usage: laszip_e2e_test.py NAME=PATH..., see programs.py; laspy=FOLDER keeps laspy, which calls both.
"""

import itertools
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "programs/query"))

import programs  # noqa: E402
from las_file import LasFile  # noqa: E402
from python_packages import interpreter  # noqa: E402

PACKAGES = ("laspy==2.7.0", "lazrs==0.8.2", "laszip==0.3.0")
FORMATS = range(11)
# Arguments: the name of a codec, then pairs of a LAS file and a LAZ file to write, or of a LAZ file and the records to
# write.
CONVERT = """
import sys, laspy
codec = getattr(laspy.LazBackend, sys.argv[1])
for source, target in zip(sys.argv[2::2], sys.argv[3::2]):
    with laspy.open(source, laz_backend=codec) as reader:
        points = reader.read().points
        if target.endswith(".laz"):
            with laspy.open(target, mode="w", header=reader.header, laz_backend=codec) as writer:
                writer.write_points(points)
        else:
            with open(target, "wb") as file:
                file.write(points.array.tobytes())
"""


def records_of(path):
    return LasFile(path).records.tobytes()


class LaszipTest(programs.Test):
    @classmethod
    def setUpClass(cls):
        cls.python = interpreter(programs.PATHS["laspy"], PACKAGES, "laspy, lazrs, laszip")

    def convert(self, codec, pairs):
        subprocess.run([self.python, "-c", CONVERT, codec, *itertools.chain.from_iterable(pairs)], check=True)

    def busy(self, point_format, extra_bytes, points):
        path = self.folder / f"{point_format} {extra_bytes} {points}.las"
        subprocess.run([programs.PATHS["busy_file"], path, *map(str, (point_format, extra_bytes, points)), "busy"],
                       check=True)
        return path

    def compressed(self, las, *flags):
        return programs.laz_copy(las, las.with_name(" ".join((las.stem, *map(str, flags))) + ".laz"), *flags)

    def assert_read(self, files):
        """Both codecs find the records of each LAS file in the LAZ file that we made of it."""
        for codec in ("Laszip", "Lazrs"):
            self.convert(codec, [(laz, laz.with_suffix(".records")) for _, laz in files])
            for las, laz in files:
                with self.subTest(codec=codec, file=laz.name):
                    self.assertTrue(laz.with_suffix(".records").read_bytes() == records_of(las))

    def test_read_all_formats_and_extra_bytes(self):
        lases = [self.busy(number, extra, 5000) for number in FORMATS for extra in (0, 1, 4, 27)]
        self.assert_read([(las, self.compressed(las)) for las in lases])

    def test_read_chunks_of_many_sizes(self):
        lases = [self.busy(number, 4, 60_000) for number in (1, 3, 5, 6, 8, 10)]
        self.assert_read([(las, self.compressed(las, "--chunk-size", size))
                          for las in lases for size in (1000, 50_000, "variable")])

    def test_read_what_the_program_writes(self):
        files = []
        for version, point_format, extra_bytes in ((2, 1, 0), (2, 3, 5), (4, 6, 6), (4, 7, 0), (4, 8, 1)):
            source = programs.make_flight(self.folder / "flight.las", version, point_format, extra_bytes)
            las, laz = (self.folder / f"out{point_format}.{kind}" for kind in ("las", "laz"))
            for target in (las, laz):
                programs.query("las", source, target, "--table", self.table, "--details",
                               "--classes", 26 if point_format < 6 else 40, *programs.FLAGS, check=0)
            files.append((las, laz))
        self.assert_read(files)

    def test_write_what_we_read(self):
        """What lazrs 0.8.2 writes of wave packets, LASzip does not read either."""
        for codec, formats in (("Laszip", FORMATS), ("Lazrs", (0, 1, 2, 3, 6, 7, 8))):
            lases = [self.busy(number, extra, 60_000) for number in formats for extra in (0, 5)]
            self.convert(codec, [(las, las.with_suffix(".laz")) for las in lases])
            for las in lases:
                with self.subTest(codec=codec, file=las.name):
                    again = programs.laz_copy(las.with_suffix(".laz"), self.folder / "again.las")
                    self.assertTrue(records_of(again) == records_of(las))


if __name__ == "__main__":
    programs.main()
