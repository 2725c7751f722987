#include "formats/las/las_contents.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "formats/clocks/trajectory_time.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

constexpr std::size_t kRunBytes = 4 << 20;

// The texts of the header, padded with zeros: ASPRS LAS 1.4 R15, table 3.
constexpr std::size_t kSystemIdentifier = 26, kGeneratingSoftware = 58, kSoftwareSize = 32;

constexpr double kBinsOfADegree = 4;

// Fewer points say nothing of how a scanner moves.
constexpr std::uint64_t kPointsOfAPattern = 1000;

// Of a circle a third lies within half of its radius: (2/pi) asin(1/2). Of a raster, half. The limit is in the middle.
constexpr double kShareOfARaster = 5.0 / 12;

void Add(const LasPointFields& fields, std::string_view record, LasContents& contents) {
  LasClassContents& of_class = contents.classes[static_cast<std::size_t>(fields.Class(record))];
  const double height = fields.Z(record);
  const int returns = fields.ReturnCount(record);
  ++contents.points, ++of_class.points;
  contents.of_several += returns > 1;
  contents.most_returns = std::max(contents.most_returns, returns);
  of_class.lowest = std::min(of_class.lowest, height);
  of_class.highest = std::max(of_class.highest, height);
  of_class.sum += height;
  if (const double time = fields.has_gps_time() ? fields.GpsTime(record) : NAN; !IsNoTime(time)) {
    contents.first_time = std::min(contents.first_time, time);
    contents.last_time = std::max(contents.last_time, time);
  }
  const double angle = fields.ScanAngle(record);
  contents.least_angle = std::min(contents.least_angle, angle);
  contents.greatest_angle = std::max(contents.greatest_angle, angle);
  ++contents.by_angle[std::min<std::size_t>(static_cast<std::size_t>(std::abs(angle) * kBinsOfADegree),
                                            contents.by_angle.size() - 1)];
  contents.backwards += fields.IsScannedBackwards(record);
}

bool MayBeUnderWater(int point_class) {
  return point_class != kLowNoise && point_class != kHighNoise &&
         !UsualSurfaceClasses(kFirstModernFormat).contains(point_class) &&
         !UsualSurfaceClasses(0).contains(point_class);
}

bool IsPair(const LasPointFields& fields, std::string_view a, std::string_view b) {
  if (!fields.has_gps_time() || fields.GpsTime(a) != fields.GpsTime(b) || !fields.OfOnePulse(a, b)) return false;
  const double higher = fields.Z(a) - fields.Z(b);
  const int upper = fields.Class(higher > 0 ? a : b), lower = fields.Class(higher > 0 ? b : a);
  return std::abs(higher) >= 1 && MayBeUnderWater(upper) &&
         (lower == DefaultClass(kFirstModernFormat) || lower == DefaultClass(0));
}

std::string TextAt(std::string_view head, std::size_t begin) {
  std::string text(head.substr(begin, kSoftwareSize));
  text.resize(std::min(text.size(), text.find('\0')));
  absl::StripAsciiWhitespace(&text);
  return text;
}

}  // namespace

std::vector<int> LasContents::ClassesWithPoints() const {
  std::vector<int> found;
  for (int i = 0; i < kClassCount; ++i)
    if (classes[static_cast<std::size_t>(i)].points > 0) found.push_back(i);
  return found;
}

std::vector<int> LasContents::Of(const std::set<int>& candidates) const {
  std::vector<int> found = ClassesWithPoints();
  std::erase_if(found, [&](int each) { return !candidates.contains(each); });
  return found;
}

ScanPattern LasContents::scan_pattern() const {
  if (points < kPointsOfAPattern) return ScanPattern::kUnknown;
  const auto share = [&](std::uint64_t part) { return static_cast<double>(part) / static_cast<double>(points); };
  if (share(backwards) > 0.05 && share(backwards) < 0.95) return ScanPattern::kRaster;
  const double greatest = std::max(-least_angle, greatest_angle);
  const bool both_sides = std::min(-least_angle, greatest_angle) > greatest / 2;
  if (!both_sides || greatest < 2) return ScanPattern::kUnknown;
  std::uint64_t inner = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(greatest / 2 * kBinsOfADegree); ++i) inner += by_angle[i];
  return share(inner) < kShareOfARaster ? ScanPattern::kPalmer : ScanPattern::kRaster;
}

absl::StatusOr<LasContents> ReadContents(const LasReader& reader, std::uint64_t most) {
  const LasPointFields fields(reader.header());
  const std::size_t length = reader.header().record_length;
  ASSIGN_OR_RETURN(LasPointRuns runs, LasPointRuns::Open(reader, 1, 0));
  LasContents contents;
  LasRun run;
  while (contents.points < most) {
    const std::uint64_t wanted = std::min(most - contents.points, std::max<std::uint64_t>(kRunBytes / length, 1));
    ASSIGN_OR_RETURN(const bool more, runs.Next(wanted, run));
    if (!more) break;
    const auto record = [&](std::size_t i) { return std::string_view(run.records).substr(i * length, length); };
    for (std::size_t i = run.before; i < run.before + run.own; ++i) {
      Add(fields, record(i), contents);
      contents.pairs += i > 0 && IsPair(fields, record(i - 1), record(i));
    }
  }
  RETURN_IF_ERROR(reader.CheckUnchanged());
  return contents;
}

std::string SoftwareOf(const LasReader& reader) {
  const std::string system = TextAt(reader.head(), kSystemIdentifier),
                    software = TextAt(reader.head(), kGeneratingSoftware);
  return absl::StrCat(system, system.empty() || software.empty() ? "" : ", ", software);
}

std::string VerticalNameOf(const CrsDescription& description) {
  const std::string& wkt = description.wkt;
  for (const std::string_view keyword : {"VERT_CS[\"", "VERTCRS[\"", "VERTICALCRS[\""}) {
    const std::size_t at = wkt.find(keyword);
    if (at == std::string::npos) continue;
    const std::size_t begin = at + keyword.size();
    return wkt.substr(begin, wkt.find('"', begin) - begin);
  }
  return description.vertical != 0 ? absl::StrCat("EPSG:", description.vertical) : "";
}

}  // namespace albtpu::formats
