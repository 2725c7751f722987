// The nodes of a surface as a CF NetCDF-4 file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "grids/netcdf_grid.h"
#include "quality/surface/surface_tile.h"

namespace albtpu::quality {

// Variables of (y, x); rows begin in the north. All but counts have the fill value where there is no node.
//
//   elevation depth water_depth              m; upwards; the same downwards; of the water, the mean of the points
//   uncertainty uncertainty_1sigma           m; the first at 95 %, 1.96 standard deviations of the node; without bias
//   sigma_pulse sigma_sea sigma_line sigma_survey   m, 1 sigma: the parts of it
//   bias                                     m, of the elevation, which is not taken away
//   points left_out passes                   int
//   shoalest shoalest_uncertainty            m, upwards, the highest point; m, at 95 %, of that point alone
//   deviation predicted_deviation            m, of the points about the plane: the sample's, and what is predicted
//   order_met                                byte, S-44: by uncertainty and bias of the node, and the THU of its points
class SurfaceFile {
 public:
  SurfaceFile(const std::filesystem::path& path, const GridFrame& frame);

  // Nodes of NodesOf(), or none. Each tile of the frame once.
  void Put(const TilePlace& tile, std::span<const SurfaceNode> nodes);
  absl::Status Close() { return file_.Close(); }
  bool ok() const { return file_.ok(); }

 private:
  NetcdfGrid file_;
  std::vector<int> floats_, counts_;
  int order_ = 0;
};

// A variable of the file.
struct SurfaceLayer {
  std::string name, description, unit;
};
// All that nodes have, but those that follow from another: depth and uncertainty_1sigma; elevation and uncertainty
// first.
std::vector<SurfaceLayer> LayersOfRasters();

// For the metadata of all formats: what a node and its uncertainty are, and by which program.
std::string SurfaceStatement(const std::string& vertical_name);

// 1 plus the strictest order of kS44Orders that a node meets; 1 plus their number: none.
std::uint8_t OrderOf(const SurfaceNode& node);

}  // namespace albtpu::quality
