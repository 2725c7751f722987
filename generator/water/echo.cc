#include "generator/water/echo.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <utility>

#include "generator/math/random_stream.h"

namespace albtpu {
namespace {

// Pairs draw from other streams than walks: parts from here on are theirs.
constexpr std::uint32_t kPairs = 1 << 16;

struct Arrival {
  float excess, ahead, sideways, weight, forward, sidelong;

  double secant() const { return std::sqrt(1 + double{forward} * forward + double{sidelong} * sidelong); }
};

// By half of this tilt the pairs at the edge of a field of view are moved inwards and outwards.
constexpr double kTiltOfEdge = 0.2;

std::vector<Arrival> ArrivalsOf(const Crossings& crossings, double absorption) {
  std::vector<Arrival> arrivals(crossings.excess.size());
  const auto scale = static_cast<float>(1 / crossings.depth);
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    arrivals[i] = {crossings.excess[i] * scale,   crossings.ahead[i] * scale,
                   crossings.sideways[i] * scale, static_cast<float>(std::exp(-absorption * crossings.excess[i])),
                   crossings.forward[i],          crossings.sidelong[i]};
  }
  return arrivals;
}

// Arrivals by square, so that those near a point are found without a full search.
class NearArrivals {
 public:
  // Squares are as wide as the largest distance of a query. Everything is near if that is not finite.
  NearArrivals(std::span<const Arrival> arrivals, double width, double height) : per_x_(1 / width), per_y_(1 / height) {
    if (per_x_ > 0) {
      begins_.assign(kSide * kSide + 1, 0);
      for (const Arrival& arrival : arrivals) ++begins_[SquareOf(arrival) + 1];
      for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
      std::vector<std::uint32_t> next = begins_;
      sorted_.resize(arrivals.size());
      for (const Arrival& arrival : arrivals) sorted_[next[SquareOf(arrival)]++] = arrival;
    } else {
      sorted_.assign(arrivals.begin(), arrivals.end());
    }
    weights_before_.reserve(sorted_.size() + 1);
    for (const Arrival& arrival : sorted_) weights_before_.push_back(weights_before_.back() + arrival.weight);
  }

  // The arrivals of nine squares around a point: three rows of them.
  struct Around {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 3> rows{};
    double weight = 0;  // of all
  };

  Around Near(double x, double y) const {
    Around around;
    if (begins_.empty()) {
      around.rows[0] = {0, static_cast<std::uint32_t>(sorted_.size())};
    } else {
      const int column = Place(x * per_x_), row = Place(y * per_y_);
      const int first = std::max(column - 1, 0), last = std::min(column + 1, kSide - 1);
      for (int i = std::max(row - 1, 0), k = 0; i <= std::min(row + 1, kSide - 1); ++i, ++k)
        around.rows[k] = {begins_[i * kSide + first], begins_[i * kSide + last + 1]};
    }
    for (const auto& row : around.rows) around.weight += WeightOf(row);
    return around;
  }

  // One of them, with a probability proportional to its weight; `pick` is uniform in [0, 1).
  const Arrival& Pick(const Around& around, double pick) const {
    double weight = pick * around.weight;
    std::size_t row = 0;
    for (; row < 2 && weight >= WeightOf(around.rows[row]); ++row) weight -= WeightOf(around.rows[row]);
    while (row > 0 && around.rows[row].first == around.rows[row].second) --row;  // by rounding
    const auto [begin, end] = around.rows[row];
    const auto first = weights_before_.begin() + begin + 1;
    const auto chosen = std::upper_bound(first, first + (end - begin - 1), weights_before_[begin] + weight);
    return sorted_[begin + (chosen - first)];
  }

 private:
  static constexpr int kSide = 128;  // The outermost squares extend to infinity.

  static int Place(double scaled) {
    return static_cast<int>(std::clamp(std::floor(scaled) + kSide / 2.0, 0.0, kSide - 1.0));
  }
  std::size_t SquareOf(const Arrival& arrival) const {
    return static_cast<std::size_t>(Place(arrival.sideways * per_y_) * kSide + Place(arrival.ahead * per_x_));
  }
  double WeightOf(const std::pair<std::uint32_t, std::uint32_t>& row) const {
    return weights_before_[row.second] - weights_before_[row.first];
  }

  double per_x_, per_y_;
  std::vector<Arrival> sorted_;
  std::vector<std::uint32_t> begins_;  // of each square in `sorted_`; empty: everything is near
  std::vector<double> weights_before_ = {0};
};

// The mean number of pairs of each photon, `pairs` in all: in proportion to the weight of the arrivals near it. Every
// photon has some, because the beam's width moves it.
std::vector<double> PairsOf(const std::vector<Arrival>& lit, const NearArrivals& seen, double pairs) {
  std::vector<double> met(lit.size());
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    met[i] = seen.Near(lit[i].ahead, lit[i].sideways).weight;
    sum += met[i] * lit[i].weight;
    weights += lit[i].weight;
  }
  const double least = 0.1 * sum / weights;
  const double scale = pairs / (sum + least * weights);
  for (std::size_t i = 0; i < lit.size(); ++i) met[i] = (met[i] + least) * lit[i].weight * scale;
  return met;
}

}  // namespace

Echo::Echo(double of_step)
    : step(of_step),
      weights(static_cast<std::size_t>((kLatest - kEarliest) / of_step) + 2),
      delays(weights.size()),
      losses(weights.size()) {}

namespace {

// The sample before a time and the share of the sample after it.
struct Place {
  std::size_t bin;
  double later;
};

std::optional<Place> PlaceOf(double time, const Echo& echo) {
  const double place = (time - Echo::kEarliest) / echo.step;
  if (!(place >= 0 && place < static_cast<double>(echo.weights.size() - 1))) return std::nullopt;
  const auto bin = static_cast<std::size_t>(place);
  return Place{bin, place - static_cast<double>(bin)};
}

}  // namespace

void Echo::Add(double time, double ahead_of, double weight, const TiltOfPair& tilt) {
  energy += weight;
  ahead += weight * ahead_of;
  ahead_squared += weight * ahead_of * ahead_of;
  const std::optional<Place> place = PlaceOf(time, *this);
  if (!place) return;
  const std::size_t bin = place->bin;
  const double later = weight * place->later, earlier = weight - later;
  weights[bin] += earlier;
  weights[bin + 1] += later;
  delays[bin] += earlier * tilt.delay;
  delays[bin + 1] += later * tilt.delay;
  losses[bin] += earlier * tilt.loss;
  losses[bin + 1] += later * tilt.loss;
}

void Echo::AddLoss(double time, double weight) {
  if (const std::optional<Place> place = PlaceOf(time, *this)) {
    losses[place->bin] += weight * (1 - place->later);
    losses[place->bin + 1] += weight * place->later;
  }
}

Echo& Echo::operator+=(const Echo& other) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] += other.weights[i];
    delays[i] += other.delays[i];
    losses[i] += other.losses[i];
  }
  energy += other.energy;
  ahead += other.ahead;
  ahead_squared += other.ahead_squared;
  return *this;
}

Echo& Echo::operator*=(double factor) {
  for (std::vector<double>* column : {&weights, &delays, &losses})
    for (double& weight : *column) weight *= factor;
  energy *= factor;
  ahead *= factor;
  ahead_squared *= factor;
  return *this;
}

Echo PairPhotons(const Crossings& sources, const Crossings& receivers, const EchoSetup& setup, std::uint64_t seed,
                 std::uint32_t cell, std::uint32_t pool) {
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
  const double absorption = setup.absorption * sources.depth;
  const NearArrivals seen(ArrivalsOf(receivers, setup.absorption), radius / cosine, radius);
  const double spread = setup.footprint / 4;
  const std::vector<double> pairs_of = PairsOf(lit, seen, setup.pairs_per_photon * static_cast<double>(lit.size()));
  double made = UniformStream(seed, cell, static_cast<std::uint32_t>(lit.size()), kPairs + pool).Next();
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (!(pairs_of[i] > 0)) continue;
    UniformStream random(seed, cell, static_cast<std::uint32_t>(i), kPairs + pool);
    const Arrival& source = lit[i];
    for (made += pairs_of[i]; made >= 1; made -= 1) {
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
      if (!(near.weight > 0)) continue;
      const Arrival& receiver = seen.Pick(near, pick);
      const double exit_x = x - receiver.ahead, exit_y = y - receiver.sideways;
      const double apart_x = source.forward - receiver.forward, apart_y = mirror * source.sidelong - receiver.sidelong;
      // The smallest field of view that sees it; wider ones are summed up below.
      const auto least = [&](double tilt) {
        const double along = (exit_x + tilt * x * apart_x) * cosine, across = exit_y + tilt * x * apart_y;
        const double diameter = 2 * std::sqrt(along * along + across * across);
        return static_cast<std::size_t>(std::lower_bound(fields_of_view.begin(), fields_of_view.end(), diameter) -
                                        fields_of_view.begin());
      };
      const double longer = source.secant() + receiver.secant();
      const TiltOfPair by_tilt{.delay = x * (longer / 2 + lag * apart_x),
                               .loss = x * absorption * longer + receiver.forward};
      const double time =
          (source.excess + receiver.excess) * 0.5 + lag * (entry_x + exit_x) + setup.tilt * by_tilt.delay;
      const double weight = source.weight * near.weight / pairs_of[i] * std::exp(-setup.tilt * by_tilt.loss);
      const std::size_t view = least(setup.tilt);
      if (view < echoes.size()) echoes[view].Add(time, x, weight, by_tilt);
      const std::size_t fallen = least(setup.tilt + kTiltOfEdge / 2), risen = least(setup.tilt - kTiltOfEdge / 2);
      if (fallen != risen) {
        if (fallen < echoes.size()) echoes[fallen].AddLoss(time, -weight / kTiltOfEdge);
        if (risen < echoes.size()) echoes[risen].AddLoss(time, weight / kTiltOfEdge);
      }
    }
  }
  const double pairs = static_cast<double>(sources.launched) * receivers.launched;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    echoes[i] *= 1 / pairs;
    if (i > 0) echoes[i] += echoes[i - 1];
  }
  return echoes;
}

}  // namespace albtpu
