// The local height of the water, from the returns of a survey that are of its surface.
#pragma once

#include <absl/container/flat_hash_map.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace albtpu {

// Positions are in a local frame in metres, heights in metres above any datum. Times are seconds on any scale; if
// there are none, give 0 everywhere: then all returns are of one time.
//
// Space is divided into cells of 5 m, time into slots of 60 s. The surface at a point is the median of the returns in a
// window of 4 x 4 cells and 2 slots, 20 m by 20 m by 2 minutes, around the corner of cells and slots that is nearest to
// the point: 7.5 to 12.5 m and 30 to 90 s to each side of it. Why these numbers:
//  * 20 m: short waves are averaged, swell is followed, and the tilt of the water along an estuary or against the
//    vertical datum (1e-4) does not matter: 1 mm over half the window.
//  * 2 minutes: the two looks of a conical scanner at one place are less than a minute apart; lines that are flown one
//    after the other lie further apart, because of the turn between them. A tide of 2 m/h moves 2 cm in 30 s.
//  * At least 3 returns: the median of 3 still ignores one outlier.
//
// Of each cell and slot, 8 returns are kept, so that memory grows with the area flown and the number of passes over
// it, but not with the number of returns: 2.6 MB per square kilometre and pass. Those 8 are the ones whose hashes are
// smallest, a random sample that depends neither on the order of the returns nor on how they were divided. The window
// has 128 of them. The median of m independent returns of the density f has the standard deviation
// 1 / (2 f sqrt(m)), with f at the median. For heights that are normally distributed with the standard deviation s,
// f = 1 / (s sqrt(2 pi)): 1.25 s / sqrt(m) = 0.11 s, or 1.4 cm for a significant wave height 4 s = 0.5 m. Waves that
// are not much shorter than the window add to it, because neighbouring returns lie on the same wave.
class LocalWaterSurface {
 public:
  // The median height [m] around the point, or none if there are too few returns of about this time. Any number of
  // threads may call it at a time.
  std::optional<double> HeightAt(double x, double y, double time) const;

  // Reads heights for one thread, faster where points that follow each other are neighbours. The surface must outlive
  // it.
  class Reader;

 private:
  friend class SurfaceReturns;
  struct Place {  // A tile of 8 x 8 cells, or of their lower left corners, and a slot or its beginning.
    std::int32_t x, y, time;
    friend bool operator==(const Place&, const Place&) = default;
    template <typename H>
    friend H AbslHashValue(H hash, const Place& place) {
      return H::combine(std::move(hash), place.x, place.y, place.time);
    }
  };
  using Medians = std::array<float, 64>;  // NaN where there are too few returns.
  absl::flat_hash_map<Place, Medians> medians_;
};

class LocalWaterSurface::Reader {
 public:
  explicit Reader(const LocalWaterSurface& surface) : surface_(surface) {}

  std::optional<double> HeightAt(double x, double y, double time);

 private:
  const LocalWaterSurface& surface_;
  std::optional<Place> place_;  // Of the tile that was read last.
  const Medians* tile_ = nullptr;
};

inline std::optional<double> LocalWaterSurface::HeightAt(double x, double y, double time) const {
  return Reader(*this).HeightAt(x, y, time);
}

// Collects the returns of the surface in one pass:
//     SurfaceReturns returns;
//     for (...) returns.Add(x, y, time, height);      // or one for each part of the points, and Merge
//     const LocalWaterSurface surface = returns.Finish();
class SurfaceReturns {
 public:
  SurfaceReturns();
  ~SurfaceReturns();
  SurfaceReturns(SurfaceReturns&&) noexcept;
  SurfaceReturns& operator=(SurfaceReturns&&) noexcept;

  // A return at (x, y) [m] at `time` [s], of the surface at `height` [m], kept in single precision: within 0.03 mm up
  // to 500 m, 0.25 mm up to 8000 m. A return with a number that is not finite or that no survey has (beyond 1e8 m or
  // 1e11 s) is ignored.
  void Add(double x, double y, double time, double height);

  // Adds the returns of another part of the survey.
  void Merge(SurfaceReturns other);

  // The memory of the kept returns.
  std::size_t bytes() const;

  // Uses all cores.
  LocalWaterSurface Finish() const;

 private:
  struct Tiles;
  std::unique_ptr<Tiles> tiles_;
};

}  // namespace albtpu
