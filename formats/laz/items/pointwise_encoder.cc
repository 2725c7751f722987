#include "formats/laz/items/pointwise_encoder.h"

#include <cassert>
#include <utility>

namespace albtpu::laz {

void PointwiseEncoder::Encode(std::string_view records, std::string& chunk) {
  assert(!records.empty() && records.size() % record_length_ == 0);
  chunk.assign(records.substr(0, record_length_));
  items_.Begin(records.data());
  encoder_.Begin();
  ArithmeticEncoder encoder = std::move(encoder_);  // Its state stays in registers here.
  for (std::size_t i = record_length_; i < records.size(); i += record_length_) {
    items_.Code(encoder, records.data() + i);
  }
  chunk += encoder.Finish();
  encoder_ = std::move(encoder);
}

}  // namespace albtpu::laz
