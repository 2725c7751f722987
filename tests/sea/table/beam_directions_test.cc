#include "sea/table/beam_directions.h"

#include <gtest/gtest.h>

#include "sea/response/closed_form.h"
#include "tests/sea/table/table_seas.h"

namespace albtpu {
namespace {

void ExpectClose(double ours, double exact, double relative) { EXPECT_NEAR(ours, exact, relative * exact); }

// The slow twin traces each direction by itself. The bound is what five incidences and five azimuths leave open at 30
// degrees, under the widest footprint and in the narrowest sea; most are a hundred times closer.
TEST(BeamDirections, AgreeWithEachDirectionByItself) {
  constexpr double kRelative = 5e-4;
  const std::vector<double> incidences = {0, 0.01, 0.03, 0.07, 0.17, 0.3, 0.4, RadiansOfDegrees(30)};
  const std::vector<double> azimuths = {0, 0.7, 1.3, 2.1, 2.9}, footprints = {0.1, 0.6, 2.5, 6};
  std::vector<FootprintKernel> kernels;
  for (const double footprint : footprints) kernels.emplace_back(BeamProfile::kUniform, footprint);
  const BeamDirections directions(incidences, azimuths);
  for (const auto& [name, description] : TableSeas()) {
    SCOPED_TRACE(name);
    const SeaResponse sea(Describe(description).spectrum, kRefractiveIndex);
    const std::vector<BeamResponse> responses = directions.ResponsesOf(sea, kernels);
    for (std::size_t i = 0; i < incidences.size(); ++i) {
      for (std::size_t a = 0; a < azimuths.size(); ++a) {
        const std::vector<BeamResponse> direct = sea.AlongDirection(incidences[i], azimuths[a], kernels);
        for (std::size_t f = 0; f < footprints.size(); ++f) {
          SCOPED_TRACE(testing::Message() << incidences[i] << " " << azimuths[a] << " " << footprints[f]);
          const BeamResponse& exact = direct[f];
          const BeamResponse& ours = responses[(i * azimuths.size() + a) * footprints.size() + f];
          ExpectClose(ours.Thu(10), exact.Thu(10), kRelative);
          ExpectClose(ours.Tvu(10), exact.Tvu(10), kRelative);
          ExpectClose(ours.refraction_along_wind(), exact.refraction_along_wind(), kRelative);
          ExpectClose(ours.refraction_cross_wind(), exact.refraction_cross_wind(), kRelative);
          const Eigen::Matrix3d difference = ours.covariance_per_depth - exact.covariance_per_depth;
          EXPECT_LT(difference.norm(), kRelative * exact.covariance_per_depth.norm());
          EXPECT_LT((ours.mean_per_depth - exact.mean_per_depth).norm(), 1e-7);
          EXPECT_NEAR(ours.Thu(0), exact.Thu(0), 1e-6);
          EXPECT_EQ(ours.azimuth, exact.azimuth);
        }
      }
    }
  }
}

}  // namespace
}  // namespace albtpu
