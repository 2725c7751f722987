#include "formats/laz/items/layered_encoder.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "formats/laz/coding/little_endian.h"
#include "formats/laz/items/point_contexts.h"

namespace albtpu::laz {
namespace {

// Of points, or of bytes of a layer.
void StoreCount(std::size_t count, char* destination) {
  const auto stored = static_cast<std::uint32_t>(count);
  assert(stored == count);
  Store(stored, destination);
}

}  // namespace

LayeredEncoder::LayeredEncoder(const LaszipRecord& record)
    : point_(record), record_length_(record.record_length()) {}

void LayeredEncoder::Encode(std::string_view records, std::string& chunk) {
  assert(!records.empty() && records.size() % record_length_ == 0);
  const std::size_t points = records.size() / record_length_;
  const RecordRun<ArithmeticEncoder> further(records.data() + record_length_, record_length_, points - 1);
  point_.Begin(records.data());
  point_.FindChanges(further);
  for (auto& stream : point_.streams()) stream.coder.Begin();
  for (std::size_t i = 0; i < further.count(); i += kBatchPoints) {
    point_.Code({further[i], record_length_, std::min(kBatchPoints, further.count() - i)});
  }

  chunk.assign(records.substr(0, record_length_));
  chunk.resize(record_length_ + (1 + point_.streams().size()) * sizeof(std::uint32_t));
  StoreCount(points, &chunk[record_length_]);
  std::size_t size_offset = record_length_ + sizeof(std::uint32_t);
  for (auto& stream : point_.streams()) {
    if (stream.present) {
      const std::string& layer = stream.coder.Finish();
      StoreCount(layer.size(), &chunk[size_offset]);
      chunk += layer;
    }
    size_offset += sizeof(std::uint32_t);
  }
}

}  // namespace albtpu::laz
