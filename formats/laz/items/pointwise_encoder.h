// The compressed bytes of a chunk of points of formats 0 to 5.
#pragma once

#include "formats/laz/coding/arithmetic_encoder.h"
#include "formats/laz/items/chunk_encoder.h"
#include "formats/laz/items/pointwise_items.h"

namespace albtpu::laz {

class PointwiseEncoder : public ChunkEncoder {
 public:
  explicit PointwiseEncoder(const LaszipRecord& record)
      : record_length_(record.record_length()), items_(record) {}

  void Encode(std::string_view records, std::string& chunk) override;

 private:
  std::size_t record_length_;
  PointwiseItems<ArithmeticEncoder> items_;
  ArithmeticEncoder encoder_;
};

}  // namespace albtpu::laz
