// The aircraft at each pulse of CSV records, for totals.
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

namespace albtpu::annotate {

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
