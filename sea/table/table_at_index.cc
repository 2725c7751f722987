#include "sea/table/table_at_index.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/table/sea_table.h"
#include "sea/water_index.h"
#include "tables/format.h"

namespace albtpu {
namespace {

// Snell's law on a sea, for one incidence and index: x along the beam, y across it.
struct Snell {
  Eigen::Matrix2d gain;       // of the tangent by the slope
  Eigen::Vector2d path;       // of the path times cos r by the slope
  Eigen::Matrix2d curvature;  // of the path times cos r
  Eigen::Vector3d bias;       // of the tangent along and across, and of the path times cos r

  void Add(const Snell& other, double times) {
    gain += times * Eigen::Matrix2d(other.gain);
    path += times * Eigen::Vector2d(other.path);
    curvature += times * Eigen::Matrix2d(other.curvature);
    bias += times * Eigen::Vector3d(other.bias);
  }
};

// Quadratic in the covariance of the slopes of the whole sea, on which the ratios of two indices depend little.
class SnellOnSea {
 public:
  SnellOnSea(double incidence, double index)
      : level_(Of(incidence, index, Eigen::Matrix2d::Zero())),
        gentle_(ChangesOf(incidence, index, kGentle)),
        steep_(ChangesOf(incidence, index, kSteep)) {}

  Snell operator()(const Eigen::Matrix2d& slopes) const {
    const double steep = std::clamp((slopes.trace() / 2 - kGentle) / (kSteep - kGentle), -1.0, 2.0);
    const std::array<double, 3> entries = {slopes(0, 0), slopes(1, 1), slopes(0, 1)};
    Snell snell = level_;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      snell.Add(gentle_[i], (1 - steep) * entries[i]);
      snell.Add(steep_[i], steep * entries[i]);
    }
    return snell;
  }

 private:
  using Changes = std::array<Snell, 3>;  // by the entries xx, yy, xy

  static constexpr double kGentle = 0.005, kSteep = 0.04;  // slope variances on each axis

  static Snell Of(double incidence, double index, const Eigen::Matrix2d& slopes) {
    const EffectiveGains gains = EffectiveGainsOf(incidence, index, slopes);
    const double refracted = StillWaterRefraction(incidence, index), c = std::cos(refracted);
    Snell snell{gains.gain.topRows<2>(), c * gains.gain.row(2).transpose(), c * gains.curvature[2],
                gains.mean - Eigen::Vector3d(std::tan(refracted), 0, 1 / c)};
    snell.bias.z() *= c;
    return snell;
  }

  // Along straight lines to slopes of this variance.
  Changes ChangesOf(double incidence, double index, double variance) const {
    const auto at = [&](double xx, double yy, double xy) {
      return Of(incidence, index, (Eigen::Matrix2d() << xx, xy, xy, yy).finished());
    };
    const Snell both = at(variance, variance, 0);
    Changes changes = {at(variance, 0, 0), at(0, variance, 0), at(variance, variance, variance / 2)};
    for (std::size_t i = 0; i < 2; ++i) changes[i].Add(level_, -1);
    changes[2].Add(both, -1);
    changes[2].Add(changes[2], 1);
    for (Snell& change : changes) change.Add(change, 1 / variance - 1);
    // Both together change more, or less, than one after the other.
    Snell together = both;
    together.Add(level_, -1);
    together.Add(changes[0], -variance);
    together.Add(changes[1], -variance);
    for (std::size_t i = 0; i < 2; ++i) changes[i].Add(together, 0.5 / variance);
    return changes;
  }

  Snell level_;
  Changes gentle_, steep_;
};

// The nodes of a table as numbers of the rows of its variables.
class Nodes {
 public:
  explicit Nodes(const UncertaintyTable::Axes& axes) {
    for (const AxisId id : kAxes) sizes_[Index(id)] = axes[Index(id)].size();
  }
  std::size_t size(AxisId id) const { return sizes_[Index(id)]; }
  std::size_t seas() const { return size(AxisId::kWindSpeed) * size(AxisId::kFetch); }
  // Of the axes but depth.
  std::size_t At(std::size_t sea, std::size_t incidence, std::size_t azimuth, std::size_t footprint) const {
    return ((sea * size(AxisId::kIncidence) + incidence) * size(AxisId::kAzimuth) + azimuth) *
               size(AxisId::kFootprint) +
           footprint;
  }
  std::size_t depths() const { return size(AxisId::kDepth); }

 private:
  std::array<std::size_t, kAxisCount> sizes_{};
};

constexpr double kNothing = 1e-9;  // what rounding leaves of a number that is 0 at nadir

double Squared(double x) { return x * x; }

// a / b, or `otherwise` where that has no meaning.
double Ratio(double a, double b, double otherwise) {
  const double ratio = a / b;
  return ratio > 0 && ratio < 1e3 ? ratio : otherwise;
}

// The variance of a tangent from 2 sigma of its angle in degrees, and back: BeamResponse::Refraction.
double VarianceOfTangent(double degrees, double bias) {
  const double angle = Squared(RadiansOfDegrees(degrees) / 2);
  double variance = angle;
  for (int i = 0; i < 3; ++i) variance = angle / Squared(1 - std::min(variance + bias * bias, 0.3));
  return variance;
}
double DegreesOfTangent(double variance, double bias) {
  return DegreesOfRadians(2 * std::sqrt(variance) * (1 - std::min(variance + bias * bias, 0.3)));
}

// Scales the variables of a table in place.
class Scaling {
 public:
  Scaling(const UncertaintyTable::Axes& axes, double from, double to, UncertaintyTable::Variables& variables)
      : axes_(axes), nodes_(axes), from_index_(from), variables_(variables) {
    for (const double degrees : axes[Index(AxisId::kIncidence)].nodes()) {
      const double incidence = RadiansOfDegrees(std::min(degrees, 80.0));
      from_.emplace_back(incidence, from);
      to_.emplace_back(incidence, to);
    }
  }

  void Scale() {
    tbb::parallel_for(std::size_t{0}, nodes_.seas(), [this](std::size_t sea) {
      const Eigen::Matrix2d slopes = SlopesOf(sea);
      // The vertical beam comes last, because the others need its values.
      for (std::size_t i = nodes_.size(AxisId::kIncidence); i-- > 0;)
        for (std::size_t a = 0; a < nodes_.size(AxisId::kAzimuth); ++a) ScaleBeams(sea, i, a, slopes);
    });
  }

 private:
  // What the beams of one direction into one sea share, whatever their footprints.
  struct Beams {
    Beams(const Eigen::Matrix2d& beam_axes, const Snell& from_snell, const Snell& to_snell, const Snell& nadir_snell)
        : axes(beam_axes), from(from_snell), to(to_snell), nadir(nadir_snell) {
      const Eigen::Matrix2d squares = (axes * from.gain * axes.transpose()).cwiseAbs2();
      const Eigen::Matrix2d new_squares = (axes * to.gain * axes.transpose()).cwiseAbs2();
      seen_by_errors = squares.inverse();
      change = new_squares - squares;
      usual = new_squares.trace() / squares.trace();
      const auto of_bias = [](double scaled, double original, double otherwise) {
        return std::abs(original) > kNothing ? Ratio(scaled, original, otherwise) : otherwise;
      };
      bias_along = of_bias(to.bias.x(), from.bias.x(), std::sqrt(usual));
      bias_vertical = of_bias(to.bias.z(), from.bias.z(), usual);
    }

    Eigen::Matrix2d axes;
    Snell from, to, nadir;
    // From the variances of the tangents to those of the slopes, on the axes of the sea, where slopes are uncorrelated;
    // and from these to how much the variances of the tangents grow at the other index.
    Eigen::Matrix2d seen_by_errors, change;
    double usual;                      // ratio of the variances of tangents, of slopes that are alike in all directions
    double bias_along, bias_vertical;  // ratios
  };

  const std::vector<float>& Values(Quantity quantity) const { return variables_[Index(quantity)]->values; }
  double Value(Quantity quantity, std::size_t node) const { return Values(quantity)[node]; }

  // Multiplies values, where there are any, and their standard errors.
  void Multiply(Quantity quantity, std::size_t begin, std::size_t count, double factor) {
    std::optional<Variable>& variable = variables_[Index(quantity)];
    if (!variable) return;
    const auto multiply = [&](std::vector<float>& numbers) {
      for (float& number : std::span(numbers).subspan(begin, count)) {
        const auto product = static_cast<float>(number * factor);
        // What is positive stays so: variables may be interpolated in their logarithm.
        number = number > 0 ? std::clamp(product, std::numeric_limits<float>::min(), kMost) : std::max(product, -kMost);
      }
    };
    multiply(variable->values);
    if (!variable->standard_errors.empty()) multiply(variable->standard_errors);
  }

  // Of the whole sea, on its axes.
  Eigen::Matrix2d SlopesOf(std::size_t sea) const {
    const double bent = Squared(1 - 1 / from_index_);
    const std::size_t node = nodes_.At(sea, 0, 0, 0);
    double x = VarianceOfTangent(Value(Quantity::kRefractionAlongWind, node), 0) / bent;
    double y = VarianceOfTangent(Value(Quantity::kRefractionCrossWind, node), 0) / bent;
    const double depth = axes_[Index(AxisId::kDepth)].nodes().back();
    double all = x + y;
    if (variables_[Index(Quantity::kBiasVertical)] && depth > 0 && all > 0) {
      // At nadir the mean path is longer by half of (1 - 1/n)^2 times the mean square slope.
      const double bias = Value(Quantity::kBiasVertical, (node + 1) * nodes_.depths() - 1);
      all = std::max(all, -2 * bias / depth / bent);
    }
    all = std::min(all, kMaxMeanSquareSlope);
    const double scale = x + y > 0 ? all / (x + y) : 0;
    return Eigen::Vector2d(x * scale, y * scale).asDiagonal();
  }

  void ScaleBeams(std::size_t sea, std::size_t incidence, std::size_t azimuth, const Eigen::Matrix2d& slopes) {
    const double angle = RadiansOfDegrees(axes_[Index(AxisId::kAzimuth)].nodes()[azimuth]);
    const Eigen::Matrix2d axes = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Eigen::Matrix2d on_beam = axes.transpose() * slopes * axes;
    const Beams beams(axes, from_[incidence](on_beam), to_[incidence](on_beam), from_[0](on_beam));
    for (std::size_t f = 0; f < nodes_.size(AxisId::kFootprint); ++f)
      ScaleBeam(nodes_.At(sea, incidence, azimuth, f), nodes_.At(sea, 0, azimuth, f), beams);
  }

  void ScaleBeam(std::size_t node, std::size_t vertical, const Beams& beams) {
    const Snell &from = beams.from, &to = beams.to;
    const Eigen::Vector2d bias = beams.axes * from.bias.head<2>(), new_bias = beams.axes * to.bias.head<2>();
    const double along = Value(Quantity::kRefractionAlongWind, node);
    const double across = Value(Quantity::kRefractionCrossWind, node);
    const Eigen::Vector2d errors(VarianceOfTangent(along, bias.x()), VarianceOfTangent(across, bias.y()));
    const Eigen::Vector2d seen = (beams.seen_by_errors * errors).cwiseMax(0);
    const Eigen::Vector2d change = beams.change * seen;
    std::array<double, 2> new_errors;
    for (int i = 0; i < 2; ++i) new_errors[i] = errors[i] * Ratio(errors[i] + change[i], errors[i], beams.usual);
    Multiply(Quantity::kRefractionAlongWind, node, 1,
             Ratio(DegreesOfTangent(new_errors[0], new_bias.x()), along, std::sqrt(beams.usual)));
    Multiply(Quantity::kRefractionCrossWind, node, 1,
             Ratio(DegreesOfTangent(new_errors[1], new_bias.y()), across, std::sqrt(beams.usual)));

    const double horizontal = Ratio(new_errors[0] + new_errors[1], errors.sum(), beams.usual);
    const Eigen::Matrix2d on_beam = beams.axes.transpose() * seen.asDiagonal() * beams.axes;
    const double first_otherwise = Squared(to.gain(0, 0) / from.gain(0, 0));
    const double first = from.path.norm() > kNothing ? Ratio(to.path.dot(on_beam * to.path),
                                                             from.path.dot(on_beam * from.path), first_otherwise)
                                                     : first_otherwise;
    const auto forms = [&](const Snell& snell) {
      return (snell.curvature * on_beam * snell.curvature * on_beam).trace();
    };
    const double second = Ratio(forms(to), forms(from), beams.usual * beams.usual);
    const double more_than_nadir = Ratio(forms(from), forms(beams.nadir), 1);

    const auto depths = axes_[Index(AxisId::kDepth)].nodes();
    const std::size_t begin = node * depths.size(), nadir_begin = vertical * depths.size();
    Multiply(Quantity::kThu, begin, depths.size(), std::sqrt(horizontal));
    Multiply(Quantity::kBiasAlongBeam, begin, depths.size(), beams.bias_along);
    Multiply(Quantity::kBiasVertical, begin, depths.size(), beams.bias_vertical);
    const auto variance = [&](std::size_t at) { return Squared(Value(Quantity::kTvu, at)); };
    const double surface = depths[0] == 0 ? variance(begin) : 0;
    const double nadir_surface = depths[0] == 0 ? variance(nadir_begin) : 0;
    for (std::size_t d = 0; d < depths.size(); ++d) {
      const double at_depth = variance(begin + d);
      const double below = std::max(0.0, at_depth - surface);
      const double of_nadir = std::max(0.0, variance(nadir_begin + d) - nadir_surface);
      const double bent = std::min(below, of_nadir * more_than_nadir);
      const double all = std::min(surface, at_depth) + below;
      const double scaled = (all - bent) * first + bent * second;
      Multiply(Quantity::kTvu, begin + d, 1, std::sqrt(Ratio(scaled, all, first)));
    }
  }

  static constexpr float kMost = 1e6f;

  const UncertaintyTable::Axes& axes_;
  const Nodes nodes_;
  double from_index_;
  std::vector<SnellOnSea> from_, to_;  // by incidence
  UncertaintyTable::Variables& variables_;
};

}  // namespace

bool StatesIndex(const UncertaintyTable& table) {
  const auto& attributes = table.provenance().attributes;
  const auto found = attributes.find(std::string(format::kRefractiveIndex));
  if (found == attributes.end()) return false;
  const double* const index = std::get_if<double>(&found->second);
  return index != nullptr && *index >= 1.01 && *index <= 2;
}

double IndexOfTable(const UncertaintyTable& table) {
  if (!StatesIndex(table)) return kRefractiveIndex;
  return std::get<double>(table.provenance().attributes.at(std::string(format::kRefractiveIndex)));
}

UncertaintyTable AtIndex(UncertaintyTable table, double index) {
  const double own = IndexOfTable(table);
  if (index == own) return table;
  const TableSchema& schema = table.schema();
  UncertaintyTable::Axes axes = table.axes();
  Provenance provenance = table.provenance();
  provenance.attributes[std::string(format::kRefractiveIndex)] = index;
  UncertaintyTable::Variables variables = std::move(table).ReleaseVariables();
  Scaling(axes, own, index, variables).Scale();
  return UncertaintyTable::Create(schema, std::move(axes), std::move(variables), std::move(provenance)).value();
}

}  // namespace albtpu
