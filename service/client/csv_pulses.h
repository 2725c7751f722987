// Pulses out of CSV records: which column is which coordinate, and what its cells say.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/client/csv_reader.h"
#include "tables/interpolation.h"
#include "tables/schema.h"

namespace albtpu::client {

// Coordinates given once for all pulses, by axis.
using FixedCoordinates = std::array<std::optional<float>, kAxisCount>;

class CsvPulses {
 public:
  // `name` is the file, for messages; `appended` are the columns that the output will get.
  static absl::StatusOr<CsvPulses> Bind(const std::string& name, const CsvRecord& header,
                                        const FixedCoordinates& fixed,
                                        const std::vector<std::string>& appended);

  absl::StatusOr<Pulse> Read(const CsvRecord& record) const;

 private:
  CsvPulses() = default;

  std::string name_;
  std::size_t column_count_ = 0;
  std::array<std::optional<std::size_t>, kAxisCount> columns_;
  FixedCoordinates fixed_;
};

// Sets one coordinate. Fetch and azimuth may be left unset: a fully developed sea, no azimuth.
void SetCoordinate(AxisId axis, float value, Pulse& pulse);

// The pulse of fixed coordinates alone, those that are absent left as `Pulse` has them.
Pulse PulseAt(const FixedCoordinates& fixed);

// The flag that gives a coordinate once for all: `--wind-speed`.
std::string FlagName(AxisId axis);

// True for fetch and azimuth, whose absence has a meaning.
constexpr bool MayBeAbsent(AxisId axis) { return axis == AxisId::kFetch || axis == AxisId::kAzimuth; }

}  // namespace albtpu::client
