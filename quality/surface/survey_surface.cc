#include "quality/surface/survey_surface.h"

#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/clocks/trajectory_time.h"
#include "quality/surface/surface_file.h"
#include "quality/surface/surface_tally.h"
#include "status/status_macros.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kSurfaceFile[] = "surface.nc";
constexpr std::size_t kTilesAtOnce = 6;

struct TileResult {
  TilePlace tile;
  absl::Status status;
  std::vector<SurfaceNode> nodes;
};

constexpr double kMostCells = 4e8;  // Of the rectangle around all points.

absl::StatusOr<GridFrame> FrameOf(const std::vector<TilePlace>& tiles, double cell, const SurfaceMap& map) {
  std::int64_t west = tiles.front().column, east = west;
  for (const TilePlace& tile : tiles) west = std::min(west, tile.column), east = std::max(east, tile.column);
  const std::int64_t south = tiles.front().row, north = tiles.back().row;
  const GridFrame frame = {.first_column = west * kTileCells,
                           .first_row = south * kTileCells,
                           .columns = static_cast<std::size_t>(east - west + 1) * kTileCells,
                           .rows = static_cast<std::size_t>(north - south + 1) * kTileCells,
                           .cell = cell,
                           .crs_name = map.crs_name,
                           .crs_wkt = map.crs_wkt,
                           .vertical_name = map.vertical_name,
                           .vertical_wkt = map.vertical_wkt,
                           .metres_per_unit = map.metres_per_unit};
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
        failed = !status.ok();
        if (failed) return;
        file.Put(result->tile, result->nodes);
        for (const SurfaceNode& node : result->nodes) tally.Add(node);
      }));
  return status;
}

absl::Status NoPointHasNumber(const SurfacePart& part) {
  return absl::FailedPreconditionError(
      absl::StrCat(part.facts.files.front().name, part.facts.files.size() > 1 ? " and others" : "",
                   ": no bathymetric point has an uncertainty; annotate points of the bottom"));
}

}  // namespace

absl::StatusOr<MadeSurface> MakeSurface(std::vector<SurfacePart> parts, const fs::path& folder) {
  ASSIGN_OR_RETURN(const JoinedParts joined, Join(parts));
  const PartFacts& facts = joined.facts;
  if (facts.with_number + facts.dry.value_or(0) == 0) return NoPointHasNumber(parts.front());
  SeaSharing sharing(facts.cell);
  for (const SeaOfSource& sea : facts.seas) sharing.Add(sea);
  const double cell = facts.cell / facts.map.metres_per_unit;
  const NodeSources sources = {.sea =
                                   [&](std::uint16_t source, double incidence, double azimuth, double footprint,
                                       std::span<const Eigen::Vector2d> places) {
                                     return sharing(facts.sources[source].sea, incidence, azimuth, footprint, places);
                                   },
                               .groups = [&](std::uint16_t source) { return facts.sources[source].groups; },
                               .metres_per_unit = facts.map.metres_per_unit};
  std::vector<PointsFile> files;
  for (std::size_t i = 0; i < parts.size(); ++i)
    files.push_back({.path = parts[i].path, .end = parts[i].points_end, .sources = joined.sources[i]});
  ASSIGN_OR_RETURN(const PointTiles points, PointTiles::Open(std::move(files), cell));
  SurfaceTally tally;
  ASSIGN_OR_RETURN(const GridFrame frame, FrameOf(points.tiles(), cell, facts.map));
  const fs::path path = folder / kSurfaceFile;
  SurfaceFile file(path, frame);
  RETURN_IF_ERROR(WriteNodes(points, frame, sources, file, tally));
  RETURN_IF_ERROR(file.Close());

  const auto text_or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  Json json = {{"program", "albtpu-query"},
               {"program_version", std::string(Version())},
               {"cell", facts.cell},
               {"crs", facts.map.crs_name},
               {"vertical_crs", text_or_null(facts.map.vertical_name)},
               {"metres_per_unit", facts.map.metres_per_unit},
               {"surveyed", Json()},
               {"files", facts.files.size()},
               {"annotations_digest", DigestOfAnnotations(facts.summary_digests)},
               {"seas", facts.seas.size()},
               {"points_with_number", facts.with_number},
               {"points_without_number", facts.without_number}};
  if (facts.times.has_value())
    json["surveyed"] = {{"first", formats::UtcText(facts.times->first)},
                        {"last", formats::UtcText(facts.times->second)}};
  if (!facts.left_out.empty()) json["points_left_out"] = LeftOutJson(facts.left_out);
  json.update(tally.ToJson());
  if (facts.dry.has_value())
    json["land"] = {{"points_with_number", *facts.dry},
                    {"points", tally.dry},
                    {"nodes", tally.of_land},
                    {"nodes_of_both", tally.of_both}};
  return MadeSurface{.json = annotate::JsonBox(std::move(json)), .path = path, .frame = frame};
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
  if (surface.contains("land"))
    absl::StrAppendFormat(&text, "  %d nodes are of land, %d of both land and water\n",
                          surface["land"]["nodes"].get<std::uint64_t>(),
                          surface["land"]["nodes_of_both"].get<std::uint64_t>());
  if (deviation["factor"].is_number())
    absl::StrAppendFormat(&text, "  points scatter %.3f m about the surface; %.3f m predicted\n",
                          number(deviation["sample"]), number(deviation["predicted"]));
  return text;
}

}  // namespace albtpu::quality
