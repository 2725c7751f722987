// Pulses from CSV records: which columns have which input of a pulse, and the numbers in their cells.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/csv/pulse_inputs.h"
#include "formats/csv/csv_reader.h"
#include "tables/schema.h"

namespace albtpu::annotate {

// Pulses with an azimuth and pulses without one are queried separately, because a column of PulseColumns has a number
// for all pulses or for none.
struct CsvPulseBatches {
  PulseBatch with_azimuth, without_azimuth;
};

// The number in a cell of `record`; none if it is empty and may be. Messages name file, line and column.
absl::StatusOr<std::optional<float>> NumberOf(const std::string& file, const formats::CsvRecord& record,
                                              std::size_t index, std::string_view column,
                                              std::string_view units, bool may_be_empty);

class CsvPulses {
 public:
  // `name` is the file, for messages; `appended` are the columns that the output gets in addition.
  static absl::StatusOr<CsvPulses> Bind(const std::string& name, const formats::CsvRecord& header,
                                        const FixedInputs& fixed, const std::vector<std::string>& appended);

  // Empties the batches, except for coordinates that are the same for all pulses.
  void Clear(CsvPulseBatches& batches) const;

  // Appends a record's pulse to one of the batches. True if the pulse has an azimuth.
  absl::StatusOr<bool> Append(const formats::CsvRecord& record, CsvPulseBatches& batches) const;

 private:
  // A column that coordinates come from.
  struct Column {
    PulseInput input;
    std::size_t index;
  };

  CsvPulses() = default;

  void FindCoordinates(const FixedInputs& fixed, const InputOrigins& origins);

  std::string name_;
  std::size_t column_count_ = 0;
  std::vector<Column> columns_;
  PulseNumbers fixed_ = {};             // From flags; the others are unspecified.
  FixedCoordinates constant_;           // The same for all pulses.
  std::vector<AxisId> varying_;         // The others, without those that are absent from all pulses.
  std::vector<AxisId> from_other_way_;  // Of these, those that have no column of their own.
  bool may_have_azimuth_ = false;       // Where no cell of it is empty.
  bool azimuths_from_north_ = false;    // Over any sea, from beam_azimuth.
};

// A single pulse at the fixed coordinates; those that have none are absent.
PulseBatch OnePulse(const FixedCoordinates& fixed);

}  // namespace albtpu::annotate
