// Pulses from CSV records: which columns have which input of a pulse or of the aircraft, and the numbers in their
// cells.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/csv/pulse_inputs.h"
#include "annotate/totals/pulse_totals.h"
#include "formats/csv/csv_reader.h"
#include "tables/schema.h"

namespace albtpu::annotate {

// Pulses with an azimuth and pulses without one are queried separately, because a column of PulseColumns has a number
// for all pulses or for none.
struct CsvPulseBatches {
  PulseBatch with_azimuth, without_azimuth;

  PulseBatch& operator[](bool has_azimuth) { return has_azimuth ? with_azimuth : without_azimuth; }
};

// The number in a cell of `record`; none if it is empty and may be. Messages name file, line and column.
absl::StatusOr<std::optional<float>> NumberOf(const std::string& file, const formats::CsvRecord& record,
                                              std::size_t index, std::string_view column, std::string_view units,
                                              bool may_be_empty);

// The axes that neither columns of this header nor `fixed` give, although they may not be absent.
std::vector<AxisId> MissingAxes(const formats::CsvRecord& header, const FixedInputs& fixed);

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

// The aircraft at each pulse of CSV records, for totals.

// Element i belongs to pulse i of a batch.
struct CsvAircraftBatch {
  AircraftColumns columns;
  std::vector<float> sea_axes;   // degree, clockwise from north; NaN: not known. Empty: as the plan states.
  std::vector<bool> undirected;  // Pulses whose beam_azimuth is empty.
};

class CsvAircraft {
 public:
  // Columns are named as BudgetInput: altitude, beam_azimuth, roll to yaw_rate; altitude and beam_azimuth may be given
  // by a flag instead. Over a table of winds, a column wind_from has the axis of the sea. Fails where altitude is
  // missing.
  static absl::StatusOr<CsvAircraft> Bind(const std::string& name, const formats::CsvRecord& header,
                                          const FixedInputs& fixed);

  void Clear(CsvAircraftBatch& batch) const;
  // Appends a record's aircraft. beam_azimuth and wind_from may be empty.
  absl::Status Append(const formats::CsvRecord& record, CsvAircraftBatch& batch) const;

 private:
  struct Column {
    std::size_t index;
    BudgetInput input;
  };

  std::string name_;
  std::vector<Column> columns_;
  std::optional<std::size_t> wind_from_;  // Its column.
  std::optional<float> altitude_, beam_azimuth_;
};

// The standard deviation of the elevation [m] of the wind's sea at each pulse, by the spectrum of its table.
void WaveHeightsOfWinds(const PulseBatch& pulses, const std::string& spectrum, std::vector<float>& heights);

}  // namespace albtpu::annotate
