#include "sea/response/compiled_sea.h"

#include <gtest/gtest.h>

#include "sea/response/refraction.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

TEST(CompiledSea, HoldsEachBeamAsIfItWereAlone) {
  const std::vector<double> incidences = {0, 0.1, 0.4}, azimuths = {0, 1, 2.5}, footprints = {0.2, 1, 4};
  for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian}) {
    const SeaResponse sea(CrossingSea(), kRefractiveIndex);
    const CompiledSea compiled(sea, BeamGrid(incidences, azimuths, footprints, profile));
    for (std::size_t i = 0; i < incidences.size(); ++i) {
      for (std::size_t a = 0; a < azimuths.size(); ++a) {
        for (std::size_t f = 0; f < footprints.size(); ++f) {
          const BeamResponse alone = sea({.incidence = incidences[i],
                                          .azimuth = azimuths[a],
                                          .footprint = footprints[f],
                                          .profile = profile});
          const BeamResponse& ours = compiled.At(i, a, f);
          EXPECT_EQ(ours.azimuth, alone.azimuth);
          // At nadir the axes of the quadrature turn with the azimuth; longer blocks of products round otherwise.
          EXPECT_LT((ours.covariance_per_depth - alone.covariance_per_depth).norm(),
                    1e-5 * alone.covariance_per_depth.norm());
          EXPECT_NEAR(ours.Thu(0), alone.Thu(0), 1e-4 * alone.Thu(0));
          EXPECT_NEAR(ours.BiasAlongBeam(1), alone.BiasAlongBeam(1), 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace albtpu
