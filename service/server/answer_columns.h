// The answer of `QueryColumns`: columns that are made at full length and then filled, so that no pulse
// allocates.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/pulse_columns.h"
#include "service/server/query.h"

namespace albtpu::server {

// The quantities that a request names; all if it names none.
using QuantitySelection = std::array<bool, kQuantityCount>;
absl::StatusOr<QuantitySelection> ReadQuantities(const v1::QueryColumnsRequest& request);

// Writes into the message, which must outlive it.
class AnswerColumns {
 public:
  AnswerColumns(const Query& query, const QuantitySelection& selection, const PulseColumns& pulses,
                v1::QueryColumnsResponse& response);

  // The answers of the pulses `begin` to `end`, `end` not included.
  void Fill(std::size_t begin, std::size_t end);

 private:
  using SeaSurfaceColumns = std::array<char*, kQuantityCount>;  // Null where not asked for.

  void MakeSeaSurface(const QuantitySelection& selection, v1::SeaSurfaceColumns& message,
                      SeaSurfaceColumns& columns);
  void MakeS44(v1::S44Columns& message);
  void WriteS44(std::size_t i, const S44Answer& answer);

  const Query& query_;
  const PulseColumns& pulses_;
  char* outcomes_;
  char* outcome_axes_;
  SeaSurfaceColumns values_{};
  SeaSurfaceColumns standard_errors_{};
  char* best_orders_ = nullptr;
  char* remaining_thu_ = nullptr;
  char* remaining_tvu_ = nullptr;
};

}  // namespace albtpu::server
