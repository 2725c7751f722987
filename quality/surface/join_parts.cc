#include <algorithm>
#include <map>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/answers/batch.h"
#include "quality/surface/surface_part.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

constexpr std::size_t kMostSources = 65'536;

std::string Length(double metres) { return absl::StrFormat("%.10g m", metres); }

// What all parts have alike, as messages name it.
std::vector<std::pair<std::string, std::string>> SettingsOf(const PartFacts& facts) {
  return {{"--cell", Length(facts.cell)},
          {"--land", facts.dry.has_value() ? "given" : "not given"},
          {"coordinate system", facts.map.crs_name},
          {"unit of x and y", Length(facts.map.metres_per_unit)},
          {"coverage", annotate::CoverageName(facts.coverage)},
          {"table", facts.table_digest},
          {"index of the water", absl::StrFormat("%.10g", facts.seas.front().water_index)}};
}

absl::Status Differ(const SurfacePart& first, const SurfacePart& other, const std::string& what,
                    const std::string& in_first, const std::string& in_other) {
  return absl::InvalidArgumentError(absl::StrCat(other.path.string(), ": its ", what, " is ", in_other, " (in ",
                                                 first.path.string(), " it is ", in_first, "); make all parts alike"));
}

absl::Status CheckAlike(const SurfacePart& first, const SurfacePart& other) {
  const auto of_first = SettingsOf(first.facts), of_other = SettingsOf(other.facts);
  for (std::size_t i = 0; i < of_first.size(); ++i)
    if (of_first[i].second != of_other[i].second)
      return Differ(first, other, of_first[i].first, of_first[i].second, of_other[i].second);
  return absl::OkStatus();
}

// Parts that state no vertical datum go with those of any one.
absl::Status CheckDatums(const std::vector<SurfacePart>& parts) {
  const auto datum = [](const SurfacePart& part) -> const std::string& { return part.facts.map.vertical_name; };
  const auto first = std::ranges::find_if(parts, [&](const SurfacePart& part) { return !datum(part).empty(); });
  const auto other = std::find_if(first, parts.end(), [&](const SurfacePart& part) {
    return !datum(part).empty() && datum(part) != datum(*first);
  });
  return other == parts.end() ? absl::OkStatus()
                              : Differ(*first, *other, "vertical datum", datum(*first), datum(*other));
}

bool IsSame(const SeaOfSource& a, const SeaOfSource& b) {
  return a.spectrum.k == b.spectrum.k && a.spectrum.s == b.spectrum.s && a.spectrum.a == b.spectrum.a &&
         a.spectrum.b == b.spectrum.b && a.x_azimuth == b.x_azimuth && a.water_index == b.water_index;
}

}  // namespace

absl::StatusOr<std::uint16_t> AddSource(PartFacts& facts, const SeaOfSource& sea, const HorizontalGroups& groups) {
  const auto known = std::ranges::find_if(facts.seas, [&](const SeaOfSource& each) { return IsSame(each, sea); });
  const auto number = static_cast<std::uint16_t>(known - facts.seas.begin());
  if (known == facts.seas.end()) facts.seas.push_back(sea);
  const auto source = std::ranges::find_if(facts.sources, [&](const SourceOfPoints& each) {
    return each.sea == number && each.groups.line == groups.line && each.groups.survey == groups.survey;
  });
  const auto found = static_cast<std::uint16_t>(source - facts.sources.begin());
  if (source == facts.sources.end()) facts.sources.push_back({.sea = number, .groups = groups});
  if (facts.sources.size() >= kMostSources)
    return absl::ResourceExhaustedError(
        absl::StrCat("there are more than ", kMostSources, " seas; make surfaces of fewer files"));
  return found;
}

absl::StatusOr<JoinedParts> Join(std::vector<SurfacePart>& parts) {
  std::ranges::sort(
      parts, {}, [](const SurfacePart& part) { return std::ranges::min(part.facts.files, {}, &PartFile::name).name; });
  RETURN_IF_ERROR(CheckDatums(parts));
  JoinedParts joined;
  std::map<PartFile, const SurfacePart*> parts_of_files;
  for (const SurfacePart& part : parts) {
    RETURN_IF_ERROR(CheckAlike(parts.front(), part));
    for (const PartFile& file : part.facts.files)
      if (const auto [other, is_new] = parts_of_files.emplace(file, &part); !is_new)
        return absl::InvalidArgumentError(absl::StrCat(part.path.string(), ": has the points of ", file.name,
                                                       ", and so has ", other->second->path.string(),
                                                       "; give each file in one part"));
  }
  PartFacts& all = joined.facts;
  const PartFacts& first = parts.front().facts;
  all.cell = first.cell, all.map = first.map, all.coverage = first.coverage, all.table_digest = first.table_digest;
  for (const SurfacePart& part : parts) {
    const PartFacts& facts = part.facts;
    std::vector<std::uint16_t>& sources = joined.sources.emplace_back();
    for (const SourceOfPoints& source : facts.sources) {
      ASSIGN_OR_RETURN(const std::uint16_t number, AddSource(all, facts.seas[source.sea], source.groups));
      sources.push_back(number);
    }
    all.map.TakeVertical(facts.map.vertical_name, facts.map.vertical_wkt);
    all.files.insert(all.files.end(), facts.files.begin(), facts.files.end());
    all.summary_digests.insert(all.summary_digests.end(), facts.summary_digests.begin(), facts.summary_digests.end());
    all.with_number += facts.with_number, all.without_number += facts.without_number;
    if (facts.dry.has_value()) all.dry = all.dry.value_or(0) + *facts.dry;
    all.left_out.Add(facts.left_out);
    if (facts.times.has_value()) {
      if (!all.times.has_value()) all.times = facts.times;
      all.times->first = std::min(all.times->first, facts.times->first);
      all.times->second = std::max(all.times->second, facts.times->second);
    }
  }
  return joined;
}

}  // namespace albtpu::quality
