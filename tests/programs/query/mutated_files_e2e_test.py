"""Random changes of headers, flags, clocks and georeferences of sound files give the numbers of the sound ones, with a
note where a number of the header was of use, or a refusal."""

import math
import os
import random
import re

import programs
from false_file import (BOUNDS, CREATION, GLOBAL_ENCODING, OFFSET, OVERLAP, SCALE, SYNTHETIC, WITHHELD, FalseFiles,
                        Points, geo_keys)
from las_file import LasFile
from programs import query

MUTATIONS = 2000 if os.environ.get("ALBTPU_EVERY_CASE") else 300


class Mutations(FalseFiles):
    """Random changes of header, flags, clocks and georeference of sound files: as the sound one, with a note where a
    number of the header was of use, or refused. None differs in silence."""

    def mutate(self, draw):
        points = Points(self.sound)
        kind = draw.choice(["bounds", "flags", "times", "encoding", "text", "keys", "scale", "offset", "wkt", "class"])
        chosen = draw.sample(range(points.count), draw.randint(1, 60))
        touched = set()
        if kind == "bounds":
            points.put("<d", BOUNDS + 8 * draw.randrange(6), draw.choice([0, -1e9, 1e9, math.nan, draw.gauss(0, 1e6)]))
        elif kind == "flags":
            points.flag(chosen, draw.choice([WITHHELD, SYNTHETIC, OVERLAP, 2, WITHHELD | SYNTHETIC]))
            touched = set(chosen)
        elif kind == "times":
            for i in chosen:
                points.put("<d", points.at(i, 22), draw.choice([0, math.nan, -math.inf, 1e300, draw.gauss(0, 1e9)]))
            touched = set(chosen)
        elif kind == "encoding":
            points.put("<H", GLOBAL_ENCODING, points.get("<H", GLOBAL_ENCODING)[0] ^ draw.choice([1, 4, 8, 16]))
        elif kind == "text":
            points.data[26:90] = bytes(draw.randrange(256) for _ in range(64))
            points.put("<2H", CREATION, draw.randrange(400), draw.randrange(3000))
        elif kind == "keys":
            points.insert_vlr(b"LASF_Projection", 34735, geo_keys(
                (3072, draw.choice([26917, 32617, 26918, 2236, 4326, 0, 32767])),
                (draw.choice([3076, 4099]), draw.choice([9001, 9002, 9003])), (4096, draw.choice([5703, 6360, 0]))))
        elif kind == "scale":
            axis = draw.randrange(3)
            points.put("<d", SCALE + 8 * axis, points.get("<3d", SCALE)[axis] * draw.choice([0.3048, 3.28084, -1, 10]))
        elif kind == "offset":
            axis = draw.randrange(3)
            points.put("<d", OFFSET + 8 * axis, points.get("<3d", OFFSET)[axis] + draw.choice([-1e3, 25, 1e5, 60]))
        elif kind == "wkt":
            at = bytes(points.data).find(b"UTM zone")
            old, new = draw.choice([(b'"central_meridian",-81', b'"central_meridian",-75'),
                                    (b'UNIT["metre",1', b'UNIT["metre",3'), (b"PROJCS", b"PROJXX"),
                                    (b"500000", b"400000")])
            points.data = bytearray(bytes(points.data).replace(old, new))
            self.assertGreater(at, 0)
        else:
            for i in chosen:
                points.data[points.at(i, 16)] = draw.choice([0, 7, 18])
            touched = set(chosen)
        return kind, bytes(points.data), touched

    def test_none_differs_in_silence(self):
        draw = random.Random(36)
        _, expected = self.annotated(self.sound, *self.flags())
        source, target = self.folder / "mutants", self.folder / "out"
        source.mkdir()
        target.mkdir()
        mutants = {}
        for i in range(MUTATIONS):
            kind, data, touched = self.mutate(draw)
            mutants[f"{i:04d}.las"] = kind, touched
            (source / f"{i:04d}.las").write_bytes(data)
        result = query("las", source, "--output-dir", target, *self.flags())
        same = noted = refused = 0
        for name, (kind, touched) in mutants.items():
            with self.subTest(name=name, kind=kind):
                if not (target / name).exists():
                    self.assertRegex(result.stderr, rf"(?m)^albtpu-query: \S*{name}: ")
                    refused += 1
                    continue
                self.assert_same(LasFile(target / name).columns(), expected, touched)
                printed = re.search(rf"(?s)albtpu-query: \S*/out/{name}:\n(.*?)(?=\nalbtpu-query: |\Z)",
                                    result.stderr)[1]
                if kind == "bounds":
                    self.assertIn("bounds", printed)
                noted += "header" in printed or "withheld" in printed or "synthetic" in printed
                same += 1
        print(f"{MUTATIONS} mutants: {same} as the sound file, {noted} of them noted; {refused} refused")
        self.assertGreater(same, MUTATIONS / 4)
        self.assertGreater(refused, MUTATIONS / 20)


if __name__ == "__main__":
    programs.main()
