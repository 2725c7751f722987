// What LAS and LAZ files say of the survey that they are of, what they leave open, and values by which it can be
// completed.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "config/survey_draft.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/las/las_contents.h"
#include "formats/las/las_header.h"
#include "formats/las/las_reader.h"

namespace albtpu::programs {

struct LasLook {
  std::string path;
  formats::LasHeader header;
  formats::LasContents contents;
  std::string software = {};            // Of the header; may be empty.
  std::string crs = {}, vertical = {};  // Names of coordinate systems; empty: not stated.
  std::string unit = {};                // Of x and y: "m", "ft", "degree"; empty: not known.
  std::string height_unit = {};         // "m", "ft"; empty: the user must state it,
  std::string units_message = {};       // by the remedy in this message.
  std::string crs_message = {};         // What is wrong with the coordinate system; empty: nothing.

  std::vector<int> bottom() const;         // The classes of bathymetric points, as far as their numbers tell.
  std::vector<int> water_surface() const;  // The same of returns from the water surface.
  formats::PointTimes times() const;       // Requires contents.has_times().
  bool has_bottom_by_default() const;      // Points of the class that is taken where none is named.
  // Whether enough pulses have two returns that may lie under water: the way of the beams follows from them.
  bool has_pairs() const;
};

// Reads the whole file, or its first points; memory does not grow with it.
absl::StatusOr<LasLook> LookAt(const std::string& path,
                               std::uint64_t most_points = std::numeric_limits<std::uint64_t>::max());

// What was found, a line each, of which the first names the file and the others are indented.
std::vector<std::string> FoundLines(const LasLook& look);

// What differs between the files so that one survey file may not fit them all, a line each.
std::vector<std::string> Differences(std::span<const LasLook> looks);

// What the files with points answer themselves, and examples for the rest. Of a section the first value is the one that
// the others go with.
struct Suggestions {
  std::vector<config::DraftValue> values;
  bool from_returns = false;               // The way of the beams follows from the returns of all files.
  bool times = false, some_times = false;  // All, and some, of the files with points have times, as trajectories need.
  // Flags of `las` that have no key, with their values: for the beams where no trajectory is given, with
  // kExampleAltitude, and for the unit of heights, which may be empty.
  std::vector<std::string> by_angle, units;
};
inline const std::vector<std::string> kExampleAltitude = {"--altitude", "400"};  // m
inline const std::vector<std::string> kExampleScanner = {"--scanner", "across-track"};
inline const std::vector<std::string> kExampleIncidence = {"--incidence", "20"};  // degree
absl::StatusOr<Suggestions> SuggestionsFor(std::span<const LasLook> looks);

// The first value of a section; null if there is none.
const config::DraftValue* FirstOf(const Suggestions& suggestions, std::string_view section);

}  // namespace albtpu::programs
