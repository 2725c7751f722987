// A run of points of a LAS file: turns their records into records with THU and TVU appended.
#pragma once

#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "service/client/uncertainty_source.h"
#include "survey/answers/batch.h"
#include "survey/answers/uncertainty_summary.h"
#include "survey/las/beam_geometry.h"
#include "survey/las/las_header.h"
#include "survey/las/las_points.h"

namespace albtpu::client {

struct LasAnnotation {
  std::set<int> classes;  // The bathymetric ones: bottom seen through water.
  FlightLine flight_line;
  bool unit_is_given = false;  // Then the coordinate system may be in feet.
  AnswerStyle style;
};

// Everything that the chunks of a file have in common.
class LasChunkWork {
 public:
  LasChunkWork(const LasHeader& header, const LasAnnotation& annotation, UncertaintySource& source);

  // Memory that is reused from chunk to chunk.
  struct Chunk {
    explicit Chunk(AnswerStyle style) : summary(style) {}

    std::string records;    // Input.
    std::string annotated;  // Output: the same records, each followed by 8 bytes.
    LasClassCounts classes;
    UncertaintySummary summary;

   private:
    friend class LasChunkWork;
    std::vector<std::uint32_t> bathymetric;  // Indices of records.
    std::vector<double> z, scan_angles;      // Of these records.
    PulseBatch pulses;
    AnswerBatch answers;
  };

  absl::Status operator()(Chunk& chunk) const;

 private:
  void Decode(Chunk& chunk) const;
  void Encode(Chunk& chunk) const;

  LasPointFields fields_;
  std::size_t record_length_;
  FlightLine flight_line_;
  AnswerStyle style_;
  AnswerSelection selection_;
  std::array<bool, kClassCount> is_bathymetric_ = {};
  UncertaintySource& source_;
};

}  // namespace albtpu::client
