// What a unit holds: the result of its work as bytes, each number exactly as it was computed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/monte_carlo/monte_carlo.h"

namespace albtpu {

std::string EncodeResult(const SeaCaseResult& result);

// DataLoss when the bytes are not those of an SeaCaseResult of this program.
absl::StatusOr<SeaCaseResult> DecodeResult(std::string_view bytes);

// The same of AnswerDirectly (interpolation_check.h).
std::string EncodeAnswers(const std::vector<Estimate>& answers);
absl::StatusOr<std::vector<Estimate>> DecodeAnswers(std::string_view bytes);

}  // namespace albtpu
