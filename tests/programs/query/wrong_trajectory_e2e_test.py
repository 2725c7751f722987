"""Wrong trajectories are refused by name, right ones are not.

Each wrong one is made from the right one of a simulated survey by the mistake that people make.
"""

import programs
from programs import query
from simulated_survey import SimulatedSurvey

SCANNERS = ("palmer", "raster", "ellipse")
# Scanners, geoid separations and lever arms. 4 m to a side turn the beams by 0.5 degree at 400 m; 5 m of height alone
# would turn them by 0.23, below the limit of 0.3: rays know the height less well, because an index of water wrong by
# 0.01 already moves it by 3 m.
INSTALLED = (("palmer", -25, "5,0,0"), ("palmer", 25, "0,4,3"), ("raster", 25, "0,-5,0"), ("raster", -25, "4,0,-3"),
             ("ellipse", -25, "0,4,3"), ("ellipse", 25, "5,0,0"))


class WrongTrajectoryTest(programs.Test):
    def survey(self, *flags, name="survey"):
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        return SimulatedSurvey(folder, "--seconds", 20, "--pulse-rate", 400, *flags)

    def query(self, survey, trajectory, *flags, lever_arm="0.3,-0.2,0.5"):
        output = self.folder / "out.las"
        output.unlink(missing_ok=True)
        arm = ("--lever-arm", lever_arm) if lever_arm else ()
        return query("las", survey.las, output, "--trajectory", trajectory, *arm, "--water-level", survey.water_level,
                     "--classes", 40, "--divergence", 1, "--wind-speed", 6, "--table", self.table, *flags)

    def assert_named(self, cause, survey, trajectory, *flags, **keywords):
        """`cause` is a regular expression that the message contains, in any case."""
        result = self.query(survey, trajectory, *flags, **keywords)
        self.assertNotEqual(result.returncode, 0, f"accepted: {result.stderr}")
        last = result.stderr.rstrip("\n").split("\n")[-1]
        self.assertTrue(last.startswith("albtpu-query: "), result.stderr)
        self.assertRegex(last, f"(?i){cause}")
        self.assertFalse((self.folder / "out.las").exists(), "something was written")

    def test_right_ones_are_not_refused(self):
        for seed in (100, 101):
            for scanner in SCANNERS:
                with self.subTest(seed=seed, scanner=scanner):
                    rough = ("--wave-height", 0.3, "--range-noise", 0.02) if seed % 2 else ()
                    survey = self.survey("--seed", seed, "--scanner", scanner,
                                         "--course", 77 * seed % 360, "--altitude", 300 + 75 * (seed % 5), *rough)
                    for trajectory in (survey.sbet, survey.ascii)[:1 + (seed == 100)]:
                        result = self.query(survey, trajectory)
                        self.assertEqual(result.returncode, 0, result.stderr)

    def test_what_is_left_out_is_named(self):
        for scanner, separation, arm in INSTALLED:
            with self.subTest(scanner=scanner, separation=separation, arm=arm):
                survey = self.survey("--scanner", scanner, "--seed", 16, "--geoid-separation", separation,
                                     "--lever-arm", arm)
                geoid = ("--geoid-separation", separation)
                self.assert_named("geoid", survey, survey.sbet, lever_arm=arm)
                self.assert_named("lever", survey, survey.sbet, *geoid, lever_arm=None)
                utc = survey.write_sbet("wrong.out", time=lambda t: t - 18)
                self.assert_named("utc", survey, utc, *geoid, lever_arm=arm)
                result = self.query(survey, survey.sbet, *geoid, lever_arm=arm)
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_another_week(self):
        # SBETs do not name the week: of another one are the records at other times, or at other places.
        survey = self.survey("--seed", 7)
        later = survey.write_sbet("wrong.out", time=lambda t: t + 2 * 86400)
        self.assert_named("no record at the times of the points", survey, later)
        elsewhere = self.survey("--seed", 7, "--origin", "27.2,-80.1", name="other")
        self.assert_named("another week", survey, elsewhere.sbet)

    def test_x_and_y_in_the_next_zone_change_nothing(self):
        # Longitude and latitude stand beside them, and are what counts: a trajectory may be exported in any system.
        outputs = []
        for grid in ("utm17n", "utm16n"):
            trajectory = self.survey("--seed", 10, "--grid", grid, name=grid).ascii
            survey = self.survey("--seed", 10)
            survey.ascii.write_bytes(trajectory.read_bytes())
            result = self.query(survey, survey.ascii, "--details")
            self.assertEqual(result.returncode, 0, result.stderr)
            outputs.append((trajectory.read_bytes(), (self.folder / "out.las").read_bytes()))
        self.assertNotEqual(outputs[0][0], outputs[1][0])
        self.assertEqual(outputs[0][1], outputs[1][1])

    def test_a_wrong_water_level_is_named_beside_the_height_of_the_trajectory(self):
        # Returns cannot tell which of the two is wrong.
        survey = self.survey("--seed", 13, "--water-level", -25)
        survey.water_level = 25
        self.assert_named("--water-level is about 5[0-9] m too high", survey, survey.sbet)

    def test_another_flight(self):
        # Geometry cannot tell what another flight is; the message says what disagrees and by how much.
        survey = self.survey("--seed", 14)
        others = {"another place": ("--origin", "27.2,-80.1"), "another line": ("--course", 37),
                  "another height": ("--altitude", 480), "the way back": ("--course", 215)}
        for what, flags in others.items():
            with self.subTest(what):
                other = self.survey("--seed", 15, *flags, name="other")
                self.assert_named(r"[0-9] (k?m|degrees)\b", survey, other.sbet)


if __name__ == "__main__":
    programs.main()
