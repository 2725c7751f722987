"""The same settings give the same total, and the same refusal, from one pulse, CSV, LAS and a server.

Of a surface from other returns or of a level, the sources of error are stated together, each of another size;
with ALBTPU_EVERY_CASE also one by one.
"""

import json
import os

import numpy as np

import albtpu
import programs
from albtpu.v1.budget_pb2 import AirErrors
from las_file import LasFile
from programs import query

SENSOR = "[sensor]\nname = 'riegl-vq-880-g'\nlever_arm = [0.3, -0.2, 0.5]\n"
DECIDED = "[datum]\nsigma = 0.08\n[water]\ncolumn = 'none'\n"
SEA = "[sea]\nwind_speed = 6.5\nwind_from = 100\n"
PULSE = SENSOR + DECIDED + SEA + "[surface]\nclasses = [41]\nlocated = 'pulse'\n"
LOCAL, LEVEL = PULSE.replace("'pulse'", "'local'"), PULSE.replace("classes = [41]\nlocated = 'pulse'", "level = 0")
# Every source of error that the wire knows, each as [sigma] states it.
SOURCES = {field.name: "[0.003, 0.004, 0.005]" if field.message_type else "0.0015"
           for field in AirErrors.DESCRIPTOR.fields}
EVERY_CASE = bool(os.environ.get("ALBTPU_EVERY_CASE"))
LOCATED = {"pulse": PULSE, "local": LOCAL, "level": LEVEL}


def all_sources(located):
    """The text of all sources that a total may have together, each of its own size."""
    sizes = {name: 0.0011 + 0.0002 * i for i, name in enumerate(SOURCES)}
    return "[sigma]\n" + "".join(
        f"{name} = " + (f"[{size}, {size + 0.003}, {size + 0.005}]\n" if SOURCES[name][0] == "[" else f"{size}\n")
        for name, size in sizes.items() if name != ("surface_range" if located == "level" else "surface_height"))


SETTINGS = {
    **{f"{located} and {name}": f"{text}[sigma]\n{name} = {value}\n"
       for located, text in LOCATED.items() for name, value in SOURCES.items()
       if (located, name) != ("level", "surface_range")
       and (EVERY_CASE or located == "pulse" or (located, name) == ("local", "surface_height"))},
    **{f"{located} and all sources": text + all_sources(located) for located, text in LOCATED.items()},
    "no datum": PULSE.replace("sigma = 0.08", "sigma = 0"),
    "mcu": PULSE.replace("sigma = 0.08", "mcu = 0.115\nconfidence = '1sigma'\nregion = 'Delaware Bay'"),
    "mcu at 95 %": PULSE.replace("sigma = 0.08", "mcu = 0.2\nconfidence = '95%'"),
    "extra": PULSE + "[extra]\nhorizontal = 0.25\nvertical = 0.1\n",
    "extra of a level": LEVEL + "[extra]\nvertical = 0.1\n",
    "extra at p95": PULSE + "[extra]\nhorizontal = 0.25\n[output]\ncoverage = 'p95'\n",
    "no lever arm": PULSE.replace("lever_arm = [0.3, -0.2, 0.5]", ""),
    "another index": PULSE.replace("column", "index = 1.338\ncolumn"),
    "the index by the state of the water": PULSE.replace("column", "temperature = 15\nsalinity = 35\ncolumn"),
    "2sigma": PULSE + "[output]\ncoverage = '2sigma'\n",
    "1sigma": PULSE + "[output]\ncoverage = '1sigma'\n",
    "p95": PULSE + "[output]\ncoverage = 'p95'\n"}
# What is refused, and a part of the message.
REFUSED = {
    "datum": (PULSE.replace("[datum]\nsigma = 0.08\n", ""), "the vertical datum is not decided"),
    "datum twice": (PULSE.replace("[datum]", "[datum]\nmcu = 0.1\nconfidence = '1sigma'"), "given beside sigma"),
    "confidence": (PULSE.replace("sigma = 0.08", "mcu = 0.2"), "'datum.mcu' has no confidence"),
    "centimetres": (PULSE.replace("sigma = 0.08", "mcu = 11.8\nconfidence = '1sigma'"), "expected 0.001 to 2 m"),
    "extra without a sensor": ("[extra]\nvertical = 0.1\n" + SEA, "[extra] has no effect without a sensor"),
    "water column": (PULSE.replace("column = 'none'", "kd = 0.1"), "the water column is not decided"),
    "both decisions": (PULSE.replace("column", "bias = 'none'\ncolumn"), "contradicts column"),
    "receiver": (PULSE.replace("column = 'none'", "bias = 'none'"), "lacks detector"),
    "no sensor": ("[sigma]\nscan = 0.1\n" + SEA, "[sigma] has no effect without a sensor"),
    "scan": (PULSE.replace("riegl-vq-880-g", "usgs-eaarl-b"), "no source gives scan (degree)"),
    "sensor": (PULSE.replace("880", "88"), "did you mean riegl-vq-880-g?"),
    "range to a level": (LEVEL + "[sigma]\nsurface_range = 0.02\n", "surface_range has no effect where a level"),
    "range and height": (PULSE + "[sigma]\nsurface_range = 0.02\nsurface_height = 0.02\n", "beside surface_height"),
    "radians": (PULSE + "[sigma]\nscan = 1.7e-5\n", "looks like radians"),
    "out of range": (PULSE + "[sigma]\nindex = 0.2\n", "'sigma.index' is 0.2 (expected 0 to 0.1)"),
    "unknown": (PULSE + "[sigma]\nscann = 0.2\n", "did you mean scan?")}
# Standard deviations of the datum, of which the total states six digits.
OF_MCU = {"mcu at 95 %": 0.2 / 1.959963984540054}
CONSTANTS = ("datum", "extra_horizontal", "extra_vertical", "refractive_index", "lever_arm_vector")
MOTION = {"roll": 3, "pitch": 4, "heading": 30, "velocity_north": 60, "velocity_east": 35, "velocity_down": 1,
          "roll_rate": 0.5, "pitch_rate": 1, "yaw_rate": 2}
NUMBERS = ("thu", "tvu", "thu_air", "tvu_air", "thu_sea", "tvu_sea")
ENTRIES = ("NN", "EE", "DD", "NE", "ND", "ED")


class SameTotals(programs.Test):
    def setUp(self):
        super().setUp()
        self.settings = self.folder / "survey.toml"
        self.pulses = self.folder / "pulses.csv"
        self.pulses.write_text("incidence,beam_azimuth,depth,altitude,footprint," + ",".join(MOTION) +
                               "\n20,90,10,400,0.5," + ",".join(map(str, MOTION.values())) + "\n")

    def ask_pulse(self, *flags):
        values = list(MOTION.values())
        motion = [",".join(map(str, values[i:i + 3])) for i in (0, 3, 6)]
        return query("pulse", "--survey", self.settings, "--table", self.table, "--json", "--incidence", 20,
                     "--beam-azimuth", 90, "--depth", 10, "--altitude", 400, "--footprint", 0.5,
                     "--attitude", motion[0], "--velocity", motion[1], "--rates", motion[2], *flags)

    def ask_csv(self, pulses, *source):
        out = self.folder / "out.csv"
        result = query("csv", pulses, out, "--survey", self.settings, "--details", "--s44-order", "1b",
                       "--overwrite", *source)
        if result.returncode:
            return result, None
        lines = [line.split(",") for line in out.read_text().splitlines()]
        return result, {name: np.array(column) for name, *column in zip(*lines)}

    def ask_las(self):
        out = self.folder / "out.las"
        return query("las", self.folder / "line.las", out, "--survey", self.settings, "--table", self.table,
                     "--incidence", 20, "--beam-azimuth", 90, "--altitude", 400, "--footprint", 0.5, "--details",
                     "--overwrite"), out

    def numbers_of_csv(self, columns):
        return {name: np.array(columns[f"total_{name}" if len(name) == 3 else name], np.float32) for name in NUMBERS}

    def budget_of_server(self, service, total, name):
        """The total by the numbers that `pulse` states."""
        stated = {key: [float(part.split(" ")[0]) for part in number["value"].split(", ")]
                  for key, number in total["plan"]["numbers"].items() if key in (*SOURCES, *CONSTANTS)}
        added = {key: stated[key][0] for key in ("extra_horizontal", "extra_vertical") if key in stated}
        errors = {key: stated[key] if len(stated[key]) > 1 else stated[key][0] for key in SOURCES if key in stated}
        return service.query_budget(
            wind_speed=6.5, incidence=20, azimuth=90 - 280, footprint=0.5, depth=10, altitude=400, beam_azimuth=90,
            sea_axis=280, located=total["plan"]["located"], coverage=total["coverage"], aircraft=MOTION,
            errors=errors,
            lever_arm=stated["lever_arm_vector"], datum=OF_MCU.get(name, stated["datum"][0]), **added,
            refractive_index=stated["refractive_index"][0],
            quantities=[f"total_{key}" if len(key) == 3 else key for key in NUMBERS])

    def test_the_same_settings_give_the_same_total(self):
        with programs.server(self.folder) as address, albtpu.connect(address) as service:
            for name, text in SETTINGS.items():
                with self.subTest(name):
                    self.settings.write_text(text)
                    answer = self.ask_pulse()
                    self.assertEqual(answer.returncode, 0, answer.stderr)
                    total = json.loads(answer.stdout)
                    expected = {number: np.float32(total[number]) for number in NUMBERS}
                    total_alone = {f"covariance_{entry}": np.float32(total["covariance_total"][entry])
                                   for entry in ENTRIES} | {"bias_vertical": np.float32(total["bias_vertical"])}
                    for source in (("--table", self.table), ("--server", address)):
                        _, columns = self.ask_csv(self.pulses, *source)
                        found = {key: value[0] for key, value in self.numbers_of_csv(columns).items()}
                        self.assertEqual(found, expected)
                        self.assertEqual({name: np.float32(columns[name][0]) for name in total_alone}, total_alone)
                        self.assertEqual(columns["s44_order_met"][0], total["s44_order_met"])
                    budget = self.budget_of_server(service, total, name)
                    # The height of the waves that a location does not see is not among the stated numbers.
                    same = NUMBERS if total["plan"]["located"] == "pulse" else ("thu_air", "tvu_air")
                    if "state" not in name:  # Of which the index is stated to six digits.
                        for number in same:
                            of_server = budget.values[f"total_{number}" if len(number) == 3 else number]
                            self.assertEqual(np.float32(of_server), expected[number], number)

    def test_points_have_the_totals_of_their_pulses(self):
        programs.make_flight(self.folder / "line.las")
        settings = {"level": LEVEL, "local": LOCAL, "pulse": PULSE, "extra": SETTINGS["extra at p95"],
                    "index": LEVEL + "[sigma]\nindex = 0.01\n",
                    "p95": LEVEL + "[output]\ncoverage = 'p95'\n"}
        for name, text in settings.items():
            with self.subTest(name):
                self.settings.write_text(text)
                result, out = self.ask_las()
                self.assertEqual(result.returncode, 0, result.stderr)
                number = {key: values.astype(np.float32) for key, values in LasFile(out).columns().items()}
                rows = np.flatnonzero((number["total_thu"] >= 0) & (number["water_depth"] >= 0))[:2000]
                self.assertGreater(len(rows), 100)
                pulses = self.folder / "of_points.csv"
                pulses.write_text("incidence,beam_azimuth,altitude,footprint,depth\n" + "".join(
                    f"20,90,400,0.5,{number['water_depth'][row]!s}\n" for row in rows))
                _, columns = self.ask_csv(pulses, "--table", self.table)
                for key, values in self.numbers_of_csv(columns).items():
                    np.testing.assert_array_equal(number[f"total_{key}" if len(key) == 3 else key][rows], values, key)

    def test_the_same_settings_are_refused_alike(self):
        programs.make_flight(self.folder / "line.las")
        for name, (text, part) in REFUSED.items():
            with self.subTest(name):
                self.settings.write_text(text)
                results = [self.ask_pulse(), self.ask_csv(self.pulses, "--table", self.table)[0], self.ask_las()[0]]
                for result in results:
                    self.assertEqual(result.returncode, results[0].returncode, result.stderr)
                    self.assertIn(part, result.stderr)
                    self.assertEqual(result.stderr.splitlines()[-1], results[0].stderr.splitlines()[-1])
                self.assertFalse((self.folder / "out.csv").exists() or (self.folder / "out.las").exists())

    def test_a_server_refuses_what_is_no_standard_deviation(self):
        pulse = dict(wind_speed=6.5, incidence=20, footprint=0.5, depth=10, altitude=400, beam_azimuth=90,
                     located="pulse")
        with programs.server(self.folder) as address, albtpu.connect(address) as service:
            for field in AirErrors.DESCRIPTOR.fields:
                wrong = [0, -1, 0] if field.message_type else -1
                part = f"errors.{field.name}" + (f".{field.message_type.fields[1].name}" if field.message_type else "")
                with self.assertRaisesRegex(albtpu.ServiceError, f"options.{part} is -1: a standard deviation"):
                    service.query_budget(**pulse, errors={field.name: wrong})
            with self.assertRaisesRegex(albtpu.ArgumentError, "scan"):
                service.query_budget(**pulse, errors={"scann": 1})


if __name__ == "__main__":
    programs.main()
