// Encodes the chunks of compressor 3; layered_decoder.h describes their parts.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "formats/laz/coding/arithmetic_encoder.h"
#include "formats/laz/items/chunk_encoder.h"
#include "formats/laz/items/laszip_record.h"
#include "formats/laz/items/layered_point.h"

namespace albtpu::laz {

class LayeredEncoder : public ChunkEncoder {
 public:
  explicit LayeredEncoder(const LaszipRecord& record);
  void Encode(std::string_view records, std::string& chunk) override;

 private:
  LayeredPoint<ArithmeticEncoder> point_;
  std::size_t record_length_;
};

}  // namespace albtpu::laz
