// For tests: queries about a single pulse, and a source that disturbs its caller.
#pragma once

#include <functional>
#include <mutex>

#include "annotate/answers/batch.h"
#include "service/client/uncertainty_source.h"
#include "tables/query/interpolation.h"

namespace albtpu::testing {

// Queries `source` about one pulse and returns all quantities with their standard errors.
inline PulseUncertainty QueryPulse(client::UncertaintySource& source, const Pulse& pulse,
                                   Coverage coverage = Coverage::kTwoSigma) {
  annotate::PulseBatch batch{.size = 1, .axis = {}};
  batch[AxisId::kWindSpeed] = {pulse.wind_speed};
  batch[AxisId::kFetch] = {pulse.fetch};
  batch[AxisId::kIncidence] = {pulse.incidence};
  if (pulse.azimuth.has_value()) batch[AxisId::kAzimuth] = {*pulse.azimuth};
  batch[AxisId::kFootprint] = {pulse.footprint};
  batch[AxisId::kDepth] = {pulse.depth};
  annotate::AnswerSelection all{.quantities = {}, .standard_errors = true};
  all.quantities.fill(true);
  annotate::AnswerBatch answers;
  const absl::Status status =
      source.Answer({.coverage = coverage, .s44_order = {}}, batch.columns(), answers.Resize(1, all));
  PulseUncertainty uncertainty;
  if (!status.ok()) return uncertainty;  // Invalid.
  uncertainty.outcome = static_cast<Outcome>(answers.outcomes[0] - 1);
  if (answers.outcome_axes[0] > 0) uncertainty.axis = kAxes[answers.outcome_axes[0] - 1];
  answers.FindSides(batch, source.table().axes);
  if (answers.sides[0] > 0) uncertainty.side = static_cast<Side>(answers.sides[0] - 1);
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    uncertainty.values[i] = answers.values[i][0];
    uncertainty.standard_errors[i] = answers.standard_errors[i][0];
  }
  return uncertainty;
}

// Answers as another source does, but first calls `disturb` once, and then fails if `status` is not OK.
class DisturbedSource : public client::UncertaintySource {
 public:
  DisturbedSource(client::UncertaintySource& source, std::function<void()> disturb,
                  absl::Status status = absl::OkStatus())
      : source_(source), disturb_(std::move(disturb)), status_(std::move(status)) {}

  const client::TableSummary& table() const override { return source_.table(); }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override {
    std::call_once(once_, disturb_);
    return status_.ok() ? source_.Answer(query, pulses, answers) : status_;
  }
  absl::Status AnswerBudget(const BudgetOptions& options, const BudgetPulses& pulses,
                            const BudgetAnswers& answers) override {
    std::call_once(once_, disturb_);
    return status_.ok() ? source_.AnswerBudget(options, pulses, answers) : status_;
  }

 private:
  client::UncertaintySource& source_;
  std::function<void()> disturb_;
  absl::Status status_;
  std::once_flag once_;
};

}  // namespace albtpu::testing
