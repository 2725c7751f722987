"""Decoders that others wrote read our LAZ files as what we wrote. Skipped without node, npm or network.

Usage: independent_decoder_e2e_test.py NAME=PATH..., see programs.py; decoders=FOLDER keeps the decoders.
"""

import gzip
import pathlib
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "programs/query"))

import independent_decoders
import programs
from las_file import LasFile

TWINS = {"1815.laz": "1815.las", "1_4_w_evlr.laz": "1_4_w_evlr.las", "autzen_trim.laz": "autzen_trim.las.gz",
         "extrabytes.laz": "extrabytes.las", "point-color.las.laz": "point-color.las",
         "point-time.las.laz": "point-time.las", "point10.las.laz": "point10.las", "simple.laz": "simple.las"}


def records_of(path):
    return LasFile(path).records.tobytes()


class IndependentDecoderTest(programs.Test):
    @classmethod
    def setUpClass(cls):
        cls.decoders = pathlib.Path(programs.PATHS["decoders"])
        try:
            independent_decoders.fetch(cls.decoders)
        except independent_decoders.Unavailable as reason:
            raise unittest.SkipTest(str(reason)) from None

    def busy(self, point_format, extra_bytes, points, mode="busy"):
        path = self.folder / f"{point_format} {extra_bytes} {points} {mode}.las"
        subprocess.run([programs.PATHS["busy_file"], path, *map(str, (point_format, extra_bytes, points)), mode],
                       check=True)
        return path

    def compressed(self, las, *flags):
        laz = las.with_name("".join((las.stem, *map(str, flags), ".laz")))
        return programs.laz_copy(las, laz, *flags)

    def check(self, pairs, decoders=independent_decoders.PACKAGES):
        """Each (LAZ file, records) pair, by each decoder."""
        for decoder in decoders:
            answers = independent_decoders.decode(self.decoders, decoder, [laz for laz, _ in pairs], self.folder)
            for (laz, expected), answer in zip(pairs, answers):
                with self.subTest(decoder=decoder, file=laz.name):
                    self.assertNotIn("error", answer)
                    self.assertEqual(len(answer["records"]), len(expected))
                    self.assertTrue(answer["records"] == expected)

    def test_decoders_read_samples_as_their_twins(self):
        samples = pathlib.Path(programs.PATHS["laz_samples"])
        if not samples.exists():
            self.skipTest(f"{samples} does not exist")
        pairs = []
        for laz, twin in TWINS.items():
            twin = samples / twin
            if twin.suffix == ".gz":
                plain = self.folder / twin.stem
                plain.write_bytes(gzip.decompress(twin.read_bytes()))
                twin = plain
            pairs.append((samples / laz, records_of(twin)))
        self.check(pairs)

    def test_busy_points_of_all_formats_and_extra_bytes(self):
        """laz-rs 0.5.2 cannot read extra bytes of formats 6 to 8 where the scanner channel changes."""
        for decoder in independent_decoders.PACKAGES:
            pairs = []
            for point_format in independent_decoders.FORMATS:
                for extra_bytes in (0, 1, 4, 27):
                    is_layered = point_format >= 6 and extra_bytes > 0
                    mode = "calm" if decoder == "laz-rs" and is_layered else "busy"
                    las = self.busy(point_format, extra_bytes, 5000, mode)
                    pairs.append((self.compressed(las), records_of(las)))
            self.check(pairs, [decoder])

    def test_several_chunks(self):
        pairs = []
        for point_format in independent_decoders.FORMATS:
            for mode, extra_bytes in (("busy", 0), ("calm", 4)):
                las = self.busy(point_format, extra_bytes, 50001, mode)
                pairs.append((self.compressed(las), records_of(las)))
                las = self.busy(point_format, extra_bytes, 3001, mode)
                pairs.append((self.compressed(las, "--chunk-size", 1000), records_of(las)))
        self.check(pairs)

    def test_chunks_of_many_sizes(self):
        """laz-rs 0.5.2 cannot read such files."""
        pairs = []
        for point_format in independent_decoders.FORMATS:
            las = self.busy(point_format, 0, 70000)
            pairs.append((self.compressed(las, "--chunk-size", "variable"), records_of(las)))
        self.check(pairs, ["laz-perf"])

    def test_output_of_the_program(self):
        pairs = []
        for version, point_format, extra_bytes in ((2, 1, 0), (2, 3, 5), (4, 6, 6), (4, 7, 0), (4, 8, 1)):
            source = programs.make_flight(self.folder / "flight.las", version, point_format, extra_bytes)
            las, laz = (self.folder / f"out{point_format}.{kind}" for kind in ("las", "laz"))
            for target in (las, laz):
                programs.query("las", source, target, "--table", self.table, "--details",
                               "--classes", 26 if point_format < 6 else 40, *programs.FLAGS, check=0)
            pairs.append((laz, records_of(las)))
        self.check(pairs)


if __name__ == "__main__":
    programs.main()
