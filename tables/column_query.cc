#include "tables/column_query.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <limits>

namespace albtpu {
namespace {

// Pulses of one piece of work, some 100 us.
constexpr std::size_t kGrain = 4096;

float NumberOrNaN(std::optional<double> number) {
  return number.has_value() ? static_cast<float>(*number) : std::numeric_limits<float>::quiet_NaN();
}

template <typename Number>
std::uint8_t OneBased(Number number) {
  return static_cast<std::uint8_t>(static_cast<int>(number) + 1);
}

template <typename Value>
void Write(Value* column, std::size_t i, Value value) {
  if (column != nullptr) column[i] = value;
}

std::uint8_t BestOrderNumber(double thu, double tvu, double depth) {
  const std::optional<S44Order> order = BestOrder(thu, tvu, depth);
  return order.has_value() ? OneBased(*order) : 0;
}

std::optional<double> Remaining(const Query& query, double (*limit)(S44Order, double), double depth,
                                double ours) {
  if (!query.s44_order.has_value()) return std::nullopt;
  return RemainingBudget(limit(*query.s44_order, depth), ours);
}

}  // namespace

class ColumnInterpolator::Layout {
 public:
  explicit Layout(const UncertaintyTable& table) : table_(table) {}

  void AnswerOne(const Query& query, const Pulse& pulse, std::size_t i, const AnswerColumns& answers) const {
    const PulseUncertainty two_sigma = Interpolate(table_, pulse);
    const PulseUncertainty uncertainty = WithCoverage(two_sigma, query.coverage);
    const bool interpolated = uncertainty.outcome == Outcome::kInterpolated;
    Write(answers.outcomes, i, OneBased(uncertainty.outcome));
    Write(answers.outcome_axes, i, interpolated ? std::uint8_t{0} : OneBased(*uncertainty.axis));
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      Write(answers.values[q], i, uncertainty.values[q]);
      Write(answers.standard_errors[q], i, uncertainty.standard_errors[q]);
    }
    const PulseUncertainty p95 = WithCoverage(two_sigma, Coverage::kP95);
    const float thu = p95[Quantity::kThu], tvu = p95[Quantity::kTvu];
    Write(answers.best_s44_orders, i,
          interpolated ? BestOrderNumber(thu, tvu, pulse.depth) : std::uint8_t{0});
    Write(answers.remaining_thu, i, NumberOrNaN(Remaining(query, ThuLimit, pulse.depth, thu)));
    Write(answers.remaining_tvu, i, NumberOrNaN(Remaining(query, TvuLimit, pulse.depth, tvu)));
  }

 private:
  UncertaintyTable table_;
};

ColumnInterpolator::ColumnInterpolator(const UncertaintyTable& table)
    : layout_(std::make_unique<const Layout>(table)) {}
ColumnInterpolator::~ColumnInterpolator() = default;
ColumnInterpolator::ColumnInterpolator(ColumnInterpolator&&) noexcept = default;
ColumnInterpolator& ColumnInterpolator::operator=(ColumnInterpolator&&) noexcept = default;

void ColumnInterpolator::Answer(const Query& query, const PulseColumns& pulses, std::size_t begin,
                                std::size_t end, const AnswerColumns& answers) const {
  assert(IsValid(pulses) && begin <= end && end <= pulses.size);
  for (std::size_t i = begin; i < end; ++i) layout_->AnswerOne(query, PulseAt(pulses, i), i, answers);
}

void AnswerOnAllCores(const ColumnInterpolator& interpolator, const Query& query, const PulseColumns& pulses,
                      const AnswerColumns& answers) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pulses.size, kGrain), [&](const auto& range) {
    interpolator.Answer(query, pulses, range.begin(), range.end(), answers);
  });
}

}  // namespace albtpu
