#include "tables/file/dataset_storage.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "absl/status/statusor.h"
#include "absl/strings/str_format.h"
#include "tables/file/hdf5.h"
#include "tables/format.h"

namespace albtpu::hdf5 {
namespace {

constexpr std::size_t kChecksumBytes = 4;  // appended to a chunk by fletcher32

template <typename... Arguments>
absl::Status Problem(const absl::FormatSpec<Arguments...>& format, const Arguments&... arguments) {
  return absl::InvalidArgumentError(absl::StrFormat(format, arguments...));
}

// The number of bytes that fletcher32 appends to each chunk, 0 without it. The filters must be deflate, with or
// without the other two, in the order in which all writers apply them. For other filters, HDF5 would load a
// plug-in.
absl::StatusOr<std::size_t> BytesBehindDeflate(hid_t creation) {
  constexpr std::array<H5Z_filter_t, 3> kOrder = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE,
                                                  H5Z_FILTER_FLETCHER32};
  bool deflated = false;
  std::size_t behind = 0;
  auto next = kOrder.begin();
  for (int i = 0; i < H5Pget_nfilters(creation); ++i) {
    std::size_t no_parameters = 0;
    const H5Z_filter_t filter = H5Pget_filter2(creation, static_cast<unsigned>(i), nullptr, &no_parameters,
                                               nullptr, 0, nullptr, nullptr);
    next = std::find(next, kOrder.end(), filter);
    if (next == kOrder.end()) {
      return Problem("uses filter %d of HDF5: expected shuffle and deflate", filter);
    }
    ++next;
    deflated = deflated || filter == H5Z_FILTER_DEFLATE;
    if (filter == H5Z_FILTER_FLETCHER32) behind = kChecksumBytes;
  }
  if (!deflated) return Problem("is in chunks without deflate: expected shuffle and deflate");
  return behind;
}

// Inflates chunks as HDF5 will, to check that they have the expected size.
class Chunks {
 public:
  Chunks(hid_t dataset, std::size_t bytes, std::size_t behind)
      : dataset_(dataset), behind_(behind), most_(compressBound(bytes) + behind), inflated_(bytes) {}

  bool IsWhole(const std::vector<hsize_t>& offset) {
    hsize_t size = 0;
    if (H5Dget_chunk_storage_size(dataset_, offset.data(), &size) < 0) return false;
    if (size <= behind_ || size > most_) return false;
    stored_.resize(size);
    std::uint32_t skipped_filters = 0;
    if (H5Dread_chunk(dataset_, H5P_DEFAULT, offset.data(), &skipped_filters, stored_.data()) < 0)
      return false;
    uLongf inflated = inflated_.size();
    return skipped_filters == 0 &&
           uncompress(inflated_.data(), &inflated, stored_.data(), size - behind_) == Z_OK &&
           inflated == inflated_.size();
  }

 private:
  hid_t dataset_;
  std::size_t behind_, most_;
  std::vector<Bytef> stored_, inflated_;
};

// Moves to the corner of the next chunk, last dimension first; false after the last chunk.
bool Advance(std::vector<hsize_t>& offset, const std::vector<hsize_t>& chunk,
             const std::vector<hsize_t>& shape) {
  for (std::size_t i = shape.size(); i-- > 0;) {
    offset[i] += chunk[i];
    if (offset[i] < shape[i]) return true;
    offset[i] = 0;
  }
  return false;
}

absl::Status CheckChunks(hid_t dataset, hid_t creation, const std::vector<hsize_t>& shape) {
  std::vector<hsize_t> chunk(shape.size());
  if (H5Pget_chunk(creation, static_cast<int>(chunk.size()), chunk.data()) !=
      static_cast<int>(chunk.size())) {
    return Problem("has chunks of another rank than its own");
  }
  std::size_t room = format::kMaxChunkValues, values = 1;
  for (const hsize_t size : chunk) {
    room /= std::max<hsize_t>(size, 1);
    if (room == 0)
      return Problem("has chunks of more than %d values, the most that a chunk may have",
                     format::kMaxChunkValues);
    values *= std::max<hsize_t>(size, 1);
  }
  const absl::StatusOr<std::size_t> behind = BytesBehindDeflate(creation);
  if (!behind.ok()) return behind.status();
  Chunks chunks(dataset, values * sizeof(float), *behind);
  std::vector<hsize_t> offset(shape.size());
  do {
    if (!chunks.IsWhole(offset)) return Problem("has a chunk that is missing or damaged");
  } while (Advance(offset, chunk, shape));
  return absl::OkStatus();
}

}  // namespace

absl::Status CheckStorage(hid_t dataset, const std::vector<hsize_t>& shape) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(creation) != 0) {
    return Problem("has its values in other files: expected them in this file");
  }
  if (layout == H5D_CHUNKED) return CheckChunks(dataset, creation, shape);
  std::size_t count = 1;
  for (const hsize_t size : shape) count *= size;
  const hsize_t stored = H5Dget_storage_size(dataset);
  if (stored == count * sizeof(float)) return absl::OkStatus();
  return Problem("has %d values in %d bytes: expected %d bytes", count, stored, count * sizeof(float));
}

}  // namespace albtpu::hdf5
