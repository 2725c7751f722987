#include "annotate/las/las_prescan.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "annotate/beams/water_heights.h"
#include "budget/beams/pulse_sample.h"
#include "formats/clocks/point_clock.h"
#include "formats/files/ordered_pipeline.h"
#include "formats/las/las_points.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

constexpr std::size_t kPrescanChunkBytes = 4 << 20;
constexpr double kMinSeparation = 1;  // m; of nearer returns the direction is too uncertain.

// What a point may be, as bits.
enum Role : std::uint8_t {
  kChosen = 1,
  kSurface = 2,
  kAtLevel = 4,
  kOfPair = 8,
  kNumbered = 16,
  kGround = 32,
  kUnclassified = 64
};

using Box = formats::LasBounds;

Box EmptyBox() {
  Box box;
  box.least.fill(std::numeric_limits<double>::infinity());
  box.greatest.fill(-std::numeric_limits<double>::infinity());
  return box;
}

void Extend(const std::array<double, 3>& least, const std::array<double, 3>& greatest, Box& box) {
  for (std::size_t axis = 0; axis < least.size(); ++axis) {
    box.least[axis] = std::min(box.least[axis], least[axis]);
    box.greatest[axis] = std::max(box.greatest[axis], greatest[axis]);
  }
}

// The contribution of one chunk.
struct Part {
  formats::LasRun run;  // Some records of the next chunk follow.
  std::vector<double> times;
  bool in_order = false;  // The times.
  std::vector<std::uint8_t> roles;
  std::vector<double> numbered_times;

  std::uint64_t numbered = 0, surface_returns = 0, synthetic_surface = 0, level_returns = 0, off_level = 0;
  double off_level_height = 0;  // Sum, m.
  Box all, of_numbered;
  double first_time, last_time;
  formats::TimeTally tally;
  SurfaceReturns surface;
  TerrainReturns ground, unclassified;
  PairSample pairs;
  std::uint64_t of_several = 0, alone = 0;
  std::vector<PulseReturn> incomplete;  // Returns whose pulse has others than those within reach.
};

class PrescanWork {
 public:
  PrescanWork(const formats::LasReader& reader, const formats::LocalFrame& frame, const LasPrescanOptions& options)
      : fields_(reader.header()),
        length_(reader.header().record_length),
        frame_(frame),
        use_withheld_(options.use_withheld),
        seconds_(options.seconds),
        pairs_(options.pairs && fields_.has_gps_time()),
        highest_(options.water_level.has_value() ? frame.Z(*options.water_level)
                                                 : std::numeric_limits<double>::infinity()) {
    roles_.fill(kOfPair);
    for (const int noise : {formats::kLowNoise, formats::kHighNoise}) roles_[noise] = 0;
    // Whatever the given classes are, these say that a return is not from under the water.
    for (const int surface : formats::UsualSurfaceClasses(reader.header().point_format)) roles_[surface] = 0;
    for (int i = 0; i < formats::kClassCount && options.dry_points; ++i)
      if (formats::MayBeDry(i, reader.header().point_format)) roles_[i] |= kNumbered;
    for (int i = 0; i < formats::kClassCount && options.terrain; ++i) {
      if (formats::IsGround(i, reader.header().point_format)) roles_[i] |= kGround;
      if (formats::IsUnclassified(i)) roles_[i] |= kUnclassified;
    }
    for (const int point_class : options.classes) roles_[point_class] |= kChosen | kNumbered | kOfPair;
    for (const int point_class : options.water_classes)
      roles_[point_class] = (roles_[point_class] | kSurface) & ~kOfPair;
    if (options.water_level.has_value())
      for (const int point_class : options.level_classes) roles_[point_class] |= kAtLevel;
  }

  // Two returns of one pulse, of classes that may belong to a pair.
  void AddPair(const PulseReturn& a, const PulseReturn& b, PairSample& pairs) const {
    const bool a_is_upper = a.position.z() >= b.position.z();
    const PulseReturn &upper = a_is_upper ? a : b, &lower = a_is_upper ? b : a;
    if (!lower.chosen || upper.position.z() > highest_ + kHighestCrest) return;
    if ((upper.position - lower.position).norm() < kMinSeparation) return;
    pairs.Add({a.time, upper.position, lower.position, upper.chosen});
  }

  absl::Status operator()(Part& part) const {
    const std::size_t count = part.run.records.size() / length_;
    part.times.assign(count, 0);
    part.roles.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view record = Record(part, i);
      part.roles[i] = RolesOf(record);
      if (fields_.has_gps_time()) part.times[i] = fields_.GpsTime(record);
    }
    part.in_order = std::ranges::adjacent_find(part.times, [](double a, double b) { return !(a <= b); }) ==
                    part.times.end();  // False if one is NaN.
    part.numbered = part.surface_returns = part.synthetic_surface = part.level_returns = part.off_level = 0;
    part.off_level_height = 0;
    part.first_time = std::numeric_limits<double>::infinity();
    part.last_time = -part.first_time;
    part.tally = {};
    part.numbered_times.clear();
    part.all = part.of_numbered = EmptyBox();
    std::optional<std::size_t> pulse;  // The last first return.
    part.surface = SurfaceReturns();
    part.ground.Clear();
    part.unclassified.Clear();
    part.pairs.Clear();
    part.of_several = part.alone = 0;
    part.incomplete.clear();
    for (std::size_t i = 0; i < part.run.own; ++i) {
      const std::uint8_t roles = part.roles[i];
      const std::array<double, 3> at = PlaceOf(Record(part, i));
      Extend(at, at, part.all);
      if ((roles & kSurface) != 0) AddSurface(part, i);
      if ((roles & (kGround | kUnclassified)) != 0) AddTerrain(part, i);
      if ((roles & kAtLevel) != 0) CompareWithLevel(part, i);
      if ((roles & kNumbered) != 0) {
        Extend(at, at, part.of_numbered);
        ++part.numbered;
        if (!formats::IsNoTime(part.times[i])) part.numbered_times.push_back(part.times[i]);
      }
      if (!pairs_ || formats::IsNoTime(part.times[i])) continue;
      AddPairs(part, i);
      if (roles == 0 || fields_.ReturnNumber(Record(part, i)) > 1) continue;
      if (pulse.has_value()) AddPulses(part, *pulse, i);
      pulse = i;
    }
    for (const double time : part.numbered_times) {
      part.first_time = std::min(part.first_time, time);
      part.last_time = std::max(part.last_time, time);
    }
    part.tally.Add(part.numbered_times);
    part.pairs.Prune();
    return absl::OkStatus();
  }

 private:
  std::string_view Record(const Part& part, std::size_t i) const {
    return std::string_view(part.run.records).substr(i * length_, length_);
  }
  std::array<double, 3> PlaceOf(std::string_view record) const {
    return {fields_.X(record), fields_.Y(record), fields_.Z(record)};
  }
  Eigen::Vector3d PositionOf(std::string_view record) const {
    return frame_.At(fields_.X(record), fields_.Y(record), fields_.Z(record));
  }

  // A withheld point has none. A synthetic one was not measured, so that no direction follows from it.
  std::uint8_t RolesOf(std::string_view record) const {
    if (!use_withheld_ && fields_.IsWithheld(record)) return 0;
    const std::uint8_t roles = roles_[static_cast<std::size_t>(fields_.Class(record))];
    return fields_.IsSynthetic(record) ? roles & ~kOfPair : roles;
  }

  void AddSurface(Part& part, std::size_t i) const {
    const Eigen::Vector3d at = PositionOf(Record(part, i));
    part.surface.Add(at.x(), at.y(), seconds_ * part.times[i], at.z());
    ++part.surface_returns;
    part.synthetic_surface += fields_.IsSynthetic(Record(part, i));
  }

  void AddTerrain(Part& part, std::size_t i) const {
    const Eigen::Vector3d at = PositionOf(Record(part, i));
    ((part.roles[i] & kGround) != 0 ? part.ground : part.unclassified).Add(at.x(), at.y(), at.z());
  }

  void CompareWithLevel(Part& part, std::size_t i) const {
    const double height = PositionOf(Record(part, i)).z();
    ++part.level_returns;
    if (std::abs(height - highest_) <= kLevelTolerance) return;
    ++part.off_level;
    part.off_level_height += height;
  }

  // Different channels of a scanner may have sent pulses at one time, and a beam that was split has equal times.
  void AddPulses(Part& part, std::size_t before, std::size_t i) const {
    if (fields_.ScannerChannel(Record(part, before)) == fields_.ScannerChannel(Record(part, i)))
      part.tally.AddPulses(part.times[before], part.times[i]);
  }

  PulseReturn ReturnOf(const Part& part, std::size_t i) const {
    const std::string_view record = Record(part, i);
    return {.record = part.run.first + i,
            .time = part.times[i],
            .position = PositionOf(record),
            .number = static_cast<std::uint8_t>(fields_.ReturnNumber(record)),
            .count = static_cast<std::uint8_t>(fields_.ReturnCount(record)),
            .channel = static_cast<std::uint8_t>(fields_.ScannerChannel(record)),
            .chosen = (part.roles[i] & kChosen) != 0};
  }

  // How many records from `begin` to `end` have the time of record i, which lies before or behind them. Most files are
  // in order of time, so such records are the nearest ones.
  static std::size_t EqualTimes(const Part& part, std::size_t i, std::size_t begin, std::size_t end) {
    const double time = part.times[i];
    std::size_t equal = 0;
    if (!part.in_order) {
      for (std::size_t j = begin; j < end; ++j) equal += part.times[j] == time;
    } else if (begin > i) {
      while (begin + equal < end && part.times[begin + equal] == time) ++equal;
    } else {
      while (begin + equal < end && part.times[end - equal - 1] == time) ++equal;
    }
    return equal;
  }

  // Each pair belongs to the chunk of its first record.
  void AddPairs(Part& part, std::size_t i) const {
    const std::size_t end = std::min(i + kPulseReach + 1, part.times.size());
    const std::size_t equal = EqualTimes(part, i, i + 1, end);
    if (fields_.ReturnCount(Record(part, i)) > 1) AddReturnOfSeveral(part, i, equal);
    if (equal == 0 || (part.roles[i] & kOfPair) == 0) return;
    for (std::size_t j = i + 1; j < end; ++j) {
      if (part.times[j] != part.times[i] || (part.roles[j] & kOfPair) == 0) continue;
      if (!fields_.OfOnePulse(Record(part, i), Record(part, j))) continue;
      AddPair(ReturnOf(part, i), ReturnOf(part, j), part.pairs);
    }
  }

  // `after`: records of the same time within reach behind this one. The first records of a chunk do not see those of
  // the chunk before; what they seem to miss is found twice then, and counts once.
  void AddReturnOfSeveral(Part& part, std::size_t i, std::size_t after) const {
    const std::size_t equal = after + EqualTimes(part, i, i > kPulseReach ? i - kPulseReach : 0, i);
    ++part.of_several;
    part.alone += equal == 0;
    const bool complete = equal + 1 >= static_cast<std::size_t>(fields_.ReturnCount(Record(part, i)));
    if (!complete && (part.roles[i] & kOfPair) != 0) part.incomplete.push_back(ReturnOf(part, i));
  }

  formats::LasPointFields fields_;
  std::size_t length_;
  formats::LocalFrame frame_;
  bool use_withheld_;
  double seconds_;
  bool pairs_;
  double highest_;  // m; where the upper return of a pair may lie: the water level, if it is given.
  std::array<std::uint8_t, formats::kClassCount> roles_;  // By class: bits of Role.
};

void Merge(const Part& part, LasPrescan& prescan) {
  prescan.numbered += part.numbered;
  prescan.surface_returns += part.surface_returns;
  prescan.synthetic_surface += part.synthetic_surface;
  prescan.level_returns += part.level_returns;
  prescan.off_level += part.off_level;
  prescan.off_level_height += part.off_level_height;  // The sum, until all parts are there.
  prescan.of_several += part.of_several;
  prescan.alone += part.alone;
  Extend(part.all.least, part.all.greatest, prescan.all);
  Extend(part.of_numbered.least, part.of_numbered.greatest, prescan.of_numbered);
  prescan.first_time = std::min(prescan.first_time, part.first_time);
  prescan.last_time = std::max(prescan.last_time, part.last_time);
  prescan.tally.Merge(part.tally);
}

}  // namespace

absl::StatusOr<LasPrescan> Prescan(const formats::LasReader& reader, const formats::LocalFrame& frame,
                                   const LasPrescanOptions& options) {
  const std::uint64_t max_records = std::max<std::uint64_t>(kPrescanChunkBytes / reader.header().record_length, 1);
  LasPrescan prescan;
  prescan.all = prescan.of_numbered = EmptyBox();
  SurfaceReturns surface;
  TerrainReturns ground, unclassified;
  PairSample pairs;
  PulseSample incomplete;
  const PrescanWork work(reader, frame, options);
  ASSIGN_OR_RETURN(formats::LasPointRuns runs,
                   formats::LasPointRuns::Open(reader, 0, kPulseReach, laz::WantedFields::kReturns));
  RETURN_IF_ERROR(formats::RunOrderedPipeline([] { return Part(); },
                                              [&](Part& part) { return runs.Next(max_records, part.run); }, work,
                                              [&](Part& part) {
                                                Merge(part, prescan);
                                                surface.Merge(std::move(part.surface));
                                                ground.Merge(part.ground);
                                                if (ground.empty())
                                                  unclassified.Merge(part.unclassified);
                                                else
                                                  unclassified.Clear();
                                                pairs.Merge(part.pairs);
                                                for (const PulseReturn& one : part.incomplete) incomplete.Add(one);
                                                return absl::OkStatus();
                                              }));
  if (prescan.off_level > 0) prescan.off_level_height /= static_cast<double>(prescan.off_level);
  for (const std::vector<PulseReturn>& pulse : incomplete.Take()) {
    for (std::size_t i = 0; i < pulse.size(); ++i) {
      for (std::size_t j = i + 1; j < pulse.size(); ++j) {
        const std::uint64_t a = pulse[i].record, b = pulse[j].record;
        if ((a > b ? a - b : b - a) > kPulseReach) work.AddPair(pulse[i], pulse[j], pairs);
      }
    }
  }
  prescan.pair_count = pairs.seen();
  prescan.terrain_is_classified = !ground.empty();
  tbb::parallel_invoke([&] { prescan.pairs = pairs.Take(); },
                       [&] {
                         if (prescan.surface_returns > 0) prescan.surface = surface.Finish();
                         if (options.terrain) prescan.terrain = (ground.empty() ? unclassified : ground).Finish();
                       });
  return prescan;
}

}  // namespace albtpu::annotate
