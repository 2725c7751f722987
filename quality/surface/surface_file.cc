#include "quality/surface/surface_file.h"

#include <array>
#include <cmath>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "tables/coverage.h"
#include "tables/s44.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

const double k95 = VerticalFactor(Coverage::kP95);

struct FloatLayer {
  const char *name, *long_name;
  double (*value)(const SurfaceNode& node);
  const char* unit = "m";
};

constexpr std::array kFloats = {
    FloatLayer{"elevation", "elevation of the bottom, upwards, in the vertical datum of the points",
               [](const SurfaceNode& n) { return n.elevation; }},
    FloatLayer{"depth", "depth of the bottom, downwards, in the vertical datum of the points",
               [](const SurfaceNode& n) { return -n.elevation; }},
    FloatLayer{"water_depth", "mean depth of the points below the water surface, without those of land",
               [](const SurfaceNode& n) { return double{n.depth}; }},
    FloatLayer{"uncertainty", "uncertainty of the elevation at 95 %, without its bias",
               [](const SurfaceNode& n) { return k95 * std::sqrt(n.variance.total()); }},
    FloatLayer{"uncertainty_1sigma", "standard deviation of the elevation",
               [](const SurfaceNode& n) { return std::sqrt(n.variance.total()); }},
    FloatLayer{"sigma_pulse", "part of the standard deviation: what is drawn anew for each pulse, but for the sea",
               [](const SurfaceNode& n) { return std::sqrt(n.variance.pulse); }},
    FloatLayer{"sigma_sea", "part of the standard deviation: the waves, which neighbouring pulses share",
               [](const SurfaceNode& n) { return std::sqrt(n.variance.sea); }},
    FloatLayer{"sigma_line", "part of the standard deviation: what the points of a line share",
               [](const SurfaceNode& n) { return std::sqrt(n.variance.line); }},
    FloatLayer{"sigma_survey", "part of the standard deviation: what all points share",
               [](const SurfaceNode& n) { return std::sqrt(n.variance.survey); }},
    FloatLayer{"land_share", "share of the points over which no water lay",
               [](const SurfaceNode& n) { return static_cast<double>(n.dry) / n.points; }, "1"},
    FloatLayer{"bias", "bias of the elevation, which is not taken away", [](const SurfaceNode& n) { return n.bias; }},
    FloatLayer{"shoalest", "elevation of the highest point", [](const SurfaceNode& n) { return n.shoalest; }},
    FloatLayer{"shoalest_uncertainty", "uncertainty of the highest point at 95 %",
               [](const SurfaceNode& n) { return k95 * n.shoalest_sigma; }},
    FloatLayer{"deviation", "standard deviation of the points about their plane",
               [](const SurfaceNode& n) { return n.deviation; }},
    FloatLayer{"predicted_deviation", "the same as the errors of the points predict it",
               [](const SurfaceNode& n) { return n.points > 1 ? std::sqrt(n.variance.within_cell(n.points)) : NAN; }}};

struct CountLayer {
  const char *name, *long_name;
  int (*value)(const SurfaceNode& node);
};

constexpr char kOrders[] = "exclusive special order_1a order_1b order_2 none";
constexpr FloatLayer kOrder = {"order_met", "order of IHO S-44 that the node meets", nullptr};

constexpr std::array kCounts = {
    CountLayer{"points", "points that the node is made of",
               [](const SurfaceNode& n) { return static_cast<int>(n.points); }},
    CountLayer{"left_out", "points that lie too far from the others",
               [](const SurfaceNode& n) { return static_cast<int>(n.left_out); }},
    CountLayer{"passes", "times that a line saw the cell", [](const SurfaceNode& n) { return n.variance.passes; }}};

}  // namespace

std::uint8_t OrderOf(const SurfaceNode& node) {
  const double tvu = k95 * std::sqrt(node.variance.total()) + std::abs(node.bias);
  const std::optional<S44Order> order = BestOrder(node.thu, tvu, node.depth);
  return static_cast<std::uint8_t>(1 + (order.has_value() ? static_cast<std::size_t>(*order) : kS44Orders.size()));
}

std::vector<SurfaceLayer> LayersOfRasters() {
  std::vector<SurfaceLayer> layers;
  for (const char* const first : {"elevation", "uncertainty"})
    for (const FloatLayer& layer : kFloats)
      if (layer.name == std::string_view(first)) layers.push_back({layer.name, layer.long_name, layer.unit});
  for (const FloatLayer& layer : kFloats) {
    const std::string_view name = layer.name;
    if (name != "elevation" && name != "uncertainty" && name != "depth" && name != "uncertainty_1sigma")
      layers.push_back({layer.name, layer.long_name, layer.unit});
  }
  for (const CountLayer& layer : kCounts)
    if (layer.name != std::string_view("left_out")) layers.push_back({layer.name, layer.long_name, ""});
  layers.push_back({kOrder.name, absl::StrCat(kOrder.long_name, ", from 1: ", kOrders), ""});
  return layers;
}

std::string SurfaceStatement(const std::string& vertical_name) {
  return absl::StrCat(
      "Nodes in the middle of cells: the mean of the points of a cell by airborne lidar bathymetry, after the slope of "
      "the 3 x 3 cells around is taken away. Elevations upwards in m, ",
      vertical_name.empty() ? "in the vertical datum of the points, which their files do not state"
                            : absl::StrCat("vertical datum: ", vertical_name),
      ". Uncertainty of a node: at 95 %, 1.96 standard deviations, propagated from the uncertainties of its points. "
      "Its "
      "parts at 1 sigma: pulse (drawn anew for each pulse), sea, line and survey. Neighbouring pulses share waves: the "
      "correlation of the sea's part over the cell is that of the spectrum of the sea. Bias is stated apart, and is in "
      "no uncertainty. Made by albtpu-query ",
      std::string(Version()), ".");
}

SurfaceFile::SurfaceFile(const std::filesystem::path& path, const GridFrame& frame)
    : file_(path, frame, kTileCells, "Nodes of a survey by airborne lidar bathymetry, and their uncertainty") {
  file_.Text(NC_GLOBAL, "comment", SurfaceStatement(frame.vertical_name));
  for (const FloatLayer& layer : kFloats) {
    floats_.push_back(file_.Floats(layer.name, layer.long_name, layer.unit));
    const std::string_view name = layer.name;
    if (name == "elevation" || name == "shoalest") file_.Text(floats_.back(), "positive", "up");
    if (name == "depth") file_.Text(floats_.back(), "positive", "down");
  }
  for (const CountLayer& layer : kCounts) counts_.push_back(file_.Counts(layer.name, layer.long_name));
  order_ = file_.Codes(kOrder.name, kOrder.long_name, kS44Orders.size() + 1, kOrders);
  file_.EndDefinitions();
}

void SurfaceFile::Put(const TilePlace& tile, std::span<const SurfaceNode> nodes) {
  const GridFrame& frame = file_.frame();
  const std::int64_t south = tile.row * kTileCells - frame.first_row;
  const auto row = static_cast<std::size_t>(static_cast<std::int64_t>(frame.rows) - south - kTileCells);
  const auto column = static_cast<std::size_t>(tile.column * kTileCells - frame.first_column);
  const auto put = [&](int variable, auto none, auto value) {
    std::vector<decltype(none)> values(std::size_t{kTileCells} * kTileCells, none);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t from_north = kTileCells - 1 - i / kTileCells;
      values[from_north * kTileCells + i % kTileCells] = value(nodes[i]);
    }
    file_.Put(variable, row, column, kTileCells, values);
  };
  for (std::size_t k = 0; k < kCounts.size(); ++k) put(counts_[k], 0, kCounts[k].value);
  if (nodes.empty()) return;  // The other variables have their fill values.
  for (std::size_t k = 0; k < kFloats.size(); ++k)
    put(floats_[k], NetcdfGrid::kNoValue, [&](const SurfaceNode& node) {
      const double value = node.points > 0 ? kFloats[k].value(node) : NAN;
      return std::isfinite(value) ? static_cast<float>(value) : NetcdfGrid::kNoValue;
    });
  put(order_, NetcdfGrid::kNoCode,
      [](const SurfaceNode& node) { return node.points > node.dry ? OrderOf(node) : NetcdfGrid::kNoCode; });
}

}  // namespace albtpu::quality
