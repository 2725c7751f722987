// A run of points of a LAS file: from their records to records with the uncertainty behind each.
#pragma once

#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "service/client/uncertainty_source.h"
#include "survey/answers/answer_style.h"
#include "survey/answers/batch.h"
#include "survey/answers/uncertainty_summary.h"
#include "survey/las/beam_geometry.h"
#include "survey/las/las_classes.h"
#include "survey/las/las_header.h"
#include "survey/las/las_point.h"

namespace albtpu::client {

struct LasAnnotation {
  std::set<int> classes;  // Those that are the bottom seen through water.
  FlightLine flight_line;
  bool unit_is_given = false;  // Then feet in the coordinate system are no surprise.
  AnswerStyle style;
};

// What is alike for all chunks of a file.
class LasChunkWork {
 public:
  LasChunkWork(const LasHeader& header, const LasAnnotation& annotation, UncertaintySource& source);

  // Memory that is used again for chunk after chunk.
  struct Chunk {
    explicit Chunk(AnswerStyle style) : summary(style) {}

    std::string records;    // In.
    std::string annotated;  // Out: the same with 8 bytes behind each.
    LasClassCounts classes;
    UncertaintySummary summary;

   private:
    friend class LasChunkWork;
    std::vector<std::uint32_t> bathymetric;  // Which records.
    std::vector<double> z, scan_angles;      // Of those.
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
