#include "generator/monte_carlo/beam_uncertainty.h"

#include <algorithm>
#include <cmath>

#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

// One quantity of a beam in all realizations (rows) and their two parts (columns).
class Column {
 public:
  template <typename Value>
  Column(const std::vector<BeamRealization>& sample, const Value& value)
      : values_(sample.size(), 2), shares_(sample.size(), 2) {
    for (Eigen::Index i = 0; i < values_.rows(); ++i) {
      for (const int part : {0, 1}) {
        values_(i, part) = value(sample[i].parts[part].errors);
        shares_(i, part) = sample[i].parts[part].share;
      }
    }
  }

  Eigen::ArrayXd Means() const { return (shares_ * values_).rowwise().sum(); }
  // Squared deviations from the best estimate m of the mean, and the correction that makes their mean an unbiased
  // estimate of the variance: the sample mean is closer to the sample than the true mean is.
  //
  // Derivation: with the control c and the residual r = v - c of the values v, m is the sample mean of r plus E[c].
  // Then E[(v - m)^2] = var(v) - 2 cov(v, m) + var(m), with cov(v, m) = cov(v, r) / n and var(m) = var(r) / n. The
  // correction is (2 cov(r, v) - var(r)) / n = cov(v - c, v + c) / n; without a control, c = 0.
  struct Squares {
    Eigen::ArrayXd sample;
    double mean_correction;
  };
  Squares SquaresAboutMean(const std::optional<Control>& control) const {
    const double mean = Mean(Means(), control).value;
    const Eigen::ArrayXd v = Means() - Means().mean();
    const Eigen::ArrayXd c = control ? Eigen::ArrayXd(control->sample - control->sample.mean()) : 0 * v;
    const double n = static_cast<double>(v.size());
    return {(shares_ * (values_ - mean).square()).rowwise().sum(), ((v - c) * (v + c)).sum() / (n - 1) / n};
  }

 private:
  Eigen::ArrayX2d values_, shares_;
};

// The control variates of a beam: its errors to first and second order in slope, with their known expectations. There
// are none where no statistics of the slopes are known.
class ControlVariates {
 public:
  ControlVariates(const std::vector<BeamRealization>& sample, const BeamOptions& beam, double refractive_index,
                  const std::optional<KnownSlopes>& known)
      : known_(known), azimuth_(std::cos(beam.azimuth), std::sin(beam.azimuth)) {
    if (!known) return;
    const Eigen::Matrix2d response = TangentResponse(beam.incidence, beam.azimuth, refractive_index);
    expectation_ = response * known->mean;
    covariance_ = response * known->footprint_covariance * response.transpose();
    offset_covariance_ = response * known->height_slope_covariance * response.transpose();
    const Eigen::Matrix2d form = SecantCurvature(beam.incidence, beam.azimuth, refractive_index);
    // The vertical error per depth is 1 - secant cos(theta_r). The secant is 1 / cos(theta_r) in still water; its
    // derivative with respect to the in-plane tangent is sin(theta_r), its second-order term in slope m^T form m / 2.
    const double refracted = StillWaterRefraction(beam.incidence, refractive_index);
    vertical_ = -std::sin(refracted) * std::cos(refracted) * azimuth_;
    square_gain_ = -0.5 * std::cos(refracted);
    const auto value_of_form = [&](const Eigen::Vector3d& squares) {
      return form(0, 0) * squares[0] + form(1, 1) * squares[1] + 2 * form(0, 1) * squares[2];
    };
    expected_form_ = value_of_form(known->moments.expected_squares);

    const Eigen::Index n = static_cast<Eigen::Index>(sample.size());
    tangent_.resize(n, 2);
    offset_.resize(n, 2);
    form_.resize(n);
    imbalance_.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      tangent_.row(i) = (response * sample[i].mean_slope).transpose().array();
      offset_.row(i) = -(response * sample[i].height_slope).transpose().array();
      form_[i] = value_of_form(sample[i].mean_squares);
      imbalance_[i] = sample[i].parts[0].share - sample[i].parts[1].share;
    }
  }

  // Controls of the squared errors.
  std::optional<Control> SquaredTangent(int axis) const {
    if (!known_) return std::nullopt;
    return Control{tangent_.col(axis).square(), covariance_(axis, axis)};
  }
  std::optional<Control> SquaredHorizontal(double depth) const {
    if (!known_) return std::nullopt;
    return Control{Squared(depth * tangent_.col(0), offset_.col(0)) + Squared(depth * tangent_.col(1), offset_.col(1)),
                   depth * depth * covariance_.trace() + offset_covariance_.trace()};
  }
  std::optional<Control> SquaredVertical(double depth) const {
    if (!known_) return std::nullopt;
    const auto both = [&](const Eigen::Matrix2d& covariance) { return vertical_.dot(covariance * vertical_); };
    return Control{
        Squared(-depth * Along(vertical_, tangent_),
                depth * square_gain_ * (form_ - expected_form_) - Along(vertical_, offset_)),
        depth * depth * (both(covariance_) + square_gain_ * square_gain_ * known_->moments.variance_of_form) +
            both(offset_covariance_)};
  }
  // Controls of the errors themselves.
  std::optional<Control> Tangent(int axis) const {
    if (!known_) return std::nullopt;
    return Control{imbalance_ * tangent_.col(axis), expectation_[axis]};
  }
  std::optional<Control> Horizontal(double depth, const Eigen::Vector2d& direction) const {
    if (!known_) return std::nullopt;
    return Control{Along(direction, offset_) - depth * imbalance_ * Along(direction, tangent_),
                   -depth * direction.dot(expectation_)};
  }
  std::optional<Control> Vertical(double depth) const {
    if (!known_) return std::nullopt;
    return Control{depth * (imbalance_ * Along(vertical_, tangent_) + square_gain_ * form_) - Along(vertical_, offset_),
                   depth * (vertical_.dot(expectation_) + square_gain_ * expected_form_)};
  }

 private:
  static Eigen::ArrayXd Along(const Eigen::Vector2d& direction, const Eigen::ArrayX2d& vectors) {
    return direction.x() * vectors.col(0) + direction.y() * vectors.col(1);
  }
  // The mean square over both parts, for equal weights, of an error that is even - odd on the surfaces of parts[0] and
  // even + odd on the inverted ones. Unequal weights subtract 2 imbalance odd even, which is left to tracing: as the
  // imbalance is linear in the slopes, the expectation of the product is not zero.
  static Eigen::ArrayXd Squared(const Eigen::ArrayXd& odd, const Eigen::ArrayXd& even) {
    return odd.square() + even.square();
  }

  std::optional<KnownSlopes> known_;
  Eigen::Vector2d azimuth_;
  Eigen::Vector2d expectation_;  // of the tangent less that in still water
  Eigen::Matrix2d covariance_, offset_covariance_;
  Eigen::Vector2d vertical_;  // vertical error per depth and tangent
  double square_gain_ = 0;    // vertical error per depth and value of the form
  double expected_form_ = 0;  // expectation of the form of the squared slopes
  Eigen::ArrayX2d tangent_;   // on the surfaces of parts[0]; on the inverted ones it has the opposite sign
  Eigen::ArrayX2d offset_;    // horizontal error at depth 0, m; equal on both
  Eigen::ArrayXd form_;       // equal on both
  Eigen::ArrayXd imbalance_;  // weight of parts[0] minus weight of parts[1]
};

}  // namespace

bool IsFinite(const BeamUncertainty& beam) {
  const auto finite = [](const Estimate& estimate) {
    return std::isfinite(estimate.value) && std::isfinite(estimate.standard_error);
  };
  const auto all = [&](const std::vector<Estimate>& estimates) {
    return std::all_of(estimates.begin(), estimates.end(), finite);
  };
  return finite(beam.refraction_along_wind) && finite(beam.refraction_cross_wind) && all(beam.thu) && all(beam.tvu) &&
         all(beam.bias_along_beam) && all(beam.bias_vertical);
}

BeamUncertainty UncertaintyOf(const std::vector<BeamRealization>& sample, const BeamOptions& beam,
                              double refractive_index, const std::optional<KnownSlopes>& known,
                              const std::vector<double>& depths) {
  const ControlVariates controls(sample, beam, refractive_index, known);
  const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
  BeamUncertainty result;
  result.realizations = static_cast<int>(sample.size());
  const auto refraction = [&](int axis) {
    const Column angle(sample, [&](const BeamErrors& e) { return std::atan(e.tangent[axis]); });
    const auto [squares, mean_correction] = angle.SquaresAboutMean(controls.Tangent(axis));
    return TwoSigmaOfSquares(squares, mean_correction, controls.SquaredTangent(axis));
  };
  result.refraction_along_wind = refraction(0);
  result.refraction_cross_wind = refraction(1);
  for (const double depth : depths) {
    const auto horizontal = [&](const Eigen::Vector2d& direction) {
      return Column(sample, [&](const BeamErrors& e) {
        return direction.dot(e.horizontal_offset + depth * e.horizontal_per_depth);
      });
    };
    const auto squares_along = [&](const Eigen::Vector2d& direction) {
      return horizontal(direction).SquaresAboutMean(controls.Horizontal(depth, direction));
    };
    const Column::Squares x = squares_along(Eigen::Vector2d::UnitX()), y = squares_along(Eigen::Vector2d::UnitY());
    result.thu.push_back(TwoSigmaOfSquares(x.sample + y.sample, x.mean_correction + y.mean_correction,
                                           controls.SquaredHorizontal(depth)));
    const Column vertical(sample,
                          [&](const BeamErrors& e) { return e.vertical_offset + depth * e.vertical_per_depth; });
    const Column::Squares z = vertical.SquaresAboutMean(controls.Vertical(depth));
    result.tvu.push_back(TwoSigmaOfSquares(z.sample, z.mean_correction, controls.SquaredVertical(depth)));
    result.bias_along_beam.push_back(Mean(horizontal(azimuth).Means(), controls.Horizontal(depth, azimuth)));
    result.bias_vertical.push_back(Mean(vertical.Means(), controls.Vertical(depth)));
  }
  return result;
}

}  // namespace albtpu
