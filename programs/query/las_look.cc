#include "programs/query/las_look.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "annotate/las/las_beams.h"
#include "config/sensors/sensor.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_crs.h"
#include "programs/query/beam_options.h"
#include "programs/query/las_clock.h"
#include "service/printable_text.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

using config::DraftValue;
using formats::LasClassContents;

// So many pairs of returns are enough to look for the way of the beams in them.
constexpr std::uint64_t kEnoughPairs = 100;

std::string UnitName(double metres) {
  for (const HeightUnit& unit : kHeightUnits)
    if (std::abs(metres - unit.metres) < 1e-7) return std::string(unit.name);
  return absl::StrFormat("units of %.9g m", metres);
}

void LookAtPlace(const formats::LasReader& reader, LasLook& look) {
  const absl::StatusOr<formats::CrsDescription> description = formats::DescribeCrs(reader);
  if (description.ok()) look.vertical = VerticalNameOf(*description);
  if (description.ok() && !description->empty()) {
    const absl::StatusOr<formats::LasCrs> crs = formats::CrsOf(reader, "");
    if (crs.ok()) {
      look.crs = crs->map->crs_name();
      look.unit = crs->map->is_geographic() ? "degree" : UnitName(crs->map->unit());
    } else {
      look.crs_message = std::string(crs.status().message());
    }
  }
  const absl::StatusOr<annotate::LasPlace> place = annotate::PlaceOf(reader, {});
  if (place.ok())
    look.height_unit = UnitName(place->frame.metres_per_z);
  else
    look.units_message = std::string(place.status().message());
}

std::vector<std::string> ClassLines(const LasLook& look) {
  const std::vector<int> bottom = look.bottom(), water = look.water_surface();
  std::vector<std::string> lines;
  for (const int each : look.contents.ClassesWithPoints()) {
    const LasClassContents& of_class = look.contents.classes[static_cast<std::size_t>(each)];
    const char* const role = std::ranges::count(bottom, each) > 0  ? ", bottom by its number"
                             : std::ranges::count(water, each) > 0 ? ", water surface by its number"
                                                                   : "";
    lines.push_back(absl::StrFormat("    class %d: %d points, heights %.2f to %.2f, mean %.2f%s", each, of_class.points,
                                    of_class.lowest, of_class.highest, of_class.mean_height(), role));
  }
  return lines;
}

double GpsNow() {
  return formats::GpsOfUtc(static_cast<double>(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

std::string TimesText(const LasLook& look) {
  const formats::LasContents& contents = look.contents;
  if (!formats::HasGpsTime(look.header.point_format))
    return absl::StrCat("none (point format ", look.header.point_format, "): no trajectory can be used");
  if (!contents.has_times()) return "none: all are equal, 0 or not finite, so that no trajectory can be used";
  return ClockText(look.times(), GpsNow());
}

std::string PlaceText(const LasLook& look) {
  std::string text = !look.crs.empty()           ? absl::StrCat(look.crs, ", x and y in ", look.unit)
                     : !look.crs_message.empty() ? "stated, but not usable"
                                                 : "no coordinate system is stated (a trajectory needs --crs)";
  absl::StrAppend(&text, "; heights ",
                  look.height_unit.empty() ? "in a unit that is not stated" : "in " + look.height_unit,
                  look.vertical.empty() ? ", vertical datum not stated" : ", vertical datum " + look.vertical);
  return text;
}

std::string ScanText(const formats::LasContents& contents) {
  constexpr const char* kNames[] = {"unknown", "elliptical, such as Palmer (judged by how often each angle occurs)",
                                    "raster (lines across the track)"};
  return absl::StrFormat("%s; scan angles %.1f to %.1f degree", kNames[static_cast<int>(contents.scan_pattern())],
                         contents.least_angle, contents.greatest_angle);
}

std::string List(const std::vector<int>& classes) { return absl::StrCat("[", absl::StrJoin(classes, ", "), "]"); }

// What a file has, in words that can be compared.
std::string ClockOf(const LasLook& look) {
  return look.contents.has_times() ? ClockName(look.times(), GpsNow()) : "no GPS times";
}

// The class that has most points, and that returns neither from the water surface nor noise have.
std::optional<int> MostFrequent(const LasLook& look) {
  std::optional<int> best;
  const std::vector<int> water = look.water_surface();
  for (const int each : look.contents.ClassesWithPoints()) {
    if (each == formats::kLowNoise || each == formats::kHighNoise || std::ranges::count(water, each) > 0) continue;
    const auto points = [&](int one) { return look.contents.classes[static_cast<std::size_t>(one)].points; };
    if (!best.has_value() || points(each) > points(*best)) best = each;
  }
  return best;
}

// Whether a text names a sensor: "RIEGL VQ-840-GE" is not "RIEGL VQ-840-G".
bool DoesName(const std::string& text, const config::Sensor& sensor) {
  const std::string lower = absl::AsciiStrToLower(text), title = absl::AsciiStrToLower(sensor.title);
  for (std::size_t at = lower.find(title); at != std::string::npos; at = lower.find(title, at + 1)) {
    const std::size_t end = at + title.size();
    if (end == lower.size() || !absl::ascii_isalnum(static_cast<unsigned char>(lower[end]))) return true;
  }
  return false;
}

// The sensor that the software in a header names, by its longest title, or one of which everything needed is known.
absl::StatusOr<std::optional<config::Sensor>> ExampleSensor(std::span<const LasLook> looks) {
  ASSIGN_OR_RETURN(const std::vector<config::Sensor> sensors, config::ListSensors());
  std::optional<config::Sensor> named, example;
  for (const config::Sensor& sensor : sensors) {
    const bool is_named =
        std::ranges::any_of(looks, [&](const LasLook& look) { return DoesName(look.software, sensor); });
    if (is_named && (!named.has_value() || sensor.title.size() > named->title.size())) named = sensor;
    const bool known = sensor.errors.Has(&AirErrors::scan) && sensor.errors.Has(&AirErrors::bottom_range) &&
                       sensor.divergence.has_value();
    if (known && !example.has_value()) example = sensor;
  }
  return named.has_value() ? named : example;
}

void SuggestWater(std::span<const LasLook> looks, const std::set<int>& water, const std::set<int>& bottom,
                  bool is_bottom_known, Suggestions& suggestions) {
  if (!water.empty()) {
    suggestions.values.push_back(
        {"surface", "classes", List({water.begin(), water.end()}), "found in the points", true});
    return;
  }
  double highest = -std::numeric_limits<double>::infinity();
  for (const LasLook& look : looks)
    for (const int each : bottom)
      highest = std::max(highest, look.contents.classes[static_cast<std::size_t>(each)].highest);
  if (std::isfinite(highest))
    suggestions.values.push_back(
        {"surface", "level", absl::StrFormat("%.2f", highest),
         is_bottom_known
             ? "an example: the highest bottom point; the water surface is not below it"
             : "an example: the highest point of the class with most points, which need not be the bottom"});
}

}  // namespace

std::vector<int> LasLook::bottom() const {
  const std::vector<int> found = contents.Of(formats::DefaultClasses(formats::kFirstModernFormat));
  return !found.empty() ? found : contents.Of(formats::DefaultClasses(0));
}

std::vector<int> LasLook::water_surface() const {
  const std::vector<int> found = contents.Of(formats::UsualSurfaceClasses(formats::kFirstModernFormat));
  return !found.empty() ? found : contents.Of(formats::UsualSurfaceClasses(0));
}

formats::PointTimes LasLook::times() const {
  return formats::PointTimesOf(header, {contents.first_time, contents.last_time}, 0);
}

bool LasLook::has_bottom_by_default() const {
  return !contents.Of(formats::DefaultClasses(header.point_format)).empty();
}

bool LasLook::has_pairs() const { return contents.has_times() && contents.pairs >= kEnoughPairs; }

absl::StatusOr<LasLook> LookAt(const std::string& path, std::uint64_t most_points) {
  ASSIGN_OR_RETURN(const formats::LasReader reader, formats::LasReader::Open(path));
  ASSIGN_OR_RETURN(formats::LasContents contents, formats::ReadContents(reader, most_points));
  LasLook look{.path = path, .header = reader.header(), .contents = std::move(contents)};
  look.software = PrintableText(formats::SoftwareOf(reader));
  LookAtPlace(reader, look);
  return look;
}

std::vector<std::string> FoundLines(const LasLook& look) {
  const formats::LasContents& contents = look.contents;
  std::vector<std::string> lines = {
      absl::StrFormat("%s: %s 1.%d, point format %d, %d points%s", PrintableText(look.path),
                      look.header.compressed ? "LAZ" : "LAS", look.header.version_minor, look.header.point_format,
                      look.header.point_count, look.software.empty() ? "" : ", by " + look.software)};
  if (contents.points == 0) return lines;
  if (contents.points < look.header.point_count)
    lines.push_back(absl::StrFormat("    as its first %d points say:", contents.points));
  for (std::string& line : ClassLines(look)) lines.push_back(std::move(line));
  lines.push_back(absl::StrFormat(
      "    returns: up to %d of a pulse; %d points are of pulses with several, %d pairs of neighbours may "
      "both lie under water",
      contents.most_returns, contents.of_several, contents.pairs));
  lines.push_back("    GPS times: " + TimesText(look));
  lines.push_back("    coordinates: " + PrintableText(PlaceText(look)));
  lines.push_back("    scan pattern: " + ScanText(contents));
  return lines;
}

std::vector<std::string> Differences(std::span<const LasLook> looks) {
  std::vector<std::string> lines;
  const auto compare = [&](const char* what, const auto& of, const char* remedy) {
    constexpr std::size_t kMost = 6;  // Further ones are counted.
    std::vector<std::string> seen;
    for (const LasLook& look : looks)
      if (const std::string text = of(look); look.contents.points > 0 && std::ranges::count(seen, text) == 0)
        seen.push_back(text);
    if (seen.size() > kMost) {
      const std::size_t more = seen.size() - kMost;
      seen.resize(kMost);
      seen.push_back(absl::StrCat(more, " more"));
    }
    if (seen.size() > 1) lines.push_back(absl::StrCat(what, " differ: ", absl::StrJoin(seen, " | "), "; ", remedy));
  };
  const auto or_none = [](const std::string& text) { return text.empty() ? std::string("not stated") : text; };
  compare(
      "coordinate systems", [&](const LasLook& look) { return or_none(look.crs); },
      "each file is read in its own, and where it states none, --crs holds for all");
  compare(
      "units of heights", [&](const LasLook& look) { return or_none(look.height_unit); },
      "a water level is in the unit of each file: annotate those of one unit at a time");
  compare(
      "vertical datums", [&](const LasLook& look) { return or_none(look.vertical); },
      "water level and [datum] hold for one of them: annotate those of one datum at a time");
  compare("clocks", ClockOf,
          "a trajectory that names no week fits seconds of the week in any; check that they are of "
          "one flight");
  compare(
      "classes", [](const LasLook& look) { return List(look.contents.ClassesWithPoints()); },
      "those of bottom and water surface should mean the same in all files");
  return lines;
}

absl::StatusOr<Suggestions> SuggestionsFor(std::span<const LasLook> looks) {
  Suggestions suggestions;
  std::vector<DraftValue>& values = suggestions.values;
  ASSIGN_OR_RETURN(const std::optional<config::Sensor> sensor, ExampleSensor(looks));
  if (sensor.has_value()) {
    values.push_back({"sensor", "name", absl::StrCat("\"", sensor->name, "\""), "an example"});
    values.push_back({"water", "column", "\"none\"", "a choice: leave it out"});
    values.push_back({"datum", "sigma", "0.1", "an example"});
  }
  const auto count = [&](const auto& has) {
    return std::ranges::count_if(looks, [&](const LasLook& look) { return look.contents.points > 0 && has(look); });
  };
  const auto with_points = count([](const LasLook&) { return true; });
  const auto with_times = count([](const LasLook& look) { return look.contents.has_times(); });
  suggestions.times = with_times == with_points;
  suggestions.some_times = with_times > 0;
  suggestions.from_returns = suggestions.some_times && suggestions.times &&
                             count([](const LasLook& look) { return look.has_pairs(); }) == with_points;
  if (suggestions.from_returns)
    values.push_back({"trajectory", "from_returns", "true", "a choice, without files: pulses have several returns"});
  if (suggestions.times) values.push_back({"trajectory", "files", "[\"sbet.out\"]", "a choice: those of the flight"});
  std::set<int> bottom, water;
  bool by_default = true;
  for (const LasLook& look : looks) {
    for (const int each : look.bottom()) bottom.insert(each);
    for (const int each : look.water_surface()) water.insert(each);
    by_default = by_default && (look.has_bottom_by_default() || look.contents.points == 0);
  }
  const bool is_bottom_known = !bottom.empty();
  if (!is_bottom_known)
    for (const LasLook& look : looks)
      if (const std::optional<int> most = MostFrequent(look)) bottom.insert(*most);
  SuggestWater(looks, water, bottom, is_bottom_known, suggestions);
  values.push_back({"sea", "wind_speed", "5", "an example"});
  if (!bottom.empty() && !(is_bottom_known && by_default)) {
    values.push_back({"output", "classes", List({bottom.begin(), bottom.end()}),
                      is_bottom_known ? "found in the points" : "an example: the class with most points",
                      is_bottom_known});
  }
  double angle = 0;
  for (const LasLook& look : looks) angle = std::max({angle, -look.contents.least_angle, look.contents.greatest_angle});
  suggestions.by_angle = angle > 0 ? kExampleScanner : kExampleIncidence;
  const auto open = std::ranges::find_if(looks, [](const LasLook& look) { return !look.units_message.empty(); });
  if (open != looks.end())
    suggestions.units = {"--units", std::string((open->unit == kSurveyFoot.name ? kSurveyFoot : kFoot).name)};
  return suggestions;
}

const DraftValue* FirstOf(const Suggestions& suggestions, std::string_view section) {
  const auto first = std::ranges::find(suggestions.values, section, &DraftValue::section);
  return first == suggestions.values.end() ? nullptr : &*first;
}

}  // namespace albtpu::programs
