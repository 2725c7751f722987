#include "generator/water/photon_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "generator/math/random_stream.h"

namespace albtpu {
namespace {

constexpr double kPi = std::numbers::pi;

// Scattering angles of a Gaussian, sigma [radian] on each axis.
PhaseFunction Gaussian(double sigma) {
  return PhaseFunction([sigma](double psi) { return -std::expm1(-psi * psi / (2 * sigma * sigma)); });
}

// Lewis (1950), doi:10.1103/PhysRev.78.526: exact after a path of given length, for any phase function.
TEST(PhotonWalk, HasTheMomentsOfLewis) {
  const PhaseFunction phase = PhaseFunction::FournierForand(0.0183);
  const double k1 = 1 - phase.MeanCosine(), k2 = 1 - phase.MeanSecondLegendre(), length = 8;
  const int photons = 400'000;
  double cosine = 0, z_mean = 0, z_square = 0, x_square = 0;
  for (int i = 0; i < photons; ++i) {
    UniformStream random(1, 7, static_cast<std::uint32_t>(i));
    Heading heading;
    double x = 0, z = 0;
    for (double left = length; left > 0;) {
      const double free = std::min(left, -std::log(random.Next()));
      x += free * heading.x;
      z += free * heading.z;
      left -= free;
      if (left > 0) heading.Scatter(phase.SinHalf(random.Next()), 2 * kPi * random.Next());
    }
    cosine += heading.z;
    z_mean += z;
    z_square += z * z;
    x_square += x * x;
  }
  const double z = (1 - std::exp(-k1 * length)) / k1;
  const double i0 = (length - z) / k1;
  const double i2 =
      ((1 - std::exp(-k2 * length)) / k2 - (std::exp(-k2 * length) - std::exp(-k1 * length)) / (k1 - k2)) / k1;
  EXPECT_NEAR(cosine / photons, std::exp(-k1 * length), 0.003);
  EXPECT_NEAR(z_mean / photons / z, 1, 0.001);
  EXPECT_NEAR(z_square / photons / (2.0 / 3 * (i0 + 2 * i2)), 1, 0.003);
  EXPECT_NEAR(x_square / photons / (2.0 / 3 * (i0 - i2)), 1, 0.01);
}

// Van de Hulst (1980), Multiple Light Scattering: a slab of optical depth 2 and albedo 0.9, g = 0.75, between matched
// surfaces, lit from above. Transmitted 0.66096.
TEST(PhotonWalk, TransmitsASlabAsVanDeHulstDoes) {
  const double depths[] = {1.8};
  const std::uint32_t photons = 400'000;
  const auto slab =
      WalkPhotons(PhaseFunction::HenyeyGreenstein(0.75), {.refractive_index = 1}, depths, photons, 1, 0, 0);
  double sum = 0;
  for (const float excess : slab[0].excess) sum += std::exp(-(double{excess} + 1.8) / 9);
  EXPECT_NEAR(sum / photons, 0.66096, 0.0015);
}

// Where all angles are small: the paths' excess has the Laplace transform of a Brownian bridge of directions. D is half
// the mean square angle per length, K = sqrt(a D): energy sech(K z), mean excess K z tanh(K z) / (2 a).
TEST(PhotonWalk, LosesLightToAbsorptionAsSmallAnglesDo) {
  const double sigma = 0.002, depth = 200, d = sigma * sigma;
  const double depths[] = {depth};
  const std::uint32_t photons = 100'000;
  const auto planes = WalkPhotons(Gaussian(sigma), {}, depths, photons, 3, 0, 0);
  ASSERT_EQ(planes[0].excess.size(), photons);
  // The tolerances are four standard errors of the drawn means.
  for (const auto& [kz, tolerance] : {std::pair{0.5, 0.001}, {1.0, 0.004}, {2.0, 0.011}}) {
    const double a = kz * kz / (depth * depth * d);
    double energy = 0, excess = 0, square = 0;
    for (std::size_t i = 0; i < photons; ++i) {
      const double weight = std::exp(-a * planes[0].excess[i]);
      energy += weight;
      excess += weight * planes[0].excess[i];
      square += weight * planes[0].sideways[i] * planes[0].sideways[i];
    }
    EXPECT_NEAR(energy / photons * std::cosh(kz), 1, tolerance) << kz;
    EXPECT_NEAR(excess / energy / (kz * std::tanh(kz) / (2 * a)), 1, 0.012) << kz;
    EXPECT_NEAR(square / energy / ((depth - std::tanh(kz) / (kz / depth)) / a), 1, 0.015) << kz;
  }
}

// Wells (1973): what lies within a circle, through the transfer function of the real forward peak.
TEST(PhotonWalk, EncirclesTheEnergyOfWells) {
  const PhaseFunction whole = PhaseFunction::FournierForand(0.0183);
  const double largest = 0.1, depth = 4, beyond = 1 - whole.ShareBelow(largest);
  const PhaseFunction cut([&](double psi) { return std::min(1.0, beyond + whole.ShareBelow(psi)); });
  const double depths[] = {depth};
  const std::uint32_t photons = 200'000;
  const auto planes = WalkPhotons(cut, {}, depths, photons, 5, 0, 0);

  // The transfer function at q: exp(-(z / q) times the integral of 1 - p from 0 to q), where p is the Hankel transform
  // of the scattered shares, the mean of J0(q psi).
  std::vector<double> angles;
  const int draws = 1000;
  for (int i = 0; i < draws; ++i) angles.push_back(2 * std::asin(cut.SinHalf((i + 0.5) / draws)));
  std::vector<double> nodes = {0}, lost = {0};
  double last = 0;
  for (double q = 0.05; q < 5000; q *= 1.02) {
    double mean = 0;
    for (const double psi : angles) mean += std::cyl_bessel_j(0, q * psi) / draws;
    lost.push_back(lost.back() + (q - nodes.back()) * (last + 1 - mean) / 2);
    nodes.push_back(q);
    last = 1 - mean;
  }
  for (const double radius : {0.01, 0.03, 0.1}) {
    const double ballistic = std::exp(-depth), step = 0.5;
    double encircled = ballistic;
    std::size_t node = 1;
    for (double q = step; q < nodes.back(); q += step) {
      while (nodes[node] < q) ++node;
      const double part = (q - nodes[node - 1]) / (nodes[node] - nodes[node - 1]);
      const double integral = lost[node - 1] + part * (lost[node] - lost[node - 1]);
      encircled += radius * std::cyl_bessel_j(1, q * radius) * (std::exp(-depth * integral / q) - ballistic) * step;
    }
    double inside = 0;
    for (std::size_t i = 0; i < planes[0].ahead.size(); ++i)
      inside += std::hypot(planes[0].ahead[i], planes[0].sideways[i]) < radius * depth;
    EXPECT_NEAR(inside / photons, encircled, 0.006) << radius;
  }
}

TEST(PhotonWalk, KeepsUnscatteredLightExactly) {
  const double depths[] = {0.5, 2};
  const std::uint32_t photons = 50'000;
  const auto planes = WalkPhotons(PhaseFunction::FournierForand(0.0183), {.refracted = 0.3}, depths, photons, 1, 0, 0);
  for (const Crossings& plane : planes) {
    std::size_t unscattered = 0;
    for (std::size_t i = 0; i < plane.excess.size(); ++i)
      unscattered += std::abs(plane.excess[i]) < 1e-12 && std::abs(plane.ahead[i]) < 1e-12;
    EXPECT_NEAR(static_cast<double>(unscattered) / photons, std::exp(-plane.depth / std::cos(0.3)), 0.01);
  }
}

TEST(PhotonWalk, IsAFunctionOfItsSeedCellAndPool) {
  const double depths[] = {1};
  const PhaseFunction phase = PhaseFunction::FournierForand(0.02);
  const auto first = WalkPhotons(phase, {}, depths, 100, 1, 2, 3);
  EXPECT_EQ(first[0].excess, WalkPhotons(phase, {}, depths, 100, 1, 2, 3)[0].excess);
  EXPECT_NE(first[0].excess, WalkPhotons(phase, {}, depths, 100, 1, 2, 4)[0].excess);
  EXPECT_NE(first[0].excess, WalkPhotons(phase, {}, depths, 100, 1, 3, 3)[0].excess);
  EXPECT_NE(first[0].excess, WalkPhotons(phase, {}, depths, 100, 2, 2, 3)[0].excess);
}

// The phase function itself [1/sr], for a backscatter fraction of 0.0183 (Fournier and Jonasz (1999), Eq. 10).
double FournierForandValue(double psi) {
  const double mu = 3.5834, n = 1.01 + 0.1542 * (mu - 3), nu = (3 - mu) / 2;
  const double s = std::pow(std::sin(psi / 2), 2);
  const double delta = 4 * s / (3 * (n - 1) * (n - 1)), at_pi = 4 / (3 * (n - 1) * (n - 1));
  const double power = std::pow(delta, nu), power_at_pi = std::pow(at_pi, nu);
  return (nu * (1 - delta) - (1 - power) + (delta * (1 - power) - nu * (1 - delta)) / s) /
             (4 * kPi * std::pow(1 - delta, 2) * power) +
         (1 - power_at_pi) * (3 * std::pow(std::cos(psi), 2) - 1) / (16 * kPi * (at_pi - 1) * power_at_pi);
}

TEST(PhaseFunction, HasTheMomentsOfFournierForand) {
  const PhaseFunction function = PhaseFunction::FournierForand(0.0183);
  EXPECT_NEAR(function.BackscatterFraction(), 0.0183, 1e-6);
  // Integrated apart from this code, with the light below 1e-6 rad.
  EXPECT_NEAR(function.MeanCosine(), 0.930004, 2e-5);
  EXPECT_NEAR(function.MeanSecondLegendre(), 0.877219, 2e-5);
  EXPECT_NEAR(function.MeanSquareAngle(), 0.176922, 2e-5);
}

TEST(PhaseFunction, IsTheIntegralOfFournierForand) {
  const PhaseFunction function = PhaseFunction::FournierForand(0.0183);
  for (const auto& [from, to] : {std::pair{0.001, 0.01}, {0.01, 0.3}, {0.3, 1.2}, {1.2, kPi}}) {
    double sum = 0;
    const int steps = 20'000;
    const double step = std::log(to / from) / steps;
    for (int i = 0; i < steps; ++i) {
      const double psi = from * std::exp((i + 0.5) * step);
      sum += 2 * kPi * FournierForandValue(psi) * std::sin(psi) * psi * step;
    }
    EXPECT_NEAR((function.ShareBelow(to) - function.ShareBelow(from)) / sum, 1, 2e-4) << from;
  }
}

TEST(PhaseFunction, HasTheMomentsOfHenyeyGreenstein) {
  const double g = 0.924;
  const PhaseFunction function = PhaseFunction::HenyeyGreenstein(g);
  EXPECT_NEAR(function.MeanCosine(), g, 1e-6);
  EXPECT_NEAR(function.MeanSecondLegendre(), g * g, 1e-6);
  EXPECT_NEAR(function.BackscatterFraction(), (1 - g) / (2 * g) * ((1 + g) / std::sqrt(1 + g * g) - 1), 1e-6);
}

TEST(PhaseFunction, DrawsAnglesOfItsMoments) {
  const PhaseFunction function = PhaseFunction::FournierForand(0.0183);
  UniformStream random(1, 0, 0);
  const int count = 1'000'000;
  double cosine = 0, backwards = 0;
  for (int i = 0; i < count; ++i) {
    const double sin_half = function.SinHalf(random.Next());
    cosine += 1 - 2 * sin_half * sin_half;
    backwards += sin_half > std::sqrt(0.5);
  }
  EXPECT_NEAR(cosine / count, function.MeanCosine(), 1e-3);
  EXPECT_NEAR(backwards / count, 0.0183, 5e-4);
  EXPECT_EQ(function.SinHalf(0), 0);
  EXPECT_NEAR(function.SinHalf(1 - 1e-12), 1, 1e-4);
}

}  // namespace
}  // namespace albtpu
