#include "generator/beam_uncertainty.h"

#include <cmath>

#include "generator/refraction.h"

namespace albtpu {
namespace {

template <typename Value>
Eigen::ArrayXd Column(const std::vector<BeamErrors>& sample, const Value& value) {
  Eigen::ArrayXd values(static_cast<Eigen::Index>(sample.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = value(sample[i]);
  return values;
}

// The control variates of a beam. None where nothing is known.
class Prediction {
 public:
  Prediction(const std::vector<BeamErrors>& sample, const BeamOptions& beam, double refractive_index,
             const std::optional<KnownSlopes>& known)
      : known_(known), azimuth_(std::cos(beam.azimuth), std::sin(beam.azimuth)) {
    if (!known) return;
    const SlopeGain gain = SmallSlopeGain(beam.incidence, refractive_index);
    const Eigen::Matrix2d answer = gain.out_of_plane * Eigen::Matrix2d::Identity() +
                                   (gain.in_plane - gain.out_of_plane) * azimuth_ * azimuth_.transpose();
    mean_ = answer * known->mean;
    covariance_ = answer * known->covariance * answer.transpose();
    x_ = Column(sample, [&](const BeamErrors& e) { return answer.row(0).dot(e.mean_slope); });
    y_ = Column(sample, [&](const BeamErrors& e) { return answer.row(1).dot(e.mean_slope); });
    // The path per depth is 1 / cos(theta_r), of which sin(theta_r) is the derivative by the in-plane tangent.
    const double refracted = StillWaterRefraction(beam.incidence, refractive_index);
    vertical_ = -std::sin(refracted) * std::cos(refracted) * azimuth_;
    square_ = Column(sample, [](const BeamErrors& e) { return e.mean_square_slope; });
    square_gain_ = -0.5 * gain.out_of_plane * gain.out_of_plane;
  }

  std::optional<Control> TangentX() const { return OfTangent(Eigen::Vector2d::UnitX()); }
  std::optional<Control> TangentY() const { return OfTangent(Eigen::Vector2d::UnitY()); }
  std::optional<Control> Along(double depth) const { return OfTangent(-depth * azimuth_); }
  std::optional<Control> Horizontal(double depth) const {
    if (!known_) return std::nullopt;
    return Control{-depth * x_, -depth * y_, 0, depth * depth * covariance_.trace()};
  }
  std::optional<Control> Vertical(double depth) const {
    if (!known_ || !known_->of_the_square) return OfTangent(depth * vertical_);
    const double gain = depth * square_gain_;
    const auto [mean, variance] = *known_->of_the_square;
    return Control{gain * square_, {}, gain * mean, gain * gain * variance};
  }

 private:
  std::optional<Control> OfTangent(const Eigen::Vector2d& weights) const {
    if (!known_) return std::nullopt;
    return Control{
        weights.x() * x_ + weights.y() * y_, {}, weights.dot(mean_), weights.dot(covariance_ * weights)};
  }

  std::optional<KnownSlopes> known_;
  Eigen::Vector2d azimuth_;
  Eigen::Vector2d mean_;  // of the predicted tangent
  Eigen::Matrix2d covariance_;
  Eigen::ArrayXd x_, y_;      // the predicted tangent, less that of still water
  Eigen::Vector2d vertical_;  // the vertical error per depth and tangent
  Eigen::ArrayXd square_;     // the mean square slope
  double square_gain_ = 0;    // the vertical error per depth and mean square slope
};

}  // namespace

BeamUncertainty UncertaintyOf(const std::vector<BeamErrors>& sample, const BeamOptions& beam,
                              double refractive_index, const std::optional<KnownSlopes>& known,
                              const std::vector<double>& depths) {
  const Prediction prediction(sample, beam, refractive_index, known);
  const Eigen::Vector2d azimuth(std::cos(beam.azimuth), std::sin(beam.azimuth));
  BeamUncertainty result;
  result.refraction_along_wind = TwoSigma(
      Column(sample, [](const BeamErrors& e) { return std::atan(e.tangent.x()); }), prediction.TangentX());
  result.refraction_cross_wind = TwoSigma(
      Column(sample, [](const BeamErrors& e) { return std::atan(e.tangent.y()); }), prediction.TangentY());
  for (const double depth : depths) {
    const auto horizontal = [&](int axis) {
      return Column(sample, [&](const BeamErrors& e) {
        return e.horizontal_offset[axis] + depth * e.horizontal_per_depth[axis];
      });
    };
    const Eigen::ArrayXd x = horizontal(0), y = horizontal(1);
    const Eigen::ArrayXd z =
        Column(sample, [&](const BeamErrors& e) { return e.vertical_offset + depth * e.vertical_per_depth; });
    result.thu.push_back(TwoSigma(x, y, prediction.Horizontal(depth)));
    result.tvu.push_back(TwoSigma(z, prediction.Vertical(depth)));
    result.bias_along_beam.push_back(Mean(azimuth.x() * x + azimuth.y() * y, prediction.Along(depth)));
    result.bias_vertical.push_back(Mean(z, prediction.Vertical(depth)));
  }
  return result;
}

}  // namespace albtpu
