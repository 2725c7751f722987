// Chooses decoder and encoder by the LASzip record.
#include <memory>

#include "formats/laz/items/chunk_decoder.h"
#include "formats/laz/items/chunk_encoder.h"
#include "formats/laz/items/layered_decoder.h"
#include "formats/laz/items/layered_encoder.h"
#include "formats/laz/items/pointwise_decoder.h"
#include "formats/laz/items/pointwise_encoder.h"

namespace albtpu::laz {

std::unique_ptr<ChunkDecoder> ChunkDecoder::For(const LaszipRecord& record, WantedFields wanted) {
  if (record.compressor == Compressor::kLayeredChunked)
    return std::make_unique<LayeredDecoder>(record, wanted);
  return std::make_unique<PointwiseDecoder>(record);
}

std::unique_ptr<ChunkEncoder> ChunkEncoder::For(const LaszipRecord& record) {
  if (record.compressor == Compressor::kLayeredChunked) return std::make_unique<LayeredEncoder>(record);
  return std::make_unique<PointwiseEncoder>(record);
}

}  // namespace albtpu::laz
