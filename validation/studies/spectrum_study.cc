#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "generator/surface/beam.h"
#include "generator/surface/discretization.h"
#include "generator/surface/sea_surface.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/spectra/apel_spectrum.h"
#include "status/status_macros.h"
#include "validation/laboratory/wave_staff.h"
#include "validation/published/published_table.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

// The beam of section 2.1.2 at one of its incidences.
constexpr double kIncidence = 15;    // degree
constexpr double kFootprint = 0.25;  // m
constexpr double kSourceHeight = 4;  // m
constexpr double kDepth = 0.25;      // m, of the plane where the rays end
constexpr double kAbove = 0.1;       // m, of the points where the drawn rays begin
constexpr int kRays = 500'000;
constexpr int kRaysPerDrawnRay = 9001;   // one ray in this many is drawn, spread over the spiral of rays
constexpr double kDrawnSpacing = 0.003;  // m, between points of the drawn surface

// The point where a ray refracted at `hit` reaches a level.
Eigen::Vector2d EndOf(const Ray& ray, const Hit& hit, double level) {
  const Eigen::Vector3d down = Refract(ray.direction, NormalOfSlope(hit.facet.slope), kRefractiveIndex);
  const Eigen::Vector2d met = ray.at_zero + hit.height * ray.per_height();
  return met + (hit.height - level) / -down.z() * down.head<2>();
}

Eigen::Vector2d Centroid(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

// The farthest points from the centroid, one for each sector, closed with the first.
std::vector<Eigen::Vector2d> EdgeOf(const std::vector<Eigen::Vector2d>& points) {
  constexpr int kSectors = 90;
  const Eigen::Vector2d centre = Centroid(points);
  std::vector<Eigen::Vector2d> edge(kSectors, centre);
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d arm = point - centre;
    const double turn = (std::atan2(arm.y(), arm.x()) / std::numbers::pi + 1) / 2;
    Eigen::Vector2d& farthest = edge[std::min(static_cast<int>(turn * kSectors), kSectors - 1)];
    if (arm.norm() > (farthest - centre).norm()) farthest = point;
  }
  edge.push_back(edge.front());
  return edge;
}

double AreaWithin(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i)
    twice += polygon[i - 1].x() * polygon[i].y() - polygon[i].x() * polygon[i - 1].y();
  return twice / 2;
}

// The plane where the rays end, through waves and through still water.
std::vector<DataTable> SpotTables(const std::vector<Eigen::Vector2d>& ends,
                                  const std::vector<Eigen::Vector2d>& still_ends) {
  constexpr int kBins = 120;
  constexpr double kBin = 0.003;  // m
  const Eigen::Vector2d still = Centroid(still_ends), moved = Centroid(ends);
  const std::vector<Eigen::Vector2d> edge = EdgeOf(still_ends);
  const double rays_per_bin = static_cast<double>(ends.size()) * kBin * kBin / AreaWithin(edge);  // of an even spot
  std::vector<int> count(kBins * kBins);
  for (const Eigen::Vector2d& end : ends) {
    const Eigen::Vector2d bin = (end - still) / kBin + Eigen::Vector2d::Constant(kBins / 2);
    if ((bin.array() >= 0).all() && (bin.array() < kBins).all())
      ++count[static_cast<int>(bin.x()) * kBins + static_cast<int>(bin.y())];
  }
  DataTable spot{.name = "figure_3_spot",
                 .title = "Power over the plane 0.25 m down, relative to that of the spot in still water",
                 .columns = {"x_m", "y_m", "power"},
                 .on_the_page = false};
  for (int i = 0; i < kBins; ++i) {
    for (int j = 0; j < kBins; ++j) {
      const Eigen::Vector2d middle = still + kBin * Eigen::Vector2d(i + 0.5 - kBins / 2, j + 0.5 - kBins / 2);
      spot.Add(middle.x(), middle.y(), count[i * kBins + j] / rays_per_bin);
    }
  }
  DataTable still_spot{.name = "figure_3_still_spot",
                       .title = "The edge of the spot in still water",
                       .columns = {"x_m", "y_m"},
                       .on_the_page = false};
  for (const Eigen::Vector2d& point : edge) still_spot.Add(point.x(), point.y());
  DataTable centroids{
      .name = "figure_3_centroids",
      .title = "The centroid of the spot 0.25 m down, relative to the point where the axis meets the water",
      .columns = {"surface", "x_m", "y_m"}};
  centroids.Add("still water", still.x(), still.y());
  centroids.Add("this realization", moved.x(), moved.y());
  return {std::move(spot), std::move(still_spot), std::move(centroids)};
}

// The beam of section 2.1.2 through one realization of the sea: 0.25 m wide, from 4 m above the water, at 15 degrees,
// down to 0.25 m below the mean surface.
std::vector<DataTable> PictureOf(const SeaState& sea, std::uint64_t seed) {
  const BeamOptions options{
      .incidence = RadiansOfDegrees(kIncidence), .footprint = kFootprint, .source_height = kSourceHeight};
  const SurfaceModel model(sea, options, ChooseDiscretization(sea, {options}));
  const SeaSurface surface(model, NormalStream(seed, 0, 0));
  const Beam beam(options, kRays);
  const SeaSurface::LocalSurface window =
      surface.SurfaceUnder(beam);  // about the point where the axis meets the long waves
  const HeightField& heights = window.heights;

  DataTable drawn_surface{.name = "figure_3_surface",
                          .title = "Elevation of one realization around the beam",
                          .columns = {"x_m", "y_m", "elevation_m"},
                          .on_the_page = false};
  const int half = static_cast<int>(0.98 * heights.reach() / kDrawnSpacing);
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const Eigen::Vector2d at(i * kDrawnSpacing, j * kDrawnSpacing);
      drawn_surface.Add(at.x(), at.y(), heights.FacetAt(at).HeightAt(at));
    }
  }
  DataTable drawn_rays{.name = "figure_3_rays",
                       .title = "Rays of the beam: points above the water, on the surface and 0.25 m below it",
                       .columns = {"x_above_m", "y_above_m", "z_above_m", "x_surface_m", "y_surface_m", "z_surface_m",
                                   "x_bottom_m", "y_bottom_m", "z_bottom_m"},
                       .on_the_page = false};
  const double mean_level = -window.elevation;
  const double bottom_level = mean_level - kDepth;
  const HeightField::Facet still_water{mean_level, Eigen::Vector2d::Zero()};
  std::vector<Eigen::Vector2d> ends, still_ends;
  const std::vector<Ray> rays = beam.Rays(window.elevation);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const Ray& ray = rays[r];
    const Hit hit = Intersect(heights, ray);
    const Eigen::Vector2d end = EndOf(ray, hit, bottom_level);
    ends.push_back(end);
    still_ends.push_back(EndOf(ray, {mean_level, still_water}, bottom_level));
    if (r % kRaysPerDrawnRay != 0) continue;
    const Eigen::Vector2d above = ray.at_zero + kAbove * ray.per_height();
    const Eigen::Vector2d met = ray.at_zero + hit.height * ray.per_height();
    drawn_rays.Add(above.x(), above.y(), kAbove, met.x(), met.y(), hit.height, end.x(), end.y(), bottom_level);
  }
  std::vector<DataTable> tables = {std::move(drawn_surface), std::move(drawn_rays)};
  std::ranges::move(SpotTables(ends, still_ends), std::back_inserter(tables));
  return tables;
}

// The caption of Figure 2.
constexpr double kWind = 5;     // m/s
constexpr double kFetch = 5.5;  // m

DataTable Spectrum(const SeaState& sea) {
  DataTable table{.name = "figure_2_spectrum",
                  .title = "S(k) of Apel's sea for 5 m/s and a fetch of 5.5 m, and B(k) = k^3 S(k)",
                  .columns = {"k_rad_per_m", "wavelength_m", "s_m3", "curvature"},
                  .on_the_page = false};
  const auto [lowest, highest] = sea.energetic_range();
  constexpr int kSteps = 400;
  for (int i = 0; i <= kSteps; ++i) {
    const double k = lowest * std::pow(highest / lowest, static_cast<double>(i) / kSteps);
    table.Add(k, 2 * std::numbers::pi / k, sea.S(k), k * k * k * sea.S(k));
  }
  return table;
}

DataTable Spreading(const SeaState& sea) {
  DataTable table{.name = "figure_2_spreading",
                  .title = "Spreading of waves about the wind, of travelling waves and of a frozen surface",
                  .columns = {"direction_deg", "spreading_per_rad", "frozen_per_rad"},
                  .on_the_page = false};
  const double k_p = sea.spectrum().peak_wavenumber();
  for (int degree = -180; degree <= 180; degree += 3) {
    const double psi = RadiansOfDegrees(degree);
    table.Add(degree, sea.spectrum().Spreading(k_p, psi), sea.FrozenSpreading(k_p, psi));
  }
  return table;
}

DataTable DirectionalSpectrum(const SeaState& sea) {
  DataTable table{.name = "figure_2_directional",
                  .title = "Psi(kx, ky) = S(k) D(psi) / k by the direction of travel of the waves",
                  .columns = {"kx_rad_per_m", "ky_rad_per_m", "psi_m4"},
                  .on_the_page = false};
  constexpr int kHalf = 60;
  const double step = 3 * sea.spectrum().peak_wavenumber() / kHalf;
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      const double k = step * std::hypot(i, j);
      table.Add(i * step, j * step, k > 0 ? sea.DirectionalPsi(k, std::atan2(j, i)) : 0);
    }
  }
  return table;
}

absl::Status CompareWithTable2(const SeaState& sea, const StudyOptions& options, Study& study) {
  ASSIGN_OR_RETURN(const Table2 table, ReadTable2(options.published));
  const std::size_t row = std::ranges::find(table.fetch, kFetch) - table.fetch.begin();
  if (row == table.fetch.size())
    return absl::InvalidArgumentError("table2_wave_staff.csv: no row for a fetch of 5.5 m");
  const char* basis = "no verdict: Table 2 does not state its wind";
  study.comparisons.push_back({.quantity = "Peak wavelength, 5 m/s, fetch 5.5 m, Eq. 3",
                               .unit = "m",
                               .published = table.peak_wavelength[row],
                               .ours = 2 * std::numbers::pi / sea.spectrum().peak_wavenumber(),
                               .basis = basis});
  study.comparisons.push_back({.quantity = "Peak frequency, 5 m/s, fetch 5.5 m, maximum of S over frequency",
                               .unit = "Hz",
                               .published = table.peak_frequency[row],
                               .ours = PeakFrequency(sea),
                               .basis = basis});
  study.comparisons.push_back(
      {.quantity = "Significant wave height, 5 m/s, fetch 5.5 m",
       .unit = "m",
       .published = table.significant_wave_height[row],
       .ours = 4 * std::sqrt(ElevationVariance(sea)),
       .basis = "no verdict: Apel's level A does not depend on fetch, which makes young seas too low"});
  return absl::OkStatus();
}

// The integral of the directional spectrum over the plane, by rings and directions of the full circle.
double VarianceOverThePlane(const SeaState& sea) {
  const auto [lowest, highest] = sea.energetic_range();
  constexpr int kRings = 4000, kDirections = 36;
  const double step = std::log(highest / lowest) / kRings;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double k = lowest * std::exp((i + 0.5) * step);
    for (int j = 0; j < kDirections; ++j) {
      const double psi = 2 * std::numbers::pi * j / kDirections;
      sum += sea.DirectionalPsi(k, psi) * k * k * step * 2 * std::numbers::pi / kDirections;
    }
  }
  return sum;
}

}  // namespace

absl::StatusOr<Study> SpectrumStudy(const StudyOptions& options) {
  const SeaState sea(kWind, kFetch);
  const double k_p = sea.spectrum().peak_wavenumber();
  Study study;
  study.id = "figures_2_and_3";
  study.title = "Figures 2 and 3: the spectrum, and a beam through a surface of it";
  study.paragraphs = {
      absl::StrFormat(
          "Apel's spectrum (Eq. 1-14), the cosine-2S spreading with s = 2 (Eq. 15) and the directional "
          "spectrum (Eq. 16 with the Jacobian 1/k) for 5 m/s and a fetch of 5.5 m. By Eq. 5 the inverse wave "
          "age is %.1f, far beyond the printed range of the peak enhancement (Eq. 7), which keeps its end "
          "value there. The peak is at %.0f rad/m, a wavelength of %.1f cm; the shoulder from there to some "
          "1000 rad/m is the capillary-gravity resonance of Eq. 11.",
          ApelSpectrum::InverseWaveAge(kWind, kFetch), k_p, 200 * std::numbers::pi / k_p),
      "On a frozen surface a wave looks the same as one that travels the opposite way, so the surfaces of "
      "the Monte Carlo have the mean of both directions (dashed in Figure 2b). The curves of the printed "
      "figures are not available as numbers; only the peak that the paper measured at that fetch (Table 2) "
      "can be compared.",
      "Figure 3 of the paper shows a triangulated surface. Ours is one realization at true scale, lit from "
      "the side, with rays of a 0.25 m beam from 4 m above, at 15 degrees, refracted at the facets that they "
      "hit. The waves are shorter than the footprint: they hardly move the centroid of the spot but break it "
      "up into caustics, which the photodiodes of the paper's laboratory sampled."};
  RETURN_IF_ERROR(CompareWithTable2(sea, options, study));
  const double variance = VarianceOverThePlane(sea), omnidirectional = ElevationVariance(sea);
  constexpr double kQuadrature = 1e-4;  // of ElevationVariance
  study.comparisons.push_back(
      {.quantity = "Ratio of the integral of the directional spectrum to that of S(k)",
       .unit = "1",
       .published = 1,
       .ours = variance / omnidirectional,
       .verdict = AgreesIf(std::abs(variance / omnidirectional - 1) < kQuadrature),
       .basis = "within 1e-4, the error of the quadratures, because the spreading integrates to one"});
  study.tables = {Spectrum(sea), Spreading(sea), DirectionalSpectrum(sea)};
  std::ranges::move(PictureOf(sea, options.seed), std::back_inserter(study.tables));
  study.figures = {
      {.name = "figure_2",
       .caption = "Figure 2: (a) the omnidirectional spectrum S(k), (b) the spreading, (c) the directional "
                  "spectrum, for 5 m/s and 5.5 m of fetch. The dotted line is the peak."},
      {.name = "figure_3",
       .caption = "Figure 3: one realization of that sea at true scale, and rays of a 0.25 m beam refracted "
                  "through it down to the depth of the detectors, 0.25 m."},
      {.name = "figure_3_spot",
       .caption = "The same beam 0.25 m down: distribution of power over the detector plane, with caustics. The "
                  "closed curve is the edge of the spot in still water, the crosses are the two centroids."}};
  return study;
}

}  // namespace albtpu
