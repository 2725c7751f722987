#include "validation/laboratory/virtual_tank.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "generator/surface/wave_patch.h"
#include "validation/laboratory/wave_staff.h"

namespace albtpu {
EvolvingPatch::EvolvingPatch(const SeaState& sea, double length, int size, const NormalStream& stream)
    : transform_(size) {
  assert(length > 0);
  const int half = size / 2 + 1;
  const double dk = 2 * std::numbers::pi / length;
  modes_.assign(static_cast<std::size_t>(size) * half, {0, 0, 0});
  std::vector<double> normals(4 * half);
  for (int row = 0; row < size; ++row) {
    const int i = SignedIndex(row, size);
    if (i == size / 2) continue;
    stream.Part(row).Fill(normals);
    for (int j = 0; j < size / 2; ++j) {
      if (i == 0 && j == 0) continue;
      const double k = dk * std::hypot(i, j);
      const double psi = std::atan2(j, i);
      // Half of an amplitude whose real and imaginary parts each have the variance Psi dkx dky.
      const double forward = 0.5 * dk * std::sqrt(sea.DirectionalPsi(k, psi));
      const double backward = 0.5 * dk * std::sqrt(sea.DirectionalPsi(k, psi + std::numbers::pi));
      const double* normal = &normals[4 * j];
      modes_[static_cast<std::size_t>(row) * half + j] = {AngularFrequency(k),
                                                          forward * std::complex<double>(normal[0], normal[1]),
                                                          backward * std::complex<double>(normal[2], normal[3])};
    }
  }
  // Both halves of the column j = 0 are stored: each mode is the mirror of the one at -i.
  for (int i = 1; i < size / 2; ++i) {
    const Mode& upper = modes_[static_cast<std::size_t>(i) * half];
    modes_[static_cast<std::size_t>(size - i) * half] = {upper.angular_frequency, std::conj(upper.backward),
                                                         std::conj(upper.forward)};
  }
}

std::vector<double> EvolvingPatch::HeightsAt(double time) const {
  InverseFft::Modes amplitudes = transform_.Allocate();
  for (std::size_t m = 0; m < modes_.size(); ++m) {
    const std::complex<double> turn = std::polar(1.0, -modes_[m].angular_frequency * time);
    amplitudes[m] = modes_[m].forward * turn + modes_[m].backward * std::conj(turn);
  }
  return transform_(std::move(amplitudes));
}

PhotodiodeArray::PhotodiodeArray(const PhotodiodeArrayOptions& options, const Eigen::Vector2d& centre)
    : options_(options), corner_(centre.array() - 0.5 * (options.per_side - 1) * options.pitch) {
  assert(options.per_side > 0 && options.pitch > 0);
  assert(options.aperture > 0 && options.aperture <= options.pitch);
}

std::optional<Eigen::Vector2d> PhotodiodeArray::Centroid(const std::vector<Eigen::Vector2d>& spots) const {
  const double radius = 0.5 * options_.aperture;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();  // of the centre of the photodiode of each hit
  long hits = 0;
  for (const Eigen::Vector2d& spot : spots) {
    const Eigen::Array2d nearest = ((spot - corner_) / options_.pitch).array().round();
    if ((nearest < 0).any() || (nearest >= options_.per_side).any()) continue;
    const Eigen::Vector2d centre = corner_ + options_.pitch * nearest.matrix();
    if ((spot - centre).squaredNorm() > radius * radius) continue;
    sum += centre;
    ++hits;
  }
  if (hits == 0) return std::nullopt;
  return sum / static_cast<double>(hits);
}

std::vector<Eigen::Vector2d> SpotsAtDepth(const std::vector<Ray>& rays, const HeightField& water,
                                          double refractive_index, double depth) {
  std::vector<Eigen::Vector2d> spots;
  spots.reserve(rays.size());
  for (const Ray& ray : rays) {
    const Hit hit = Intersect(water, ray);
    const Eigen::Vector3d refracted = Refract(ray.direction, NormalOfSlope(hit.facet.slope), refractive_index);
    const Eigen::Vector2d tangent = refracted.head<2>() / -refracted.z();
    spots.push_back(ray.at_zero + hit.height * ray.per_height() + (depth + hit.height) * tangent);
  }
  return spots;
}

namespace {

// The readings of the detectors in one frame.
struct Frame {
  Eigen::Vector2d full_beam;
  std::vector<std::optional<Eigen::Vector2d>> arrays;
};

Eigen::Vector2d MeanOf(const std::vector<Eigen::Vector2d>& spots) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& spot : spots) sum += spot;
  return sum / static_cast<double>(spots.size());
}

// A beam with its rays and the arrays in its light.
struct PreparedBeam {
  std::vector<Ray> rays;
  std::vector<PhotodiodeArray> arrays;

  PreparedBeam(const BeamOptions& options, const TankExperiment& experiment) {
    const Beam beam(options, experiment.rays);
    rays = beam.Rays(0);
    const double tangent = std::tan(StillWaterRefraction(options.incidence, experiment.refractive_index));
    for (const PhotodiodeArrayOptions& array : experiment.arrays)
      arrays.emplace_back(array, experiment.depth * tangent * beam.azimuth_direction());
  }

  Frame Observe(const HeightField& water, const TankExperiment& experiment) const {
    const auto spots = SpotsAtDepth(rays, water, experiment.refractive_index, experiment.depth);
    Frame frame{MeanOf(spots), {}};
    for (const PhotodiodeArray& array : arrays) frame.arrays.push_back(array.Centroid(spots));
    return frame;
  }
};

// The part of the periodic patch about the origin that `points` along each side cover.
HeightField WindowOf(const std::vector<double>& patch, const TankGrid& grid, int points) {
  std::vector<double> heights(static_cast<std::size_t>(points) * points);
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      heights[static_cast<std::size_t>(i) * points + j] =
          patch[static_cast<std::size_t>(i % grid.size) * grid.size + j % grid.size];
    }
  }
  return HeightField(std::move(heights), points, grid.length / grid.size);
}

// The odd number of points along a window that holds every ray. Waves of a few centimetres shift the intersections by
// less than the margin.
int PointsToHold(const std::vector<PreparedBeam>& beams, double spacing) {
  constexpr double kMargin = 0.02;  // m
  double reach = 0;
  for (const PreparedBeam& beam : beams)
    for (const Ray& ray : beam.rays) reach = std::max(reach, ray.at_zero.cwiseAbs().maxCoeff());
  return 2 * static_cast<int>(std::ceil((reach + kMargin) / spacing)) + 1;
}

CentroidAngles AnglesOf(const std::vector<std::optional<Eigen::Vector2d>>& centroids,
                        const std::optional<Eigen::Vector2d>& still, double depth) {
  assert(still.has_value());
  const auto lit = std::count_if(centroids.begin(), centroids.end(), [](auto& c) { return c.has_value(); });
  CentroidAngles angles{Eigen::ArrayXd(lit), Eigen::ArrayXd(lit)};
  Eigen::Index i = 0;
  for (const std::optional<Eigen::Vector2d>& centroid : centroids) {
    if (!centroid) continue;
    angles.along_wind[i] = std::atan((centroid->x() - still->x()) / depth);
    angles.cross_wind[i] = std::atan((centroid->y() - still->y()) / depth);
    ++i;
  }
  return angles;
}

}  // namespace

double UnscaledTankWaveHeight(double wind_speed_10m) {
  return 4 * std::sqrt(ElevationVariance(SeaState(wind_speed_10m, kTankFetch)));
}

SeaState TankSea(double wind_speed_10m, double significant_wave_height) {
  return SeaState({.waves = WindSea{.wind_speed_10m = wind_speed_10m, .fetch = kTankFetch},
                   .height_scale = significant_wave_height / UnscaledTankWaveHeight(wind_speed_10m)});
}

WaterOfFrame IndependentFrames(const SeaState& sea, const TankGrid& grid, std::uint64_t seed, std::uint32_t cell) {
  // The waves of the tank are much shorter than the patch, so the patch takes all of them.
  const double longer_than_all = 0.5 * sea.energetic_range().lowest;
  const auto model = std::make_shared<const WavePatchModel>(sea, grid.length, grid.size,
                                                            CrossFade(0.5 * longer_than_all, longer_than_all));
  return [model, seed, cell](int frame) { return model->Draw(NormalStream(seed, cell, frame)); };
}

WaterOfFrame SuccessiveFrames(const SeaState& sea, const TankGrid& grid, double rate, std::uint64_t seed,
                              std::uint32_t cell) {
  const auto patch = std::make_shared<const EvolvingPatch>(sea, grid.length, grid.size, NormalStream(seed, cell, 0));
  return [patch, rate](int frame) { return patch->HeightsAt(frame / rate); };
}

CentroidScatter ScatterOf(const CentroidAngles& angles) {
  return {InDegrees(TwoSigma(angles.along_wind)), InDegrees(TwoSigma(angles.cross_wind))};
}

std::vector<TankReading> ObserveTank(const TankExperiment& experiment, const WaterOfFrame& water) {
  assert(experiment.frames >= 2);
  std::vector<PreparedBeam> beams;
  for (const BeamOptions& options : experiment.beams) beams.emplace_back(options, experiment);
  const int points = PointsToHold(beams, experiment.grid.length / experiment.grid.size);
  const HeightField still_water(std::vector<double>(9, 0.0), 3, 1.0);

  std::vector<std::vector<Frame>> frames(experiment.frames);  // of each beam
  tbb::parallel_for(0, experiment.frames, [&](int f) {
    const HeightField window = WindowOf(water(f), experiment.grid, points);
    for (const PreparedBeam& beam : beams) frames[f].push_back(beam.Observe(window, experiment));
  });

  std::vector<TankReading> readings;
  for (std::size_t b = 0; b < beams.size(); ++b) {
    const Frame still = beams[b].Observe(still_water, experiment);
    const auto angles_of = [&](auto&& centroid_of) {
      std::vector<std::optional<Eigen::Vector2d>> centroids;
      for (const std::vector<Frame>& frame : frames) centroids.push_back(centroid_of(frame[b]));
      return AnglesOf(centroids, centroid_of(still), experiment.depth);
    };
    TankReading reading;
    reading.full_beam = angles_of([](const Frame& frame) { return std::optional(frame.full_beam); });
    for (std::size_t a = 0; a < experiment.arrays.size(); ++a)
      reading.arrays.push_back(angles_of([a](const Frame& frame) { return frame.arrays[a]; }));
    readings.push_back(std::move(reading));
  }
  return readings;
}

std::vector<Eigen::Vector2d> LightOfFrame(const TankExperiment& experiment, const std::vector<double>& water) {
  const PreparedBeam beam(experiment.beams.front(), experiment);
  const int points = PointsToHold({beam}, experiment.grid.length / experiment.grid.size);
  return SpotsAtDepth(beam.rays, WindowOf(water, experiment.grid, points), experiment.refractive_index,
                      experiment.depth);
}

}  // namespace albtpu
