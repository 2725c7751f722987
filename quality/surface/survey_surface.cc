#include "quality/surface/survey_surface.h"

#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "budget/total/error_ellipse.h"
#include "quality/crosscheck/cross_check.h"
#include "quality/surface/surface_file.h"
#include "status/status_macros.h"
#include "tables/s44.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kPointsFile[] = ".points", kSurfaceFile[] = "surface.nc";
constexpr std::size_t kMostSources = 65'536;
constexpr std::size_t kTilesAtOnce = 6;

// Of the horizontal variance but for the sea's.
HorizontalGroups GroupsOf(const Json& summary) {
  const Json& all = summary["answers"]["total"]["all"];
  const auto fraction = [&](const char* shares, const char* name) {
    const Json number = all.value(shares, Json::object()).value(name, Json());
    return number.is_number() ? number.get<double>() : 0.0;
  };
  const double sea = fraction("shares_horizontal", "sea"), rest = 1 - sea;
  if (!(rest > 0)) return {};
  // To a hundredth, so that files of one survey have the same ones.
  const auto part = [&](double whole) { return std::round(100 * std::clamp(whole / rest, 0.0, 1.0)) / 100; };
  HorizontalGroups groups;
  groups.line = part(fraction("groups_horizontal", "line"));
  groups.survey = std::min(part(fraction("groups_horizontal", "survey")), 1 - groups.line);
  groups.pulse = 1 - groups.line - groups.survey;
  return groups;
}

// The sources of points: files of one sea and alike in what their horizontal errors are made of.
class Sources {
 public:
  explicit Sources(double cell) : sharing_(cell) {}

  absl::StatusOr<std::uint16_t> Of(const AnnotatedLasFile& file, const annotate::SeaTimeline* seas) {
    ASSIGN_OR_RETURN(SeaOfSource sea, SeaOfFile(file, seas));
    const auto known = std::ranges::find_if(seas_, [&](const SeaOfSource& each) {
      return each.spectrum.s == sea.spectrum.s && each.spectrum.a == sea.spectrum.a &&
             each.spectrum.b == sea.spectrum.b && each.x_azimuth == sea.x_azimuth &&
             each.water_index == sea.water_index;
    });
    const auto number = static_cast<std::uint16_t>(known - seas_.begin());
    if (known == seas_.end()) {
      sharing_.Add(sea);
      seas_.push_back(std::move(sea));
    }
    const HorizontalGroups groups = GroupsOf(file.summary());
    const auto [found, is_new] =
        numbers_.emplace(std::tuple(number, groups.line, groups.survey), static_cast<std::uint16_t>(list_.size()));
    if (is_new) list_.emplace_back(number, groups);
    if (list_.size() > kMostSources)
      return absl::ResourceExhaustedError(absl::StrCat("there are more than ", kMostSources, " seas; make parts"));
    return found->second;
  }

  NodeSources node_sources() const {
    return {.sea = [this](std::uint16_t source, double incidence, double azimuth,
                          double footprint) { return sharing_(list_[source].first, incidence, azimuth, footprint); },
            .groups = [this](std::uint16_t source) { return list_[source].second; }};
  }
  std::size_t seas() const { return seas_.size(); }

 private:
  SeaSharing sharing_;
  std::vector<SeaOfSource> seas_;
  std::vector<std::pair<std::uint16_t, HorizontalGroups>> list_;  // Sea, groups.
  std::map<std::tuple<std::uint16_t, double, double>, std::uint16_t> numbers_;
};

SurfacePoint PointOf(const AnnotatedPoint& point, double factor, std::uint16_t source) {
  const auto variance = [factor](float length) {
    const double sigma = length / factor;
    return static_cast<float>(sigma * sigma);
  };
  SurfacePoint of{.x = point.x, .y = point.y, .z = point.z, .time = point.time};
  of.sea = variance(point.tvu_sea);
  of.pulse = std::max(variance(point.tvu_pulse) - of.sea, 0.F);
  of.line = variance(point.tvu_line);
  of.survey = std::max(point.variance_z - of.sea - of.pulse - of.line, 0.F);
  of.xx = point.variance_x, of.yy = point.variance_y, of.xy = point.covariance_xy;
  of.xz = point.covariance_xz, of.yz = point.covariance_yz;
  of.incidence = point.incidence, of.azimuth = point.beam_azimuth, of.footprint = point.footprint;
  of.depth = point.depth, of.bias = point.bias_vertical;
  // At 95 %, by the axes of the ellipse.
  const double mean = (double{point.variance_x} + point.variance_y) / 2;
  const double split = std::hypot((double{point.variance_x} - point.variance_y) / 2, double{point.covariance_xy});
  const double ratio = mean > 0 ? std::sqrt(std::clamp((mean - split) / (mean + split), 0.0, 1.0)) : 0;
  of.thu = static_cast<float>(2 * std::sqrt(2 * mean) * RadiusFactors::Get()(static_cast<float>(ratio)));
  of.flight_line = static_cast<std::uint16_t>(point.line);
  of.source = source;
  return of;
}

// Sums over nodes, for the summary.
struct SurfaceTally {
  std::uint64_t nodes = 0, points = 0, left_out = 0;
  std::array<std::uint64_t, kS44Orders.size() + 1> orders = {};
  double pulse = 0, sea = 0, line = 0, survey = 0;  // Variances, m^2.
  double uncertainty = 0, independent = 0;          // At 95 %, m: as it is, and if points were independent.
  double mean_of_points = 0;                        // At 95 %, m: the mean TVU of the points.
  double squares = 0, predicted = 0;                // Of deviations: sample and prediction, m^2, each times n - 1.
  double chi_square = 0, degrees = 0;

  void Add(const SurfaceNode& node) {
    if (node.points == 0) {
      left_out += node.left_out;
      return;
    }
    ++nodes, points += node.points, left_out += node.left_out;
    ++orders[OrderOf(node) - 1U];
    const NodeVariance& v = node.variance;
    pulse += v.pulse, sea += v.sea, line += v.line, survey += v.survey;
    const double factor = VerticalFactor(Coverage::kP95);
    uncertainty += factor * std::sqrt(v.total());
    mean_of_points += factor * std::sqrt(v.of_point + v.survey);
    independent += factor * std::sqrt((v.of_point + v.survey) / node.points);
    if (node.points > 1 && v.within_cell(node.points) > 0) {
      squares += (node.points - 1.0) * node.deviation * node.deviation;
      predicted += (node.points - 1.0) * v.within_cell(node.points);
      chi_square += (node.points - 1.0) * node.deviation * node.deviation / v.within_cell(node.points);
      degrees += node.points - 1.0;
    }
  }

  Json ToJson() const {
    const auto n = static_cast<double>(std::max<std::uint64_t>(nodes, 1));
    const double variance = pulse + sea + line + survey;
    const auto share = [variance](double part) { return variance > 0 ? part / variance : 0; };
    Json json = {
        {"nodes", nodes},
        {"points", points},
        {"left_out", left_out},
        {"uncertainty_95", uncertainty / n},
        {"shares", {{"pulse", share(pulse)}, {"sea", share(sea)}, {"line", share(line)}, {"survey", share(survey)}}},
        {"for_comparison",
         {{"points_taken_as_independent_95", independent / n}, {"mean_tvu_of_points_95", mean_of_points / n}}},
        {"order_met", Json::object()},
        {"deviation", {{"degrees_of_freedom", degrees}}}};
    for (std::size_t i = 0; i < orders.size(); ++i)
      json["order_met"][i < kS44Orders.size() ? std::string(kS44OrderNames[i]) : "none"] = orders[i];
    json["deviation"]["sample"] = degrees > 0 ? Json(std::sqrt(squares / degrees)) : Json();
    json["deviation"]["predicted"] = degrees > 0 ? Json(std::sqrt(predicted / degrees)) : Json();
    json["deviation"]["factor"] = degrees > 0 ? Json(std::sqrt(chi_square / degrees)) : Json();
    return json;
  }
};

struct TileResult {
  TilePlace tile;
  absl::Status status;
  std::vector<SurfaceNode> nodes;
};

constexpr double kMostCells = 4e8;  // Of the rectangle around all points.

absl::StatusOr<GridFrame> FrameOf(const std::vector<TilePlace>& tiles, double cell, const AnnotatedLasFile& first) {
  std::int64_t west = tiles.front().column, east = west;
  for (const TilePlace& tile : tiles) west = std::min(west, tile.column), east = std::max(east, tile.column);
  const std::int64_t south = tiles.front().row, north = tiles.back().row;
  const GridFrame frame = {.first_column = west * kTileCells,
                           .first_row = south * kTileCells,
                           .columns = static_cast<std::size_t>(east - west + 1) * kTileCells,
                           .rows = static_cast<std::size_t>(north - south + 1) * kTileCells,
                           .cell = cell,
                           .crs_name = first.crs_name(),
                           .crs_wkt = first.crs_wkt(),
                           .metres_per_unit = first.metres_per_unit()};
  if (static_cast<double>(frame.columns) * static_cast<double>(frame.rows) > kMostCells)
    return absl::ResourceExhaustedError(
        absl::StrFormat("the surface is too large (points lie %d x %d cells apart); give "
                        "larger cells by --cell, or fewer files at a time",
                        frame.columns, frame.rows));
  return frame;
}

// All tiles of the frame from the north-west, as the file has them; those with points some at a time.
absl::Status WriteNodes(const PointTiles& points, const GridFrame& frame, const NodeSources& sources, SurfaceFile& file,
                        SurfaceTally& tally) {
  const std::int64_t west = frame.first_column / kTileCells, south = frame.first_row / kTileCells;
  const auto across = static_cast<std::int64_t>(frame.columns) / kTileCells;
  const std::int64_t down = static_cast<std::int64_t>(frame.rows) / kTileCells;
  const auto has_points = [&](const TilePlace& tile) { return std::ranges::binary_search(points.tiles(), tile); };
  absl::Status status;
  std::atomic<bool> failed = false;
  std::int64_t next = 0;
  tbb::parallel_pipeline(
      kTilesAtOnce,
      tbb::make_filter<void, TilePlace>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) {
        if (next == across * down || failed) {
          control.stop();
          return TilePlace{};
        }
        const TilePlace tile = {.row = south + down - 1 - next / across, .column = west + next % across};
        ++next;
        return tile;
      }) & tbb::make_filter<TilePlace, TileResult*>(tbb::filter_mode::parallel, [&](const TilePlace& tile) {
        auto result = std::make_unique<TileResult>(TileResult{.tile = tile, .status = {}, .nodes = {}});
        if (!has_points(tile)) return result.release();
        absl::StatusOr<std::vector<SurfacePoint>> of_tile = points.Read(tile);
        result->status = of_tile.status();
        if (of_tile.ok())
          result->nodes = NodesOf(tile, *std::move(of_tile), frame.cell, frame.metres_per_unit, sources);
        return result.release();
      }) & tbb::make_filter<TileResult*, void>(tbb::filter_mode::serial_in_order, [&](TileResult* made) {
        const std::unique_ptr<TileResult> result(made);
        status.Update(result->status);
        if (!status.ok()) return;
        file.Put(result->tile, result->nodes);
        for (const SurfaceNode& node : result->nodes) tally.Add(node);
      }));
  return status;
}

}  // namespace

absl::StatusOr<annotate::JsonBox> MakeSurface(const std::vector<AnnotatedLasFile>& files, const SurfaceOptions& options,
                                              const fs::path& folder) {
  const AnnotatedLasFile& first = files.front();
  const double cell = options.cell / first.metres_per_unit(), factor = VerticalFactor(first.coverage());
  Sources sources(options.cell);
  const fs::path points_path = folder / kPointsFile;
  ASSIGN_OR_RETURN(PointTilesWriter writer, PointTilesWriter::Create(points_path, cell));
  annotate::FileProgress progress = ProgressOver(files);
  std::uint64_t without = 0, with = 0;
  LeftOutPoints left_out;
  for (const AnnotatedLasFile& file : files) {
    progress.NextFile();
    ASSIGN_OR_RETURN(const std::uint16_t source, sources.Of(file, options.seas));
    ASSIGN_OR_RETURN(const LeftOutPoints of_file, file.ForEach(progress, [&](std::span<const AnnotatedPoint> points) {
      for (const AnnotatedPoint& point : points) {
        ++(point.has_number ? with : without);
        if (point.has_number) writer.Add(PointOf(point, factor, source));
      }
    }));
    left_out.Add(of_file);
  }
  RETURN_IF_ERROR(writer.Finish());
  if (with == 0) return NoBathymetricPoint(files);
  ASSIGN_OR_RETURN(const PointTiles points, PointTiles::Open({points_path}, cell));
  SurfaceTally tally;
  ASSIGN_OR_RETURN(const GridFrame frame, FrameOf(points.tiles(), cell, first));
  SurfaceFile file(folder / kSurfaceFile, frame);
  RETURN_IF_ERROR(WriteNodes(points, frame, sources.node_sources(), file, tally));
  RETURN_IF_ERROR(file.Close());
  std::error_code not_removed;
  fs::remove(points_path, not_removed);

  Json json = {{"program", "albtpu-query"},
               {"program_version", std::string(Version())},
               {"cell", options.cell},
               {"crs", first.crs_name()},
               {"metres_per_unit", first.metres_per_unit()},
               {"seas", sources.seas()},
               {"points_with_number", with},
               {"points_without_number", without}};
  if (!left_out.empty()) json["points_left_out"] = LeftOutJson(left_out);
  json.update(tally.ToJson());
  return annotate::JsonBox(std::move(json));
}

std::string SurfaceText(const Json& surface) {
  const auto number = [](const Json& value) { return value.is_number() ? value.get<double>() : NAN; };
  const Json &shares = surface["shares"], &deviation = surface["deviation"];
  std::string text = absl::StrFormat(
      "  %d nodes of %g m from %d points; mean uncertainty %.3f m at 95 %%\n"
      "  of its variance: pulse %.0f %%, sea %.0f %%, line %.0f %%, survey %.0f %%\n"
      "  points taken as independent would give %.3f m, the mean TVU of points %.3f m\n",
      surface["nodes"].get<std::uint64_t>(), number(surface["cell"]), surface["points"].get<std::uint64_t>(),
      number(surface["uncertainty_95"]), 100 * number(shares["pulse"]), 100 * number(shares["sea"]),
      100 * number(shares["line"]), 100 * number(shares["survey"]),
      number(surface["for_comparison"]["points_taken_as_independent_95"]),
      number(surface["for_comparison"]["mean_tvu_of_points_95"]));
  if (deviation["factor"].is_number())
    absl::StrAppendFormat(&text, "  points scatter %.3f m about the surface; %.3f m predicted\n",
                          number(deviation["sample"]), number(deviation["predicted"]));
  return text;
}

}  // namespace albtpu::quality
