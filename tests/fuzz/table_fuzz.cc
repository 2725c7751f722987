// Arbitrary bytes as a table file are rejected with a reason, or are a table for which both interpolators agree. In
// either case HDF5 has no more objects open than before.
#include <hdf5.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "tables/file/hdf5.h"
#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"
#include "tables/query/column_query.h"
#include "tables/water/water_column_table.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/twin.h"
#include "tests/tables/synthetic_table.h"

namespace {

using namespace albtpu;

constexpr std::size_t kMostValues = 100'000;  // Larger tables are only decoded, not interpolated.

// Queries pulses on nodes, between them and outside the table, with and without azimuth.
void CheckAnswers(const UncertaintyTable& table) {
  constexpr std::size_t kPulses = 8;
  std::array<std::vector<float>, kAxisCount> columns;
  PulseColumns pulses{.size = kPulses, .axis = {}};
  for (const AxisId id : kAxes) {
    const std::vector<double>& nodes = table.axis(id).nodes();
    const double first = nodes.front(), last = nodes.back(), second = nodes[nodes.size() / 2];
    for (const double x : {first, last, second, (first + second) / 2, (second + last) / 2, first + 0.9 * (last - first),
                           first - 1, 2 * last})
      columns[Index(id)].push_back(static_cast<float>(x));
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
  const fuzz::Twin twin(table);
  for (const bool azimuth_absent : {false, true}) {
    if (azimuth_absent) pulses.axis[Index(AxisId::kAzimuth)] = {};
    interpolator.Interpolate({}, pulses, 0, kPulses, answers);
    twin.MustAgree({}, pulses, answers);
  }
}

// The second kind: rejected with a reason, or finite within its nodes.
void CheckWater(absl::string_view file) {
  absl::StatusOr<Table> table = DecodeTable(file, kWaterColumn);
  if (!table.ok()) {
    ALBTPU_MUST(absl::IsDataLoss(table.status()) || absl::IsInvalidArgument(table.status()));
    return;
  }
  for (const QuantitySchema& quantity : kWaterColumn.quantities)
    if (ValueCount(table->axes(), quantity) > kMostValues) return;
  const absl::StatusOr<WaterColumnTable> water = WaterColumnTable::Create(*std::move(table));
  if (!water.ok()) {
    ALBTPU_MUST(absl::IsInvalidArgument(water.status()));
    return;
  }
  const auto first = [&](WaterAxis axis) { return water->Range(axis).first; };
  const auto last = [&](WaterAxis axis) { return water->Range(axis).second; };
  for (const bool at_last : {false, true}) {
    const auto node = [&](WaterAxis axis) { return at_last ? last(axis) : first(axis); };
    const std::optional<WaterAnswer> answer =
        water->Of(node(WaterAxis::kBackscatterFraction), node(WaterAxis::kScatteringOverAbsorption))
            .At({.incidence = node(WaterAxis::kIncidence),
                 .optical_depth = node(WaterAxis::kOpticalDepth),
                 .field_of_view = node(WaterAxis::kFieldOfView),
                 .pulse_length = node(WaterAxis::kPulseLength)});
    ALBTPU_MUST(answer.has_value());
    for (const double value : *answer) ALBTPU_MUST(!std::isnan(value));
  }
}

// HDF5 keeps nothing of a rejected file that affects the next one: another table is read correctly.
void ReadAnother() {
  static const UncertaintyTable table = testing::TinyTable();
  static const std::string sealed = EncodeTable(table).value();
  const std::string file = sealed;  // Likely in the memory of the previous file.
  const absl::StatusOr<UncertaintyTable> another = DecodeTable(file);
  ALBTPU_MUST(another.ok() && another->digest() == table.digest());
}

ssize_t OpenInHdf5() {
  const hdf5::Session session;
  return H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view file(reinterpret_cast<const char*>(data), size);
  const ssize_t open_before = OpenInHdf5();
  const absl::StatusOr<UncertaintyTable> table = DecodeTable(file);
  ALBTPU_MUST(OpenInHdf5() == open_before);
  if (!table.ok()) {
    ALBTPU_MUST(absl::IsDataLoss(table.status()) || absl::IsInvalidArgument(table.status()));
    ALBTPU_MUST(!table.status().message().empty());
    CheckWater(file);
    ALBTPU_MUST(OpenInHdf5() == open_before);
    if (seal::Check(file).ok()) ReadAnother();
    return 0;
  }
  if (ValueCount(table->axes(), Quantity::kThu) <= kMostValues) CheckAnswers(*table);
  return 0;
}
