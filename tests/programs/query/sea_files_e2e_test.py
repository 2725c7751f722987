"""albtpu-query sea: what files of the sea have, their tables, damaged files, and real ones."""

import datetime
import json
import math

import programs
import sea_states
from programs import query
from sea_states import FLIGHT_START, SAMPLES, WAVES, numbers, pulse, utc


class SeaFilesTest(sea_states.Test):
    def test_the_command_sea(self):
        series = self.sea_csv((FLIGHT_START, 1, 200), (FLIGHT_START + 3600, 2, 200))
        flags = ("--wind-speed", 6, "--wind-from", 250)
        seas = json.loads(query("sea", series, *flags, "--json", check=0).stdout)
        self.assertEqual([record["time"] for record in seas["records"]],
                         [utc(FLIGHT_START), utc(FLIGHT_START + 3600)])
        for record in seas["records"]:
            self.assertLess(record["mean_square_slope_below_11"], record["mean_square_slope_below_20"])
            self.assertLess(record["mean_square_slope_below_20"], record["mean_square_slope"])
            variances = [footprint["slope_variance"] for footprint in record["footprints"]]
            self.assertEqual(variances, sorted(variances, reverse=True))
            self.assertEqual([footprint["footprint"] for footprint in record["footprints"]], [0.2, 0.6, 1, 2, 5])
            tails = record["refraction_along_by_tail"]
            self.assertLess(tails["none"], min(tails["relax"], tails["wind"], tails["level"]))
            self.assertEqual(tails["relax"], record["footprints"][1]["refraction_along"])
            # V at nadir is 2 (1 - 1/n) in each direction, in the limit of small slopes.
            footprint = record["footprints"][1]
            squares = math.radians(math.hypot(footprint["refraction_along"], footprint["refraction_cross"])) ** 2
            self.assertAlmostEqual(squares / (4 * (1 - 1 / 1.34) ** 2 * footprint["slope_variance"]), 1, delta=0.1)
            for beam in record["correlation"]:
                cells = beam["cells"]
                self.assertEqual([cell["side"] for cell in cells], [0.5, 1, 2, 5, 10])
                for name in ("slope_along", "slope_across", "horizontal", "vertical", "height"):
                    shares = [cell[name] for cell in cells]
                    self.assertEqual(shares, sorted(shares, reverse=True))
                    self.assertTrue(0 < shares[-1] and shares[0] < 1, shares)
                    self.assertTrue(all(abs(pair[name]) < 1 for pair in beam["lags"]))
            # The depth at nadir has errors of second order alone.
            nadir, slanted = record["correlation"]
            self.assertEqual((nadir["incidence"], slanted["incidence"]), (0, 20))
            self.assertLess(nadir["cells"][1]["vertical"], slanted["cells"][1]["vertical"])
        self.assertAlmostEqual(seas["records"][1]["hs"] / seas["records"][0]["hs"], math.sqrt(2), places=6)
        text = query("sea", series, *flags, check=0).stdout
        self.assertIn(utc(FLIGHT_START + 3600), text)

    def test_the_table_of_a_sea_can_be_kept(self):
        table = self.folder / "kept.h5"
        query("sea", *WAVES, "--output", table, check=0)
        kept = pulse("--table", table, "--wind-speed", 1, "--azimuth", 30)
        self.assertEqual(numbers(kept), numbers(pulse(*WAVES, "--azimuth", 30)))
        self.assert_fails(query("sea", *WAVES, "--output", table), 1, "exists")
        query("sea", *WAVES, "--output", table, "--overwrite", check=0)
        series = self.sea_csv((FLIGHT_START, 1, 200), (FLIGHT_START + 3600, 2, 200))
        for flags in ((), ("--sea-time", utc(FLIGHT_START + 60))):
            self.assert_fails(query("sea", series, *flags, "--output", self.folder / "two.h5"), 2, "--sea-time")
        query("sea", series, "--sea-time", utc(FLIGHT_START), "--output", self.folder / "two.h5", check=0)
        self.assert_fails(query("sea"), 2, "no waves are given")


class SampleTest(programs.Test):
    def sample(self, name):
        path = SAMPLES / name
        if not path.exists():
            self.skipTest(f"there is no sample {name} beside the checkout")
        return path

    def seas(self, path, *flags):
        return json.loads(query("sea", path, "--json", *flags, check=0).stdout)["records"]

    def test_heights_of_a_buoy_are_those_that_it_states(self):
        stated = {}
        for line in self.sample("41010.spec").read_text().splitlines():
            words = line.split()
            if not line.startswith("#"):
                stated[datetime.datetime(*map(int, words[:4]), tzinfo=datetime.timezone.utc)] = float(words[5])
        errors = []
        for sea in self.seas(self.sample("41010.data_spec"), "--sea-depth", 870):
            time = datetime.datetime.strptime(sea["time"] + "+0000", "%Y-%m-%dT%H:%MZ%z")
            height = stated.get(time.replace(minute=0))
            if height is not None:
                errors.append(sea["hs"] - height)
        self.assertGreater(len(errors), 100)
        self.assertLess(math.sqrt(sum(error ** 2 for error in errors) / len(errors)), 0.05)

    def test_files_of_other_kinds_are_seas(self):
        for name, flags in (("41010w2019part.txt.gz", ()), ("41010.spec", ()), ("ww3station.spec", ()),
                            ("swanfile.spec", ())):
            with self.subTest(name=name):
                for sea in self.seas(self.sample(name), *flags):
                    self.assertTrue(0 < sea["hs"] < 15)
                    self.assertTrue(0 < sea["mean_square_slope"] < 0.2)


if __name__ == "__main__":
    programs.main()
