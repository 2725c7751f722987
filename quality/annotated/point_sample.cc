#include "quality/annotated/point_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "absl/strings/str_format.h"

namespace albtpu::quality {
namespace {

constexpr std::size_t kSampled = 512;      // Points of a sample.
constexpr std::size_t kFewestSampled = 8;  // Points by which files are compared.
constexpr double kCopyShare = 0.5;         // Above this share of common points, a file is a copy: lines have none.
constexpr double kRoundedTime = 1e-6;      // s; copies may have rounded times.
constexpr double kLargestGpsTime = 1e12;   // s; larger numbers are no times.
constexpr double kStepsApart = 1.01;       // Between places of copies, whose coordinates may have been rounded.

// The finalizer of SplitMix64 (Steele et al. 2014, doi:10.1145/2660193.2660195): one to one, and each bit of the result
// depends on all bits.
std::uint64_t Mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

}  // namespace

std::uint64_t PointSample::Rank(std::string_view record) const {
  const double time = fields_.has_gps_time() ? fields_.GpsTime(record) : 0;
  const bool has_time = time != 0 && std::abs(time) < kLargestGpsTime;  // Neither 0 nor NaN.
  return Mixed(has_time ? static_cast<std::uint64_t>(std::llround(time / kRoundedTime))
                        : std::bit_cast<std::uint64_t>(fields_.X(record)));
}

std::vector<PointSample::Point> PointSample::Choose(std::string_view records) const {
  std::vector<Point> chosen;
  const std::uint64_t limit = limit_;
  for (std::size_t at = 0; at + record_length_ <= records.size(); at += record_length_) {
    const std::string_view record = records.substr(at, record_length_);
    if (const std::uint64_t rank = Rank(record); rank < limit)
      chosen.push_back({rank, fields_.X(record), fields_.Y(record)});
  }
  return chosen;
}

void PointSample::Add(const std::vector<Point>& chosen) {
  points_.insert(points_.end(), chosen.begin(), chosen.end());
  if (points_.size() > kSampled) {
    std::ranges::nth_element(points_, points_.begin() + kSampled, {}, &Point::rank);
    limit_ = points_[kSampled].rank;
  }
  // Of equal ranks, the sample has all or none.
  std::erase_if(points_, [this](const Point& point) { return point.rank >= limit_; });
}

double PointSample::CommonShare(const PointSample& a, const PointSample& b) {
  const std::uint64_t limit = std::min(a.limit_.load(), b.limit_.load());
  const double x_step = kStepsApart * std::max(a.x_step_, b.x_step_),
               y_step = kStepsApart * std::max(a.y_step_, b.y_step_);
  const auto below = [limit](const PointSample& sample) {
    std::vector<Point> points = sample.points_;
    std::erase_if(points, [limit](const Point& point) { return point.rank >= limit; });
    std::ranges::sort(points, {}, &Point::rank);
    return points;
  };
  std::vector<Point> fewer = below(a), more = below(b);
  if (fewer.size() > more.size()) std::swap(fewer, more);
  if (fewer.size() < kFewestSampled) return 0;
  const auto is_in_both = [&](const Point& point) {
    for (auto other = std::ranges::lower_bound(more, point.rank, {}, &Point::rank);
         other != more.end() && other->rank == point.rank; ++other)
      if (std::abs(point.x - other->x) <= x_step && std::abs(point.y - other->y) <= y_step) return true;
    return false;
  };
  return static_cast<double>(std::ranges::count_if(fewer, is_in_both)) / static_cast<double>(fewer.size());
}

absl::Status SampledFiles::Add(const std::filesystem::path& path, std::shared_ptr<const PointSample> sample) {
  const std::lock_guard lock(mutex_);
  for (const auto& [other, of_other] : samples_) {
    const double share = PointSample::CommonShare(*sample, *of_other);
    if (other != path && share > kCopyShare)
      return absl::InvalidArgumentError(absl::StrFormat(
          "%s: %.0f %% of its points are those of %s, at the same times and places; give one of the two files, because "
          "these points would count twice",
          path.string(), 100 * share, other.string()));
  }
  samples_[path] = std::move(sample);
  return absl::OkStatus();
}

}  // namespace albtpu::quality
