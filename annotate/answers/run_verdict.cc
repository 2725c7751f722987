#include "annotate/answers/run_verdict.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"

namespace albtpu::annotate {
namespace {

constexpr double kRarelyAllDeeper = 20;  // m
constexpr double kAboveByWaves = 2;      // m; how far the shallowest point may seem above the right level.

}  // namespace

std::string RunVerdict::Problem(const AnswerTally& tally) const {
  const std::string how_many =
      tally.interpolated == 0
          ? absl::StrCat("no ", record_, " got a number")
          : absl::StrCat("only ", tally.interpolated, " of ", tally.chosen, " ", record_, "s got a number");
  const std::string outcomes =
      absl::StrJoin(tally.without_number, ", ", [](std::string* text, const auto& outcome) {
        absl::StrAppend(text, outcome.second.count, " ", outcome.first);
      });
  const std::optional<LikelyCause> cause = FindLikelyCause(tally, context_);
  if (!cause.has_value()) return how_many;
  return absl::StrCat(how_many, " (", outcomes, ": ", cause->why, "); ", cause->suggestion);
}

std::string RunVerdict::Add(std::string_view file, const AnswerTally& answers) {
  all_.Merge(answers);
  ++files_;
  last_file_ = file;
  if (!answers.mostly_without_number()) return "";
  return absl::StrCat(std::string(file), ": ", Problem(answers));
}

std::optional<double> RunVerdict::MinDepthWithOtherSign() const {
  if (!all_.min_depth.has_value() || *all_.min_depth < kRarelyAllDeeper) return std::nullopt;
  const double corrected = *all_.min_depth - 2 * context_.water_level.value_or(0);
  if (corrected >= kRarelyAllDeeper || corrected < -kAboveByWaves) return std::nullopt;
  return corrected;
}

absl::Status RunVerdict::status() const {
  const std::string where = files_ == 1 ? last_file_ : absl::StrCat("in all ", files_, " files");
  if (all_.mostly_without_number()) {
    return absl::FailedPreconditionError(absl::StrCat(where, ": ", Problem(all_)));
  }
  const std::optional<double> corrected = MinDepthWithOtherSign();
  if (!corrected.has_value()) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrFormat(
      "%s: no %s is shallower than %g m (the least depth is %.1f m); is the sign of --water-level wrong? "
      "corrected, the least depth would be %.1f m",
      where, record_, kRarelyAllDeeper, *all_.min_depth, *corrected));
}

std::string RunVerdict::DeepNote() const {
  if (!all_.min_depth.has_value() || *all_.min_depth < kRarelyAllDeeper) return "";
  if (MinDepthWithOtherSign().has_value()) return "";  // status() says more.
  return absl::StrFormat(
      "no %s is shallower than %g m (the least depth is %.1f m); unless the survey is that deep, check the "
      "water level and its vertical datum",
      record_, kRarelyAllDeeper, *all_.min_depth);
}

}  // namespace albtpu::annotate
