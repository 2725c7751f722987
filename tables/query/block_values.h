// The numbers of a block of pulses, before they are restated and written.
#pragma once

#include "tables/query/block.h"
#include "tables/query/node_records.h"
#include "tables/query/pulse_block.h"

namespace albtpu {

// Which numbers are to be found.
struct Needs {
  bool refraction = false;           // its standard errors included
  bool displacement = false;         // THU, TVU and the biases
  bool displacement_errors = false;  // their standard errors
  bool radius = false;               // the 95 % radius of the horizontal error; needs the first two
};

// At 2 sigma. Numbers of pulses that are not inside the table, and numbers that it does not hold, mean nothing.
class BlockValues {
 public:
  BlockValues(const NodeRecords& records, const Needs& needs) : records_(records), needs_(needs) {}

  void Find(const PulseBlock& block);

  const BlockOf<float>& value(Quantity quantity) const { return downwind_.value(quantity); }
  const BlockOf<float>& standard_error(Quantity quantity) const { return downwind_.standard_error(quantity); }
  const BlockOf<double>& radius_over_thu() const { return downwind_.radius_over_thu; }

 private:
  struct AtOneAzimuth {
    const BlockOf<float>& value(Quantity quantity) const;
    const BlockOf<float>& standard_error(Quantity quantity) const;

    BlockOf<float> refraction[kRecordSize];
    BlockOf<float> displacement[kRecordSize];
    BlockOf<float> displacement_errors[kRecordSize];
    BlockOf<double> radius_over_thu;
  };

  void Find(const PulseBlock& block, Side side, AtOneAzimuth& numbers);
  void TakeExponentials(const BlendedPulses& pulses, bool refraction, AtOneAzimuth& numbers) const;
  void TakeLarger(std::size_t count);

  const NodeRecords& records_;
  const Needs needs_;
  BlockOf<float> blended_[kRecordSize];  // one record after the other
  AtOneAzimuth downwind_, crosswind_;
};

}  // namespace albtpu
