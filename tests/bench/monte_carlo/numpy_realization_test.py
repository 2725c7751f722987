"""The NumPy peer agrees with the scalar walk.

Usage: numpy_realization_test.py BEAM_CASE_SURFACE
"""

import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import numpy_realization as peer  # noqa: E402

PROGRAM = sys.argv[1]


class NumpyRealization(unittest.TestCase):
    def test_puts_the_spot_where_the_scalar_walk_does(self):
        for incidence in (0, 20):
            case = peer.BeamCase(PROGRAM, 96, incidence)
            triangulation = peer.triangulate(case.facts["points"], case.facts["spacing"])
            spots = peer.trace(case, triangulation, case.heights)
            # One of the 10 000 rays may meet an edge within rounding and take either facet.
            np.testing.assert_allclose(spots, case.facts["spots"], rtol=0, atol=1e-4 * case.depths.max())

    def test_draws_the_sea_of_the_patch(self):
        case = peer.BeamCase(PROGRAM, 48, 0)
        random = np.random.default_rng(1)
        variances = [peer.draw(case, random).var() for _ in range(400)]
        power = case.power.sum() * 2 - case.power[:, 0].sum()
        self.assertAlmostEqual(np.mean(variances), power, delta=4 * np.std(variances) / 20)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
