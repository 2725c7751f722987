#include "tests/fuzz/table_checks.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "tables/query/column_query.h"
#include "tables/water/water_column_table.h"
#include "tests/fuzz/twin.h"

namespace albtpu::fuzz {
namespace {

constexpr std::size_t kMostValues = 100'000;  // A larger table takes too long.

// Where a table is asked on one axis.
enum class Place { kFirst, kLast, kBetween, kNearLast, kBelow, kAbove };

double Coordinate(const Axis& axis, Place place) {
  const double first = axis.nodes().front(), last = axis.nodes().back(), middle = axis.nodes()[axis.size() / 2];
  switch (place) {
    case Place::kFirst:
      return first;
    case Place::kLast:
      return last;
    case Place::kBetween:
      return (first + middle) / 2;
    case Place::kNearLast:
      return first + 0.9 * (last - first);
    case Place::kBelow:
      return first - 1;
    case Place::kAbove:
      return 2 * last;
  }
  return last;
}

// Finite but for the energy, which is interpolated as its logarithm.
bool IsNumber(const std::optional<WaterAnswer>& answer) {
  if (!answer.has_value()) return false;
  for (std::size_t q = 0; q < answer->size(); ++q)
    if (q == Index(WaterQuantity::kEnergy) ? std::isnan((*answer)[q]) : !std::isfinite((*answer)[q])) return false;
  return true;
}

void CheckWaterAt(const WaterColumnTable& water, Place place) {
  const auto at = [&](WaterAxis axis) { return Coordinate(water.axis(axis), place); };
  const OneWater one = water.Of(at(WaterAxis::kBackscatterFraction), at(WaterAxis::kScatteringOverAbsorption));
  WaterBeam beam{.incidence = at(WaterAxis::kIncidence),
                 .optical_depth = at(WaterAxis::kOpticalDepth),
                 .field_of_view = at(WaterAxis::kFieldOfView),
                 .pulse_length = at(WaterAxis::kPulseLength)};
  const std::optional<WaterAnswer> answer = one.At(beam);
  ALBTPU_MUST(IsNumber(answer));
  const std::optional<WaterOverIncidence> over_incidence = one.OverIncidence(beam);
  ALBTPU_MUST(over_incidence.has_value() && IsNumber(over_incidence->At(beam.incidence)));

  const double incidence = beam.incidence;
  for (const double beyond : {2 * water.Range(WaterAxis::kIncidence).second + 1, -1.0, std::nan("")}) {
    beam.incidence = beyond;
    ALBTPU_MUST(!one.At(beam).has_value() && !over_incidence->At(beyond).has_value());
  }
  beam.incidence = incidence;
  beam.optical_depth = 2 * water.Range(WaterAxis::kOpticalDepth).second;
  ALBTPU_MUST(!one.At(beam).has_value() && !one.OverIncidence(beam).has_value());
}

}  // namespace

void CheckAnswers(const UncertaintyTable& table) {
  if (ValueCount(table.axes(), Quantity::kThu) > kMostValues) return;
  constexpr std::size_t kPulses = 8;
  std::array<std::vector<float>, kAxisCount> columns;
  PulseColumns pulses{.size = kPulses, .axis = {}};
  for (const AxisId id : kAxes) {
    const Axis& axis = table.axis(id);
    const double middle = axis.nodes()[axis.size() / 2], last = axis.nodes().back();
    for (const Place place :
         {Place::kFirst, Place::kLast, Place::kBetween, Place::kNearLast, Place::kBelow, Place::kAbove})
      columns[Index(id)].push_back(static_cast<float>(Coordinate(axis, place)));
    for (const double x : {middle, (middle + last) / 2}) columns[Index(id)].push_back(static_cast<float>(x));
    pulses.axis[Index(id)] = columns[Index(id)];
  }
  std::vector<std::uint8_t> outcomes(kPulses), axes(kPulses);
  std::array<std::vector<float>, kQuantityCount> values, errors;
  AnswerColumns answers;
  answers.outcomes = outcomes.data();
  answers.outcome_axes = axes.data();
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    values[q].resize(kPulses);
    errors[q].resize(kPulses);
    answers.values[q] = values[q].data();
    answers.standard_errors[q] = errors[q].data();
  }
  const ColumnInterpolator interpolator(table);
  const Twin twin(table);
  for (const bool azimuth_absent : {false, true}) {
    if (azimuth_absent) pulses.axis[Index(AxisId::kAzimuth)] = {};
    interpolator.Interpolate({}, pulses, 0, kPulses, answers);
    twin.MustAgree({}, pulses, answers);
  }
}

void CheckWater(Table table) {
  for (const QuantitySchema& quantity : kWaterColumn.quantities)
    if (ValueCount(table.axes(), quantity) > kMostValues) return;
  const absl::StatusOr<WaterColumnTable> water = WaterColumnTable::Create(std::move(table));
  if (!water.ok()) {
    ALBTPU_MUST(absl::IsInvalidArgument(water.status()));
    return;
  }
  for (const Place place : {Place::kFirst, Place::kLast, Place::kBetween, Place::kNearLast})
    CheckWaterAt(*water, place);
}

float AnyTableNumber(Random& random) {
  if (random() % 2 == 0) return NotableNumber<float>(random);
  return std::ldexp(static_cast<float>(random() % 2048), static_cast<int>(random() % 24) - 16);
}

}  // namespace albtpu::fuzz
