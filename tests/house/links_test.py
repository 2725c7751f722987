"""What the programs load: no gRPC where tables are made, no FFTW (which is GPL) where they are served.

Usage: links_test.py ALBTPU_GENERATE ALBTPU_SERVE ALBTPU_QUERY
"""

import re
import subprocess
import sys
import unittest

GENERATE, SERVE, QUERY = sys.argv[1:4]


def libraries(program):
    """All shared libraries that `program` loads, those of its libraries too."""
    loaded = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    return re.findall(r"(lib[\w+-]+)\S*\.so", loaded)


class Programs(unittest.TestCase):
    def assert_loads(self, program, wanted, unwanted):
        names = libraries(program)
        for name in wanted:
            self.assertIn(name, names, program)
        for name in names:
            self.assertFalse(name.startswith(unwanted), f"{program} loads {name}")

    def test_the_generator_loads_no_grpc(self):
        self.assert_loads(GENERATE, ["libfftw3"], ("libgrpc", "libprotobuf"))

    def test_the_service_loads_no_fftw(self):
        self.assert_loads(SERVE, ["libgrpc++"], ("libfftw3",))

    def test_the_client_loads_no_fftw(self):
        self.assert_loads(QUERY, ["libgrpc++"], ("libfftw3",))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
