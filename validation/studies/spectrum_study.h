// A beam drawn through one realization of a sea.
#pragma once

#include <cstdint>

#include "sea/sea_state.h"
#include "validation/report/study.h"

namespace albtpu {

// The beam of the paper's section 2.1.2 through one realization of the sea, as tables: 0.25 m wide, from 4 m above
// the water, at 15 degrees, down to 0.25 m below the mean surface.
struct BeamPicture {
  DataTable surface{.name = "figure_3_surface",
                    .title = "Elevation of one realization around the beam",
                    .columns = {"x_m", "y_m", "elevation_m"},
                    .rows = {},
                    .on_the_page = false};
  DataTable rays{.name = "figure_3_rays",
                 .title = "Rays of the beam: points above the water, on the surface and 0.25 m below it",
                 .columns = {"x_above_m", "y_above_m", "z_above_m", "x_surface_m", "y_surface_m", "z_surface_m",
                             "x_bottom_m", "y_bottom_m", "z_bottom_m"},
                 .rows = {},
                 .on_the_page = false};
  DataTable spot{.name = "figure_3_spot",
                 .title = "Power over the plane 0.25 m down, relative to that of the spot in still water",
                 .columns = {"x_m", "y_m", "power"},
                 .rows = {},
                 .on_the_page = false};
  DataTable still_spot{.name = "figure_3_still_spot",
                       .title = "The edge of the spot in still water",
                       .columns = {"x_m", "y_m"},
                       .rows = {},
                       .on_the_page = false};
  DataTable centroids{
      .name = "figure_3_centroids",
      .title = "The centroid of the spot 0.25 m down, relative to the point where the axis meets the water",
      .columns = {"surface", "x_m", "y_m"},
      .rows = {}};
};

BeamPicture PictureOf(const SeaState& sea, std::uint64_t seed);

}  // namespace albtpu
