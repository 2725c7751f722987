#include "sea/response/footprint_kernel.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// Weights that take a function at six lags about the edge of a disc to its value there, and to its derivative by ln s
// (Lagrange's polynomial). `weight` is 2 pi |dp|.
struct LagRing {
  static constexpr int kLags = 6;

  int first;  // lag
  Eigen::Matrix<double, kLags, 1> value, slope;
  double weight;
};

// The ring about the lag `s` [m] on every `stride`th lag of the lattice. Rings within the shortest lags, over which no
// surface varies, have no weight.
LagRing RingAt(double s, double weight, int stride) {
  const HankelLattice& lattice = HankelLattice::Shared();
  const double position = lattice.IndexOfLag(s) / stride;
  LagRing ring{static_cast<int>(std::floor(position)) - 2, {}, {}, weight};
  if (position < 2) {
    ring.first = 0;
    ring.weight = 0;
    ring.value.setZero();
    ring.slope.setZero();
    return ring;
  }
  for (int i = 0; i < LagRing::kLags; ++i) {
    double value = 1, slope = 0;  // of the product of the factors so far
    for (int j = 0; j < LagRing::kLags; ++j) {
      if (j == i) continue;
      const double factor = (position - ring.first - j) / (i - j);
      slope = slope * factor + value / (i - j);
      value *= factor;
    }
    ring.value[i] = value;
    ring.slope[i] = slope / (stride * lattice.step());
  }
  return ring;
}

// -dp/dx of the overlap and of the irradiance, x in diameters, where the integral over the plane is 1. The overlap of
// a uniform beam ends at x = 1 like a root: with x = sin t its rings are smooth in t.
std::vector<LagRing> OverlapRings(BeamProfile profile, double diameter) {
  const double scale = 2 * kPi * 4 / (kPi * diameter * diameter);
  std::vector<LagRing> rings;
  if (profile == BeamProfile::kUniform) {
    for (const auto& [t, weight] : GaussLegendre(24, 0, kPi / 2)) {
      rings.push_back(RingAt(diameter * std::sin(t), scale * 4 / kPi * std::pow(std::cos(t), 2) * weight,
                             FootprintKernel::kLagStride));
    }
  } else {
    for (const auto& [x, weight] : GaussLegendre(24, 0, 2.2))
      rings.push_back(RingAt(diameter * x, scale * 8 * x * std::exp(-4 * x * x) * weight, FootprintKernel::kLagStride));
  }
  return rings;
}

std::vector<LagRing> IrradianceRings(BeamProfile profile, double diameter) {
  if (profile == BeamProfile::kUniform) return {RingAt(diameter / 2, 8 / (diameter * diameter), 1)};
  std::vector<LagRing> rings;
  for (const auto& [y, weight] : GaussLaguerre(8))  // the power beyond the radius x is exp(-y), y = 8 x^2
    rings.push_back(RingAt(diameter * std::sqrt(y / 8), 16 / (diameter * diameter) * weight, 1));
  return rings;
}

// A wave's D' is 1 - W cos(kappa . s), whose harmonics are 1 - W J_0 and -(-1)^l W J_2l; BeamSpectrum is kappa^2 times
// the elevation's.
SpectrumRing OnSpectrum(const LagRing& ring, const Eigen::ArrayXd& average) {
  const HankelLattice& lattice = HankelLattice::Shared();
  const Eigen::ArrayXd filter = average / lattice.wavenumbers().square();
  SpectrumRing on{Eigen::MatrixXd(lattice.size(), HankelLattice::kOrders / 2), {}, ring.weight};
  on.slope = on.value;
  for (int l = 0; l < HankelLattice::kOrders / 2; ++l) {
    const HankelLattice::Kernel kernel = l == 0 ? lattice.OneMinusBessel(ring.first, LagRing::kLags, 1)
                                                : lattice.Bessel(2 * l, ring.first, LagRing::kLags, 1);
    const Eigen::MatrixXd about = kernel.cast<double>().transpose() * (l % 2 == 0 && l > 0 ? -1 : 1);
    on.value.col(l) = filter * (about * ring.value).array();
    on.slope.col(l) = filter * (about * ring.slope).array();
  }
  on.value.col(0).array() += (1 - average) / lattice.wavenumbers().square();
  return on;
}

}  // namespace

FootprintKernel::FootprintKernel(BeamProfile profile, double diameter) {
  const HankelLattice& lattice = HankelLattice::Shared();
  const double reach = profile == BeamProfile::kUniform ? diameter : 2.2 * diameter;
  assert(HankelLattice::kShortestLag < 0.1 * diameter && reach < 0.8 * HankelLattice::kLongestLag);
  average_.resize(lattice.size());
  for (int i = 0; i < lattice.size(); ++i)
    average_[i] = FootprintAverage({.footprint = diameter, .profile = profile}, lattice.wavenumbers()[i], 0);
  for (const LagRing& ring : IrradianceRings(profile, diameter))
    irradiance_rings_.push_back(OnSpectrum(ring, average_));
  const int lags = static_cast<int>(lattice.IndexOfLag(reach) / kLagStride) + 5;
  overlap_.resize(lags);
  for (int j = 0; j < lags; ++j) {
    const double s = lattice.Lag(j * kLagStride);
    // The first lag stands for the disc within it, too.
    const double steps = j == 0 ? 0.5 * kLagStride * lattice.step() + 0.5 : kLagStride * lattice.step();
    overlap_[j] = 2 * kPi * s * s * steps * 4 / (kPi * diameter * diameter) * FootprintOverlap(profile, s / diameter);
  }
  overlap_edge_ = overlap_edge_slope_ = Eigen::ArrayXd::Zero(lags);
  for (const LagRing& ring : OverlapRings(profile, diameter)) {
    overlap_edge_.segment<LagRing::kLags>(ring.first) += ring.weight * ring.value.array();
    overlap_edge_slope_.segment<LagRing::kLags>(ring.first) += ring.weight * ring.slope.array();
  }
}

}  // namespace albtpu
