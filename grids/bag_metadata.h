// The metadata of a Bathymetric Attributed Grid: ISO 19115 as XML by ISO 19139, with the profile of the Open Navigation
// Surface Working Group (Format Specification Document of BAG, 2.0.1).
#pragma once

#include <optional>
#include <string>

namespace albtpu {

struct BagFacts {
  std::string title, abstract;
  std::string organisation;                              // Empty: unknown.
  std::string vertical_wkt;                              // Empty: unknown.
  std::string software, process;                         // That made it, and how.
  std::string source;                                    // What it was made of.
  std::string made;                                      // UTC, "2026-01-31T12:00:00".
  std::optional<std::string> first_survey, last_survey;  // UTC, alike.
  double lowest = 0, highest = 0;                        // Elevations, m.
};

// A template of GDAL's driver: what the driver knows (size, place, horizontal system) stands as ${NAME}.
//
// The type of the uncertainty is productUncert: of the types that the format has, the one of a node that was computed
// from other uncertainties at 95 %. The others are standard deviations of soundings. The abstract says what it is.
std::string BagMetadata(const BagFacts& facts);

}  // namespace albtpu
