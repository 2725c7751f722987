// A run of points of a LAS file: from their records to records with the uncertainty behind each.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "service/client/batch.h"
#include "service/client/las_annotation.h"
#include "service/client/las_header.h"
#include "service/client/las_point.h"

namespace albtpu::client {

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
