// The compressed bytes of a chunk, from its points.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/laz/items/laszip_record.h"

namespace albtpu::laz {

// Encodes one chunk after the other; the memory for the models is used again.
class ChunkEncoder {
 public:
  // For a record by RecordFor().
  static std::unique_ptr<ChunkEncoder> For(const LaszipRecord& record);
  virtual ~ChunkEncoder() = default;

  // Compresses `records`, one point or more, into `chunk`, whose contents it replaces.
  virtual void Encode(std::string_view records, std::string& chunk) = 0;
};

}  // namespace albtpu::laz
