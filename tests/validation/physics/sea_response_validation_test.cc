// The response theory against ray tracing: random beams on many seas.
//
// The waves that tracing draws are a sample of the spectrum in steps of wavenumber and direction. The covariance of
// their slopes is known, and its ratio to that of the sea is taken out. Tracing does not draw the waves shorter than
// its grid, whose mean effect it adds to the rays: on seas without such waves, where it is exact, the bounds are
// narrower.
//
// It tries a twelfth of the beams, or all of them. What it finds of each beam becomes a line of a CSV file, which
// validation/plots/response_theory.py draws:
//     ALBTPU_EVERY_BEAM=1 ALBTPU_CSV=FOLDER sea_response_validation_test
//     python3 validation/plots/draw.py FOLDER docs response_theory
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>

#include "absl/strings/str_format.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "generator/surface/discretization.h"
#include "sea/angle.h"
#include "sea/response/refraction.h"
#include "sea/response/sea_response.h"
#include "sea/sea_state.h"
#include "tests/validation/physics/response_seas.h"
#include "validation/studies/closed_form_ratio.h"

namespace albtpu {
namespace {

constexpr double kDepth = 20;  // m

bool EveryBeam() { return std::getenv("ALBTPU_EVERY_BEAM") != nullptr; }

// Two standard deviations of the drawn waves over those of the sea, in the limit of small slopes. Of vertical errors
// that holds for the share of the variance that is linear in the slopes, that of the closed form.
struct GridRatios {
  double along, cross, thu, tvu;
};

GridRatios RatiosOfGrid(const SeaState& sea, const SurfaceModel& drawn_by, const BeamOptions& beam, double n,
                        const BeamResponse& ours) {
  const auto passed = [&](double k, double psi) { return FootprintPower(beam, k, psi); };
  const Eigen::Matrix2d response = TangentResponse(beam.incidence, beam.azimuth, n);
  const Eigen::Matrix2d drawn = response * drawn_by.FacetSlopeCovariance(passed) * response.transpose();
  const Eigen::Matrix2d exact = response * SlopeCovariance(sea, passed) * response.transpose();
  const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
  const double refracted = StillWaterRefraction(beam.incidence, n);
  const double of_path = std::pow(2 * std::sin(refracted) * std::cos(refracted), 2);
  const double excess = of_path * azimuth.dot((drawn - exact) * azimuth);
  return {std::sqrt(drawn(0, 0) / exact(0, 0)), std::sqrt(drawn(1, 1) / exact(1, 1)),
          std::sqrt(drawn.trace() / exact.trace()),
          std::sqrt(1 + excess / std::pow(ours.Tvu(kDepth) / kDepth, 2))};
}

// The relative errors that are allowed besides standard errors.
struct Bound {
  double rms, each;
};
// Beams on the same surfaces share most of the random error of their biases: their rms is of few samples.
constexpr double kAny = std::numeric_limits<double>::infinity();

struct Tally {
  std::string name;
  Bound bound;
  double worst = 0, squares = 0, variances = 0;
  int count = 0;

  void Add(double ours, const Estimate& traced, const std::string& where, double k) {
    const double error = ours / traced.value - 1,
                 standard_error = traced.standard_error / std::abs(traced.value);
    EXPECT_LT(std::abs(error), bound.each + k * standard_error) << name << ": " << where;
    worst = std::max(worst, std::abs(error));
    squares += error * error;
    variances += standard_error * standard_error;
    ++count;
  }
  ~Tally() {
    if (count == 0) return;
    const double rms = std::sqrt(squares / count), standard_error = std::sqrt(variances / count);
    std::printf("%-13s rms %.2f %%, worst %.2f %%, standard error %.2f %%, %d beams\n", name.c_str(),
                100 * rms, 100 * worst, 100 * standard_error, count);
    EXPECT_LT(rms, std::hypot(bound.rms, standard_error)) << name;
  }
};

// What of all beams is compared, and how well it has to agree.
struct Tallies {
  Tally along, cross, thu, tvu, bias_along_beam, bias_vertical, thu_at_surface;
};

class Evidence {
 public:
  // In the folder ALBTPU_CSV, if there is one.
  explicit Evidence(const std::string& name) {
    const char* folder = std::getenv("ALBTPU_CSV");
    if (folder == nullptr) return;
    file_.open(std::filesystem::path(folder) / (name + ".csv"));
    file_ << "sea,incidence,azimuth,footprint,gaussian,refractive_index,seen,quantity,value,ratio,standard_"
             "error\n";
  }
  void Add(const std::string& beam, const char* quantity, double ours, const Estimate& traced) {
    file_ << beam
          << absl::StrFormat(",%s,%.6g,%.6f,%.6f\n", quantity, traced.value, ours / traced.value,
                             traced.standard_error / std::abs(traced.value));
  }

 private:
  std::ofstream file_;
};

struct ComparisonEffort {
  int finer = 1;  // times as many points and rays along the footprint as are chosen by default
  int realizations = 300;
};

class Comparison {
 public:
  // Of so many `beams` in all.
  Comparison(const ComparisonEffort& effort, int beams, Tallies& tallies, Evidence evidence)
      : effort_(effort),
        k_(StandardErrorsFor(7 * beams)),
        tallies_(tallies),
        evidence_(std::move(evidence)) {}

  // Traces the beams of the case and compares each with the theory. `cell` chooses the random numbers.
  void Add(const NamedSea& named, SeaCase sea_case, std::uint32_t cell) {
    sea_case.sea.waves = named.waves;
    sea_case.depths = {0, kDepth};
    const SeaState sea(sea_case.sea);
    Discretization grid = ChooseDiscretization(sea, sea_case.beams);
    grid.points_per_footprint *= effort_.finer;
    grid.rays = std::min(effort_.finer * effort_.finer * grid.rays, kMostRays);
    sea_case.discretization = grid;
    const SeaCaseResult traced = Simulate(
        sea_case, {.realizations = effort_.realizations, .most_realizations = effort_.realizations}, 1, cell);
    const SurfaceModel drawn_by(sea, WidestBeam(sea_case.beams), grid);
    const SeaResponse theory(SpectrumOf(named), sea_case.refractive_index);
    const double all_slopes = SlopeCovariance(sea).trace();
    for (std::size_t b = 0; b < sea_case.beams.size(); ++b) {
      const BeamOptions& beam = sea_case.beams[b];
      const auto power = [&](double k, double psi) { return FootprintPower(beam, k, psi); };
      const std::string where = absl::StrFormat(
          "\"%s\",%.2f,%.1f,%.3f,%d,%.4f,%.4g", named.name, DegreesOfRadians(beam.incidence),
          DegreesOfRadians(beam.azimuth), beam.footprint, beam.profile == BeamProfile::kGaussian,
          sea_case.refractive_index, SlopeCovariance(sea, power).trace() / all_slopes);
      const BeamResponse ours = theory(beam);
      Compare(ours, RatiosOfGrid(sea, drawn_by, beam, sea_case.refractive_index, ours), traced.beams[b],
              where);
    }
  }

 private:
  void Compare(const BeamResponse& ours, const GridRatios& grid, const BeamUncertainty& traced,
               const std::string& where) {
    const auto add = [&](Tally& tally, double value, const Estimate& estimate, double least) {
      if (std::abs(estimate.value) < least) return;
      tally.Add(value, estimate, where, k_);
      evidence_.Add(where, tally.name.c_str(), value, estimate);
    };
    add(tallies_.along, ours.refraction_along_wind() * grid.along, traced.refraction_along_wind,
        RadiansOfDegrees(0.2));
    add(tallies_.cross, ours.refraction_cross_wind() * grid.cross, traced.refraction_cross_wind,
        RadiansOfDegrees(0.2));
    add(tallies_.thu, ours.Thu(kDepth) * grid.thu, traced.thu[1], 0);
    add(tallies_.tvu, ours.Tvu(kDepth) * grid.tvu, traced.tvu[1], 0.0005 * kDepth);
    add(tallies_.bias_along_beam, ours.BiasAlongBeam(kDepth), traced.bias_along_beam[1], 0.0005 * kDepth);
    add(tallies_.bias_vertical, ours.BiasVertical(kDepth), traced.bias_vertical[1], 0);
    add(tallies_.thu_at_surface, ours.Thu(0), traced.thu[0], 0.0005);
  }

  ComparisonEffort effort_;
  double k_;
  Tallies& tallies_;
  Evidence evidence_;
};

// Beams that share footprint, profile and refractive index are traced on the same surfaces.
constexpr int kFootprints = 6, kBeamsOfFootprint = 10;

SeaCase RandomBeams(bool gaussian, std::mt19937_64& bits) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(bits() >> 11);
  };
  SeaCase sea_case;
  sea_case.refractive_index = between(1.33, 1.345);
  const double footprint = 0.2 * std::exp(between(0, std::log(30)));
  for (int b = 0; b < kBeamsOfFootprint; ++b) {
    sea_case.beams.push_back({.incidence = b == 0 ? 0 : RadiansOfDegrees(between(0, 30)),
                              .azimuth = RadiansOfDegrees(between(0, 360)),
                              .footprint = footprint,
                              .profile = gaussian ? BeamProfile::kGaussian : BeamProfile::kUniform});
  }
  return sea_case;
}

void CompareRandomBeams(const std::vector<NamedSea>& seas, std::uint64_t seed, const ComparisonEffort& effort,
                        Tallies& tallies, const std::string& name) {
  Comparison comparison(effort, kFootprints * kBeamsOfFootprint * static_cast<int>(seas.size()), tallies,
                        Evidence(name));
  std::mt19937_64 bits(seed);
  for (int i = 0; i < static_cast<int>(seas.size()); ++i) {
    for (int f = 0; f < kFootprints; ++f) {
      SeaCase sea_case = RandomBeams(f % 3 == 1, bits);
      if (!EveryBeam()) {
        if (f != i % kFootprints) continue;
        sea_case.beams.resize(kBeamsOfFootprint / 2);
      }
      comparison.Add(seas[i], std::move(sea_case), i * kFootprints + f);
    }
  }
}

// The agreement to which the theory is held: relative, besides standard errors, in rms and for each beam.
TEST(SeaResponse, AgreesWithTracingOnManySeas) {
  if (!HasBuoy()) std::printf("no measured spectrum: the sample files of buoys are not there\n");
  Tallies tallies{{"along", {0.0035, 0.02}},       {"cross", {0.0035, 0.02}},
                  {"thu", {0.003, 0.015}},         {"tvu", {0.005, 0.025}},
                  {"bias along", {kAny, 0.01}},    {"bias vertical", {0.01, 0.01}},
                  {"thu at depth 0", {0.03, 0.06}}};
  CompareRandomBeams(ResponseSeas(HasBuoy()), 20261123, {}, tallies, "many_seas");
}

TEST(SeaResponse, AgreesWithTracingWhoseGridHoldsAllWaves) {
  Tallies tallies{{"along", {0.001, 0.003}},       {"cross", {0.001, 0.003}},
                  {"thu", {0.001, 0.003}},         {"tvu", {0.003, 0.003}},
                  {"bias along", {kAny, 0.005}},   {"bias vertical", {kAny, 0.005}},
                  {"thu at depth 0", {0.01, 0.02}}};
  CompareRandomBeams(ResolvedSeas(), 20261124, {.finer = 2, .realizations = 500}, tallies, "resolved_seas");
}

// The beams on which the theory differs most from the table of Apel's seas (survey_table_validation_test): by 2.0 % in
// refraction along the wind, 1.5 % across it, 1.4 % in THU and 2.7 % in TVU.
TEST(SeaResponse, AgreesWithTracingOnAFinerGridWhereTheTableDiffersMost) {
  struct Node {
    double wind_speed, fetch, incidence, azimuth, footprint;
  };
  constexpr Node kNodes[] = {{4.1, 1170, 25, 24, 1.45},
                             {15, 1170, 25, 90, 0.832},
                             {2.5, 15700, 14, 24, 4.39},
                             {15, 1310, 1, 0, 0.212}};
  Tallies tallies{{"along", {0.003, 0.003}},       {"cross", {0.003, 0.003}},
                  {"thu", {0.003, 0.003}},         {"tvu", {0.003, 0.003}},
                  {"bias along", {kAny, 0.003}},   {"bias vertical", {0.003, 0.003}},
                  {"thu at depth 0", {0.03, 0.06}}};
  Comparison comparison({.finer = 4, .realizations = 1000}, static_cast<int>(std::size(kNodes)), tallies,
                        Evidence("worst_nodes"));
  std::uint32_t cell = 0;
  for (const Node& node : kNodes) {
    SeaCase sea_case;
    sea_case.beams = {{.incidence = RadiansOfDegrees(node.incidence),
                       .azimuth = RadiansOfDegrees(node.azimuth),
                       .footprint = node.footprint}};
    comparison.Add({"Apel", {node.wind_speed, node.fetch, &kApelModel}}, std::move(sea_case), cell++);
  }
}

}  // namespace
}  // namespace albtpu
