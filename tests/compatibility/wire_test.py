"""Clients and servers of earlier versions and of this one understand each other, by recorded messages and programs.

Usage: wire_test.py PYTHON_PACKAGE NAME=PATH...      albtpu_serve and albtpu_query
"""

import pathlib
import shutil
import sys
import unittest

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "programs/query"))
from runs import SERVED, VERSIONS, copy_input, make, python_answers  # noqa: E402

import grpc  # noqa: E402
from google.protobuf import descriptor_pb2  # noqa: E402

import differences  # noqa: E402
import wire  # noqa: E402
from commands import FolderTest  # noqa: E402
from serving import Server, connect  # noqa: E402

PACKAGE = sys.argv[1]
PATHS = dict(argument.split("=", 1) for argument in sys.argv[2:])
SERVE, QUERY = PATHS["albtpu_serve"], PATHS["albtpu_query"]


def descriptors():
    """The .proto files of this version, as the package has them; a test of the package compares these with proto/."""
    files = {}

    def add(file):
        files[file.name] = file
        for imported in file.dependencies:
            add(imported)
    for service in wire.SERVICES.values():
        add(service.file)
    found = descriptor_pb2.FileDescriptorSet()
    for file in files.values():
        file.CopyToProto(found.file.add())
    return found


class Wire(FolderTest):
    def serve(self, version):
        server = Server(SERVE, "--tables", version / "tables")
        self.addCleanup(server.__exit__)
        return server

    def test_nothing_of_the_proto_files_was_removed(self):
        for version in VERSIONS:
            recorded = descriptor_pb2.FileDescriptorSet.FromString((version / "wire.descriptors").read_bytes())
            self.assertEqual(wire.removed(recorded, descriptors()), [])

    def test_a_removed_field_is_seen(self):
        changed = descriptors()
        message = next(each for file in changed.file for each in file.message_type if each.name == "Pulse")
        del message.field[-1]
        message.field[0].number = 99
        found = "; ".join(wire.removed(descriptors(), changed))
        self.assertRegex(found, r"\Aalbtpu.v1.Pulse.depth: .+, now gone; "
                                r"albtpu.v1.Pulse.wind_speed: .+, now 99 [^;]+\Z")

    def test_requests_get_the_answers_of_then(self):
        for version in VERSIONS:
            with connect(self.serve(version).address) as channel:
                for path, request, response in wire.load(version / "wire"):
                    with differences.corrected():
                        self.assert_answered(version, channel, path, request, response)
                    # What answered then was at the index of the table, 1.33.
                    asked = wire.parse(wire.method_of(path).input_type, request)
                    if path.endswith("/QueryBudget") or not wire.ask_for_index(asked, 1.33):
                        continue
                    self.assert_answered(version, channel, path, asked.SerializeToString(), response)

    def assert_answered(self, version, channel, path, request, response):
        kind = wire.method_of(path).output_type
        try:
            answer = next(channel.stream_stream(path)(iter([request])))
        except grpc.RpcError as error:
            self.fail(f"{path} of {version.name}: {error.code()} {error.details()}")
        # The digest of a sea, and its file, are those of one version and instruction set.
        found = differences.of_messages(wire.parse(kind, response), wire.parse(kind, answer),
                                        ignored=("digest", "file", "refractive_index", "attributes", "campaign"))
        self.assertEqual(list(found), [], path)

    def test_the_python_client_of_then_works_with_the_server_of_now(self):
        for version in VERSIONS:
            answers = python_answers(self.serve(version).address, {"PYTHONPATH": str(version / "python_client.zip")})
            self.assert_answers(version, answers)

    def test_the_python_client_of_now_works_with_the_server_of_then(self):
        for version in VERSIONS:
            with wire.Between(kept=wire.load(version / "wire")) as server:
                self.assert_answers(version, python_answers(server.address, {"PYTHONPATH": PACKAGE}))

    def test_albtpu_query_of_now_works_with_the_server_of_then(self):
        for version in VERSIONS:
            folder = self.folder / version.name
            copy_input(version, folder)
            shutil.rmtree(folder / "tables")
            with wire.Between(kept=wire.load(version / "wire")) as server:
                make(QUERY, folder, SERVED, "--server", server.address)
            for name in ("answers.csv", "total_answers.csv", "pulse.json", "waves.json", "total.json"):
                with differences.corrected():
                    self.assertEqual(differences.of_files(version / name, folder / name), [])

    def assert_answers(self, version, answers):
        recorded = differences.read_json(version / "python.json")
        with differences.corrected():
            self.assertEqual(list(differences.of_json(recorded, answers)), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
