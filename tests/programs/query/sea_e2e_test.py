"""albtpu-query over any sea: flags, survey files, calms, contradictions."""

import json

import numpy as np

import programs
import sea_states
from programs import query
from sea_states import FLIGHT_START, PULSE, WAVES, numbers, pulse, utc


class SeaTest(sea_states.Test):
    def test_each_flag_tells_on_the_answer(self):
        plain = pulse(*WAVES)
        self.assertEqual(plain["outcome"], "INTERPOLATED")
        self.assertIsNone(plain["wind_speed"])
        self.assertEqual(plain["table"], "sea")
        self.assertTrue(plain["azimuth_absent"])
        seen = [numbers(plain)]
        for flags in (("--beam-azimuth", 100), ("--azimuth", 35), ("--gamma", 6), ("--spread", 20), ("--sea-depth", 2),
                      ("--tail", "wind"), ("--tail", "level"), ("--tail", "none"), ("--tail-from", 0.5),
                      ("--swell", "1.1,9.5,295"), ("--swell", "1.1,9.5,295,30"),
                      ("--swell", "1.1,9.5,295", "--swell", "0.4,14,180")):
            with self.subTest(flags=flags):
                answer = numbers(pulse(*WAVES, *flags))
                self.assertNotIn(answer, seen)
                seen.append(answer)
        self.assertEqual(numbers(pulse(*WAVES, "--spreading", "mitsuyasu", "--tail", "relax", "--gamma", 3.3)), seen[0])
        sea = plain["sea"]["first"]
        self.assertAlmostEqual(sea["hs"], 0.6, delta=1e-3)
        self.assertEqual(sea["tp"], 3.2)
        self.assertEqual((sea["wind_speed"], sea["wind_speed_of"], sea["wind_direction_of"], sea["tail"]),
                         (6, "user", "user", "relax"))
        self.assertAlmostEqual(sea["x_azimuth"], 45)
        self.assertGreater(sea["relative_standard_error"]["tail"], 0)
        self.assertEqual(sea["relative_standard_error"]["sampling"], 0)
        self.assertTrue(0 < sea["share_measured"] < 1)

    def test_directions_count_from_the_wind(self):
        crossing = (*WAVES, "--swell", "1.1,9.5,295")
        true = pulse(*crossing, "--beam-azimuth", 75)  # 30 degrees clockwise from downwind
        self.assertEqual(true["azimuth"], 30)
        from_downwind = pulse(*crossing, "--azimuth", 30)
        np.testing.assert_allclose(numbers(from_downwind), numbers(true), rtol=1e-5)
        np.testing.assert_allclose(numbers(pulse(*crossing, "--beam-azimuth", 255))[:4], numbers(true)[:4], rtol=1e-5)
        self.assertNotAlmostEqual(pulse(*crossing, "--azimuth", -30)["thu"] / true["thu"], 1, places=3)

    def test_what_is_not_known_is_stated(self):
        answer = pulse("--hs", 0.6, "--tp", 3.2, "--waves-from", 230)
        sea = answer["sea"]["first"]
        self.assertEqual((sea["wind_speed_of"], sea["wind_direction_of"]), ("waves", "waves"))
        self.assertTrue(any("wind speed" in sentence for sentence in sea["assumed"]), sea["assumed"])
        text = query("pulse", *PULSE, "--hs", 0.6, "--tp", 3.2, "--waves-from", 230, check=0).stdout
        self.assertIn("assumed: the wind speed is derived", text)
        self.assertIn("derived from the waves", text)
        total = query("pulse", *PULSE, "--hs", 0.6, "--tp", 3.2, "--waves-from", 230, "--sensor", "riegl-vq-880-g",
                      "--surface-located", "level", "--datum-sigma", 0, "--water-column", "none", "--altitude", 400,
                      check=0).stdout
        self.assertRegex(total, r"(?s)assumed: the wind speed is derived.*[^\n]\n\Z")
        isotropic, complete = self.folder / "isotropic.csv", self.folder / "complete.csv"
        isotropic.write_text("f,E\n0.1,1\n0.2,1\n0.3,0.2\n0.4,0.1\n")
        complete.write_text("k,S,a2,b2\n0.1,1,0.5,0\n0.2,1,0.5,0\n")
        for file, said in ((isotropic, "its waves are taken as isotropic"), (complete, "harmonics count from north")):
            answers = [pulse("--sea", file, "--wind-speed", 6, "--beam-azimuth", azimuth) for azimuth in (0, 90)]
            sea = answers[0]["sea"]["first"]
            self.assertEqual(sea["wind_direction_of"], "unknown")
            self.assertTrue(any(said in sentence for sentence in sea["assumed"]), sea["assumed"])
            north, east = (numbers(answer)[2:4] for answer in answers)
            self.assertEqual(np.allclose(north, east, rtol=1e-5), file == isotropic, (north, east))
        errors = pulse(*WAVES, "--standard-errors")
        self.assertAlmostEqual(errors["thu_standard_error"] / errors["thu"],
                               errors["sea"]["first"]["relative_standard_error"]["total"], delta=0.02)

    def test_a_calm_has_only_what_is_given(self):
        calm = pulse("--hs", 0, "--tp", 5, "--waves-from", 0, "--wind-speed", 0)
        self.assertEqual(numbers(calm), [0] * 6)
        self.assertEqual(calm["outcome"], "INTERPOLATED")
        swell = pulse("--swell", "1.1,9.5,295", "--wind-speed", 0)
        self.assertGreater(swell["thu"], 0)
        self.assertEqual(swell["sea"]["first"]["share_measured"], 1)
        self.assertLess(swell["thu"], pulse("--swell", "1.1,9.5,295", "--wind-speed", 6)["thu"])

    def test_a_survey_file_gives_the_same_bits(self):
        flags = (*WAVES, "--swell", "1.1,9.5,295", "--sea-depth", 12, "--tail", "level", "--tail-from", 0.8)
        survey = self.toml("""[sea]
wind_speed = 6
wind_from = 225
water_depth = 12
tail = "level"
tail_from = 0.8
[[sea.waves]]
hs = 0.6
tp = 3.2
waves_from = 230
[[sea.waves]]
hs = 1.1
tp = 9.5
gamma = 7
waves_from = 295
spread = 18
""")
        by_flags, by_file = (pulse(*each, "--beam-azimuth", 140) for each in (flags, ("--survey", survey)))
        self.assertEqual(by_file, by_flags)
        part = self.toml("[sea]\nwater_depth = 12\n[[sea.waves]]\nhs = 0.6\ntp = 3.2\nwaves_from = 230\n", "part.toml")
        self.assertEqual(numbers(pulse("--survey", part, "--wind-speed", 6, "--wind-from", 225)),
                         numbers(pulse(*WAVES, "--sea-depth", 12)))

    def test_a_survey_file_with_a_wind_alone_asks_a_table_of_winds(self):
        survey = self.toml("[sea]\nwind_speed = 6\nwind_from = 250\n")
        flags = ("--table", self.table, "--beam-azimuth", 100)
        self.assertEqual(pulse("--survey", survey, *flags), pulse("--wind-speed", 6, "--wind-from", 250, *flags))
        self.assertEqual(pulse("--survey", survey, "--wind-speed", 7, *flags),
                         pulse("--wind-speed", 7, "--wind-from", 250, *flags))

    def test_contradictions_are_one_clear_message(self):
        series = self.sea_csv((FLIGHT_START, 1, 200), (FLIGHT_START + 3600, 1, 200))
        complete = self.folder / "complete.csv"
        complete.write_text("k,S,a2,b2\n0.1,1,0,0\n0.2,1,0,0\n")
        waves = self.toml("[[sea.waves]]\nhs = 1\ntp = 5\nwaves_from = 20\n")
        at = ("--sea-time", utc(FLIGHT_START))
        # tests/config/sea_settings_test.cc has what each key of a sea contradicts.
        for flags, code, *parts in (
                (("--sea", series, *WAVES), 2, "both say which waves"),
                (("--survey", waves, "--sea", series), 2, "has 2 records from", "--sea-time"),
                ((*WAVES, "--table", self.table), 2, "--table cannot be used with a sea"),
                ((*WAVES, "--table-name", "survey"), 2, "--table-name cannot be used with a sea"),
                ((*WAVES, "--fetch", 1000), 2, "--fetch (fetch in a survey file) has no effect with waves"),
                ((*WAVES, "--spread", 18, "--spreading", "mitsuyasu"), 2, "both say how directions spread"),
                ((*WAVES, "--azimuth", 3, "--beam-azimuth", 4), 2, "leave out one of the two ways"),
                (("--wind-speed", 5, "--tail", "wind", "--table", self.table), 2, "--tail", "no effect without waves"),
                (("--hs", 1), 2, "--tp is missing"), (("--swell", "1,9"), 2, "HS,TP,FROM"),
                ((*WAVES[:-4], "--wind-speed", 500), 2, "expected 0 to 100 m/s"),
                (("--hs", 2, "--tp", 2, "--waves-from", 0), 2, "waves of 2 m and 2 s", "break above 0.89 m"),
                (("--sea", series, "--sea-time", "noon"), 2, "'noon' is no time"),
                (("--sea", series, "--sea-time", utc(FLIGHT_START - 60)), 1, "has no sea at", "2 records last from"),
                (("--sea", series, *at, "--sea-place", "Key West"), 1, "has no place 'Key West'"),
                (("--sea", complete, "--tail", "wind"), 1, "which is complete"),
                (("--sea", complete, *at), 1, "--sea-time has no effect"),
                (("--sea", self.folder / "absent"), 1, "absent: does not exist"),
                (("--survey", self.folder / "absent"), 1, "absent: does not exist"),
                (("--survey", self.toml("[sea]\nwind_sped = 5\n", "wrong.toml")), 1, "wrong.toml: line 2:",
                 "did you mean wind_speed?")):
            with self.subTest(flags=flags):
                self.assert_fails(query("pulse", *PULSE, *flags), code, *parts)

    def test_csv_gives_what_pulse_gives(self):
        source = self.folder / "in.csv"
        source.write_text("incidence,footprint,depth,beam_azimuth\n15,0.6,8,100\n15,0.6,8,\n5,1,3,300\n")
        result = query("csv", source, self.folder / "out.csv", *WAVES, check=0)
        self.assertIn("sea, Hs 0.60 m", result.stderr)
        header, *rows = (line.split(",") for line in (self.folder / "out.csv").read_text().splitlines())
        thu = [np.float32(row[header.index("thu")]) for row in rows]
        self.assertEqual(thu[0], np.float32(pulse(*WAVES, "--beam-azimuth", 100)["thu"]))
        self.assertEqual(thu[1], np.float32(pulse(*WAVES)["thu"]))
        self.assertEqual(json.loads((self.folder / "out.csv.json").read_text())["input"]["sea"]["first"]["tp"], 3.2)
        for column in ("wind_speed", "fetch", "wind_from"):
            source.write_text(f"incidence,footprint,depth,{column}\n15,0.6,8,5\n")
            self.assert_fails(query("csv", source, self.folder / "never.csv", *WAVES), 1,
                              f"column '{column}' contradicts the given sea")


if __name__ == "__main__":
    programs.main()
