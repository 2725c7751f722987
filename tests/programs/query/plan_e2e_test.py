"""albtpu-query plan, from outside: its depths against those of single pulses, its page, bad inputs."""

import json
import re
import shutil
import unittest

import programs
from page_probe import probe
from programs import query

SENSOR = ("--sensor", "riegl-vq-880-g", "--datum-sigma", 0.08)
DRY = (*SENSOR, "--water-column", "none")
ORDERS = ("exclusive", "special", "1a", "1b", "2")
WATER = """
[sensor]
name = "riegl-vq-880-g"
[datum]
sigma = 0.08
[water]
kd = 0.12
kd_kind = "diffuse532"
detector = "peak"
field_of_view = 3
pulse_length = 1.5
bias = "none"
"""


class Plan(programs.Test):
    def plan(self, *arguments):
        result = query("plan", "--table", self.table, "--json", *arguments, check=0)
        return json.loads(result.stdout)

    def order_of_pulse(self, wind, depth, altitude, incidence):
        pulse = json.loads(query("pulse", "--table", self.table, *DRY, "--surface-located", "local", "--wind-speed",
                                 wind, "--depth", depth, "--altitude", altitude, "--incidence", incidence, "--coverage",
                                 "p95", "--json", check=0).stdout)
        return pulse["s44_order_met"] if pulse["outcome"] == "INTERPOLATED" else None

    def test_depths_are_those_of_single_pulses(self):
        plan = self.plan(*DRY, "--order", "special", "--winds", "2,6,10", "--altitudes", "300,500", "--incidences",
                         "10,20")
        altitude = next(axis for axis in plan["axes"] if axis["name"] == "altitude")
        checked = 0
        for row, value in enumerate(altitude["values"]):
            for column, wind in enumerate(plan["seas"]):
                depth = altitude["depth"]["special"][row][column]
                met = [self.order_of_pulse(wind, each, value, plan["conditions"]["incidence"])
                       for each in (max(depth, 0.25), depth + 0.25)]
                if depth > 0:
                    self.assertIn(met[0], ORDERS[:2])
                if altitude["limited_by"]["special"][row][column] in ("thu", "tvu"):
                    self.assertNotIn(met[1], ORDERS[:2])
                    self.assertIsNotNone(met[1])
                    checked += 1
                else:
                    self.assertIsNone(met[1])
        self.assertGreater(checked, 2)
        # The planned conditions lie on the axes.
        incidence = next(axis for axis in plan["axes"] if axis["name"] == "incidence")
        for order in ORDERS:
            self.assertEqual(incidence["depth"][order][1], [each["depth"][order] for each in plan["planned"]])

    def test_less_wind_and_a_weaker_order_reach_deeper(self):
        plan = self.plan(*DRY, "--order", "special")
        for each in plan["planned"]:
            depths = [each["depth"][order] for order in ORDERS]
            self.assertEqual(depths, sorted(depths))
        # The table begins at a footprint of 0.25 m, that of a divergence of 1 mrad from 235 m at 20 degrees.
        self.assertEqual(set(plan["axes"][0]["depth"]["special"][0]), {None})
        for axis in plan["axes"]:
            for depths in axis["depth"]["special"]:
                if depths[0] is None:
                    continue
                self.assertEqual(depths, sorted(depths, reverse=True), axis["name"])
        # Below, a smaller footprint averages over fewer waves, which can cost more than the altitude gains.
        altitude = plan["axes"][0]
        rows = [depths for value, depths in zip(altitude["values"], altitude["depth"]["special"]) if value >= 400]
        for column in range(len(plan["seas"])):
            depths = [row[column] for row in rows]
            self.assertEqual(depths, sorted(depths, reverse=True))

    def test_says_how_much_wind_there_may_be(self):
        text = query("plan", "--table", self.table, *DRY, "--order", "special", check=0).stdout
        self.assertIn("greatest wind speed for order special:", text)
        self.assertIn("boresight", text)

    def test_varies_the_water_and_the_waves(self):
        survey = self.toml(WATER)
        plan = self.plan("--survey", survey, "--order", "special", "--kds", "0.06,0.2", "--winds", "3,8")
        water = next(axis for axis in plan["axes"] if axis["name"] == "kd")
        self.assertEqual(water["values"], [0.06, 0.2])
        self.assertGreaterEqual(water["depth"]["special"][0][0], water["depth"]["special"][1][0])
        result = query("plan", *DRY, "--order", "special", "--hs", 1, "--tp", 5, "--waves-from", 200, "--wind-speed", 4,
                       "--wave-heights", "0.5,2", "--altitudes", 400, "--incidences", 20, "--json", check=0)
        waves = json.loads(result.stdout)
        self.assertEqual(waves["sea"], {"name": "significant_wave_height", "unit": "m"})
        self.assertGreaterEqual(waves["planned"][0]["depth"]["special"], waves["planned"][1]["depth"]["special"])

    def test_leaves_out_what_cannot_be_answered(self):
        result = query("plan", *DRY, "--hs", 1, "--tp", 3, "--waves-from", 200, "--wave-heights", "4,0.5,0.25",
                       "--altitudes", 400, "--incidences", 20, "--json", check=0)
        self.assertIn("4 m and more left out: ", result.stderr)
        self.assertEqual(json.loads(result.stdout)["seas"], [0.25, 0.5])
        result = query("plan", "--table", self.table, *DRY, "--winds", "5,3,99,3", "--json", check=0)
        self.assertIn("--winds: 99 left out (the table has ", result.stderr)
        self.assertEqual(json.loads(result.stdout)["seas"], [3, 5])
        self.assert_fails(query("plan", "--table", self.table, *DRY, "--winds", 99), 2, "--winds", "nothing is left")

    @unittest.skipIf(shutil.which("chromium") is None, "no Chromium")
    def test_draws_a_page(self):
        output = self.folder / "plan"
        query("plan", "--table", self.table, *DRY, "--order", "special", "--output", output, check=0)
        self.assertEqual(sorted(path.name for path in output.iterdir()), ["plan.html", "plan.json"])
        page = (output / "plan.html").read_text()
        self.assertIn("Order special at 400 m of altitude", page)
        self.assertNotRegex(page, r"url\(|@import|https?://")
        self.assertEqual(re.findall(r"""(?:src|href)=["'](?!data:)[^"']*""", page), [])
        for width, height in ((390, 844), (1280, 900)):
            seen = probe(output / "plan.html", self.folder, width, height)
            self.assertLessEqual(seen["content"], max(seen["width"], width), seen)
            self.assertEqual((seen["broken"], seen["images"]), (0, 3))

    def test_refuses_what_is_no_plan(self):
        for arguments, *parts in ((("--datum-sigma", 0), "sensor"),
                                  (SENSOR, "water column is not decided"),
                                  ((*DRY, "--order", "3"), "1a"),
                                  ((*DRY, "--winds", "a"), "--winds"),
                                  ((*DRY, "--altitude", 0), "from 10 to 5000 m"),
                                  ((*DRY, "--kds", 0.1), "--kds has no effect"),
                                  ((*DRY, "--incidence", 60), "no table knows the planned beam"),
                                  ((*DRY, "--output", ""), "--output"),
                                  ((*DRY, "--sea", "buoy.txt"), "--hs")):
            self.assert_fails(query("plan", "--table", self.table, *arguments), 2, *parts)
        output = self.folder / "full"
        output.mkdir()
        (output / "mine").touch()
        self.assert_fails(query("plan", "--table", self.table, *DRY, "--output", output), 1, "--overwrite")


if __name__ == "__main__":
    programs.main()
