// The seas over which the points of a survey were measured, and what pulses in one cell share of each.
#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "quality/seas/sea_of_pulses.h"
#include "quality/seas/seas_of_files.h"
#include "sea/correlation/pulse_correlation.h"
#include "sea/correlation/pulse_pairs.h"

namespace albtpu::quality {

// Any number of threads may use it at a time, once all seas are added.
class SeaSharing {
 public:
  explicit SeaSharing(double cell) : pairs_(cell) {}  // m

  // The number of the sea.
  std::uint16_t Add(const SeaOfSource& sea);
  std::size_t size() const { return seas_.size(); }

  // Angles in degree, `footprint` in m. Between beams at steps of incidence and azimuth it is interpolated, right to
  // 2 % of the variances, and the footprint is rounded to 4 %, which changes the correlation by less than 0.01. Nothing
  // for a beam that is not known.
  SeaOfPulses operator()(std::uint16_t source, double incidence, double azimuth, double footprint,
                         std::span<const Eigen::Vector2d> places) const;

 private:
  static constexpr int kIncidenceStep = 5, kMostIncidence = 30;  // degree
  static constexpr int kIncidences = kMostIncidence / kIncidenceStep + 1, kAzimuths = 16;

  struct Sea {
    WaveCorrelation waves;
    double x_azimuth, water_index;
  };
  // Tables of one sea and one footprint, by steps of incidence and azimuth; null where none was asked for yet.
  struct Beams {
    std::array<std::atomic<const Eigen::MatrixXf*>, std::size_t{kIncidences}* kAzimuths> known = {};
    ~Beams() {
      for (const auto& each : known) delete each.load();
    }
  };
  using Key = std::pair<std::uint16_t, int>;  // Sea, steps of ln footprint.

  Beams& BeamsOf(const Key& key) const;
  const Eigen::MatrixXf& At(Beams& beams, const Key& key, int incidence, int azimuth) const;

  PulsePairs pairs_;
  std::vector<std::unique_ptr<const Sea>> seas_;
  mutable absl::Mutex mutex_;
  mutable std::map<Key, std::unique_ptr<Beams>> beams_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace albtpu::quality
