#include "quality/annotated/point_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "formats/text/text.h"

namespace albtpu::quality {
namespace {

constexpr std::size_t kSampled = 512;      // Points of a sample.
constexpr std::size_t kFewestSampled = 8;  // Points by which files are compared.
// A file is a copy with more points in common than this share: lines have none. Identical points are those of a buffer,
// by which tiles overlap; a few may lie on the edge of two tiles.
constexpr double kCopyShare = 0.5, kBufferShare = 0.01;
constexpr double kRoundedTime = 1e-6;     // s; copies may have rounded times.
constexpr double kLargestGpsTime = 1e12;  // s; larger numbers are no times.
constexpr double kStepsApart = 1.01;      // Between places of copies, whose coordinates may have been rounded.

// The finalizer of SplitMix64 (Steele et al. 2014, doi:10.1145/2660193.2660195): one to one, and each bit of the result
// depends on all bits.
std::uint64_t Mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

}  // namespace

std::vector<PointSample::Point> PointSample::Choose(std::string_view records) const {
  std::vector<Point> chosen;
  const std::uint64_t limit = limit_;
  for (std::size_t at = 0; at + record_length_ <= records.size(); at += record_length_) {
    const std::string_view record = records.substr(at, record_length_);
    if (!use_withheld_ && fields_.IsWithheld(record)) continue;
    const double time = fields_.has_gps_time() ? fields_.GpsTime(record) : 0;
    const bool has_time = time != 0 && std::abs(time) < kLargestGpsTime;  // Neither 0 nor NaN.
    const std::uint64_t rank = Mixed(has_time ? static_cast<std::uint64_t>(std::llround(time / kRoundedTime))
                                              : std::bit_cast<std::uint64_t>(fields_.X(record)));
    if (rank < limit) chosen.push_back({rank, fields_.X(record), fields_.Y(record), fields_.Z(record), has_time});
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

PointSample::Common PointSample::CommonOf(const PointSample& a, const PointSample& b) {
  const std::uint64_t limit = std::min(a.limit_.load(), b.limit_.load());
  std::array<double, 3> most = {};
  for (std::size_t i = 0; i < most.size(); ++i) most[i] = kStepsApart * std::max(a.steps_[i], b.steps_[i]);
  const auto by_rank = [](const Point& point, const Point& other) { return point.rank < other.rank; };
  const auto below = [limit, by_rank](const PointSample& sample) {
    std::vector<Point> points = sample.points_;
    std::erase_if(points, [limit](const Point& point) { return point.rank >= limit; });
    std::ranges::sort(points, by_rank);
    return points;
  };
  std::vector<Point> fewer = below(a), more = below(b);
  if (fewer.size() > more.size()) std::swap(fewer, more);
  if (fewer.size() < kFewestSampled) return {};
  std::size_t common = 0, identical = 0;
  for (const Point& point : fewer) {
    bool is_common = false, is_identical = false;
    const auto [begin, end] = std::equal_range(more.begin(), more.end(), point, by_rank);
    for (const Point& other : std::span(begin, end)) {
      if (std::abs(point.x - other.x) > most[0] || std::abs(point.y - other.y) > most[1]) continue;
      is_common = true;
      is_identical = is_identical || (point.has_time && std::abs(point.z - other.z) <= most[2]);
    }
    common += is_common, identical += is_identical;
  }
  const auto of_fewer = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(fewer.size());
  };
  return {of_fewer(common), of_fewer(identical)};
}

absl::Status SampledFiles::Add(const std::filesystem::path& path, std::shared_ptr<const PointSample> sample) {
  const std::lock_guard lock(mutex_);
  for (const auto& [other, of_other] : samples_) {
    if (other == path) continue;
    const PointSample::Common common = PointSample::CommonOf(*sample, *of_other);
    const bool copy = common.share > kCopyShare;
    if (!copy && common.identical <= kBufferShare) continue;
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": has points of ", other.string(),
                     ", at the same times and places: ", formats::PercentText(copy ? common.share : common.identical),
                     " of those of the smaller file, which would count twice; ",
                     copy ? "give one of the two files"
                          : "where these are tiles with buffers, remove the points of the buffers or flag them as "
                            "withheld"));
  }
  samples_[path] = std::move(sample);
  return absl::OkStatus();
}

}  // namespace albtpu::quality
