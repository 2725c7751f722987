// The response theory against ray tracing. It tries a twelfth of the beams of the report, or all of them:
//     ALBTPU_EVERY_BEAM=1 physics_validation_test --gtest_filter=SeaResponse.*
// The twelfth that the quick report compares is tested by tests/e2e/validate_test.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "sea/angle.h"
#include "sea/files/sea_file.h"
#include "sea/spectra/described_sea.h"
#include "sea/table/sea_table.h"
#include "sea/table/table_at_index.h"
#include "tables/query/interpolation.h"
#include "tests/every_case.h"
#include "validation/studies/closed_form_ratio.h"
#include "validation/studies/response_comparison.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

constexpr std::uint64_t kSeed = 20261123;

bool EveryBeam() { return std::getenv("ALBTPU_EVERY_BEAM") != nullptr; }

void ExpectAgreement(const std::vector<Comparison>& comparisons) {
  EXPECT_GE(std::count_if(comparisons.begin(), comparisons.end(),
                          [](const Comparison& found) { return found.verdict == Verdict::kAgrees; }),
            5);
  for (const Comparison& found : comparisons) {
    std::printf("%s: %.3f %%, standard error %.3f %%, %s\n", found.quantity.c_str(), found.ours, found.standard_error,
                found.basis.c_str());
    EXPECT_NE(found.verdict, Verdict::kDiffers) << found.quantity << ": " << found.basis;
  }
}

TEST(SeaResponse, AgreesWithTracingInAllThatTheReportCompares) {
  if (!EveryBeam()) {
    GTEST_SKIP() << "ALBTPU_EVERY_BEAM=1 runs it; the quick report has a twelfth";
  }
  const absl::StatusOr<Study> study = ResponseTheoryStudy({.published = {}, .quick = false, .seed = kSeed});
  ExpectAgreement(study->comparisons);
}

TEST(SeaResponse, AgreesWithTracingOnAMeasuredSea) {
  const std::filesystem::path buoy = std::filesystem::path(SEA_SAMPLES) / "41010.data_spec";
  if (!std::filesystem::exists(buoy)) {
    GTEST_SKIP() << buoy << " is not there";
  }
  const ResponseSea sea = ResponseSeaOf("NDBC 41010", Describe(ReadSeaFile(buoy)->records.front()).spectrum);
  ExpectAgreement(VerdictsOnManySeas(CompareRandomBeams({sea}, !EveryBeam(), {}, kSeed)));
}

// The same surfaces are traced in both waters, so that their random errors cancel in the ratios.
TEST(TableAtIndex, ScalesAsTracingDoes) {
  const WindSea waves{.wind_speed_10m = 7, .model = &kElfouhailyModel};
  SeaCase sea_case;
  sea_case.sea = {.waves = waves};
  for (const double incidence : {0, 10, 20}) {
    sea_case.beams.push_back(
        {.incidence = RadiansOfDegrees(incidence), .azimuth = RadiansOfDegrees(0), .footprint = 0.6});
  }
  sea_case.depths = {10};
  const auto traced = [&](double index) {
    sea_case.refractive_index = index;
    return Simulate(sea_case, {.realizations = 256, .most_realizations = 256}, kSeed, 0).beams;
  };
  const UncertaintyTable table =
      SeaCompiler().Compile(SeaDescription{.wind_speed_10m = 7}, INFINITY, kRefractiveIndex).value();
  const std::vector<BeamUncertainty> before = traced(kRefractiveIndex);
  for (const double index : {1.34, 1.345, 1.36}) {
    const UncertaintyTable scaled = AtIndex(table, index);
    const std::vector<BeamUncertainty> after = traced(index);
    for (std::size_t b = 0; b < before.size(); ++b) {
      const Pulse pulse{.incidence = static_cast<float>(10 * b), .azimuth = 0, .footprint = 0.6f, .depth = 10};
      const PulseUncertainty from = Interpolate(table, pulse), to = Interpolate(scaled, pulse);
      const auto same = [&](Quantity quantity, double ratio) {
        std::printf("index %g, %zu degrees, %s: scaled over traced %.5f\n", index, 10 * b,
                    std::string(Describe(quantity).name).c_str(), to[quantity] / from[quantity] / ratio);
        EXPECT_NEAR(to[quantity] / from[quantity] / ratio, 1, 1e-3);
      };
      same(Quantity::kRefractionAlongWind,
           after[b].refraction_along_wind.value / before[b].refraction_along_wind.value);
      same(Quantity::kRefractionCrossWind,
           after[b].refraction_cross_wind.value / before[b].refraction_cross_wind.value);
      same(Quantity::kThu, after[b].thu[0].value / before[b].thu[0].value);
      same(Quantity::kTvu, after[b].tvu[0].value / before[b].tvu[0].value);
      same(Quantity::kBiasVertical, after[b].bias_vertical[0].value / before[b].bias_vertical[0].value);
    }
  }
}

struct Node {
  double wind_speed, fetch, incidence, azimuth, footprint;
};

void ExpectAgreement(const std::vector<Node>& nodes, const SpectrumModel& model, const TracingEffort& effort) {
  std::vector<ComparedBeam> beams;
  for (const Node& node : nodes) {
    SeaCase sea_case;
    sea_case.beams = {{.incidence = RadiansOfDegrees(node.incidence),
                       .azimuth = RadiansOfDegrees(node.azimuth),
                       .footprint = node.footprint}};
    const ResponseSea sea = ResponseSeaOf(std::string(model.key), WindSea{node.wind_speed, node.fetch, &model});
    beams.push_back(CompareBeams(sea, sea_case, effort, kSeed, static_cast<std::uint32_t>(beams.size())).front());
  }
  const double k = StandardErrorsFor(static_cast<int>(kComparedQuantities.size() * beams.size()));
  for (const ComparedQuantity quantity : kComparedQuantities) {
    const Agreement found = AgreementOf(beams, quantity, k);
    std::printf("%s: %.3f %%, standard error %.3f %%, worst %.3f %%\n", Name(quantity), 100 * found.rms,
                100 * found.standard_error, 100 * found.worst);
    EXPECT_LE(found.worst_beyond, quantity == ComparedQuantity::kThuAtSurface ? 0.06 : 0.003) << Name(quantity);
  }
}

TEST(SeaResponse, AgreesWithTracingOnAFineGridOverYoungAndSteepSeas) {
  ExpectAgreement(
      {{4.1, 1170, 25, 24, 1.45}, {15, 1170, 25, 90, 0.832}, {2.5, 15700, 14, 24, 4.39}, {15, 1310, 1, 0, 0.212}},
      kApelModel, {.realizations = albtpu::testing::EveryCase() ? 1000 : 500, .finer = 4});
}

// The nodes of survey.h5 that differ most in refraction along and across, THU and TVU (survey_table_validation_test):
// by their random errors alone, of which more realizations leave less.
TEST(SeaResponse, AgreesWithTracingWhereTheTableDiffersMost) {
  ExpectAgreement(
      {{1.2, 5200, 25, 22, 0.95}, {2.55, 180e3, 25, 79, 4.4}, {2.1, 430e3, 25, 0, 4.4}, {3.8, 2350, 25, 79, 3.85}},
      kElfouhailyModel, {.realizations = albtpu::testing::EveryCase() ? 4000 : 2000});
}

}  // namespace
}  // namespace albtpu
