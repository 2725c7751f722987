"""Who includes whom: generator -> tables <- service -> proto, and nothing else.

Usage: includes_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
ROOMS = {
    "tables": {"tables"},
    "generator": {"generator", "tables"},
    "service": {"service", "tables", "proto"},
}
WIRE = ("albtpu/", "google/rpc/", "grpc/health/")  # What protoc makes of proto/.
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
QUOTED = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def room_of(header):
    """The folder of this tree that a header comes from; None if it comes from elsewhere."""
    if header.startswith(WIRE):
        return "proto"
    room = header.split("/")[0]
    return room if (SOURCE / room).is_dir() else None


class Includes(unittest.TestCase):
    def includes(self, room, pattern=INCLUDE):
        sources = [path for path in (SOURCE / room).rglob("*") if path.suffix in (".h", ".cc")]
        self.assertTrue(sources, f"no C++ in {room}")
        return [(path.relative_to(SOURCE), header)
                for path in sources for header in pattern.findall(path.read_text())]

    def test_follow_the_arrows_of_the_house(self):
        for room, allowed in ROOMS.items():
            for path, header in self.includes(room):
                self.assertIn(room_of(header), allowed | {None}, f"{path} includes {header}")

    def test_keep_client_and_server_apart(self):
        for room, other in (("service/server", "service/client/"), ("service/client", "service/server/")):
            for path, header in self.includes(room):
                self.assertFalse(header.startswith(other), f"{path} includes {header}")

    def test_keep_physics_out_of_the_service_and_the_wire_out_of_the_generator(self):
        foreign = {"generator": ("grpc", "google/protobuf"),
                   "tables": ("grpc", "google/protobuf", "fftw3", "Eigen/"),
                   "service": ("fftw3", "hdf5", "H5")}
        for room, headers in foreign.items():
            for path, header in self.includes(room):
                own = room_of(header) is not None
                self.assertFalse(not own and header.startswith(headers), f"{path} includes {header}")

    def test_name_own_headers_from_the_root_of_the_tree(self):
        for room in (*ROOMS, "tests"):
            for path, header in self.includes(room, QUOTED):
                elsewhere = header.endswith(".pb.h") or header.startswith("absl/")
                self.assertTrue(elsewhere or (SOURCE / header).is_file(), f"{path} includes {header}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
