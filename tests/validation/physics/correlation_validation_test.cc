// The correlation of pulses against tracing through seas that move: many pulses in each realization. A quick run tries
// two seas; ALBTPU_EVERY_CASE=1 all twelve, with more realizations.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include "sea/angle.h"
#include "sea/correlation/pulse_correlation.h"
#include "sea/samples.h"
#include "tests/every_case.h"
#include "tests/validation/physics/moving_sea.h"
#include "validation/studies/response_comparison.h"

namespace albtpu {
namespace {

constexpr std::uint64_t kMovingSeaSeed = 20261126;
constexpr int kRays = 60;
constexpr int kSeaCount = 12;  // of ResponseSeas()

using albtpu::testing::EveryCase;

struct Lag {
  Eigen::Vector2d apart;
  std::size_t time;  // in kTimes
};
const std::vector<double> kTimes = {0, 0.1, 0.3, 0.8};  // s
const std::array<Lag, 8> kLags = {{{{0.5, 0}, 0},
                                   {{0, 1}, 0},
                                   {{-1.5, 1.5}, 0},
                                   {{4, -1}, 0},
                                   {{0, 0}, 1},
                                   {{0.7, 0}, 2},
                                   {{-0.7, 0}, 2},
                                   {{0.5, -1}, 3}}};
constexpr std::array kSides = {0.5, 1.0, 2.0, 4.0, 8.0};  // m
constexpr int kPulses = 6;                                // in a cell

struct PulsePair {
  BeamOptions beam;
  WaveMotion motion;
  double orientation;  // of cells
};

PulsePair CaseOf(int sea) {
  constexpr std::array kIncidence = {0.0, 20.0, 10.0, 20.0};
  const bool gaussian = sea % 3 == 1;
  PulsePair made{{.incidence = RadiansOfDegrees(kIncidence[sea % 4]),
                  .azimuth = RadiansOfDegrees(50.0 * sea),
                  .footprint = gaussian ? 0.5 + 0.1 * (sea % 2) : 0.6 + 0.2 * (sea % 3),
                  .profile = gaussian ? BeamProfile::kGaussian : BeamProfile::kUniform},
                 {.travel = sea % 4 == 3 ? WaveTravel::kBothWays : WaveTravel::kOneWay},
                 0.3 * sea};
  return made;
}

// PulseSums over the pulses of some realizations, and the covariances and variances that follow.
constexpr int kErrors = 3;  // horizontal, vertical, height
using Values = Eigen::Array<double, kErrors, 1>;
Values Product(const TracedPulse& a, const TracedPulse& b) {
  return {a[0] * b[0] + a[1] * b[1], a[2] * b[2], a[3] * b[3]};
}

struct PulseSums {
  double pulses = 0, pairs = 0, cells = 0;
  TracedPulse mean = TracedPulse::Zero();
  // Products of two pulses and squares of means over cells, each with the mean square of the same pulses: a ratio of
  // both varies far less than each of them.
  std::array<Values, kLags.size()> pair, square_of_pair;
  std::array<Values, kSides.size()> cell, square_of_cell;

  PulseSums() {
    for (auto* each : {&pair, &square_of_pair}) each->fill(Values::Zero());
    for (auto* each : {&cell, &square_of_cell}) each->fill(Values::Zero());
  }
  void Add(const PulseSums& other, double sign = 1) {
    pulses += sign * other.pulses;
    pairs += sign * other.pairs;
    cells += sign * other.cells;
    mean += sign * other.mean;
    for (std::size_t i = 0; i < pair.size(); ++i) {
      pair[i] += sign * other.pair[i];
      square_of_pair[i] += sign * other.square_of_pair[i];
    }
    for (std::size_t i = 0; i < cell.size(); ++i) {
      cell[i] += sign * other.cell[i];
      square_of_cell[i] += sign * other.square_of_cell[i];
    }
  }
};

// Of lags and of means over cells, over the variance of a pulse.
using Ratios = Eigen::Array<double, kErrors, kLags.size() + kSides.size()>;
Ratios RatiosOf(const PulseSums& sums) {
  const TracedPulse mean = sums.mean / sums.pulses;
  const Values bias = Product(mean, mean);
  Ratios ratios;
  for (std::size_t i = 0; i < kLags.size(); ++i)
    ratios.col(i) = (sums.pair[i] - sums.pairs * bias) / (sums.square_of_pair[i] - sums.pairs * bias);
  for (std::size_t i = 0; i < kSides.size(); ++i)
    ratios.col(kLags.size() + i) = (sums.cell[i] - sums.cells * bias) / (sums.square_of_cell[i] - sums.cells * bias);
  return ratios;
}

PulseSums SumsOf(const MovingSea& sea, const PulsePair& made, std::uint32_t cell, std::uint32_t realization) {
  constexpr int kAnchors = 60, kCells = 30;
  const std::vector<HeightField> surfaces = sea.Draw(NormalStream(kMovingSeaSeed, cell, realization), kTimes);
  const PulseTracer tracer(made.beam, kRefractiveIndex, kRays);
  UniformStream random(kMovingSeaSeed, cell, realization, 5000);
  // A metre and a half is left beside the edge, for the footprint and for the heights of the waves.
  const auto place = [&](double margin) {
    const double room = MovingSea::kLength / 2 - 1.5 - margin;
    const double x = room * (2 * random.Next() - 1), y = room * (2 * random.Next() - 1);
    return Eigen::Vector2d(x, y);
  };
  PulseSums sums;
  const auto count = [&](const TracedPulse& pulse) {
    sums.pulses += 1;
    sums.mean += pulse;
  };
  for (int a = 0; a < kAnchors; ++a) {
    const Eigen::Vector2d at = place(4);
    const TracedPulse first = tracer(surfaces[0], at);
    count(first);
    sums.pairs += 1;
    for (std::size_t i = 0; i < kLags.size(); ++i) {
      const TracedPulse second = tracer(surfaces[kLags[i].time], at + kLags[i].apart);
      count(second);
      sums.pair[i] += Product(first, second);
      sums.square_of_pair[i] += (Product(first, first) + Product(second, second)) / 2;
    }
  }
  const Eigen::Vector2d x(std::cos(made.orientation), std::sin(made.orientation)), y(-x.y(), x.x());
  for (int c = 0; c < kCells; ++c) {
    sums.cells += 1;
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      const Eigen::Vector2d centre = place(kSides[i] * std::numbers::sqrt2 / 2);
      TracedPulse mean = TracedPulse::Zero();
      for (int p = 0; p < kPulses; ++p) {
        const double u = random.Next() - 0.5, v = random.Next() - 0.5;
        const TracedPulse pulse = tracer(surfaces[0], centre + kSides[i] * (u * x + v * y));
        count(pulse);
        mean += pulse / kPulses;
        sums.square_of_cell[i] += Product(pulse, pulse) / kPulses;
      }
      sums.cell[i] += Product(mean, mean);
    }
  }
  return sums;
}

Ratios Theory(const HarmonicSpectrum& spectrum, const PulsePair& made) {
  const WaveCorrelation sea(spectrum, made.motion);
  const BeamCorrelation beam(sea, made.beam, kRefractiveIndex);
  Ratios ratios;
  for (std::size_t i = 0; i < kLags.size(); ++i) {
    const PulseCorrelation found = CorrelationOf(beam.Between(kLags[i].apart, kTimes[kLags[i].time]), beam.pulse());
    ratios.col(i) << found.horizontal, found.vertical, found.height;
  }
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const PulseCorrelation found = CorrelationOf(beam.InCell({kSides[i], made.orientation}), beam.pulse());
    ratios.col(kLags.size() + i) << MeanOfPulses(found.horizontal, kPulses), MeanOfPulses(found.vertical, kPulses),
        MeanOfPulses(found.height, kPulses);
  }
  return ratios;
}

// Of the realizations, which are independent, and of the ratios of all of them: the jackknife.
Ratios StandardErrors(const std::vector<const PulseSums*>& parts, const Ratios& of_all) {
  PulseSums all;
  for (const PulseSums* part : parts) all.Add(*part);
  Ratios scatter = Ratios::Zero();
  for (const PulseSums* part : parts) {
    PulseSums others = all;
    others.Add(*part, -1);
    scatter += (RatiosOf(others) - of_all).square();
  }
  const auto n = static_cast<double>(parts.size());
  return (scatter * (n - 1) / n).sqrt();
}

// Of departures in standard errors.
struct Tail {
  int beyond = 0;  // 3
  double worst = 0;

  void Add(const Ratios& departures) {
    beyond += static_cast<int>((departures.abs() > 3).count());
    worst = std::max(worst, departures.abs().maxCoeff());
  }
};

// Departures as they are if theory is right: those of realizations that are drawn from the traced ones, with
// repetitions, from all of these. They are correlated and have the tails of what was traced.
std::vector<Tail> DrawnTails(const std::vector<PulseSums>& parts, const Ratios& traced, std::uint32_t sea, int draws) {
  std::vector<Tail> tails(draws);
  tbb::parallel_for(0, draws, [&](int draw) {
    UniformStream random(kMovingSeaSeed, sea, static_cast<std::uint32_t>(draw), 6000);
    PulseSums all;
    std::vector<const PulseSums*> drawn;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto one = static_cast<std::size_t>(random.Next() * static_cast<double>(parts.size()));
      drawn.push_back(&parts[std::min(one, parts.size() - 1)]);
      all.Add(*drawn.back());
    }
    const Ratios ratios = RatiosOf(all);
    tails[draw].Add((ratios - traced) / StandardErrors(drawn, ratios));
  });
  return tails;
}

// Bounds of 0.01, or of as many standard errors, from so many realizations, as the greatest of the deviations of all
// seas exceeds with a probability of 5 %.
class PulseCorrelations : public ::testing::TestWithParam<int> {
 protected:
  static constexpr int kDraws = 4000;

  static void TearDownTestSuite() {
    if (correlations_ == 0) return;
    double mean = 0, as_many = 0, as_far = 0;
    for (const Tail& tail : expected_) {
      mean += static_cast<double>(tail.beyond) / kDraws;
      as_many += tail.beyond >= found_.beyond ? 1.0 / kDraws : 0;
      as_far += tail.worst >= found_.worst ? 1.0 / kDraws : 0;
    }
    std::printf(
        "%d of %d beyond 3 standard errors, %.1f expected, as many with a probability of %.3f; the worst %.2f, as far "
        "with one of %.3f\n",
        found_.beyond, correlations_, mean, as_many, found_.worst, as_far);
  }

  static void Count(const Ratios& departures, const std::vector<Tail>& drawn) {
    correlations_ += static_cast<int>(departures.size());
    found_.Add(departures);
    for (int i = 0; i < kDraws; ++i) {
      expected_[i].beyond += drawn[i].beyond;
      expected_[i].worst = std::max(expected_[i].worst, drawn[i].worst);
    }
  }

 private:
  inline static int correlations_ = 0;
  inline static Tail found_;
  inline static std::vector<Tail> expected_ = std::vector<Tail>(kDraws);  // Sum over seas, which are independent.
};

TEST_P(PulseCorrelations, AgreeWithTracingThroughAMovingSea) {
  const int index = GetParam();
  if (!EveryCase() && index != 2 && index != 5) GTEST_SKIP() << "ALBTPU_EVERY_CASE=1 runs it";
  const ResponseSea known = ResponseSeas()[index];
  const PulsePair made = CaseOf(index);
  const HarmonicSpectrum spectrum = WithoutShortWaves(known.spectrum);
  const MovingSea sea(spectrum, made.motion);
  const int realizations = EveryCase() ? 80 : 12;
  std::vector<PulseSums> parts(realizations);
  tbb::parallel_for(0, realizations, [&](int r) { parts[r] = SumsOf(sea, made, index, r); });
  PulseSums all;
  for (const PulseSums& part : parts) all.Add(part);
  const Ratios traced = RatiosOf(all), theory = Theory(spectrum, made);
  std::vector<const PulseSums*> each;
  for (const PulseSums& part : parts) each.push_back(&part);
  const Ratios errors = StandardErrors(each, traced);
  const Ratios departures = theory - traced;
  Count(departures / errors, DrawnTails(parts, traced, static_cast<std::uint32_t>(index), kDraws));
  const double k = StudentQuantile(realizations - 1, 0.025 / (kSeaCount * Ratios::SizeAtCompileTime));
  const char* const quantity[] = {"horizontal", "vertical", "height"};
  std::printf("%s, %.0f degrees, %.1f m %s; theory, traced - theory and 1000 standard errors of lags, then cells\n",
              known.name.c_str(), DegreesOfRadians(made.beam.incidence), made.beam.footprint,
              Name(made.beam.profile).data());
  for (int q = 0; q < kErrors; ++q) {
    std::printf("  %-10s", quantity[q]);
    for (Eigen::Index i = 0; i < traced.cols(); ++i) {
      std::printf(" %6.3f%+.3f(%.0f)", theory(q, i), -departures(q, i), 1000 * errors(q, i));
      EXPECT_LE(std::abs(departures(q, i)), std::max(0.01, k * errors(q, i)))
          << quantity[q] << ", " << i << ": theory " << theory(q, i) << ", traced " << traced(q, i)
          << ", standard error " << errors(q, i);
    }
    std::printf("\n");
  }
  std::printf("  rms %.2f standard errors, %d of %d beyond 3\n", std::sqrt((departures / errors).square().mean()),
              static_cast<int>((departures.abs() > 3 * errors).count()), static_cast<int>(departures.size()));
}

INSTANTIATE_TEST_SUITE_P(Seas, PulseCorrelations, ::testing::Range(0, kSeaCount));

}  // namespace
}  // namespace albtpu
