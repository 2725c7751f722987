// Pulses from CSV records: which column has which coordinate, and the numbers in its cells.
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

// Coordinates that are the same for all pulses, by axis.
using FixedCoordinates = std::array<std::optional<float>, kAxisCount>;

// Pulses with an azimuth and pulses without one are queried separately, because a column of PulseColumns has a number
// for all pulses or for none.
struct CsvPulseBatches {
  PulseBatch with_azimuth, without_azimuth;
};

class CsvPulses {
 public:
  // `name` is the file, for messages; `appended` are the columns that the output gets in addition.
  static absl::StatusOr<CsvPulses> Bind(const std::string& name, const CsvRecord& header,
                                        const FixedCoordinates& fixed,
                                        const std::vector<std::string>& appended);

  // Empties the batches, except for coordinates that are the same for all pulses.
  void Clear(CsvPulseBatches& batches) const;

  // Appends a record's pulse to one of the batches. True if the pulse has an azimuth.
  absl::StatusOr<bool> Append(const CsvRecord& record, CsvPulseBatches& batches) const;

 private:
  CsvPulses() = default;

  absl::StatusOr<std::optional<float>> Number(const CsvRecord& record, AxisId axis) const;

  std::string name_;
  std::size_t column_count_ = 0;
  std::array<std::optional<std::size_t>, kAxisCount> columns_;
  FixedCoordinates fixed_;
};

// A single pulse at the fixed coordinates; fetch and azimuth may be absent.
PulseBatch OnePulse(const FixedCoordinates& fixed);

// The flag that sets a coordinate for all pulses: `--wind-speed`.
std::string FlagName(AxisId axis);

}  // namespace albtpu::client
