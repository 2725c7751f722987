#include "tables/file/hdf5_numbers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "absl/strings/str_format.h"
#include "status/status_macros.h"
#include "tables/file/hdf5.h"
#include "tables/format.h"

namespace albtpu::hdf5 {
namespace {

constexpr std::size_t kChecksumBytes = 4;     // appended to a chunk by fletcher32
constexpr std::size_t kTogether = 64;         // Chunks in memory, of which a hostile file has millions.
constexpr std::size_t kMostDeflation = 1032;  // Deflate makes nothing smaller than by this factor.

template <typename... Arguments>
absl::Status Problem(const absl::FormatSpec<Arguments...>& format, const Arguments&... arguments) {
  return absl::InvalidArgumentError(absl::StrFormat(format, arguments...));
}

std::size_t Product(std::span<const hsize_t> sizes) {
  return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
}

// What chunks pass through besides deflate.
struct Filters {
  bool shuffle = false;
  bool checksum = false;
};

// The filters must be deflate, with or without the other two, in the order in which all writers apply them.
absl::StatusOr<Filters> FiltersOf(hid_t creation) {
  constexpr std::array<H5Z_filter_t, 3> kOrder = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
  Filters filters;
  bool deflated = false;
  auto next = kOrder.begin();
  for (int i = 0; i < H5Pget_nfilters(creation); ++i) {
    std::size_t count = 1;
    unsigned parameter = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), nullptr, &count, &parameter, 0, nullptr, nullptr);
    next = std::find(next, kOrder.end(), filter);
    if (next == kOrder.end()) return Problem("uses filter %d of HDF5: expected shuffle and deflate", filter);
    ++next;
    deflated = deflated || filter == H5Z_FILTER_DEFLATE;
    filters.shuffle = filters.shuffle || filter == H5Z_FILTER_SHUFFLE;
    filters.checksum = filters.checksum || filter == H5Z_FILTER_FLETCHER32;
    if (filter == H5Z_FILTER_SHUFFLE && (count != 1 || parameter != sizeof(float)))
      return Problem("is shuffled by %d bytes: expected the %d of a value", parameter, sizeof(float));
  }
  if (!deflated) return Problem("is in chunks without deflate: expected shuffle and deflate");
  return filters;
}

// Fletcher's checksum as HDF5 has it, over big-endian words of 16 bits.
std::uint32_t Fletcher32(std::span<const Bytef> bytes) {
  std::uint32_t sum = 0, sum_of_sums = 0;
  const auto fold = [](std::uint32_t number) { return (number & 0xFFFF) + (number >> 16); };
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const std::uint32_t low = i + 1 < bytes.size() ? bytes[i + 1] : 0;
    sum = fold(sum + (std::uint32_t{bytes[i]} << 8 | low));
    sum_of_sums = fold(sum_of_sums + sum);
  }
  return sum_of_sums << 16 | sum;
}

class ChunkReader {
 public:
  // `values` are those of the whole dataset.
  ChunkReader(hid_t dataset, const std::vector<hsize_t>& shape, const std::vector<hsize_t>& chunk, Filters filters,
              std::vector<float>& values)
      : dataset_(dataset), shape_(shape), chunk_(chunk), filters_(filters), size_(Product(chunk)), values_(values) {
    while (whole_ > 1 && chunk_[whole_ - 1] == shape_[whole_ - 1]) --whole_;
  }

  // False if a chunk is missing or damaged.
  bool ReadAll() const {
    std::vector<StoredChunk> chunks;
    std::vector<hsize_t> corner(shape_.size());
    bool is_last = false;
    while (!is_last) {
      // HDF5 serves one thread at a time.
      chunks.clear();
      while (!is_last && chunks.size() < kTogether) {
        std::optional<StoredChunk> chunk = ReadStored(corner);
        if (!chunk.has_value()) return false;
        chunks.push_back(*std::move(chunk));
        is_last = !Advance(corner);
      }
      if (!InflateAll(chunks)) return false;
    }
    return true;
  }

 private:
  struct StoredChunk {
    std::vector<hsize_t> corner;
    std::vector<Bytef> bytes;  // Deflated, and the checksum if there is one.
  };

  // Moves to the corner of the next chunk, last dimension first; false after the last chunk.
  bool Advance(std::vector<hsize_t>& corner) const {
    for (std::size_t i = shape_.size(); i-- > 0;) {
      corner[i] += chunk_[i];
      if (corner[i] < shape_[i]) return true;
      corner[i] = 0;
    }
    return false;
  }

  bool InflateAll(const std::vector<StoredChunk>& chunks) const {
    std::atomic<bool> is_sound = true;
    const auto inflate = [&](const auto& range) {
      std::vector<Bytef> inflated(size_ * sizeof(float));
      for (const StoredChunk& chunk : range) {
        if (Inflate(chunk, inflated))
          Place(chunk, inflated, 0, 0, 0);
        else
          is_sound = false;
      }
    };
    // Isolated, because this thread has HDF5: a task of another table would wait for it forever.
    tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(tbb::blocked_range(chunks.begin(), chunks.end()), inflate); });
    return is_sound;
  }

  std::size_t checksum_bytes() const { return filters_.checksum ? kChecksumBytes : 0; }

  std::optional<StoredChunk> ReadStored(const std::vector<hsize_t>& corner) const {
    hsize_t size = 0;
    if (H5Dget_chunk_storage_size(dataset_, corner.data(), &size) < 0) return std::nullopt;
    const std::size_t behind = checksum_bytes();
    if (size <= behind || size > compressBound(size_ * sizeof(float)) + behind) return std::nullopt;
    StoredChunk chunk{corner, std::vector<Bytef>(size)};
    std::uint32_t skipped_filters = 0;
    if (H5Dread_chunk(dataset_, H5P_DEFAULT, corner.data(), &skipped_filters, chunk.bytes.data()) < 0)
      return std::nullopt;
    return skipped_filters == 0 ? std::optional(std::move(chunk)) : std::nullopt;
  }

  bool Inflate(const StoredChunk& chunk, std::vector<Bytef>& inflated) const {
    const std::span<const Bytef> deflated = std::span(chunk.bytes).first(chunk.bytes.size() - checksum_bytes());
    if (filters_.checksum && !HasChecksum(deflated)) return false;
    uLongf size = inflated.size();
    return uncompress(inflated.data(), &size, deflated.data(), deflated.size()) == Z_OK && size == inflated.size();
  }

  // Whether the little-endian checksum behind the bytes is theirs.
  static bool HasChecksum(std::span<const Bytef> deflated) {
    std::uint32_t checksum = 0;
    static_assert(std::endian::native == std::endian::little && sizeof checksum == kChecksumBytes);
    std::memcpy(&checksum, deflated.data() + deflated.size(), kChecksumBytes);
    return checksum == Fletcher32(deflated);
  }

  // Copies the part of the chunk that lies in the dataset: along `dimension` and the later ones, from `from` in the
  // chunk to `to` in the dataset.
  void Place(const StoredChunk& chunk, const std::vector<Bytef>& inflated, std::size_t dimension, std::size_t from,
             std::size_t to) const {
    const auto after = [&](const std::vector<hsize_t>& sizes) {
      return Product(std::span(sizes).subspan(dimension + 1));
    };
    const std::size_t count = std::min(chunk_[dimension], shape_[dimension] - chunk.corner[dimension]);
    const std::size_t step = after(chunk_), step_of_values = after(shape_);
    to += chunk.corner[dimension] * step_of_values;
    if (dimension + 1 == whole_) return Copy(inflated, from, count * step, &values_[to]);
    for (std::size_t i = 0; i < count; ++i)
      Place(chunk, inflated, dimension + 1, from + i * step, to + i * step_of_values);
  }

  // Shuffled chunks have the first bytes of all values, then the second ones, and so on.
  void Copy(const std::vector<Bytef>& inflated, std::size_t from, std::size_t count, float* to) const {
    if (!filters_.shuffle) {
      std::memcpy(to, inflated.data() + from * sizeof(float), count * sizeof(float));
      return;
    }
    const Bytef* const bytes = inflated.data() + from;
    for (std::size_t i = 0; i < count; ++i) {
      to[i] =
          std::bit_cast<float>(std::uint32_t{bytes[i]} | std::uint32_t{bytes[size_ + i]} << 8 |
                               std::uint32_t{bytes[2 * size_ + i]} << 16 | std::uint32_t{bytes[3 * size_ + i]} << 24);
    }
  }

  const hid_t dataset_;
  const std::vector<hsize_t>&shape_, &chunk_;
  const Filters filters_;
  const std::size_t size_;             // of a chunk, in values
  std::size_t whole_ = shape_.size();  // From this dimension on, chunks span the dataset; 1 or more.
  std::vector<float>& values_;
};

absl::StatusOr<std::vector<hsize_t>> ChunkShape(hid_t creation, std::size_t rank) {
  std::vector<hsize_t> chunk(rank);
  if (H5Pget_chunk(creation, static_cast<int>(rank), chunk.data()) != static_cast<int>(rank))
    return Problem("has chunks of another rank than its own");
  std::size_t room = format::kMaxChunkValues;
  for (hsize_t& size : chunk) {
    size = std::max<hsize_t>(size, 1);
    room /= size;
    if (room == 0)
      return Problem("has chunks of more than %d values, the most that a chunk may have", format::kMaxChunkValues);
  }
  return chunk;
}

absl::StatusOr<std::vector<float>> ReadChunks(hid_t dataset, hid_t creation, const std::vector<hsize_t>& shape) {
  ASSIGN_OR_RETURN(const std::vector<hsize_t> chunk, ChunkShape(creation, shape.size()));
  ASSIGN_OR_RETURN(const Filters filters, FiltersOf(creation));
  const auto damaged = [] { return Problem("has a chunk that is missing or damaged"); };
  const std::size_t count = Product(shape);
  if (H5Dget_storage_size(dataset) < count * sizeof(float) / kMostDeflation) return damaged();
  std::vector<float> values(count);
  if (!ChunkReader(dataset, shape, chunk, filters, values).ReadAll()) return damaged();
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (H5Tconvert(type, H5T_NATIVE_FLOAT, count, values.data(), nullptr, H5P_DEFAULT) < 0)
    return Problem("cannot be read");
  return values;
}

}  // namespace

absl::StatusOr<std::vector<float>> ReadFloats(hid_t dataset, const std::vector<hsize_t>& shape) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(creation) != 0)
    return Problem("has its values in other files: expected them in this file");
  if (layout == H5D_CHUNKED) return ReadChunks(dataset, creation, shape);
  const std::size_t count = Product(shape);
  const hsize_t stored = H5Dget_storage_size(dataset);
  if (stored != count * sizeof(float))
    return Problem("has %d values in %d bytes: expected %d bytes", count, stored, count * sizeof(float));
  std::vector<float> values(count);
  if (H5Dread(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    return Problem("cannot be read");
  return values;
}

}  // namespace albtpu::hdf5
