"""albtpu-query trajectory, from outside: sound files are shown, others are refused by name."""

import json
import math
import pathlib
import struct

import programs
from programs import query

COURSE, SPEED, RATE = math.radians(344.4), 56.5, 50
NORTH, EAST = SPEED * math.cos(COURSE), SPEED * math.sin(COURSE)
START = 313200  # s of the week: Wednesday 15:00
RADIUS = 6378137  # m


def positions(count):
    """Time since the start, latitude and longitude [rad] of a straight flight over a sphere."""
    for i in range(count):
        t = i / RATE
        latitude = math.radians(25.1)
        yield t, latitude + NORTH * t / RADIUS, math.radians(-80.6) + EAST * t / (RADIUS * math.cos(latitude))


def sbet(count=1000, gap=(5, 7.5)):
    wander = 0.3
    vx = NORTH * math.cos(wander) - EAST * math.sin(wander)
    vy = -(NORTH * math.sin(wander) + EAST * math.cos(wander))
    return b"".join(struct.pack("<17d", START + t, lat, lon, 400 + t, vx, vy, 1, 0.01, 0.02, COURSE + wander, wander,
                                0, 0, -9.8, 0, 0, 0)
                    for t, lat, lon in positions(count) if not gap[0] < t < gap[1])


def smrmsg(count=20):
    return b"".join(struct.pack("<10d", START + i, .02, .03, .05, .01, .01, .01, .6, .6, 3) for i in range(count))


def ascii_text(count=1000, start=146968200):
    return "".join(f"{start + t:.6f} {math.degrees(lon):.9f} {math.degrees(lat):.9f} {5e5 + EAST * t:.3f} "
                   f"{3e6 + NORTH * t:.3f} 400 1 2 344 .02 .03 .05 .01 .01 .05\n"
                   for t, lat, lon in positions(count)).encode()


class Trajectory(programs.Test):
    def file(self, name, data):
        (self.folder / name).write_bytes(data)
        return self.folder / name

    def json_of(self, *arguments, code=0):
        return json.loads(query("trajectory", *arguments, "--json", check=code).stdout)["files"]

    def test_shows_an_sbet(self):
        shown, = self.json_of(self.file("a.out", sbet()))
        self.assertEqual((shown["error"], shown["format"], shown["records"]), (None, "SBET", 876))
        self.assertEqual((shown["start"], shown["start_utc"], shown["gaps"]), (START, None, 1))
        self.assertAlmostEqual(shown["end"], START + 19.98, delta=1e-6)
        self.assertAlmostEqual(shown["rate"], RATE, delta=1e-6)
        self.assertAlmostEqual(shown["longest_gap"], 2.5, delta=1e-6)
        self.assertAlmostEqual(shown["longest_gap_start"], START + 5, delta=1e-6)
        self.assertEqual(shown["least_height"], 400)
        self.assertAlmostEqual(shown["greatest_height"], 419.98, delta=1e-6)
        # A sphere for the ellipsoid: within 0.7 % of the speed.
        self.assertAlmostEqual(shown["speed"], SPEED, delta=0.007 * SPEED)
        self.assertLess(shown["velocity_difference"], 0.007 * SPEED)
        self.assertIsNone(shown["sigma_north"])

    def test_of_few_records_has_their_rate(self):
        data, size = sbet(gap=(0, 0)), 17 * 8
        thinned = b"".join(data[at * size:(at + 1) * size] for at in range(0, len(data) // size, 25))
        shown, = self.json_of(self.file("a.out", thinned))
        self.assertAlmostEqual(shown["rate"], 2, delta=1e-6)

    def test_shows_an_smrmsg(self):
        shown, = self.json_of(self.file("a.out", smrmsg()))
        self.assertEqual((shown["format"], shown["records"], shown["gaps"], shown["rate"]), ("SMRMSG", 20, 0, 1))
        self.assertEqual([shown["sigma_north"], shown["sigma_east"], shown["sigma_down"]], [.02, .03, .05])
        self.assertAlmostEqual(shown["sigma_heading"], 0.05, delta=1e-15)
        self.assertIsNone(shown["speed"])

    def test_shows_an_ascii_trajectory_with_its_date(self):
        shown, = self.json_of(self.file("a.txt", ascii_text()))
        self.assertEqual((shown["format"], shown["records"]), ("ASCII", 1000))
        self.assertEqual(shown["start_utc"], "2016-05-11T02:16:23Z")  # 1146968200 s since 1980-01-06, minus 17 s
        self.assertIsNone(shown["velocity_difference"])

    def test_prints_text_for_people(self):
        text = query("trajectory", self.file("a.out", sbet()), self.file("b.out", smrmsg()), check=0).stdout
        self.assertIn("(Wednesday 15:00:00)", text)
        self.assertIn("1 above 0.2 s, the longest of 2.500 s from 313205.000 s", text)
        self.assertIn("velocity check passed", text)
        self.assertIn("format         SMRMSG", text)

    def test_shows_sound_files_beside_refused_ones(self):
        flight = self.folder / "flight"
        flight.mkdir()
        for name, data in (("a.out", sbet()), ("b.out", sbet()[:1000]), ("c.out", b""),
                           ("d.txt", ascii_text().replace(b" 25.1", b" 95.1"))):
            self.file(f"flight/{name}", data)
        files = self.json_of(flight, code=1)
        self.assertEqual([pathlib.Path(shown["file"]).name for shown in files], ["a.out", "b.out", "c.out", "d.txt"])
        self.assertEqual([shown["error"] is None for shown in files], [True, False, False, False])
        self.assertIn("not a multiple of 136", files[1]["error"])
        self.assertIn("is empty", files[2]["error"])
        self.assertIn("line 1, column 3 'latitude'", files[3]["error"])
        result = query("trajectory", flight, check=1)
        self.assertIn("format         SBET", result.stdout)
        self.assertEqual(len(result.stderr.splitlines()), 3)


if __name__ == "__main__":
    programs.main()
