"""albtpu-query sensors: all sensors, one of them, and messages."""

import json
import pathlib

import programs
from programs import query

SHIPPED = pathlib.Path(__file__).resolve().parents[3] / "config/sensors/shipped"
NUMBERS = {"scan", "bottom_range", "surface_range", "range_offset", "lever_arm", "time", "position", "attitude",
           "boresight", "divergence"}


def sensors(*arguments, folder=SHIPPED, check=None):
    return query("sensors", *arguments, environment={"ALBTPU_SENSORS": str(folder)}, check=check)


class SensorsTest(programs.Test):
    def test_lists_all_sensors(self):
        lines = sensors(check=0).stdout.splitlines()
        self.assertEqual(lines[0].split(), ["name", "title", "scan", "bottom_range", "divergence"])
        self.assertEqual(lines[1].split(), ["degree", "m", "mrad"])
        self.assertEqual([line.split()[0] for line in lines[2:]], sorted(path.stem for path in SHIPPED.glob("*.toml")))
        row = next(line for line in lines if line.startswith("riegl-vq-880-g "))
        self.assertRegex(row, r"RIEGL VQ-880-G +0.02 +0.025 +1 \(0.7 to 2\)$")
        self.assertEqual(len({len(line) for line in lines}), 1)

    def test_states_a_source_for_each_number(self):
        answer = json.loads(sensors("--json", check=0).stdout)
        self.assertGreaterEqual(len(answer["sensors"]), 14)
        for sensor in answer["sensors"]:
            known = NUMBERS & set(sensor)
            self.assertEqual(known | set(sensor["unknown"]), NUMBERS, sensor["name"])
            self.assertFalse(known & set(sensor["unknown"]))
            for key in known:
                self.assertLessEqual({"value", "unit", "source"}, set(sensor[key]))
                self.assertGreater(len(sensor[key]["source"]), 10)
            alone = json.loads(sensors(sensor["name"], "--json", check=0).stdout)
            self.assertEqual(alone, sensor)

    def test_shows_one_with_what_is_not_known(self):
        text = sensors("fugro-ramms", check=0).stdout
        self.assertIn("0.015 degree, cBLUE", text)
        self.assertRegex(text, r"not known; give it in \[sigma\] of the survey file: .*\bposition\b")
        self.assertRegex(text, r"not known; give it by --divergence: divergence")
        self.assertNotIn(str(SHIPPED), text)

    def test_reads_a_file_of_the_user(self):
        mine = self.write("mine.toml", "title = 'Mine'\n[attitude]\nvalue = [0.0025, 0.0025, 0.005]\nunit = 'degree'\n"
                                       "source = 'its manual'\n")
        self.assertIn("attitude       [0.0025, 0.0025, 0.005] degree, its manual", sensors(mine, check=0).stdout)
        mine.write_text("title = 'Mine'\n[scan]\nvalue = 0.02\nunit = 'degree'\n")
        for result in (sensors(mine), sensors(folder=self.folder)):
            self.assert_fails(result, 1, f"{mine}: line 2: [scan] source is missing; give")

    def test_names_the_sensor_that_is_meant(self):
        self.assert_fails(sensors("riegl-vq-88-g"), 1, "did you mean riegl-vq-880-g?")
        self.assert_fails(sensors(""), 2, "name")
        empty = sensors(folder=self.folder / "none", check=0)
        self.assertEqual(empty.stdout, "")
        self.assertIn("there are no sensors in ", empty.stderr)


if __name__ == "__main__":
    programs.main()
