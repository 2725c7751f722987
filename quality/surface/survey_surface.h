// The surface of a survey from its annotated files: a grid of nodes, and a summary of it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/json_box.h"
#include "annotate/seas/sea_timeline.h"
#include "grids/netcdf_grid.h"
#include "quality/annotated/annotated_points.h"
#include "quality/seas/sea_sharing.h"
#include "quality/surface/node.h"
#include "quality/surface/surface_part.h"
#include "quality/surface/surface_point.h"
#include "tables/coverage.h"

namespace albtpu::quality {

struct SurfaceOptions {
  double cell = 1;                              // m, 0.1 to 20
  const annotate::SeaTimeline* seas = nullptr;  // Null: the seas of the winds that the files state.
  bool land = false;                            // Also the dry points of the ground, and of the bottom above the water.
};

SurfaceMap MapOf(const AnnotatedLasFile& file);

// Of the horizontal variance but for the sea's, in the mean of a file: of its bathymetric or its dry points.
HorizontalGroups GroupsOf(const AnnotatedLasFile& file, bool dry);

// Of a point with a number, in a file of that coverage.
SurfacePoint SurfacePointOf(const AnnotatedPoint& point, Coverage coverage, std::uint16_t source);

// The same of a dry point with a number, without what the slope of the terrain adds to its height. `groups` are those
// of dry points.
SurfacePoint DrySurfacePointOf(const DryPoint& dry, Coverage coverage, const HorizontalGroups& groups,
                               std::uint16_t source);

// Puts the points of files into a part at `path`, which must be new, and is not sealed. Memory does not depend on their
// number. Of no files the part is empty.
absl::StatusOr<SurfacePart> GatherPoints(const std::vector<AnnotatedLasFile>& files, const SurfaceOptions& options,
                                         const std::filesystem::path& path);

struct MadeSurface {
  annotate::JsonBox json;      // surface.json
  std::filesystem::path path;  // surface.nc
  GridFrame frame;             // Of it.
};

// Writes surface.nc into `folder`. However points are distributed to parts, it is the same, byte for byte. Memory is
// that of the points of some tiles. FailedPrecondition where no point has a number; otherwise as Join().
absl::StatusOr<MadeSurface> MakeSurface(std::vector<SurfacePart> parts, const std::filesystem::path& folder);

// For the user, some lines.
std::string SurfaceText(const nlohmann::ordered_json& surface);

}  // namespace albtpu::quality
