"""The installed CMake package: its examples build outside of the tree, and agree with albtpu-query.

Usage: package_test.py CMAKE BUILD_FOLDER C_COMPILER CXX_COMPILER
"""

import csv
import io
import json
import re
import shutil
import subprocess
import sys
import unittest

from commands import make_folder, run
from serving import Server

CMAKE, BUILD, C_COMPILER, CXX_COMPILER = sys.argv[1:5]
PULSE = ("--wind-speed", "7", "--incidence", "12", "--azimuth", "30", "--footprint", "0.6", "--depth", "8")
LINE = ("--wind-speed", "7", "--footprint", "0.6", "--coverage", "p95")  # In addition to the two columns of the file.

PLUGIN = {
    "CMakeLists.txt": """
        cmake_minimum_required(VERSION 3.25)
        project(plugin LANGUAGES CXX)
        find_package(albtpu REQUIRED COMPONENTS tables)
        if(TARGET albtpu::client OR TARGET gRPC::grpc)
          message(FATAL_ERROR "only the component tables was requested")
        endif()
        add_library(plugin MODULE plugin.cc)
        target_link_libraries(plugin PRIVATE albtpu::tables)
        target_link_options(plugin PRIVATE -Wl,--no-undefined)
        """,
    # A header of the plug-in's own that has the name of one of ours.
    "tables/schema.h": "#error wrong header\n",
    "plugin.cc": """
        #include <albtpu/tables/column_query.h>
        #include <albtpu/tables/table_io.h>
        extern "C" bool Answers(const char* path) {
          const auto table = albtpu::ReadTable(path);
          if (table.ok()) albtpu::ColumnInterpolator(*table).Interpolate({}, {}, 0, 0, {});
          return table.ok();
        }
        """,
}


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = make_folder(cls.addClassCleanup, "albtpu package ")
        cls.prefix = cls.folder / "moved"
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", cls.folder / "installed"], check=True,
                       capture_output=True)
        (cls.folder / "installed").rename(cls.prefix)
        cls.table = cls.prefix / "share/albtpu/tables/survey.h5"

    def configure(self, source, *flags):
        """Returns the build folder and the result of CMake."""
        build = self.folder / "build" / source.name
        shutil.rmtree(build, ignore_errors=True)
        result = subprocess.run(
            [CMAKE, "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-GNinja",
             f"-DCMAKE_C_COMPILER={C_COMPILER}", f"-DCMAKE_CXX_COMPILER={CXX_COMPILER}", *flags],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return build, result

    def build(self, source, *flags):
        build, configured = self.configure(source, *flags)
        self.assertEqual(configured.returncode, 0, configured.stdout)
        built = subprocess.run([CMAKE, "--build", build], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True)
        self.assertEqual(built.returncode, 0, built.stdout)
        return build

    def run_program(self, *command, **variables):
        result = run(*command, environment=variables)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def query(self, *arguments):
        return self.run_program(self.prefix / "bin/albtpu-query", *arguments, "--table", self.table)

    def expected_line(self, line, *flags):
        """The answer of albtpu-query for the pulses of `line`: CSV of incidence, depth, THU and TVU."""
        pulses, answers = self.folder / "pulses.csv", self.folder / "answers.csv"
        rows = [row[:2] for row in csv.reader(io.StringIO(line))]
        with pulses.open("w") as file:
            csv.writer(file).writerows(rows)
        self.query("csv", pulses, answers, *LINE, *flags, "--overwrite")
        columns = ("incidence", "depth", "thu", "tvu")
        with answers.open() as file:
            return "".join(",".join(cells) + "\n" for cells in
                           [columns, *([row[name] for name in columns] for row in csv.DictReader(file))])

    def test_examples_agree_with_the_command_line(self):
        build = self.build(self.prefix / "share/doc/albtpu/clients/cpp")
        one, from_table = self.run_program(build / "table", self.table).split("\n", 1)
        # A table answers for the water that it was made in, a server for sea water.
        in_its_water = ("--water-index", "1.33")
        pulse = json.loads(self.query("pulse", *PULSE, *in_its_water, "--coverage", "2sigma", "--json"))
        numbers = re.fullmatch(r"# INTERPOLATED: THU (\S+) m, TVU (\S+) m, 2 sigma", one)
        self.assertIsNotNone(numbers, one)
        # Single pulses are computed in double precision, columns in single precision.
        self.assertAlmostEqual(float(numbers[1]), pulse["thu"], delta=1e-5 * pulse["thu"])
        self.assertAlmostEqual(float(numbers[2]), pulse["tvu"], delta=1e-5 * pulse["tvu"])
        self.assertEqual(from_table, self.expected_line(from_table, *in_its_water))

        with Server(self.prefix / "bin/albtpu-serve", "--tables", str(self.table.parent)) as server:
            # A proxy that is not there is not asked for this machine.
            stamp, from_server = self.run_program(build / "ask", server.address,
                                                  http_proxy="http://127.0.0.1:9").split("\n", 1)
        self.assertIn(pulse["digest"], stamp)
        self.assertEqual(from_server, self.expected_line(from_server))

        lost = run(build / "ask", server.address)
        self.assertEqual(lost.returncode, 1)
        self.assertIn(server.address, lost.stderr)

    def test_component_tables_links_into_a_shared_object_without_grpc(self):
        source = self.folder / "plugin"
        for name, text in PLUGIN.items():
            (source / name).parent.mkdir(parents=True, exist_ok=True)
            (source / name).write_text(text)
        self.build(source, "-DCMAKE_DISABLE_FIND_PACKAGE_gRPC=ON", f"-DCMAKE_CXX_FLAGS=-I'{source}'")

    def test_component_client_names_the_missing_package(self):
        _, configured = self.configure(self.prefix / "share/doc/albtpu/clients/cpp",
                                       "-DCMAKE_DISABLE_FIND_PACKAGE_gRPC=ON")
        self.assertNotEqual(configured.returncode, 0)
        self.assertIn("install libgrpc++-dev", configured.stdout)

    def test_headers_include_only_installed_and_packaged_headers(self):
        include = self.prefix / "include"
        headers = list(include.rglob("*.h"))
        self.assertTrue(headers)
        for header in headers:
            for name in re.findall(r'^#include ["<](.+)[">]$', header.read_text(), re.MULTILINE):
                known = (include / name).is_file() or name.startswith("absl/") or re.fullmatch(r"\w+", name)
                self.assertTrue(known, f"{header.relative_to(include)} includes {name}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
