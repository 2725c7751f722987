#include "tables/water/water_column_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "absl/strings/str_cat.h"
#include "tables/format.h"

namespace albtpu {
namespace {

// The nodes from `first` on and what each counts.
struct Weights {
  std::size_t first = 0, count = 0;
  std::array<double, 4> of = {};
};

double Scaled(const Axis& axis, double x) { return axis.scale() == Scale::kLog ? std::log(x) : x; }

// Lagrange's polynomial through the four nodes around `coordinate`, which is within the nodes; through all of fewer.
Weights CubicWeights(const Axis& axis, double coordinate) {
  const std::vector<double>& nodes = axis.nodes();
  Weights weights;
  weights.count = std::min<std::size_t>(4, nodes.size());
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), coordinate) - nodes.begin();
  const auto last = static_cast<std::ptrdiff_t>(nodes.size() - weights.count);
  weights.first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 2, 0, last));
  const double x = Scaled(axis, coordinate);
  for (std::size_t i = 0; i < weights.count; ++i) {
    double weight = 1;
    const double own = Scaled(axis, nodes[weights.first + i]);
    for (std::size_t j = 0; j < weights.count; ++j) {
      if (j == i) continue;
      const double other = Scaled(axis, nodes[weights.first + j]);
      weight *= (x - other) / (own - other);
    }
    weights.of[i] = weight;
  }
  return weights;
}

// The same near an incidence of 0, with the mirror image of the second node before the first, which is 0: the first of
// three nodes, and what the second counts for quantities that a mirror keeps, and turns.
struct MirroredWeights {
  Weights even, odd;
};
MirroredWeights WeightsOfIncidence(const Axis& axis, double coordinate) {
  const std::vector<double>& nodes = axis.nodes();
  if (nodes.size() < 3 || nodes.front() != 0 || coordinate >= nodes[1]) {
    const Weights weights = CubicWeights(axis, coordinate);
    return {weights, weights};
  }
  const std::array<double, 4> at = {-nodes[1], 0, nodes[1], nodes[2]};
  std::array<double, 4> of = {1, 1, 1, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) of[i] *= (coordinate - at[j]) / (at[i] - at[j]);
  }
  return {{.first = 0, .count = 3, .of = {of[1], of[2] + of[0], of[3], 0}},
          {.first = 0, .count = 3, .of = {of[1], of[2] - of[0], of[3], 0}}};
}

// A polynomial through nodes of very different distances overshoots by the cube of their ratio: far beyond any water,
// and in the end beyond single precision.
absl::Status CheckDistances(const std::vector<Axis>& axes) {
  constexpr double kMostUneven = 1000;
  for (const Axis& axis : axes) {
    for (std::size_t first = 0; first + 1 < axis.size(); ++first) {
      const std::size_t last = std::min(first + 3, axis.size() - 1);
      const double whole = Scaled(axis, axis.nodes()[last]) - Scaled(axis, axis.nodes()[first]);
      for (std::size_t i = first; i < last; ++i) {
        if (whole <= kMostUneven * (Scaled(axis, axis.nodes()[i + 1]) - Scaled(axis, axis.nodes()[i]))) continue;
        return absl::InvalidArgumentError(absl::StrCat(
            "axis '", std::string(axis.schema().name), "' has nodes at ", axis.nodes()[i], " and ", axis.nodes()[i + 1],
            ", which are too close for its other nodes: cubic polynomials join four of them"));
      }
    }
  }
  return absl::OkStatus();
}

double Held(const Axis& axis, double x) { return std::clamp(x, axis.nodes().front(), axis.nodes().back()); }

const Axis& AxisOf(const std::vector<Axis>& axes, WaterAxis axis) { return axes[Index(axis)]; }

// Whether a quantity is kept over b z, to which it is in proportion where light is scattered once at most.
bool IsOverScattering(std::size_t quantity) {
  return quantity != Index(WaterQuantity::kStretch) && quantity != Index(WaterQuantity::kSpot);
}

// Whether it changes its sign in a mirror.
bool IsOdd(std::size_t quantity) {
  return quantity >= Index(WaterQuantity::kBiasAlongPeak) && quantity <= Index(WaterQuantity::kBiasAlongCentroid);
}

// Where a beam lies on the axes but that of the incidence. nullopt if the table does not cover it.
struct PlaceOfBeam {
  Weights tau, view, pulse;

  static std::optional<PlaceOfBeam> Of(const std::vector<Axis>& axes, const WaterBeam& beam) {
    const Axis &optical_depth = AxisOf(axes, WaterAxis::kOpticalDepth), &view = AxisOf(axes, WaterAxis::kFieldOfView),
               &pulse = AxisOf(axes, WaterAxis::kPulseLength);
    if (!(beam.optical_depth >= 0 && beam.optical_depth <= optical_depth.nodes().back())) return std::nullopt;
    if (!(beam.field_of_view >= view.nodes().front() && beam.pulse_length >= pulse.nodes().front()))
      return std::nullopt;
    return PlaceOfBeam{CubicWeights(optical_depth, Held(optical_depth, beam.optical_depth)),
                       CubicWeights(view, Held(view, beam.field_of_view)),
                       CubicWeights(pulse, Held(pulse, beam.pulse_length))};
  }
};

// At `count` nodes of the incidence from `first` on, interpolated over the other axes. `values` is as in OneWater: the
// innermost loop runs over nodes and quantities, which lie side by side.
std::vector<WaterAnswer> AtNodes(const std::vector<float>& values, const std::vector<Axis>& axes, std::size_t first,
                                 std::size_t count, const PlaceOfBeam& place) {
  const std::size_t views = AxisOf(axes, WaterAxis::kFieldOfView).size(),
                    pulses = AxisOf(axes, WaterAxis::kPulseLength).size(),
                    record = AxisOf(axes, WaterAxis::kIncidence).size() * kWaterQuantityCount;
  std::vector<double> sums(count * kWaterQuantityCount);
  for (std::size_t j = 0; j < place.tau.count; ++j) {
    for (std::size_t k = 0; k < place.view.count; ++k) {
      const std::size_t row = ((place.tau.first + j) * views + place.view.first + k) * pulses + place.pulse.first;
      for (std::size_t l = 0; l < place.pulse.count; ++l) {
        const double weight = place.tau.of[j] * place.view.of[k] * place.pulse.of[l];
        const float* const numbers = values.data() + (row + l) * record + first * kWaterQuantityCount;
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weight * numbers[i];
      }
    }
  }
  std::vector<WaterAnswer> answers(count);
  for (std::size_t i = 0; i < count; ++i)
    std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(i * kWaterQuantityCount), kWaterQuantityCount,
                answers[i].begin());
  return answers;
}

// The sum over nodes of the incidence, in the units of an answer. `nodes` begins with that of the first weight.
WaterAnswer OverNodes(const MirroredWeights& weights, double scattering, std::span<const WaterAnswer> nodes) {
  WaterAnswer answer = {};
  for (std::size_t i = 0; i < weights.even.count; ++i) {
    for (std::size_t q = 0; q < kWaterQuantityCount; ++q)
      answer[q] += (IsOdd(q) ? weights.odd : weights.even).of[i] * nodes[i][q];
  }
  for (std::size_t q = 0; q < kWaterQuantityCount; ++q)
    if (IsOverScattering(q)) answer[q] *= scattering;
  answer[Index(WaterQuantity::kEnergy)] = std::exp(answer[Index(WaterQuantity::kEnergy)]);
  return answer;
}

bool Covers(const Axis& axis, double x) { return x >= axis.nodes().front() && x <= axis.nodes().back(); }

}  // namespace

std::optional<WaterAnswer> WaterOverIncidence::At(double incidence) const {
  if (!Covers(*axis_, incidence)) return std::nullopt;
  const MirroredWeights weights = WeightsOfIncidence(*axis_, incidence);
  return OverNodes(weights, scattering_, std::span(of_).subspan(weights.even.first));
}

std::optional<WaterAnswer> OneWater::At(const WaterBeam& beam) const {
  const Axis& incidence = AxisOf(*axes_, WaterAxis::kIncidence);
  const std::optional<PlaceOfBeam> place = PlaceOfBeam::Of(*axes_, beam);
  if (!place || !Covers(incidence, beam.incidence)) return std::nullopt;
  const MirroredWeights weights = WeightsOfIncidence(incidence, beam.incidence);
  return OverNodes(weights, scattering_ * beam.optical_depth,
                   AtNodes(values_, *axes_, weights.even.first, weights.even.count, *place));
}

std::optional<WaterOverIncidence> OneWater::OverIncidence(const WaterBeam& beam) const {
  const std::optional<PlaceOfBeam> place = PlaceOfBeam::Of(*axes_, beam);
  if (!place) return std::nullopt;
  WaterOverIncidence over;
  over.axis_ = &AxisOf(*axes_, WaterAxis::kIncidence);
  over.scattering_ = scattering_ * beam.optical_depth;
  over.of_ = AtNodes(values_, *axes_, 0, over.axis_->size(), *place);
  return over;
}

absl::StatusOr<WaterColumnTable> WaterColumnTable::Create(Table table) {
  for (std::size_t q = 0; q < kWaterQuantityCount; ++q) {
    if (table.variable(q) != nullptr) continue;
    return absl::InvalidArgumentError(absl::StrCat("variable '", std::string(kWaterColumn.quantities[q].name),
                                                   "' is missing; a table of the water column has all of them"));
  }
  const std::vector<float>& energies = table.variable(Index(WaterQuantity::kEnergy))->values;
  if (!std::all_of(energies.begin(), energies.end(), [](float energy) { return energy > 0; }))
    return absl::InvalidArgumentError("variable 'energy' has a value of 0; an echo has energy");
  if (!(AxisOf(table.axes(), WaterAxis::kOpticalDepth).nodes().front() > 0))
    return absl::InvalidArgumentError("axis 'optical_depth' begins at 0; its first node must be above");
  if (const double first = AxisOf(table.axes(), WaterAxis::kIncidence).nodes().front(); first != 0) {
    return absl::InvalidArgumentError(absl::StrCat("axis 'incidence' begins at ", first,
                                                   " degrees; a table of the water column begins at 0, the vertical"));
  }
  if (absl::Status status = CheckDistances(table.axes()); !status.ok()) return status;
  WaterColumnTable water(std::move(table));
  const auto wrong = std::ranges::find_if(water.values_, [](float v) { return !(std::abs(v) <= format::kMaxValue); });
  if (wrong == water.values_.end()) return water;
  const auto quantity = static_cast<std::size_t>(wrong - water.values_.begin()) % kWaterQuantityCount;
  return absl::InvalidArgumentError(absl::StrCat("variable '", std::string(kWaterColumn.quantities[quantity].name), "'",
                                                 quantity == Index(WaterQuantity::kEnergy) ? " in its logarithm" : "",
                                                 " is beyond ", format::kMaxValue,
                                                 " for each time that light is scattered; is an axis in other units?"));
}

WaterColumnTable::WaterColumnTable(Table table) : table_(std::move(table)) {
  assert(&table_.schema() == &kWaterColumn);
  const std::vector<double>& fractions = axis(WaterAxis::kBackscatterFraction).nodes();
  const std::vector<double>& ratios = axis(WaterAxis::kScatteringOverAbsorption).nodes();
  const std::vector<double>& taus = axis(WaterAxis::kOpticalDepth).nodes();
  const std::size_t incidences = axis(WaterAxis::kIncidence).size(), pulses = axis(WaterAxis::kPulseLength).size(),
                    cells = axis(WaterAxis::kFieldOfView).size() * pulses;
  values_.resize(fractions.size() * ratios.size() * taus.size() * cells * incidences * kWaterQuantityCount);
  for (std::size_t q = 0; q < kWaterQuantityCount; ++q) {
    const std::vector<float>& from = table_.variable(q)->values;
    const std::size_t cells_of_value = kWaterColumn.quantities[q].over_last_axis ? 1 : pulses;
    std::size_t at = 0;  // In the order of the table's axes.
    for (std::size_t water = 0; water < fractions.size() * ratios.size(); ++water) {
      const double per_scattering =
          OpticalDepthPerScattering(ratios[water % ratios.size()], fractions[water / ratios.size()]);
      for (std::size_t incidence = 0; incidence < incidences; ++incidence) {
        for (std::size_t tau = 0; tau < taus.size(); ++tau, at += cells / cells_of_value) {
          const std::size_t row = (water * taus.size() + tau) * cells;
          for (std::size_t cell = 0; cell < cells; ++cell) {
            double value = from[at + cell / cells_of_value];
            if (q == Index(WaterQuantity::kEnergy)) value = std::log(value);
            if (IsOverScattering(q)) value *= per_scattering / taus[tau];
            values_[((row + cell) * incidences + incidence) * kWaterQuantityCount + q] = static_cast<float>(value);
          }
        }
      }
    }
  }
}

std::pair<double, double> WaterColumnTable::Range(WaterAxis axis) const {
  const std::vector<double>& nodes = this->axis(axis).nodes();
  return {nodes.front(), nodes.back()};
}

OneWater WaterColumnTable::Of(double backscatter_fraction, double scattering_over_absorption) const {
  const Axis &fraction = axis(WaterAxis::kBackscatterFraction), &ratio = axis(WaterAxis::kScatteringOverAbsorption);
  const double held_fraction = Held(fraction, backscatter_fraction),
               held_ratio = Held(ratio, scattering_over_absorption);
  const Weights i = CubicWeights(fraction, held_fraction);
  const Weights j = CubicWeights(ratio, held_ratio);
  OneWater water;
  water.scattering_ = 1 / OpticalDepthPerScattering(held_ratio, held_fraction);
  water.axes_ = &table_.axes();
  water.values_.resize(values_.size() / fraction.size() / ratio.size());
  for (std::size_t m = 0; m < i.count; ++m) {
    for (std::size_t n = 0; n < j.count; ++n) {
      const auto weight = static_cast<float>(i.of[m] * j.of[n]);
      const float* const from = &values_[((i.first + m) * ratio.size() + j.first + n) * water.values_.size()];
      for (std::size_t k = 0; k < water.values_.size(); ++k) water.values_[k] += weight * from[k];
    }
  }
  return water;
}

}  // namespace albtpu
