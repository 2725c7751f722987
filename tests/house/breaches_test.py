"""Each rule of the house finds the breach that is planted in a small tree, and nothing else."""

import pathlib
import tempfile
import unittest

import house
import rules

LAW = """
[rules]
levels = {"." = 2, "tests" = 3, "docker/overlays" = 3}
files_in_folder = 5
lines_in_file = 14
median_lines = 5
lines_in_room = 40
lines_in_readme = [2, 4]
left_to_rooms_toml = ["may use"]
tests_of_many_rooms = ["formats/flights"]
foreign_namespaces = ["std"]
[rules.namespaces]
sea = "albtpu"
config = "albtpu::config"
formats = "albtpu::formats"
programs = "albtpu::programs"
tests = "albtpu::testing"
[[rules.heavy_headers]]
headers = ["CLI/"]
rooms = ["programs", "tests"]
[[rules.keys]]
tables = ["config/keys.h", "sea/errors.h"]
shared = ["index"]
rooms = ["config", "sea", "programs"]

[rooms."sea"]
[rooms."config"]
uses = ["sea"]
[rooms."formats"]
uses = ["sea"]
[rooms."formats/las"]
uses = ["formats"]
[rooms."programs"]
uses = ["config", "formats/", "sea"]
libraries = ["CLI11"]

[libraries]
CLI11 = {headers = ["CLI/"], targets = ["CLI11::"]}
zlib = {headers = ["zlib.h"], targets = ["ZLIB::"]}
"""
README = "# A room\n\nBegin with its header.\n"


def header(namespace, *lines):
    return "\n".join(["// What this is.", "#pragma once", "#include <vector>", f"namespace {namespace} {{", *lines,
                      f"}}  // namespace {namespace}", ""])


TREE = {
    "rooms.toml": LAW,
    **{f"{room}/README.md": README for room in ("sea", "config", "formats", "formats/las", "programs")},
    "sea/CMakeLists.txt": "add_library(albtpu_sea sea.cc)\n",
    "sea/sea.h": header("albtpu", "class Sea;", "namespace inner { int depth(); }"),
    "sea/sea.cc": '#include "sea/sea.h"\n\nnamespace albtpu {\nnamespace {\nint hidden() { return \'}\'; }\n}\n}\n',
    "sea/errors.h": header("albtpu", "inline constexpr Source kSources[] = {",
                           '    {"scan", "degree", 5},  // {"scan", "degree", 6} in a comment',
                           '    {.name = "index", .unit = "1", .greatest = 0.1},', "};"),
    "config/keys.h": header("albtpu::config", "inline constexpr Key kWater[] = {",
                            '    {"index", "--water-index", "1", 1.3, 1.4},', '    {"kd", "", "1/m", 0.001, 10}};',
                            "inline constexpr Key kDatum[] = {", '    {"kd", "", "m", 0, kMost}};'),
    "formats/format.h": header("albtpu::formats", "struct Format {};") + (
        "namespace albtpu {\ntemplate <typename T> class Sea;\n}\nnamespace std {\nstruct hash {};\n}\n"),
    "formats/CMakeLists.txt": "albtpu_sources(sources . las)\nadd_library(albtpu_formats STATIC ${sources})\n",
    "formats/las/las.cc": '#include "formats/las/las.h"\n\nnamespace albtpu::formats {\nint bytes() { return 1; }\n}\n',
    "formats/las/las.h": '#include "formats/format.h"\n' + header("albtpu::formats::las", "int bytes();"),
    "programs/CMakeLists.txt": "add_executable(query main.cc)\ntarget_link_libraries(query albtpu_sea CLI11::CLI11)\n",
    "programs/flags.h": "#include <CLI/CLI.hpp>\n" + header("albtpu::programs", "int flags();"),
    "programs/main.cc": '#include "programs/flags.h"\n#include "sea/sea.h"\n\nint main() {\n  return 0;\n}\n',
    "tests/formats/las/las_test.cc": '#include "formats/las/las.h"\n' + header("albtpu::formats", "int test();"),
    "tests/formats/flights/flight.h": header("albtpu::testing", "int flight();"),
    "docker/overlays/volume/kustomization.yaml": "resources: []\n",
    "build/CMakeCache.txt": "",
    "build/made.h": "a line\n" * 50,
}


def changed(path, old, new):
    assert old in TREE[path], path
    return {path: TREE[path].replace(old, new)}


def broken_rules(files):
    """What breaks each rule that is broken."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        tree = house.Tree(folder)
        broken = {rule: list(rule(tree)) for rule in rules.held(tree.law)}
        return {rule: breaches for rule, breaches in broken.items() if breaches}


class SmallTree(unittest.TestCase):
    broken = set()

    @classmethod
    def tearDownClass(cls):
        assert cls.broken == set(rules.RULES), f"not tried: {set(rules.RULES) - cls.broken}"

    def assert_breach(self, planted, message):
        found = broken_rules({**TREE, **planted})
        self.assertEqual(list(found.values()), [[message]])
        self.broken.update(found)

    def test_keeps_all_rules(self):
        self.assertEqual(broken_rules(TREE), {})

    def test_has_no_rule_that_nothing_holds(self):
        with self.assertRaisesRegex(ValueError, "no rule takes lines_in_a_file"):
            broken_rules({**TREE, **changed("rooms.toml", "lines_in_file", "lines_in_a_file")})

    def test_is_seen_to_include_what_the_law_forbids(self):
        self.assert_breach({"formats/format.h": '#include "config/keys.h"\n' + TREE["formats/format.h"]},
                           "formats/format.h includes config/keys.h: rooms.toml does not let formats use config")
        self.assert_breach({"sea/sea.h": '#include "sea/no.h"\n' + TREE["sea/sea.h"]},
                           "sea/sea.h includes sea/no.h, which does not exist")

    def test_is_seen_to_have_code_in_no_room(self):
        self.assert_breach({"attic/sea.h": TREE["sea/sea.h"]}, "attic/sea.h lies in no room of rooms.toml")

    def test_is_seen_to_use_libraries_that_the_law_forbids(self):
        self.assert_breach({"sea/sea.cc": "#include <zlib.h>\n" + TREE["sea/sea.cc"]},
                           "sea/sea.cc includes zlib.h: rooms.toml does not let sea use zlib")
        self.assert_breach({"sea/sea.cc": "#include <png.h>\n" + TREE["sea/sea.cc"]},
                           "sea/sea.cc includes png.h, of no library in rooms.toml")

    def test_is_seen_to_link_what_the_law_forbids(self):
        self.assert_breach(changed("programs/CMakeLists.txt", "CLI11::CLI11", "ZLIB::ZLIB"),
                           "query links ZLIB::ZLIB: rooms.toml does not let programs use zlib")
        linked = TREE["sea/CMakeLists.txt"] + "target_link_libraries(albtpu_sea PNG::PNG)\n"
        self.assert_breach({"sea/CMakeLists.txt": linked},
                           "albtpu_sea links PNG::PNG, of no library in rooms.toml")

    def test_is_seen_to_compile_a_source_twice_or_never(self):
        self.assert_breach({"programs/more.cc": TREE["programs/main.cc"]}, "programs/more.cc is compiled by 0 targets")
        self.assert_breach({"formats/las/las_main.cc": TREE["formats/las/las.cc"]},
                           "formats/las/las_main.cc is compiled by 0 targets")
        left_out = 'list(FILTER sources EXCLUDE REGEX "/la(s|z)\\\\.cc$")\nadd_'
        self.assert_breach(changed("formats/CMakeLists.txt", "add_", left_out),
                           "formats/las/las.cc is compiled by 0 targets")
        twice = TREE["programs/CMakeLists.txt"] + "add_executable(twice main.cc)\n"
        self.assert_breach({"programs/CMakeLists.txt": twice},
                           "programs/main.cc is compiled by 2 targets")

    def test_is_seen_to_have_heavy_headers_in_headers(self):
        law = TREE["rooms.toml"].replace('[rooms."sea"]', '[rooms."sea"]\nlibraries = ["CLI11"]')
        self.assert_breach({"rooms.toml": law, "sea/sea.h": "#include <CLI/App.hpp>\n" + TREE["sea/sea.h"]},
                           "sea/sea.h includes CLI/App.hpp: among headers only those of programs, tests may")
        source = {"sea/sea.cc": "#include <CLI/App.hpp>\n" + TREE["sea/sea.cc"]}
        self.assertEqual(broken_rules({**TREE, "rooms.toml": law} | source), {})

    def test_is_seen_to_run_in_circles(self):
        self.assert_breach({"sea/errors.h": '#include "sea/sea.h"\n' + TREE["sea/errors.h"],
                            "sea/sea.cc": '#include "sea/errors.h"\n' + TREE["sea/sea.cc"]},
                           "sea/errors, sea/sea include each other")
        self.assert_breach(changed("rooms.toml", '[rooms."sea"]', '[rooms."sea"]\nuses = ["programs"]'),
                           "rooms.toml lets config, programs, sea use each other")

    def test_is_seen_to_open_namespaces_of_other_rooms(self):
        self.assert_breach(changed("sea/sea.cc", "namespace albtpu {", "namespace albtpu::formats {"),
                           "sea/sea.cc:3 opens albtpu::formats: expected albtpu")
        self.assert_breach(changed("sea/sea.h", "namespace inner", "namespace config"),
                           "sea/sea.h:6 opens albtpu::config: expected albtpu")
        self.assert_breach(changed("config/keys.h", "namespace albtpu::config", "namespace albtpu"),
                           "config/keys.h:4 opens albtpu: expected albtpu::config")
        self.assert_breach(changed("formats/format.h", "namespace std", "namespace tbb"),
                           "formats/format.h:10 opens tbb: expected albtpu::formats")
        self.assert_breach(changed("formats/format.h", "class Sea;", "class Sea {};"),
                           "formats/format.h:7 opens albtpu: expected albtpu::formats")
        self.assert_breach(changed("tests/formats/flights/flight.h", "albtpu::testing", "albtpu::programs"),
                           "tests/formats/flights/flight.h:4 opens albtpu::programs: "
                           "expected albtpu::formats or albtpu::testing")

    def test_is_seen_to_declare_keys_twice(self):
        for planted in ('Key key = {"kd", "1/m", 0.01, 5};', 'keys.Number("kd", 0.01, kMost, "1/m");',
                        'Key key = {"kd", "--kd", kAttenuation};', 'Key k = {.key = "kd", .unit = "1/m", .most = 1};'):
            self.assert_breach({"programs/main.cc": TREE["programs/main.cc"] + planted},
                               "programs/main.cc:7 declares the range of 'kd': only config/keys.h, sea/errors.h may")
        word = changed("config/keys.h", '{"kd", "", "1/m", 0.001, 10}', '{"bias", "", kWords}, {"bias", "", kWords}')
        self.assert_breach(word, "config/keys.h:7 declares the key 'bias', which config/keys.h declares, too")
        self.assert_breach({"programs/main.cc": TREE["programs/main.cc"] +
                            'app.add_option("--water-index")\n  ->check(NumberIn(1.2, 1.5));'},
                           "programs/main.cc:7 gives --water-index a range, which config/keys.h declares")
        self.assert_breach(changed("sea/errors.h", '"scan", "degree", 5}', '"kd", "1/m", 5}'),
                           "sea/errors.h:6 declares the key 'kd', which config/keys.h declares, too")
        self.assert_breach(changed("config/keys.h", '"index", "--water-index", "1"', '"kd", "--water-index", "1"'),
                           "config/keys.h:7 declares the key 'kd', which config/keys.h declares, too")
        self.assert_breach(changed("rooms.toml", '["index"]', "[]"),
                           "sea/errors.h:7 declares the key 'index', which config/keys.h declares, too")
        self.assert_breach({"sea/errors.h": header("albtpu")}, "sea/errors.h: no key was found there")

    def test_is_seen_to_be_deep_or_crowded(self):
        self.assert_breach({"sea/waves/deep/c.txt": ""}, "sea/waves/deep lies 3 levels deep: 2 at most")
        self.assert_breach({"tests/sea/waves/deep/c.txt": ""}, "tests/sea/waves/deep lies 4 levels deep: 3 at most")
        self.assert_breach({"sea/more.txt": "", "sea/most.txt": ""}, "sea holds 7 files: 5 at most")

    def test_is_seen_to_have_files_that_are_too_long_or_slivers(self):
        self.assert_breach({"sea/sea.cc": TREE["sea/sea.cc"] + "\n" * 8},
                           "sea/sea.cc has 15 lines: 14 at most, split it")
        slivers = {f"clients/{folder}/{file}.py": "import sys\n" for folder in ("one", "two") for file in range(5)}
        self.assert_breach(slivers, "the median of the product's files is 1 lines: 5 at least, a class lives with its "
                                    "helpers")

    def test_is_seen_to_be_a_tower(self):
        self.assert_breach({f"programs/more/{file}.py": "import sys\n" * 12 for file in range(3)},
                           "programs has 49 lines: 40 at most")

    def test_is_seen_to_have_tests_of_no_room(self):
        self.assert_breach({"tests/formats/laz/laz_test.cc": TREE["tests/formats/las/las_test.cc"]},
                           "tests/formats/laz mirrors no room")

    def test_is_seen_to_have_no_readme_or_a_long_one(self):
        self.assert_breach({"sea/README.md": "# A room\n"}, "sea/README.md has 1 lines: 2 to 4 expected")
        without = {path: text for path, text in TREE.items() if path != "sea/README.md"}
        self.assertEqual(list(broken_rules(without).values()), [["sea has no README.md"]])
        self.assert_breach({"sea/README.md": "# A room\n\nThe root may\nuse `tables`.\n"},
                           "sea/README.md says 'may use': rooms.toml says what a room may use")


if __name__ == "__main__":
    unittest.main(verbosity=2)
