#include "budget/beams/water_surface.h"

#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "sea/samples.h"

namespace albtpu {
namespace {

constexpr double kCell = 5, kSlot = 60;  // m, s
constexpr int kTile = 8;                 // Cells along the side of a tile.
constexpr int kWindow = 4;               // Cells along the side of the window.
constexpr std::size_t kKept = 8;
constexpr std::size_t kMinReturns = 3;
constexpr double kFarthest = 1e8, kLatest = 1e11;

// A kept return: its hash above the bits of its height, so that the smallest ones are a random sample.
using Sample = std::uint64_t;
constexpr Sample kNoSample = ~Sample{0};  // Its height would be NaN.
// In ascending order.
using Cell = std::array<Sample, kKept>;

float HeightOf(Sample sample) { return std::bit_cast<float>(static_cast<std::uint32_t>(sample)); }

Sample SampleOf(double x, double y, double time, double height) {
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  const auto low = std::bit_cast<std::uint32_t>(static_cast<float>(height));
  const std::uint64_t place = MixBits(bits(x) + 0x9e3779b97f4a7c15 * bits(y));
  const std::uint64_t hash = MixBits(place + bits(time) + 0x9e3779b97f4a7c15 * low);
  return (hash & 0xffffffff00000000) | low;
}

void Keep(Sample sample, Cell& cell) {
  if (sample >= cell.back()) return;
  std::size_t i = kKept - 1;
  for (; i > 0 && cell[i - 1] > sample; --i) cell[i] = cell[i - 1];
  cell[i] = sample;
}

// The largest integer that is not above `number`, which is within 2^31.
std::int32_t Floor(double number) {
  const auto truncated = static_cast<std::int32_t>(number);
  return truncated - (number < truncated ? 1 : 0);
}

bool IsPlausible(double x, double y, double time) {
  return std::abs(x) < kFarthest && std::abs(y) < kFarthest && std::abs(time) < kLatest;
}

std::int32_t TileOf(std::int32_t cell) { return cell >> 3; }
int InTile(std::int32_t cell) { return cell & (kTile - 1); }
std::size_t Row(std::int32_t x, std::int32_t y) { return InTile(y) * kTile + InTile(x); }

// Moves the heights for which `is_left` holds before the others, and returns their end. It has no branches: in heights
// without order, a processor would foresee half of them wrongly.
template <typename IsLeft>
std::size_t Part(std::span<float> heights, std::size_t first, std::size_t last, const IsLeft& is_left) {
  std::size_t end = first;
  for (std::size_t i = first; i < last; ++i) {
    const float height = heights[i];
    heights[i] = heights[end];
    heights[end] = height;
    end += is_left(height);
  }
  return end;
}

// Leaves the heights in the order of std::nth_element, by Hoare's quickselect (1961, doi:10.1145/366622.366647).
float MedianOf(std::span<float> heights) {
  const std::size_t middle = heights.size() / 2;
  std::size_t first = 0, last = heights.size();
  while (last - first > 1) {
    const float a = heights[first], b = heights[(first + last) / 2], c = heights[last - 1];
    const float pivot = std::max(std::min(a, b), std::min(std::max(a, b), c));
    const std::size_t below = Part(heights, first, last, [=](float height) { return height < pivot; });
    if (middle < below) {
      last = below;
      continue;
    }
    const std::size_t to_pivot = Part(heights, below, last, [=](float height) { return height <= pivot; });
    if (middle < to_pivot) break;  // All from `below` on are the pivot.
    first = to_pivot;
  }
  const float upper = heights[middle];
  if (heights.size() % 2 == 1) return upper;
  const float lower = *std::max_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(middle));
  return static_cast<float>((static_cast<double>(lower) + upper) / 2);
}

}  // namespace

struct SurfaceReturns::Tiles {
  using Place = LocalWaterSurface::Place;
  using Tile = std::array<Cell, kTile * kTile>;

  Tile& At(const Place& place) {
    if (last != nullptr && place == last_place) return *last;  // Returns that follow each other are neighbours.
    std::unique_ptr<Tile>& tile = map[place];
    if (tile == nullptr) {
      tile = std::make_unique<Tile>();
      for (Cell& cell : *tile) cell.fill(kNoSample);
    }
    last_place = place;
    last = tile.get();
    return *last;
  }

  // The tiles that windows around corners in `place` reach, where there are any: 3 x 3 in the slot that ends at the
  // time of the corners, and 3 x 3 in the one that begins.
  using Neighbours = std::array<const Tile*, 18>;
  Neighbours Around(const Place& place) const {
    Neighbours neighbours{};
    for (int i = 0; i < 18; ++i) {
      const auto found = map.find(Place{place.x + i % 3 - 1, place.y + i / 3 % 3 - 1, place.time + i / 9 - 1});
      if (found != map.end()) neighbours[i] = found->second.get();
    }
    return neighbours;
  }

  // Reads the heights in the window around the lower left corner of the cell (x, y) of the tile in the middle; returns
  // their number.
  using Heights = std::array<float, 2 * kWindow * kWindow * kKept>;
  static std::size_t ReadWindow(const Neighbours& neighbours, std::int32_t x, std::int32_t y, Heights& heights) {
    constexpr std::int32_t kHalf = kWindow / 2;
    std::size_t count = 0;
    for (int slot = 0; slot < 2; ++slot) {
      for (std::int32_t cell_y = y - kHalf; cell_y < y + kHalf; ++cell_y) {
        for (std::int32_t cell_x = x - kHalf; cell_x < x + kHalf; ++cell_x) {
          const Tile* tile = neighbours[9 * slot + 3 * (TileOf(cell_y) + 1) + TileOf(cell_x) + 1];
          if (tile == nullptr) continue;
          const Cell& cell = (*tile)[Row(cell_x, cell_y)];
          for (std::size_t i = 0; i < kKept && cell[i] != kNoSample; ++i) heights[count++] = HeightOf(cell[i]);
        }
      }
    }
    return count;
  }

  absl::flat_hash_map<Place, std::unique_ptr<Tile>> map;
  Place last_place{};
  Tile* last = nullptr;
};

SurfaceReturns::SurfaceReturns() : tiles_(std::make_unique<Tiles>()) {}
SurfaceReturns::~SurfaceReturns() = default;
SurfaceReturns::SurfaceReturns(SurfaceReturns&&) noexcept = default;
SurfaceReturns& SurfaceReturns::operator=(SurfaceReturns&&) noexcept = default;

void SurfaceReturns::Add(double x, double y, double time, double height) {
  if (!IsPlausible(x, y, time) || !(std::abs(height) < kFarthest)) return;
  const std::int32_t cell_x = Floor(x / kCell), cell_y = Floor(y / kCell);
  auto& tile = tiles_->At({TileOf(cell_x), TileOf(cell_y), Floor(time / kSlot)});
  Keep(SampleOf(x, y, time, height), tile[Row(cell_x, cell_y)]);
}

void SurfaceReturns::Merge(SurfaceReturns other) {
  tiles_->last = nullptr;
  for (auto& [place, theirs] : other.tiles_->map) {
    auto& ours = tiles_->map[place];
    if (ours == nullptr) {
      ours = std::move(theirs);
      continue;
    }
    for (std::size_t row = 0; row < ours->size(); ++row)
      for (const Sample sample : (*theirs)[row]) Keep(sample, (*ours)[row]);
  }
}

std::size_t SurfaceReturns::bytes() const {
  return tiles_->map.size() * sizeof(Tiles::Tile) + tiles_->map.capacity() * (sizeof(Tiles::Place) + sizeof(void*) + 1);
}

LocalWaterSurface SurfaceReturns::Finish() const {
  LocalWaterSurface surface;
  // Windows that reach a tile of returns are around corners in it, in its neighbours and in the next slot.
  for (const auto& [place, unused] : tiles_->map)
    for (int i = 0; i < 18; ++i) surface.medians_[{place.x + i % 3 - 1, place.y + i / 3 % 3 - 1, place.time + i / 9}];
  std::vector<std::pair<const Tiles::Place, LocalWaterSurface::Medians>*> tiles;
  for (auto& tile : surface.medians_) tiles.push_back(&tile);
  tbb::parallel_for_each(tiles, [this](auto* tile) {
    const Tiles::Neighbours neighbours = tiles_->Around(tile->first);
    Tiles::Heights heights;
    for (std::int32_t row = 0; row < kTile * kTile; ++row) {
      const std::size_t count = Tiles::ReadWindow(neighbours, row % kTile, row / kTile, heights);
      tile->second[row] =
          count < kMinReturns ? std::numeric_limits<float>::quiet_NaN() : MedianOf(std::span(heights).first(count));
    }
  });
  return surface;
}

std::optional<double> LocalWaterSurface::Reader::HeightAt(double x, double y, double time) {
  if (!IsPlausible(x, y, time)) return std::nullopt;
  const std::int32_t corner_x = Floor(x / kCell + 0.5), corner_y = Floor(y / kCell + 0.5);
  const Place place{TileOf(corner_x), TileOf(corner_y), Floor(time / kSlot + 0.5)};
  if (place_ != place) {
    const auto found = surface_.medians_.find(place);
    place_ = place;
    tile_ = found == surface_.medians_.end() ? nullptr : &found->second;
  }
  if (tile_ == nullptr) return std::nullopt;
  const float median = (*tile_)[Row(corner_x, corner_y)];
  if (std::isnan(median)) return std::nullopt;
  return median;
}

}  // namespace albtpu
