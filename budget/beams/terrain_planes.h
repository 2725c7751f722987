// The slope of the land around a point, from the returns of a survey that are of the ground.
#pragma once

#include <absl/container/flat_hash_map.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace albtpu {

// Positions in a local frame in metres, z up.
//
// The plane at a point is that of the returns in 3 x 3 cells around the one that the point lies in. Cells have 2 m, so
// that the window, 6 m, is wider than the footprint and the horizontal error of any airborne lidar, and narrower than
// most dunes and banks. 4 returns of each cell are kept, those with the smallest hashes, a random sample that depends
// neither on the order of the returns nor on how they were divided. Of the 36 returns of a window with heights that
// scatter by s about the plane, the slope has the standard deviation s / (6 x 1.73 m): 0.3 % for 3 cm.
//
// Where returns fill more than kMostCells cells, cells are twice as wide, until they do not: memory is bounded by
// 130 MB, for 2.8 square kilometres in cells of 2 m and 11 in cells of 4 m.
//
// The plane begins as the one of those through three of the returns that has the least median of vertical distances,
// which shrubs do not turn unless they are nearly half of the returns. Then, twice, it is that of the least squares of
// the returns within 3 scaled medians. There is none with fewer than 6 returns, or where they lie nearly on a line.
class TerrainPlanes {
 public:
  struct Gradient {  // m of height per m towards x and y
    float x, y;
  };

  // None if too few returns lie around. Any number of threads may call it at a time.
  std::optional<Gradient> GradientAt(double x, double y) const;

  double cell() const { return cell_; }  // m
  std::size_t size() const { return gradients_.size(); }

 private:
  friend class TerrainReturns;
  using Place = std::pair<std::int32_t, std::int32_t>;  // Of a cell.
  absl::flat_hash_map<Place, Gradient> gradients_;
  double cell_ = 0;
};

// Collects the returns of the ground in one pass; or one for each part of the points, and Merge.
class TerrainReturns {
 public:
  static constexpr std::size_t kMostCells = 700'000;

  // A return with a number that is not finite or beyond 1e7 m is ignored.
  void Add(double x, double y, double z);
  // Adds the returns of another part of the survey.
  void Merge(const TerrainReturns& other);
  void Clear() { *this = {}; }

  bool empty() const { return cells_.empty(); }
  // Uses all cores.
  TerrainPlanes Finish() const;

 private:
  static constexpr std::size_t kKept = 4;  // Of a cell.
  struct Sample {
    std::uint32_t hash = ~std::uint32_t{0};  // Its largest value: none.
    float x = 0, y = 0, z = 0;
  };
  using Cell = std::array<Sample, kKept>;  // By ascending hash.
  using Place = TerrainPlanes::Place;

  double cell() const;
  void Keep(const Sample& sample, Cell& cell) const;
  void CoarsenTo(int level);
  void Bound();
  std::optional<TerrainPlanes::Gradient> PlaneAround(const Place& place) const;

  absl::flat_hash_map<Place, Cell> cells_;
  int level_ = 0;  // Cells have 2 m times 2 to this power.
};

}  // namespace albtpu
