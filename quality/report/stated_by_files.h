// What the summaries of annotated files state: the project, every number with its source, what the sources of error
// contribute, and how much of the variance rests on assumed numbers.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "quality/annotated/annotated_points.h"

namespace albtpu::quality {

// `given`, keys and their text; otherwise [project] of the survey file of the first file that has it; null where none
// has.
nlohmann::ordered_json ProjectOf(const std::vector<AnnotatedLasFile>& files,
                                 const std::vector<std::pair<std::string, std::string>>& given);

// The vertical datum of elevations in metres.
struct StatedDatum {
  std::string name, wkt;  // Empty if not stated.
};
// That of the first file whose coordinate system states it; otherwise `given`, or else the first name that the survey
// file of a file gave.
StatedDatum DatumOf(const std::vector<AnnotatedLasFile>& files, const std::string& given);

// Of one file, by name; of several scanners in one file with the channel: "scan, scanner channel 1".
nlohmann::ordered_json NumbersOf(const nlohmann::ordered_json& summary);

// Every number with its source, of all files: where they differ, one each.
nlohmann::ordered_json NumbersOf(const std::vector<AnnotatedLasFile>& files);

// Outcomes of the points that have no number, `points`, with their counts.
nlohmann::ordered_json OutcomesWithoutNumber(const std::vector<AnnotatedLasFile>& files, std::uint64_t points);

// By depth: from, to, points, standard deviations of each contribution in m, horizontally (radial) and vertically, and
// means of both biases. Null where a summary does not state its variances.
nlohmann::ordered_json ContributionsOf(const std::vector<AnnotatedLasFile>& files);

// Fractions of the variance: `horizontal` and `vertical` of what is assumed, `share`, the larger of both, the fractions
// of each source, `samples` and `how`. Null where a summary does not state them.
nlohmann::ordered_json AssumedOf(const std::vector<AnnotatedLasFile>& files);

inline constexpr double kMostAssumed = 1.0 / 3;  // Of the variance, where the headline may be green.

}  // namespace albtpu::quality
