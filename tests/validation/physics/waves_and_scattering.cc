#include "tests/validation/physics/waves_and_scattering.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/beam.h"
#include "generator/surface/sea_surface.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"
#include "tables/water/water_schema.h"

namespace albtpu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kPairs = 3;  // of each photon of the beam
constexpr int kReceiversPerSource = 2;
constexpr double kCellsAcrossView = 60;  // Photons that meet on the bottom share a cell.

struct Arrival {
  double x, y, time, weight;  // time in metres of water, later than unscattered light through still water
};

// The photons of a beam of `footprint` that reach the bottom, through `surface` into water that scatters as `phase`, or
// not at all.
std::vector<Arrival> Arrivals(const std::vector<Ray>& rays, const HeightField& surface, const PhaseFunction* phase,
                              const RoundTrip& trip, std::uint64_t seed) {
  const double sine = std::sin(trip.incidence), cosine = std::cos(trip.incidence);
  const double refracted = std::asin(sine / trip.refractive_index);
  const double unscattered = trip.depth / std::cos(refracted);
  std::vector<Arrival> arrivals;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit hit = Intersect(surface, rays[i]);
    const Eigen::Vector2d at = rays[i].at_zero + hit.height * rays[i].per_height();
    const auto [tangent, secant] = RefractAtSlope(rays[i].direction, hit.facet.slope, trip.refractive_index);
    // Straight to the mean surface, above or below, where its walk begins.
    const double before = hit.height * secant + (at.x() * sine - hit.height * cosine) / trip.group_index;
    const Eigen::Vector2d entry = at + hit.height * tangent;
    Eigen::Vector2d end = entry + trip.depth * tangent;
    double path = trip.depth * secant;
    if (phase != nullptr) {
      std::mt19937_64 random(seed + i);
      Traveller photon(*phase, trip, 0);
      photon.at = {entry.x(), entry.y(), 0};
      photon.going = Eigen::Vector3d(tangent.x(), tangent.y(), 1).normalized();
      if (photon.Travel(random) != Traveller::End::kBottom) continue;
      end = photon.at.head<2>();
      path = photon.path;
    }
    const double excess = path - unscattered;
    arrivals.push_back({end.x(), end.y(), before + excess, phase == nullptr ? 1 : std::exp(-trip.absorption * excess)});
  }
  return arrivals;
}

Echo Meet(const std::vector<Arrival>& lit, std::vector<Arrival> seen, const WavesAndScattering& at, double step,
          std::uint64_t seed) {
  const double cell = at.trip.field_of_view / kCellsAcrossView;
  const double straight = at.trip.depth * std::tan(std::asin(std::sin(at.trip.incidence) / at.trip.refractive_index));
  const auto place = [&](const Arrival& a) {
    return std::pair(std::floor((a.x - straight) / cell), std::floor(a.y / cell));
  };
  const auto before = [&](const Arrival& a, const Arrival& b) { return place(a) < place(b); };
  std::sort(seen.begin(), seen.end(), before);
  std::mt19937_64 random(seed);
  Echo echo(step);
  for (const Arrival& source : lit) {
    const auto [begin, end] = std::equal_range(seen.begin(), seen.end(), source, before);
    for (int k = 0; k < kPairs && begin != end; ++k) {
      const Arrival& receiver = begin[static_cast<std::ptrdiff_t>(Uniform(random) * static_cast<double>(end - begin))];
      const double ahead = ((source.x + receiver.x) / 2 - straight) / at.trip.depth;
      echo.Add((source.time + receiver.time) / 2 / at.trip.depth, ahead,
               source.weight * receiver.weight * static_cast<double>(end - begin), {.delay = ahead});
    }
  }
  return echo;
}

// One realization, by detector: reported minus true, along the beam and upwards [m].
using Errors = std::array<Eigen::Vector2d, 3>;

class Simulation {
 public:
  Simulation(const PhaseFunction& phase, const WavesAndScattering& at, int photons)
      : phase_(phase),
        at_(at),
        options_{.incidence = at.trip.incidence, .footprint = at.trip.field_of_view},
        model_(SeaState(at.wind, kInfinity), options_, {2, 200, 1}),
        beam_({.incidence = at.trip.incidence, .footprint = at.trip.footprint, .profile = BeamProfile::kGaussian},
              photons),
        view_(options_, kReceiversPerSource * photons),
        pulse_(PulseLengthOverDepth(at.nanoseconds, at.trip.depth, at.trip.group_index)) {}

  HeightField Still() const { return model_.StillSurface(); }
  HeightField Waves(const NormalStream& stream) const { return SeaSurface(model_, stream).SurfaceUnder(view_).heights; }

  // The sequence of photons is of `seed`, and the same for every surface.
  Errors Report(const HeightField& surface, bool scatters, std::uint64_t seed) const {
    const PhaseFunction* phase = scatters ? &phase_ : nullptr;
    const Echo echo =
        Meet(Arrivals(beam_.Rays(0), surface, phase, at_.trip, seed << 32),
             Arrivals(view_.Rays(0), surface, phase, at_.trip, (seed << 32) + (1 << 30)), at_, pulse_ / 30, seed);
    const DetectedBottom bottom = DetectBottom(echo, pulse_).value();
    const double refracted = std::asin(std::sin(at_.trip.incidence) / at_.trip.refractive_index);
    Errors errors;
    for (std::size_t d = 0; d < errors.size(); ++d) {
      const double late = bottom.by[d].time * at_.trip.depth;
      // The part of the bottom that is measured, as the light is delayed by its point.
      errors[d] = {late * std::sin(refracted) - bottom.by[d].by_tilt * at_.trip.depth, -late * std::cos(refracted)};
    }
    return errors;
  }

 private:
  const PhaseFunction& phase_;
  WavesAndScattering at_;
  BeamOptions options_;
  SurfaceModel model_;
  Beam beam_, view_;
  double pulse_;
};

ReportedBottom Moments(const std::vector<std::array<Errors, 2>>& sample, std::size_t detector, const Errors& clear) {
  const auto count = static_cast<double>(sample.size());
  Eigen::Vector2d first = Eigen::Vector2d::Zero(), second = first, products = first;
  for (const auto& [one, other] : sample) {
    first += one[detector] / count;
    second += other[detector] / count;
    products += one[detector].cwiseProduct(other[detector]) / count;
  }
  const Eigen::Vector2d variances = (products - first.cwiseProduct(second)).cwiseMax(0) * count / (count - 1);
  const Eigen::Vector2d mean = (first + second) / 2 - clear[detector];
  return {mean[0], mean[1], std::sqrt(variances[0]), std::sqrt(variances[1])};
}

}  // namespace

ComparedEffects Compare(const PhaseFunction& phase, const WavesAndScattering& at, int realizations, int photons,
                        std::uint64_t seed) {
  const Simulation simulation(phase, at, photons);
  std::vector<std::array<Errors, 2>> waves(realizations), both(realizations), scattering(1);
  const HeightField still = simulation.Still();
  for (std::uint64_t set : {0, 1}) scattering[0][set] = simulation.Report(still, true, set);
  const Errors clear = simulation.Report(still, false, 0);
  tbb::parallel_for(0, realizations, [&](int i) {
    const HeightField surface = simulation.Waves(NormalStream(seed, 0, static_cast<std::uint32_t>(i)));
    for (std::uint64_t set : {0, 1}) {
      waves[i][set] = simulation.Report(surface, false, set);
      both[i][set] = simulation.Report(surface, true, set);
    }
  });
  ComparedEffects reported;
  for (std::size_t d = 0; d < reported.both.size(); ++d) {
    reported.waves[d] = Moments(waves, d, clear);
    reported.both[d] = Moments(both, d, clear);
    const Eigen::Vector2d alone = (scattering[0][0][d] + scattering[0][1][d]) / 2 - clear[d];
    reported.scattering[d] = {alone[0], alone[1], 0, 0};
  }
  return reported;
}

}  // namespace albtpu
