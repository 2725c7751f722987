// Pulses out of CSV records: which column is which coordinate, and what its cells say.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "survey/answers/batch.h"
#include "survey/csv/csv_reader.h"
#include "tables/schema.h"

namespace albtpu::client {

// Coordinates given once for all pulses, by axis.
using FixedCoordinates = std::array<std::optional<float>, kAxisCount>;

// Pulses of one file. Those with an azimuth and those without are asked about apart: a column has all or
// none.
struct CsvPulseBatches {
  PulseBatch with_azimuth, without_azimuth;
};

class CsvPulses {
 public:
  // `name` is the file, for messages; `appended` are the columns that the output will get.
  static absl::StatusOr<CsvPulses> Bind(const std::string& name, const CsvRecord& header,
                                        const FixedCoordinates& fixed,
                                        const std::vector<std::string>& appended);

  // Empties the batches but for what is alike for all pulses.
  void Clear(CsvPulseBatches& batches) const;

  // Appends a record's pulse to one of the batches; true when it has an azimuth.
  absl::StatusOr<bool> Append(const CsvRecord& record, CsvPulseBatches& batches) const;

 private:
  CsvPulses() = default;

  absl::StatusOr<std::optional<float>> Number(const CsvRecord& record, AxisId axis) const;

  std::string name_;
  std::size_t column_count_ = 0;
  std::array<std::optional<std::size_t>, kAxisCount> columns_;
  FixedCoordinates fixed_;
};

// The one pulse of fixed coordinates alone; fetch and azimuth may be absent.
PulseBatch OnePulse(const FixedCoordinates& fixed);

// The flag that gives a coordinate once for all: `--wind-speed`.
std::string FlagName(AxisId axis);

// True for fetch and azimuth, whose absence has a meaning: a fully developed sea, the worse of along and
// across.
constexpr bool MayBeAbsent(AxisId axis) { return axis == AxisId::kFetch || axis == AxisId::kAzimuth; }

}  // namespace albtpu::client
