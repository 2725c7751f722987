"""Random changes of headers, flags, clocks and georeferences of sound files give the numbers of the sound ones, with a
note where a number of the header was of use, or a refusal."""

import json
import math
import os
import random
import re

import programs
from false_file import (BOUNDS, CREATION, FLIGHT, GLOBAL_ENCODING, OFFSET, OVERLAP, SCALE, SYNTHETIC, WITHHELD,
                        FalseFiles, Points, geo_keys)
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

MUTATIONS = 2000 if os.environ.get("ALBTPU_EVERY_CASE") else 200
# Sound files: scanner, coordinate system, version and format, clock, georeference and density differ.
SOUND = ((), ("--las-version", 2, "--point-format", 1),
         ("--grid", "florida-east-ft"), ("--grid", "geographic"),
         ("--las-version", 4, "--point-format", 7, "--grid", "utm16n", "--altitude", 600),
         ("--las-version", 3, "--point-format", 3, "--grid", "utm18n", "--origin", "37,-75.5"),
         ("--time", "week"), ("--geotiff-keys", "--las-version", 2, "--point-format", 1, "--time", "week"),
         ("--wave-height", 0.5, "--file-for-each-line", "--shuffle"),
         ("--course", 40, "--week", 2200, "--scale", 0.01))


class Mutations(FalseFiles):
    """Random changes of header, flags, clocks and georeference of sound files: as the sound one, with a note where a
    number of the header was of use, or refused. None differs in silence."""

    def mutate(self, sound, draw):
        """Another file: the kind of its change, its bytes and the points that the change concerns."""
        points = Points(sound)
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
                points.put("<d", points.at(i, points.time), draw.choice([0, math.nan, -math.inf, 1e300,
                                                                         draw.gauss(0, 1e9)]))
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
        elif kind == "wkt":  # In files that have one.
            old, new = draw.choice([(rb'"central_meridian",-8\d', b'"central_meridian",-75'),
                                    (rb'UNIT\["metre",1', b'UNIT["metre",3'), (b"PROJCS", b"PROJXX"),
                                    (b"500000", b"400000")])
            points.data = bytearray(re.sub(old, new, bytes(points.data)))
        else:
            for i in chosen:
                points.classify(i, draw.choice([0, 7, 18]))
            touched = set(chosen)
        return kind, bytes(points.data), touched

    def test_none_differs_in_silence(self):
        draw = random.Random(36)
        same = noted = refused = 0
        for number, flags in enumerate(SOUND):
            with self.subTest(flags=flags):
                self.survey = SimulatedSurvey(self.folder / f"flight{number}", *FLIGHT, *flags)
                sound = self.survey.las.read_bytes()
                _, expected = self.annotated(sound, *self.flags())
                self.assertIsNotNone(expected)
                found = self.check(number, sound, expected, draw)
                same, noted, refused = same + found[0], noted + found[1], refused + found[2]
        print(f"{MUTATIONS} mutants of {len(SOUND)} files: {same} as the sound file, {noted} of them noted; "
              f"{refused} refused")
        self.assertGreater(same, MUTATIONS / 4)
        self.assertGreater(refused, MUTATIONS / 20)

    def check(self, number, sound, expected, draw):
        """How many mutants of a sound file gave its numbers, how many of these with a note, and how many failed."""
        source, target = self.folder / f"mutants{number}", self.folder / f"out{number}"
        source.mkdir()
        target.mkdir()
        mutants = {}
        for i in range(MUTATIONS // len(SOUND)):
            kind, data, touched = self.mutate(sound, draw)
            mutants[f"{i:04d}.las"] = kind, data == sound, touched
            (source / f"{i:04d}.las").write_bytes(data)
        result = query("las", source, "--output-dir", target, *self.flags())
        same = noted = refused = 0
        for name, (kind, unchanged, touched) in mutants.items():
            with self.subTest(number=number, name=name, kind=kind):
                if not (target / name).exists():
                    self.assertFalse(unchanged)
                    self.assertRegex(result.stderr, rf"(?m)^albtpu-query: \S*{name}: ")
                    refused += 1
                    continue
                self.assert_same(LasFile(target / name).columns(), expected, touched)
                summary = json.loads((target / f"{name}.json").read_text())
                printed = "\n".join(summary["input"].get("notes", []))
                if kind == "bounds":
                    self.assertIn("bounds", printed)
                noted += "header" in printed or "withheld" in printed or "synthetic" in printed
                same += 1
        return same, noted, refused


if __name__ == "__main__":
    programs.main()
