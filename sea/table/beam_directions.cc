#include "sea/table/beam_directions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kIncidences = 5;  // the first of them at nadir
constexpr int kAzimuths = 5;    // odd, so that all harmonics come in pairs

double SquaredTangent(double angle) { return std::pow(std::tan(angle), 2); }

// From 0 to `largest`: the extrema of Chebyshev's polynomial.
double ChebyshevNode(int i, double largest) { return largest * (1 - std::cos(kPi * i / (kIncidences - 1))) / 2; }

// The weight of the node `i` at `x` in the polynomial through the nodes from `first` on.
double LagrangeWeight(int i, int first, double x, double largest) {
  double weight = 1;
  for (int j = first; j < kIncidences; ++j) {
    if (j == i) continue;
    const double node = ChebyshevNode(j, largest);
    weight *= (x - node) / (ChebyshevNode(i, largest) - node);
  }
  return weight;
}

// The weight of the azimuth that is `apart` away, of kAzimuths that divide half a turn evenly.
double TrigonometricWeight(double apart) {
  double weight = 1;
  for (int m = 1; m <= kAzimuths / 2; ++m) weight += 2 * std::cos(2 * m * apart);
  return weight / kAzimuths;
}

// What is even in the direction is in the frame of the sea; what is odd, in the axes of the beam and by
// tan(incidence), is even, too.
constexpr int kEvenParts = 9, kOddParts = 6;

Eigen::Matrix2d BeamAxes(double azimuth) {
  const double cosine = std::cos(azimuth), sine = std::sin(azimuth);
  return (Eigen::Matrix2d() << cosine, -sine, sine, cosine).finished();
}

Eigen::Matrix<double, kEvenParts, 1> EvenParts(const BeamResponse& beam) {
  const Eigen::Matrix3d &k = beam.covariance_per_depth, &s = beam.covariance_at_surface;
  return (Eigen::Matrix<double, kEvenParts, 1>() << k(0, 0), k(0, 1), k(1, 1), k(2, 2), s(0, 0), s(0, 1), s(1, 1),
          s(2, 2), beam.mean_per_depth.z())
      .finished();
}

Eigen::Matrix<double, kOddParts, 1> OddParts(const BeamResponse& beam, double azimuth) {
  const Eigen::Matrix2d to_beam = BeamAxes(azimuth).transpose();
  return (Eigen::Matrix<double, kOddParts, 1>() << to_beam * beam.covariance_per_depth.topRightCorner<2, 1>(),
          to_beam * beam.covariance_at_surface.topRightCorner<2, 1>(), to_beam * beam.mean_per_depth.head<2>())
      .finished();
}

Eigen::Matrix3d Covariance(double xx, double xy, double yy, double zz, const Eigen::Vector2d& z) {
  return (Eigen::Matrix3d() << xx, xy, z.x(), xy, yy, z.y(), z.x(), z.y(), zz).finished();
}

template <typename Even, typename Odd>
BeamResponse FromParts(const Even& even, const Odd& odd, double azimuth) {
  const Eigen::Matrix2d axes = BeamAxes(azimuth);
  BeamResponse beam;
  beam.covariance_per_depth = Covariance(even[0], even[1], even[2], even[3], axes * odd.segment(0, 2).transpose());
  beam.covariance_at_surface = Covariance(even[4], even[5], even[6], even[7], axes * odd.segment(2, 2).transpose());
  beam.mean_per_depth << axes * odd.segment(4, 2).transpose(), even[8];
  beam.azimuth = axes.col(0);
  return beam;
}

}  // namespace

BeamDirections::BeamDirections(const std::vector<double>& incidences, const std::vector<double>& azimuths) {
  for (const double incidence : incidences)
    for (const double azimuth : azimuths) wanted_.push_back({incidence, azimuth});
  const double largest = SquaredTangent(*std::max_element(incidences.begin(), incidences.end()));
  assert(largest > 0);
  for (int i = 0; i < kIncidences; ++i)
    for (int j = 0; j < kAzimuths; ++j)
      traced_.push_back({std::atan(std::sqrt(ChebyshevNode(i, largest))), kPi * j / kAzimuths});
  even_.resize(wanted_.size(), traced_.size());
  odd_ = even_;
  for (std::size_t w = 0; w < wanted_.size(); ++w) {
    const double tangent = std::tan(wanted_[w].incidence);
    for (std::size_t t = 0; t < traced_.size(); ++t) {
      const int i = static_cast<int>(t) / kAzimuths;
      const double of_azimuth = TrigonometricWeight(wanted_[w].azimuth - traced_[t].azimuth);
      even_(w, t) = of_azimuth * LagrangeWeight(i, 0, tangent * tangent, largest);
      odd_(w, t) = i == 0 ? 0
                          : of_azimuth * LagrangeWeight(i, 1, tangent * tangent, largest) * tangent /
                                std::tan(traced_[t].incidence);
    }
  }
}

std::vector<BeamResponse> BeamDirections::ResponsesOf(const SeaResponse& sea,
                                                      const std::vector<FootprintKernel>& footprints) const {
  const std::size_t count = footprints.size();
  Eigen::MatrixXd even(traced_.size(), kEvenParts * count), odd(traced_.size(), kOddParts * count);
  std::vector<BeamResponse> beams;
  for (std::size_t t = 0; t < traced_.size(); ++t) {
    const auto& [incidence, azimuth] = traced_[t];
    if (t == 0 || incidence > 0) beams = sea.AlongDirection(incidence, azimuth, footprints);
    for (std::size_t f = 0; f < count; ++f) {
      even.row(t).segment<kEvenParts>(f * kEvenParts) = EvenParts(beams[f]).transpose();
      odd.row(t).segment<kOddParts>(f * kOddParts) = OddParts(beams[f], azimuth).transpose();
    }
  }
  const Eigen::MatrixXd wanted_even = even_ * even, wanted_odd = odd_ * odd;
  std::vector<BeamResponse> responses;
  responses.reserve(wanted_.size() * count);
  for (std::size_t w = 0; w < wanted_.size(); ++w) {
    for (std::size_t f = 0; f < count; ++f) {
      responses.push_back(FromParts(wanted_even.row(w).segment<kEvenParts>(f * kEvenParts),
                                    wanted_odd.row(w).segment<kOddParts>(f * kOddParts), wanted_[w].azimuth));
    }
  }
  return responses;
}

}  // namespace albtpu
