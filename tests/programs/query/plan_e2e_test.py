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
WAVES = ("--hs", 1, "--tp", 5, "--waves-from", 200)
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

    def test_says_how_the_surface_is_located(self):
        survey = self.toml('[surface]\nlevel = "-0.5 m"\n')
        for flags, location, source in (((), "local", "assumed: no water level is given"),
                                        (("--survey", survey), "level", "assumed: by the water level"),
                                        (("--surface-located", "pulse"), "pulse", "the user")):
            flags = (*DRY, *flags, "--winds", 5)
            self.assertEqual(self.plan(*flags)["located"], location)
            self.assertIn(f"  surface located: {location} ({source})\n",
                          query("plan", "--table", self.table, *flags, check=0).stdout)
        self.assertRegex(" ".join(query("plan", "--help", check=0).stdout.split()),
                         "of a plan level with a water level, local without")

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

    def test_leaves_out_waves_that_break(self):
        """Miche's limit is 0.89 m at 2 s, 0.45 m in 0.5 m of water."""
        for flags, kept in ((("--hs", 0.3, "--tp", 2), [0.25, 0.5, 0.75]),
                            (("--hs", 0.25, "--tp", 6, "--sea-depth", 0.5, "--wave-heights", "0.25,1,2"), [0.25])):
            result = query("plan", *DRY, *flags, "--waves-from", 200, "--altitudes", 400, "--incidences", 20, "--json",
                           check=0)
            self.assertEqual(json.loads(result.stdout)["seas"], kept)
            self.assertIn("higher than waves can be", result.stderr)

    def test_attenuations_are_those_at_532_nm(self):
        """Whatever kind the survey's own attenuation is of."""
        plans = []
        for kind in ("diffuse532", "satellite490"):
            survey = self.toml(WATER.replace("diffuse532", kind))
            plans.append(self.plan("--survey", survey, "--winds", 5, "--kds", "0.1,0.2", "--altitudes", 400,
                                   "--incidences", 20)["axes"][-1])
        self.assertEqual(plans[0], plans[1])

    def test_prints_every_condition(self):
        flags = (*DRY, "--order", "special", "--winds", "2,6,10", "--altitudes", "300,500", "--incidences", "10,20")
        text = query("plan", "--table", self.table, *flags, check=0).stdout
        plan = self.plan(*flags)
        self.assertGreater(len(plan["seas"]), 1)
        for axis in plan["axes"]:
            head = f"order special by {axis['name']} [{axis['unit']}, down] and wind speed [m/s, across]:\n"
            table = text.partition(head)[2].splitlines()
            self.assertEqual(table[0].split(), [f"{sea:g}" for sea in plan["seas"]])
            for line, value, depths in zip(table[1:], axis["values"], axis["depth"]["special"]):
                self.assertEqual(line.split(), [f"{value:g}", *("-" if depth is None else f"{depth:.2f}"
                                                                for depth in depths)])

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
                                  ((*DRY, "--winds", "5,,6"), "--winds: '' is not a number in the range"),
                                  ((*DRY, "--altitude", 0), "from 10 to 5000 m"),
                                  ((*DRY, "--kds", 0.1), "--kds has no effect"),
                                  ((*DRY, "--incidence", 60), "no table knows the planned beam"),
                                  ((*DRY, "--fetch", 0.5), "the fetch of 0.5 m is below that of the table", "--fetch"),
                                  ((*DRY, "--wave-heights", 0.5), "--wave-heights has no effect without waves", "--hs"),
                                  ((*DRY, *WAVES, "--winds", 5), "--winds has no effect over waves", "--wave-heights"),
                                  ((*DRY, "--output", ""), "--output")):
            self.assert_fails(query("plan", "--table", self.table, *arguments), 2, *parts)
        output = self.folder / "full"
        output.mkdir()
        (output / "mine").touch()
        self.assert_fails(query("plan", "--table", self.table, *DRY, "--output", output), 1, "--overwrite")


# Significant heights by time, of which some hours are missing.
STATES = (("00:00", 0.2), ("01:00", 0.4), ("02:30", 0.8), ("08:00", 1.5), ("09:00", 1.2))


def series():
    """Spectra with a peak at 0.2 Hz, as CSV."""
    bins = [0.05 * i for i in range(1, 13)]
    shape = [min(f / 0.2, (0.2 / f)**4) for f in bins]
    energy = 16 * 0.05 * sum(shape)  # Hs^2 of the shape.
    rows = [f"2020-06-08T{time}Z,{f:.2f},{each * hs**2 / energy:.6g},0.4,250"
            for time, hs in STATES for f, each in zip(bins, shape)]
    return "\n".join(["time,f,E,r2,alpha2", *rows]) + "\n"


HOURS = ("--order", "special", "--altitudes", "300,400", "--incidences", "10,20", "--sea-gap", 3)


class PlanOfHours(programs.Test):
    """Of a series of seas: the same count by a call of `pulse` for each hour and depth."""

    def setUp(self):
        super().setUp()
        self.sea = self.write("sea.csv", series())
        self.sensor = self.toml(f"[sea]\nfile = \"{self.sea}\"\nwind_speed = 4\nwind_from = 250\n"
                                "[sensor]\nname = \"riegl-vq-880-g\"\n[datum]\nsigma = 0.08\n"
                                "[water]\ncolumn = \"none\"\n")

    def order_met(self, hour, depth, altitude, incidence):
        pulse = json.loads(query("pulse", "--survey", self.sensor, "--sea-time", f"2020-06-08T{hour:02}:00Z",
                                 "--surface-located", "local", "--depth", depth, "--altitude", altitude, "--incidence",
                                 incidence, "--coverage", "p95", "--sea-gap", 3, "--json", check=0).stdout)
        self.assertEqual(pulse["outcome"], "INTERPOLATED")
        return pulse["s44_order_met"]

    def test_share_of_hours_is_the_count_of_single_pulses(self):
        plan = json.loads(query("plan", "--survey", self.sensor, *HOURS, "--json", check=0).stdout)
        hours = plan["hours"]
        self.assertEqual((hours["first"], hours["last"]), ("2020-06-08T00:00Z", "2020-06-08T09:00Z"))
        # The gap from 02:30 to 08:00 is longer than three hours.
        self.assertEqual((hours["count"], hours["without_sea"]), (5, 5))
        self.assertEqual(plan["seas"], [])
        depths = [each["depth"] for each in hours["by_depth"]]
        altitude = next(axis for axis in plan["axes"] if axis["name"] == "altitude")
        for row, value in enumerate(altitude["values"]):
            for column, depth in list(enumerate(depths))[:5:2]:
                met = [self.order_met(hour, depth, value, plan["conditions"]["incidence"]) in ORDERS[:2]
                       for hour in (0, 1, 2, 8, 9)]
                self.assertAlmostEqual(altitude["share"]["special"][row][column], sum(met) / 5, places=9,
                                       msg=f"{value} m, {depth} m")
        # The planned altitude is on the axis.
        self.assertEqual(altitude["share"]["special"][1], [each["share"]["special"] for each in hours["by_depth"]])

    def test_prints_the_shares_and_that_tides_are_aside(self):
        text = query("plan", "--survey", self.sensor, *HOURS, check=0).stdout
        self.assertIn("share of 5 hours from 2020-06-08T00:00Z to 2020-06-08T09:00Z in which each order of S-44 is"
                      " met, tides aside", text)
        self.assertIn("5 hours more have no sea", text)
        self.assertIn("share of hours for order special by incidence [degree, down], down to", text)

    def test_of_one_instant_is_that_of_one_sea(self):
        plan = json.loads(query("plan", "--survey", self.sensor, *HOURS, "--sea-time", "2020-06-08T01:00Z", "--json",
                                check=0).stdout)
        self.assertEqual(len(plan["seas"]), 1)
        self.assertAlmostEqual(plan["seas"][0], 0.4, delta=0.02)  # By the width of the bins.
        depth = plan["planned"][0]["depth"]["special"]
        self.assertGreater(depth, 0.25)
        self.assertIn(self.order_met(1, depth, 400, 20), ORDERS[:2])
        self.assertNotIn(self.order_met(1, depth + 0.25, 400, 20), ORDERS[:2])

    def test_draws_a_page_of_hours(self):
        output = self.folder / "plan"
        query("plan", "--survey", self.sensor, *HOURS, "--output", output, check=0)
        page = (output / "plan.html").read_text()
        self.assertIn("5 hours from 2020-06-08T00:00Z", page)
        self.assertIn("Tides are not considered", page)
        self.assertEqual(page.count("<img"), 3)

    def test_refuses_what_has_no_effect(self):
        for flags in (("--winds", 3), ("--wave-heights", 1)):
            self.assert_fails(query("plan", "--survey", self.sensor, *flags), 2, "no effect with a file of the sea")
        self.assert_fails(query("plan", *DRY, "--sea", self.folder / "none.txt"), 1, "none.txt")


if __name__ == "__main__":
    programs.main()
