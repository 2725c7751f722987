"""The committed messages and stubs are those that protoc and grpc_python_plugin generate from the .proto files.

Usage: stubs_test.py PROTO_FOLDER PACKAGE_FOLDER [--write]

--write generates them anew.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

PROTO, PACKAGE = map(pathlib.Path, sys.argv[1:3])
STUBS = PACKAGE / "src/albtpu/v1"


def make_stubs(output):
    protos = sorted(PROTO.glob("albtpu/v1/*.proto"))
    subprocess.run(["protoc", "-I", PROTO, f"--python_out={output}", f"--pyi_out={output}", *protos],
                   check=True)
    services = [proto for proto in protos if "\nservice " in proto.read_text()]
    subprocess.run(["protoc", "-I", PROTO, f"--grpc_out={output}",
                    "--plugin=protoc-gen-grpc=/usr/bin/grpc_python_plugin", *services], check=True)
    return {path.name: path.read_text() for path in pathlib.Path(output, "albtpu/v1").iterdir()}


class Stubs(unittest.TestCase):
    def test_match_the_proto(self):
        with tempfile.TemporaryDirectory() as output:
            made = make_stubs(output)
        committed = {path.name: path.read_text() for path in STUBS.iterdir() if "_pb2" in path.stem}
        self.assertEqual(sorted(made), sorted(committed))
        for name, text in made.items():
            self.assertEqual(committed[name], text, f"{name} is out of date: run this test with --write")


if __name__ == "__main__":
    if sys.argv[3:] == ["--write"]:
        make_stubs(PACKAGE / "src")
    else:
        unittest.main(argv=sys.argv[:1], verbosity=2)
