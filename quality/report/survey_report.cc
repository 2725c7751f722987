#include "quality/report/survey_report.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "annotate/answers/batch.h"
#include "config/sea_settings.h"
#include "formats/clocks/trajectory_time.h"
#include "quality/report/bottom_coverage.h"
#include "quality/report/length_histogram.h"
#include "quality/report/limit_margins.h"
#include "quality/report/line_tallies.h"
#include "quality/report/stated_by_files.h"
#include "quality/report/surface_nodes.h"
#include "status/status_macros.h"
#include "tables/s44.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTvuStep = 0.002, kThuStep = 0.01;  // m, of the histograms.

constexpr double kReportAdjustment = 1e9;  // s, from the times of files with dates to GPS time; exact.

const std::vector<int>& BandEnds() {
  static const std::vector<int> ends = {1, 2, 5, 10, 15, 20, 30, 50};
  return ends;
}

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
  // `specifications` are those of points, among which `wanted` is one.
  Reporter(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options,
           const std::vector<Specification>& specifications, const WantedClass& wanted)
      : files_(files),
        options_(options),
        specifications_(specifications),
        wanted_(wanted),
        judge_(specifications),
        orders_(specifications),
        classes_(ClassCount(specifications)),
        first_(files.front()),
        datum_(DatumOf(files, options.vertical_datum)),
        grid_(options.cell / first_.metres_per_unit(), first_.coverage()),
        land_cells_(options.cell / first_.metres_per_unit()),
        patches_(options.patch, first_.metres_per_unit(), first_.coverage()) {}

  absl::StatusOr<SurveyReport> Make() {
    ASSIGN_OR_RETURN(const FileSeas seas, SeasOf(files_, options_.seas));
    annotate::FileProgress progress = ProgressOver(files_);
    for (const AnnotatedLasFile& file : files_) {
      progress.NextFile();
      OfFile& of_file = of_files_.emplace_back();
      ASSIGN_OR_RETURN(const LeftOutPoints left_out,
                       file.ForEach(
                           progress, [&](std::span<const AnnotatedPoint> points) { Add(points, of_file); },
                           [&](const DryPoint& point) {
                             land_.Add(point);
                             land_cells_.Add(point);
                           }));
      left_out_.Add(left_out);
      RETURN_IF_ERROR(grid_.status());
    }
    if (all_.points() == 0) return NoBathymetricPoint(files_);
    const BottomCoverage coverage = BottomCoverage::Of(grid_, land_cells_, first_.metres_per_unit());
    RETURN_IF_ERROR(FillPatches(files_, seas, patches_, [&](std::span<const AnnotatedPoint> points) {
      for (const AnnotatedPoint& point : points)
        lines_.Add(point, patches_.lines(), judge_.Met(point), first_.coverage());
    }));
    const std::optional<CrossCheck> check = CheckPatches(patches_, seas.waves);
    return SurveyReport{.json = annotate::JsonBox(ToJson(check, coverage)),
                        .grid = std::move(grid_),
                        .facts = {.coverage = first_.coverage(),
                                  .crs_name = first_.crs_name(),
                                  .crs_wkt = first_.crs_wkt(),
                                  .vertical_name = datum_.name,
                                  .vertical_wkt = datum_.wkt,
                                  .metres_per_unit = first_.metres_per_unit()}};
  }

 private:
  void Add(std::span<const AnnotatedPoint> points, OfFile& of_file) {
    const Coverage coverage = first_.coverage();
    for (const AnnotatedPoint& point : points) {
      const std::uint64_t met = judge_.Met(point);
      all_.Add(point, met, coverage);
      of_file.tally.Add(point, met, coverage);
      if (!formats::IsNoTime(point.time)) {
        of_file.first_time = std::min(of_file.first_time, point.time);
        of_file.last_time = std::max(of_file.last_time, point.time);
      }
      grid_.Add(point, orders_.Best(met));
      if (!point.has_number) continue;
      depths_.Add(point, met, coverage);
      tvu_.Add(point.tvu);
      thu_.Add(point.thu);
      margins_.Add(judge_.Margin(point, wanted_.index));
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

  // The verdict if the overlap's factor were applied to all standard deviations; null where it is not known.
  Json WithFactorJson(const std::optional<CrossCheck>& check) const {
    if (!check.has_value() || !(check->factor.value > 0) || !std::isfinite(check->factor.value)) return nullptr;
    const std::uint64_t meeting = margins_.Within(check->factor.value);
    const double fraction = static_cast<double>(meeting) / static_cast<double>(all_.points());
    return {{"factor", check->factor.value},
            {"meeting", meeting},
            {"fraction", fraction},
            {"passes", Reach(meeting, all_.points(), options_.pass_share)}};
  }

  // When the points were measured; null where their times have no dates.
  Json SurveyedJson() const {
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (!files_[i].has_dates()) return nullptr;
      if (!(of_files_[i].last_time > of_files_[i].first_time)) continue;
      first = std::min(first, of_files_[i].first_time), last = std::max(last, of_files_[i].last_time);
    }
    if (!(last > first && first >= -kReportAdjustment && last < kLastDate)) return nullptr;
    return {{"first", formats::UtcText(first + kReportAdjustment)},
            {"last", formats::UtcText(last + kReportAdjustment)}};
  }

  Json WantedJson() const {
    const Specification& specification = specifications_[wanted_.specification];
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
                 {"passes", Reach(meeting, all_.points(), options_.pass_share)},
                 {"without_number", OutcomesWithoutNumber(files_, all_.points() - all_.with_number())},
                 {"failing", {{"points", failing_.points}, {"largest_share", Json::object()}}}};
    for (std::size_t i = 0; i < failing_.largest.size(); ++i)
      if (failing_.largest[i] > 0) json["failing"]["largest_share"][kVerticalShareNames[i]] = failing_.largest[i];
    return json;
  }

  Json SpecificationsJson() const {
    Json list = Json::array();
    std::size_t index = 0;
    for (const Specification& each : specifications_) {
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
                                   {"also", of.also.empty() ? Json() : Json(of.also)},
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
        if ((name == "water_entered" || name == "water_attenuation") && number.is_object())
          json[name] = number.value("value", Json());
      json["first_time"] = json["last_time"] = nullptr;
      if (of_files_[i].last_time > of_files_[i].first_time) {
        json["first_time"] = of_files_[i].first_time;
        json["last_time"] = of_files_[i].last_time;
      }
      list.push_back(std::move(json));
    }
    return list;
  }

  Json ToJson(const std::optional<CrossCheck>& check, const BottomCoverage& coverage) const {
    Json json = {{"program", "albtpu-query"},
                 {"program_version", std::string(Version())},
                 {"made_from", MadeFrom(files_, options_)},
                 {"coverage", annotate::CoverageName(first_.coverage())},
                 {"project", ProjectOf(files_, options_.project)},
                 {"surveyed", SurveyedJson()},
                 {"crs", first_.crs_name()},
                 {"vertical_datum", datum_.name.empty() ? Json() : Json(datum_.name)},
                 {"metres_per_unit", first_.metres_per_unit()},
                 {"metres_per_height_unit", first_.metres_per_height_unit()},
                 {"table", first_.summary().value("table", Json())},
                 {"cell", options_.cell},
                 {"wanted", WantedJson()},
                 {"specifications", SpecificationsJson()},
                 {"all", all_.Json(classes_)},
                 {"by_depth", depths_.Json(classes_)},
                 {"depth_bands", depths_.Json(classes_, BandEnds())},
                 {"lines", lines_.Json(patches_.lines(), classes_)},
                 {"files", FilesJson()},
                 {"histograms", {{"thu", thu_.ToJson()}, {"tvu", tvu_.ToJson()}}},
                 {"numbers", NumbersOf(files_)},
                 {"assumed", AssumedOf(files_)},
                 {"contributions", ContributionsOf(files_)},
                 {"bottom", coverage.Json()},
                 {"land", land_.Json(options_.specifications, options_.check_points)},
                 {"crosscheck", nullptr}};
    json["wanted"]["with_factor"] = WithFactorJson(check);
    const Specification& specification = specifications_[wanted_.specification];
    json["wanted"]["nodes"] =
        specification.name != "s44"
            ? Json()
            : NodesOf(*options_.surface, specification.classes[wanted_.of_class].name, options_.pass_share);
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
  const std::vector<Specification>& specifications_;
  WantedClass wanted_;
  ClassJudge judge_;
  S44Orders orders_;
  std::size_t classes_;
  const AnnotatedLasFile& first_;
  StatedDatum datum_;
  PointTally all_;
  LandTable land_;
  DepthTallies depths_;
  LineTallies lines_;
  LimitMargins margins_;
  std::vector<OfFile> of_files_;
  LengthHistogram thu_{kThuStep}, tvu_{kTvuStep};
  Failing failing_;
  LeftOutPoints left_out_;
  SurveyGrid grid_;
  LandCells land_cells_;
  OverlapPatches patches_;
};

}  // namespace

nlohmann::ordered_json MadeFrom(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options) {
  Json json = {
      {"cell", options.cell},          {"patch", options.patch},           {"specification", options.specification},
      {"class", options.wanted_class}, {"pass_share", options.pass_share}, {"specifications", Json::array()},
      {"files", Json::array()}};
  if (!options.project.empty()) json["project"] = options.project;
  if (!options.vertical_datum.empty()) json["vertical_datum"] = options.vertical_datum;
  if (!options.surface->is_null()) json["surface"] = *options.surface;
  if (options.seas != nullptr) json["sea"] = config::Parameters(options.seas->settings());
  json["check_points"] = Json::array({options.check_points.horizontal, options.check_points.vertical});
  for (const Specification& each : options.specifications) json["specifications"].push_back(LimitsJson(each));
  for (const AnnotatedLasFile& file : files)
    json["files"].push_back({{"name", file.path().filename().string()},
                             {"bytes", file.reader().file_size()},
                             {"summary_digest", file.summary_digest()}});
  return json;
}

absl::StatusOr<SurveyReport> MakeReport(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options) {
  RETURN_IF_ERROR(CheckSurface(*options.surface, files));
  const std::vector<Specification> of_points = OfPoints(options.specifications);
  ASSIGN_OR_RETURN(const WantedClass wanted, FindClass(of_points, options.specification, options.wanted_class));
  return Reporter(files, options, of_points, wanted).Make();
}

}  // namespace albtpu::quality
