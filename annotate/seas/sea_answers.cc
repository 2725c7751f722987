#include "annotate/seas/sea_answers.h"

#include <tbb/task_arena.h>

#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "status/status_macros.h"
#include "tables/s44.h"

namespace albtpu::annotate {
std::shared_ptr<OpenSeas::Sea> OpenSeas::Find(std::size_t i) {
  const absl::MutexLock lock(&mutex_);
  if (const auto found = by_record_.find(i); found != by_record_.end()) {
    order_.splice(order_.begin(), order_, found->second);
    return order_.front();
  }
  order_.push_front(std::make_shared<Sea>(i));
  by_record_[i] = order_.begin();
  if (order_.size() > most_) {
    by_record_.erase(order_.back()->record);
    order_.pop_back();  // Users of the source keep it alive.
  }
  return order_.front();
}

absl::StatusOr<std::shared_ptr<client::UncertaintySource>> OpenSeas::Get(std::size_t i) {
  const std::shared_ptr<Sea> sea = Find(i);
  if (!sea->opening.TryLock()) {
    if (i + 1 < seas_.size()) {
      const std::shared_ptr<Sea> next = Find(i + 1);
      if (next->opening.TryLock()) {
        Compile(*next);
        next->opening.Unlock();
      }
    }
    sea->opening.Lock();
  }
  Compile(*sea);
  const absl::StatusOr<std::shared_ptr<client::UncertaintySource>> source = sea->source;
  sea->opening.Unlock();
  return source;
}

void OpenSeas::Compile(Sea& sea) {
  if (!sea.source.ok() || *sea.source != nullptr) return;
  // Isolated, because this thread has the sea: a task of other pulses would wait for it forever.
  absl::StatusOr<std::unique_ptr<client::UncertaintySource>> source =
      tbb::this_task_arena::isolate([&] { return sources_->Open(seas_.sea(sea.record)); });
  if (source.ok())
    sea.source = std::shared_ptr<client::UncertaintySource>(*std::move(source));
  else
    sea.source = source.status();
}

namespace {

// Interpolates `answers`, those of the first sea, towards `others`; `weights` are those of the others.
void Blend(const AnswerBatch& others, const std::vector<float>& weights, AnswerBatch& answers) {
  for (const Quantity quantity : kQuantities) {
    const std::span<float> values = answers.values[Index(quantity)], errors = answers.standard_errors[Index(quantity)];
    const std::span<const float> other_values = others.values[Index(quantity)],
                                 other_errors = others.standard_errors[Index(quantity)];
    const auto linear = [](float a, float b, float weight) { return a + weight * (b - a); };
    if (Describe(quantity).is_bias) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear(values[i], other_values[i], weights[i]);
      for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = linear(errors[i], other_errors[i], weights[i]);
      continue;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float weight = weights[i], a = (1 - weight) * values[i], b = weight * other_values[i];
      const float value = std::sqrt(a * values[i] + b * other_values[i]);
      if (!errors.empty()) {
        errors[i] =
            value > 0 ? (a * errors[i] + b * other_errors[i]) / value : linear(errors[i], other_errors[i], weight);
      }
      values[i] = value;
    }
  }
  // The axis of the nearer sea; heights in variance.
  for (std::size_t i = 0; i < answers.sea_axes.size(); ++i) {
    if (weights[i] > 0.5f) answers.sea_axes[i] = others.sea_axes[i];
    const float weight = weights[i], height = answers.wave_heights[i], other = others.wave_heights[i];
    answers.wave_heights[i] = std::sqrt((1 - weight) * height * height + weight * other * other);
  }
}

// The orders of S-44 that THU and TVU at 95 % leave open, and what remains of one of them.
void CompareWithS44(const PulseBatch& pulses, std::optional<S44Order> order, const AnswerBatch& p95,
                    const AnswerSelection& selection, AnswerBatch& answers) {
  const std::span<const float> thu = p95[Quantity::kThu], tvu = p95[Quantity::kTvu];
  answers.best_s44_orders.resize(selection.best_s44_orders ? pulses.size : 0);
  answers.remaining_thu.resize(selection.s44_remaining ? pulses.size : 0);
  answers.remaining_tvu.resize(answers.remaining_thu.size());
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const double depth = pulses.coordinate(AxisId::kDepth, i);
    const bool known = answers.interpolated(i);
    if (selection.best_s44_orders) {
      const std::optional<S44Order> best = known ? BestOrder(thu[i], tvu[i], depth) : std::nullopt;
      answers.best_s44_orders[i] = best.has_value() ? static_cast<std::uint8_t>(static_cast<int>(*best) + 1) : 0;
    }
    if (!selection.s44_remaining) continue;
    const auto remaining = [&](double limit, double ours) {
      const std::optional<double> left = known ? RemainingBudget(limit, ours) : std::nullopt;
      return static_cast<float>(left.value_or(NAN));
    };
    answers.remaining_thu[i] = order.has_value() ? remaining(ThuLimit(*order, depth), thu[i]) : NAN;
    answers.remaining_tvu[i] = order.has_value() ? remaining(TvuLimit(*order, depth), tvu[i]) : NAN;
  }
}

// The pulses of `rows`.
PulseBatch Rows(const PulseBatch& pulses, const std::vector<std::uint32_t>& rows) {
  PulseBatch part{.size = rows.size(), .axis = {}, .azimuths_from_north = pulses.azimuths_from_north};
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const std::vector<float>& column = pulses.axis[axis];
    if (column.size() != pulses.size) {
      part.axis[axis] = column;
      continue;
    }
    part.axis[axis].reserve(rows.size());
    for (const std::uint32_t row : rows) part.axis[axis].push_back(column[row]);
  }
  return part;
}

template <typename Number>
void Scatter(const std::vector<Number>& part, const std::vector<std::uint32_t>& rows, std::vector<Number>& all) {
  if (all.empty()) return;
  for (std::size_t i = 0; i < rows.size(); ++i) all[rows[i]] = part[i];
}

void Scatter(const AnswerBatch& part, const std::vector<std::uint32_t>& rows, AnswerBatch& all) {
  Scatter(part.outcomes, rows, all.outcomes);
  Scatter(part.outcome_axes, rows, all.outcome_axes);
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    Scatter(part.values[i], rows, all.values[i]);
    Scatter(part.standard_errors[i], rows, all.standard_errors[i]);
  }
  Scatter(part.best_s44_orders, rows, all.best_s44_orders);
  Scatter(part.remaining_thu, rows, all.remaining_thu);
  Scatter(part.remaining_tvu, rows, all.remaining_tvu);
  Scatter(part.sea_axes, rows, all.sea_axes);
  Scatter(part.wave_heights, rows, all.wave_heights);
}

}  // namespace

absl::StatusOr<std::unique_ptr<SeaAnswers>> SeaAnswers::Open(std::shared_ptr<const SeaTimeline> seas,
                                                             std::unique_ptr<client::SeaSources> sources) {
  const std::size_t first = seas->by_time() ? 0 : seas->fixed().first;
  std::unique_ptr<SeaAnswers> answers(new SeaAnswers(std::move(seas), std::move(sources)));
  ASSIGN_OR_RETURN(answers->first_, answers->Summary(first));
  return answers;
}

AnswerSource SeaAnswers::source() {
  return {first_, [this](const Query& query, const PulseBatch& pulses, const AnswerSelection& selection,
                         AnswerBatch& answers) { return Answer(query, pulses, selection, answers); }};
}

absl::StatusOr<client::TableSummary> SeaAnswers::Summary(std::size_t record) {
  ASSIGN_OR_RETURN(const std::shared_ptr<client::UncertaintySource> sea, open_.Get(record));
  return sea->table();
}

absl::Status SeaAnswers::Answer(const Query& query, const PulseBatch& pulses, const AnswerSelection& selection,
                                AnswerBatch& answers) {
  if (!seas_->by_time())
    return AnswerBetween(query, pulses, seas_->fixed(),
                         std::vector<float>(pulses.size, static_cast<float>(seas_->fixed().weight)), selection,
                         answers);
  assert(pulses.times.size() == pulses.size);
  // The pulses between each two records. Mostly all lie between the same two.
  struct Group {
    BetweenRecords between;
    std::vector<std::uint32_t> rows;
    std::vector<float> weights;
  };
  std::map<std::size_t, Group> groups;  // By the first record.
  Group* last = nullptr;
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const std::optional<BetweenRecords> between = seas_->At(pulses.times[i], last == nullptr ? 0 : last->between.first);
    assert(between.has_value());
    if (last == nullptr || last->between.first != between->first) last = &groups[between->first];
    if (last->rows.empty() || between->second != between->first) last->between = *between;
    last->rows.push_back(static_cast<std::uint32_t>(i));
    last->weights.push_back(static_cast<float>(between->weight));
  }
  if (groups.size() == 1) return AnswerBetween(query, pulses, last->between, last->weights, selection, answers);
  answers.Resize(pulses.size, selection);
  answers.sea_axes.resize(selection.sea_frame ? pulses.size : 0);
  answers.wave_heights.resize(answers.sea_axes.size());
  AnswerBatch part;
  for (const auto& [first, group] : groups) {
    RETURN_IF_ERROR(AnswerBetween(query, Rows(pulses, group.rows), group.between, group.weights, selection, part));
    Scatter(part, group.rows, answers);
  }
  return absl::OkStatus();
}

absl::Status SeaAnswers::AnswerBetween(const Query& query, const PulseBatch& pulses, const BetweenRecords& between,
                                       const std::vector<float>& weights, const AnswerSelection& selection,
                                       AnswerBatch& answers) {
  ASSIGN_OR_RETURN(const std::shared_ptr<client::UncertaintySource> first, open_.Get(between.first));
  if (between.second == between.first) return AnswerPulses(*first, query, pulses, selection, answers);
  ASSIGN_OR_RETURN(const std::shared_ptr<client::UncertaintySource> second, open_.Get(between.second));
  AnswerBatch others;
  const auto ask = [&](const Query& asked, const AnswerSelection& selected, AnswerBatch& blended) {
    absl::Status status = AnswerPulses(*first, asked, pulses, selected, blended);
    if (status.ok()) status = AnswerPulses(*second, asked, pulses, selected, others);
    if (status.ok()) Blend(others, weights, blended);
    return status;
  };
  AnswerSelection numbers = selection;  // Of the blended numbers follow the orders.
  numbers.best_s44_orders = numbers.s44_remaining = false;
  absl::Status status = ask(query, numbers, answers);
  if (!status.ok() || (!selection.best_s44_orders && !selection.s44_remaining)) return status;
  AnswerSelection limited;
  limited.quantities[Index(Quantity::kThu)] = limited.quantities[Index(Quantity::kTvu)] = true;
  AnswerBatch p95;
  status = ask({.coverage = Coverage::kP95, .s44_order = {}}, limited, p95);
  if (status.ok()) CompareWithS44(pulses, query.s44_order, p95, selection, answers);
  return status;
}

}  // namespace albtpu::annotate
