#include "generator/water/echo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "generator/math/random_stream.h"

namespace albtpu {
namespace {

// Pairs draw from other streams than walks: parts from here on are theirs.
constexpr std::uint32_t kPairs = 1 << 16;

struct Arrival {
  float excess, ahead, sideways, weight;
};

std::vector<Arrival> ArrivalsOf(const Crossings& crossings, double absorption) {
  std::vector<Arrival> arrivals(crossings.excess.size());
  const auto scale = static_cast<float>(1 / crossings.depth);
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    arrivals[i] = {crossings.excess[i] * scale, crossings.ahead[i] * scale, crossings.sideways[i] * scale,
                   static_cast<float>(std::exp(-absorption * crossings.excess[i]))};
  }
  return arrivals;
}

// Arrivals by square, so that those near a point are found without looking at all.
class NearArrivals {
 public:
  // Squares are as wide as the greatest distance that is asked for. Everything is near if that is not finite.
  NearArrivals(std::span<const Arrival> arrivals, double width, double height)
      : per_x_(1 / width), per_y_(1 / height) {
    if (!(per_x_ > 0)) {
      sorted_.assign(arrivals.begin(), arrivals.end());
      return;
    }
    begins_.assign(kSide * kSide + 1, 0);
    for (const Arrival& arrival : arrivals) ++begins_[SquareOf(arrival) + 1];
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    std::vector<std::uint32_t> next = begins_;
    sorted_.resize(arrivals.size());
    for (const Arrival& arrival : arrivals) sorted_[next[SquareOf(arrival)]++] = arrival;
  }

  // The arrivals of nine squares around a point.
  class Around {
   public:
    std::uint32_t count() const { return count_; }
    const Arrival& operator[](std::uint32_t i) const {
      for (const std::span<const Arrival> row : rows_) {
        if (i < row.size()) return row[i];
        i -= static_cast<std::uint32_t>(row.size());
      }
      return rows_.back().back();
    }

   private:
    friend NearArrivals;
    std::array<std::span<const Arrival>, 3> rows_;
    std::uint32_t count_ = 0;
  };

  Around Near(double x, double y) const {
    Around around;
    if (begins_.empty()) {
      around.rows_[0] = sorted_;
    } else {
      const int column = Place(x * per_x_), row = Place(y * per_y_);
      const int first = std::max(column - 1, 0), last = std::min(column + 1, kSide - 1);
      for (int i = std::max(row - 1, 0), k = 0; i <= std::min(row + 1, kSide - 1); ++i, ++k) {
        const std::uint32_t begin = begins_[i * kSide + first], end = begins_[i * kSide + last + 1];
        around.rows_[k] = std::span(sorted_).subspan(begin, end - begin);
      }
    }
    for (const auto& row : around.rows_) around.count_ += static_cast<std::uint32_t>(row.size());
    return around;
  }

 private:
  static constexpr int kSide = 128;  // The outermost squares have all that is beyond.

  static int Place(double scaled) {
    return static_cast<int>(std::clamp(std::floor(scaled) + kSide / 2.0, 0.0, kSide - 1.0));
  }
  std::size_t SquareOf(const Arrival& arrival) const {
    return static_cast<std::size_t>(Place(arrival.sideways * per_y_) * kSide + Place(arrival.ahead * per_x_));
  }

  double per_x_, per_y_;
  std::vector<Arrival> sorted_;
  std::vector<std::uint32_t> begins_;  // of each square in `sorted_`; empty: everything is near
};

}  // namespace

Echo::Echo(double of_step)
    : step(of_step),
      weights(static_cast<std::size_t>((kLatest - kEarliest) / of_step) + 2),
      ahead_weights(weights.size()) {}

void Echo::Add(double time, double ahead_of, double weight) {
  energy += weight;
  ahead += weight * ahead_of;
  ahead_squared += weight * ahead_of * ahead_of;
  const double place = (time - kEarliest) / step;
  if (!(place >= 0 && place < static_cast<double>(weights.size() - 1))) return;
  const auto bin = static_cast<std::size_t>(place);
  const double later = weight * (place - static_cast<double>(bin)), earlier = weight - later;
  weights[bin] += earlier;
  weights[bin + 1] += later;
  ahead_weights[bin] += earlier * ahead_of;
  ahead_weights[bin + 1] += later * ahead_of;
}

Echo& Echo::operator+=(const Echo& other) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] += other.weights[i];
    ahead_weights[i] += other.ahead_weights[i];
  }
  energy += other.energy;
  ahead += other.ahead;
  ahead_squared += other.ahead_squared;
  return *this;
}

Echo& Echo::operator*=(double factor) {
  for (double& weight : weights) weight *= factor;
  for (double& weight : ahead_weights) weight *= factor;
  energy *= factor;
  ahead *= factor;
  ahead_squared *= factor;
  return *this;
}

Echo PairPhotons(const Crossings& sources, const Crossings& receivers, const EchoSetup& setup,
                 std::uint64_t seed, std::uint32_t cell, std::uint32_t pool) {
  const std::array one = {setup.field_of_view};
  return std::move(PairPhotons(sources, receivers, setup, one, seed, cell, pool).front());
}

std::vector<Echo> PairPhotons(const Crossings& sources, const Crossings& receivers, const EchoSetup& setup,
                              std::span<const double> fields_of_view, std::uint64_t seed, std::uint32_t cell,
                              std::uint32_t pool) {
  std::vector<Echo> echoes(fields_of_view.size(), Echo(setup.step));
  const std::vector<Arrival> lit = ArrivalsOf(sources, setup.absorption);
  const double cosine = std::cos(setup.incidence), radius = setup.field_of_view / 2;
  const double lag = std::sin(setup.incidence) / (2 * setup.group_index);
  const NearArrivals seen(ArrivalsOf(receivers, setup.absorption), radius / cosine, radius);
  const double spread = setup.footprint / 4;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    UniformStream random(seed, cell, static_cast<std::uint32_t>(i), kPairs + pool);
    const Arrival& source = lit[i];
    for (int k = 0; k < setup.pairs_per_photon; ++k) {
      double entry_x = 0, entry_y = 0;
      if (spread > 0) {
        const double length = spread * std::sqrt(-2 * std::log(random.Next()));
        const double angle = 2 * std::numbers::pi * random.Next();
        entry_x = length * std::cos(angle) / cosine;
        entry_y = length * std::sin(angle);
      }
      // Water has no left and right: either photon may be mirrored.
      double pick = 2 * random.Next();
      const double mirror = pick < 1 ? 1 : -1;
      pick = pick < 1 ? pick : pick - 1;
      const double x = entry_x + source.ahead, y = entry_y + mirror * source.sideways;
      const NearArrivals::Around near = seen.Near(x, y);
      if (near.count() == 0) continue;
      const auto chosen = static_cast<std::uint32_t>(pick * near.count());
      const Arrival& receiver = near[std::min(chosen, near.count() - 1)];
      const double exit_x = x - receiver.ahead, exit_y = y - receiver.sideways;
      const double diameter = 2 * std::hypot(exit_x * cosine, exit_y);
      // The least field of view that sees it; wider ones are summed up below.
      const auto least = std::lower_bound(fields_of_view.begin(), fields_of_view.end(), diameter);
      if (least == fields_of_view.end()) continue;
      const double time = (source.excess + receiver.excess) * 0.5 + lag * (entry_x + exit_x);
      echoes[static_cast<std::size_t>(least - fields_of_view.begin())].Add(
          time, x, double{source.weight} * receiver.weight * near.count());
    }
  }
  const double pairs = static_cast<double>(sources.launched) * receivers.launched;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    echoes[i] *= 1 / (setup.pairs_per_photon * pairs);
    if (i > 0) echoes[i] += echoes[i - 1];
  }
  return echoes;
}

}  // namespace albtpu
