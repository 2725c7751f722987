#include "quality/report/survey_report.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "annotate/answers/batch.h"
#include "status/status_macros.h"
#include "tables/s44.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTvuStep = 0.002, kThuStep = 0.01;  // m, of the histograms.
constexpr std::size_t kSteps = 1000;                 // The last has all that is greater.

const std::vector<int>& BandEnds() {
  static const std::vector<int> ends = {1, 2, 5, 10, 15, 20, 30, 50};
  return ends;
}

struct Histogram {
  double step;
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(kSteps);

  void Add(double value) { ++counts[std::min(static_cast<std::size_t>(value / step), kSteps - 1)]; }
  Json ToJson() const {
    std::size_t used = kSteps;
    while (used > 1 && counts[used - 1] == 0) --used;
    return {{"step", step}, {"counts", std::vector<std::uint64_t>(counts.begin(), counts.begin() + used)}};
  }
};

struct OfFile {
  PointTally tally;
  double first_time = std::numeric_limits<double>::infinity(), last_time = -first_time;
};

// Of points that do not meet the wanted class.
struct Failing {
  std::uint64_t points = 0;
  std::array<double, kVerticalShareNames.size()> shares = {};
  std::array<std::uint64_t, kVerticalShareNames.size()> largest = {};
};

// The strictest order of S-44 that a point meets, as TotalBatch::best_orders has it.
class S44Orders {
 public:
  explicit S44Orders(const std::vector<Specification>& specifications) {
    std::size_t index = 0;
    for (const Specification& each : specifications)
      for (const SpecificationClass& of : each.classes) {
        const std::optional<S44Order> order = each.name == "s44" ? FindS44Order(of.name) : std::nullopt;
        if (order.has_value()) bits_[static_cast<std::size_t>(*order)] = std::uint64_t{1} << index;
        ++index;
      }
  }
  std::uint8_t Best(std::uint64_t met) const {
    for (std::size_t i = 0; i < bits_.size(); ++i)
      if ((met & bits_[i]) != 0) return static_cast<std::uint8_t>(i + 1);
    return 0;
  }

 private:
  std::array<std::uint64_t, kS44Orders.size()> bits_ = {};
};

class Reporter {
 public:
  Reporter(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options, const WantedClass& wanted)
      : files_(files),
        options_(options),
        wanted_(wanted),
        judge_(options.specifications),
        orders_(options.specifications),
        classes_(ClassCount(options.specifications)),
        first_(files.front()),
        grid_(options.cell / first_.metres_per_unit(), first_.coverage()),
        patches_(options.patch, first_.metres_per_unit(), first_.coverage()) {}

  absl::StatusOr<SurveyReport> Make() {
    annotate::FileProgress progress = ProgressOver(files_);
    for (const AnnotatedLasFile& file : files_) {
      progress.NextFile();
      OfFile& of_file = of_files_.emplace_back();
      ASSIGN_OR_RETURN(const LeftOutPoints left_out,
                       file.ForEach(
                           progress, [&](std::span<const AnnotatedPoint> points) { Add(points, of_file); },
                           [&](const DryPoint& point) { land_.Add(point); }));
      left_out_.Add(left_out);
      RETURN_IF_ERROR(grid_.status());
    }
    if (all_.points() == 0) return NoBathymetricPoint(files_);
    ASSIGN_OR_RETURN(const FileSeas seas, SeasOf(files_, nullptr));
    RETURN_IF_ERROR(FillPatches(files_, seas, patches_));
    const std::optional<CrossCheck> check = CheckPatches(patches_, seas.waves);
    return SurveyReport{.json = annotate::JsonBox(ToJson(check)),
                        .grid = std::move(grid_),
                        .facts = {.coverage = first_.coverage(),
                                  .crs_name = first_.crs_name(),
                                  .crs_wkt = first_.crs_wkt(),
                                  .metres_per_unit = first_.metres_per_unit()}};
  }

 private:
  void Add(std::span<const AnnotatedPoint> points, OfFile& of_file) {
    const Coverage coverage = first_.coverage();
    for (const AnnotatedPoint& point : points) {
      const std::uint64_t met = judge_.Met(point);
      all_.Add(point, met, coverage);
      of_file.tally.Add(point, met, coverage);
      of_file.first_time = std::min(of_file.first_time, point.time);
      of_file.last_time = std::max(of_file.last_time, point.time);
      lines_[point.line].Add(point, met, coverage);
      grid_.Add(point, orders_.Best(met));
      if (!point.has_number) continue;
      depths_.Add(point, met, coverage);
      tvu_.Add(point.tvu);
      thu_.Add(point.thu);
      if ((met >> wanted_.index & 1) == 0) AddFailing(point);
    }
    patches_.Find(points);
  }

  void AddFailing(const AnnotatedPoint& point) {
    const auto shares = VerticalShares(point, first_.coverage());
    ++failing_.points;
    for (std::size_t i = 0; i < shares.size(); ++i) failing_.shares[i] += shares[i];
    ++failing_.largest[static_cast<std::size_t>(std::ranges::max_element(shares) - shares.begin())];
  }

  // Outcomes of the points that have no number, from the summaries.
  Json WithoutNumber() const {
    std::map<std::string, std::uint64_t> counts;
    for (const AnnotatedLasFile& file : files_) {
      for (const auto& [outcome, count] : file.summary()["answers"]["outcomes"].items())
        if (outcome != "INTERPOLATED" && count.is_number_unsigned()) counts[outcome] += count.get<std::uint64_t>();
    }
    // Points of ours have all their reasons in the summaries; others may not.
    std::uint64_t named = 0;
    for (const auto& [outcome, count] : counts) named += count;
    const std::uint64_t without = all_.points() - all_.with_number();
    // Summaries may count points that are left out here.
    if (named > without) counts.clear(), named = 0;
    if (named < without) counts["UNKNOWN"] = without - named;
    return counts.empty() ? Json::object() : Json(counts);
  }

  Json WantedJson() const {
    const Specification& specification = options_.specifications[wanted_.specification];
    const std::uint64_t meeting = all_.meeting(wanted_.index);
    const double fraction = static_cast<double>(meeting) / static_cast<double>(all_.points());
    Json json = {{"specification", specification.title},
                 {"class", specification.classes[wanted_.of_class].name},
                 {"index", wanted_.index},
                 {"source", specification.source},
                 {"points", all_.points()},
                 {"with_number", all_.with_number()},
                 {"meeting", meeting},
                 {"fraction", fraction},
                 {"pass_share", options_.pass_share},
                 {"passes", 100 * fraction >= options_.pass_share},
                 {"without_number", WithoutNumber()},
                 {"failing", {{"points", failing_.points}, {"largest_share", Json::object()}}}};
    for (std::size_t i = 0; i < failing_.largest.size(); ++i)
      if (failing_.largest[i] > 0) json["failing"]["largest_share"][kVerticalShareNames[i]] = failing_.largest[i];
    return json;
  }

  Json SpecificationsJson() const {
    Json list = Json::array();
    std::size_t index = 0;
    for (const Specification& each : options_.specifications) {
      Json json = {{"name", each.name},
                   {"title", each.title},
                   {"edition", each.edition.empty() ? Json() : Json(each.edition)},
                   {"source", each.source},
                   {"classes", Json::array()}};
      for (const SpecificationClass& of : each.classes) {
        const auto limit = [](const std::optional<Limit>& known) {
          if (!known.has_value()) return Json();
          return Json{
              {"constant", known->constant}, {"of_depth", known->of_depth}, {"combined", known->rss ? "rss" : "sum"}};
        };
        const std::uint64_t meeting = all_.meeting(index);
        json["classes"].push_back({{"name", of.name},
                                   {"index", index},
                                   {"coverage", annotate::CoverageName(of.coverage)},
                                   {"horizontal", limit(of.horizontal)},
                                   {"vertical", limit(of.vertical)},
                                   {"meeting", meeting},
                                   {"fraction", static_cast<double>(meeting) / static_cast<double>(all_.points())}});
        ++index;
      }
      list.push_back(std::move(json));
    }
    return list;
  }

  Json FilesJson() const {
    Json list = Json::array();
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const Json& summary = files_[i].summary();
      const Json &parameters = summary["parameters"], &input = summary["input"];
      Json json = {{"name", files_[i].path().filename().string()}, {"bytes", files_[i].reader().file_size()}};
      json.update(of_files_[i].tally.Json(classes_));
      json["outcomes"] = summary["answers"]["outcomes"];
      json["wind_speed"] = parameters.value("wind_speed", Json());
      json["wind_from"] = parameters.value("wind_from", Json());
      json["sea"] = input.value("sea", parameters.value("sea", Json()));
      const Json numbers = NumbersOf(summary);
      for (const auto& [name, number] : numbers.items())
        if (name == "water_attenuation" && number.is_object())
          json["water_attenuation"] = number.value("value", Json());
      json["first_time"] = json["last_time"] = nullptr;
      if (of_files_[i].last_time > of_files_[i].first_time) {
        json["first_time"] = of_files_[i].first_time;
        json["last_time"] = of_files_[i].last_time;
      }
      list.push_back(std::move(json));
    }
    return list;
  }

  // By name; of several scanners in one file with the channel: "scan, scanner channel 1".
  static Json NumbersOf(const Json& summary) {
    const auto of_total = [](const Json& in) {
      const Json total = in.is_object() ? in.value("total", Json()) : Json();
      const Json numbers = total.is_object() ? total.value("numbers", Json()) : Json();
      return numbers.is_object() ? numbers : Json::object();
    };
    const Json& parameters = summary["parameters"];
    if (!parameters.contains("channels") || !parameters["channels"].is_array()) return of_total(parameters);
    const Json names = summary["answers"].value("channels", Json());
    Json all = Json::object();
    for (std::size_t i = 0; i < parameters["channels"].size(); ++i) {
      const Json name = i < names.size() && names[i].is_object() ? names[i].value("name", Json()) : Json();
      const std::string channel = name.is_string() ? name.get<std::string>() : absl::StrCat("channel ", i + 1);
      const Json numbers = of_total(parameters["channels"][i]);
      for (const auto& [key, number] : numbers.items()) all[absl::StrCat(key, ", ", channel)] = number;
    }
    return all;
  }

  // Every number with its source, of all files: where they differ, one each.
  Json NumbersJson() const {
    Json list = Json::array();
    std::set<std::string> seen;
    for (const AnnotatedLasFile& file : files_) {
      const Json numbers = NumbersOf(file.summary());
      for (const auto& [name, number] : numbers.items()) {
        Json json = {{"name", name}};
        for (const char* const key : {"value", "source", "assumed"})
          if (number.is_object() && number.contains(key)) json[key] = number[key];
        if (seen.insert(json.dump()).second) list.push_back(std::move(json));
      }
    }
    return list;
  }

  Json ToJson(const std::optional<CrossCheck>& check) const {
    Json json = {{"program", "albtpu-query"},
                 {"program_version", std::string(Version())},
                 {"made_from", MadeFrom(files_, options_)},
                 {"coverage", annotate::CoverageName(first_.coverage())},
                 {"crs", first_.crs_name()},
                 {"metres_per_unit", first_.metres_per_unit()},
                 {"metres_per_height_unit", first_.metres_per_height_unit()},
                 {"table", first_.summary().value("table", Json())},
                 {"cell", options_.cell},
                 {"wanted", WantedJson()},
                 {"specifications", SpecificationsJson()},
                 {"all", all_.Json(classes_)},
                 {"by_depth", depths_.Json(classes_)},
                 {"depth_bands", depths_.Json(classes_, BandEnds())},
                 {"lines", Json::array()},
                 {"files", FilesJson()},
                 {"histograms", {{"thu", thu_.ToJson()}, {"tvu", tvu_.ToJson()}}},
                 {"numbers", NumbersJson()},
                 {"land", land_.Json(options_.specifications, options_.check_points)},
                 {"crosscheck", nullptr}};
    for (const auto& [line, tally] : lines_) {
      Json of_line = {{"line", line}};
      of_line.update(tally.Json(classes_));
      json["lines"].push_back(std::move(of_line));
    }
    if (!left_out_.empty()) json["left_out"] = LeftOutJson(left_out_);
    if (!check.has_value()) json["nothing_to_compare"] = patches_.lines().NothingToCompare();
    if (check.has_value()) {
      json["crosscheck"] = CrossCheckJson(*check);
      json["crosscheck"]["patch"] = options_.patch;
      json["crosscheck"]["patches_taken"] = patches_.sampled();
    }
    return json;
  }

  const std::vector<AnnotatedLasFile>& files_;
  const ReportOptions& options_;
  WantedClass wanted_;
  ClassJudge judge_;
  S44Orders orders_;
  std::size_t classes_;
  const AnnotatedLasFile& first_;
  PointTally all_;
  LandTable land_;
  DepthTallies depths_;
  std::map<int, PointTally> lines_;
  std::vector<OfFile> of_files_;
  Histogram thu_{kThuStep}, tvu_{kTvuStep};
  Failing failing_;
  LeftOutPoints left_out_;
  SurveyGrid grid_;
  OverlapPatches patches_;
};

}  // namespace

nlohmann::ordered_json MadeFrom(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options) {
  Json json = {
      {"cell", options.cell},          {"patch", options.patch},           {"specification", options.specification},
      {"class", options.wanted_class}, {"pass_share", options.pass_share}, {"specifications", Json::array()},
      {"files", Json::array()}};
  json["check_points"] = Json::array({options.check_points.horizontal, options.check_points.vertical});
  for (const Specification& each : options.specifications) json["specifications"].push_back(LimitsJson(each));
  for (const AnnotatedLasFile& file : files)
    json["files"].push_back({{"name", file.path().filename().string()}, {"bytes", file.reader().file_size()}});
  return json;
}

absl::StatusOr<SurveyReport> MakeReport(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options) {
  ASSIGN_OR_RETURN(const WantedClass wanted,
                   FindClass(options.specifications, options.specification, options.wanted_class));
  return Reporter(files, options, wanted).Make();
}

}  // namespace albtpu::quality
