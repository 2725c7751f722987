#include "laz/laz_points.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::laz {
namespace {

constexpr int kMaxThreads = 16;
// The largest batch.
constexpr std::size_t kBatchBytes = 4 << 20;
constexpr std::size_t kPointsOfBatch = kCommonChunkSize;

// Models take 1.3 kB for each byte of a record in each scanner channel that has points. The models of all threads are
// bounded by those of records of this many bytes, which a single thread may need.
constexpr std::size_t kMaxRecordBytes = 1 << 16;

// The points of a chunk, and the number of the first of its batches.
struct ChunkTask {
  Chunk chunk;
  std::uint64_t number = 0;  // From 1.
  std::uint64_t first_batch = 0;
};

// Without a chunk table only the header states where the points end. A program that was interrupted leaves points
// behind `end` that it has not counted; a table whose offset is lost may also lie there: version 0, and the number of
// chunks.
absl::Status CheckAllCounted(const ByteSource& file, const LazExtent& extent, std::uint64_t end) {
  const std::uint64_t more = extent.points_end - end, chunk_size = extent.record.chunk_size;
  if (more < extent.record.record_length()) return absl::OkStatus();
  std::array<char, sizeof(std::uint64_t)> next;
  RETURN_IF_ERROR(file.ReadAt(end, next));
  const std::uint64_t chunks = chunk_size > 0 ? (extent.point_count + chunk_size - 1) / chunk_size : 0;
  if (chunk_size > 0 && Load<std::uint64_t>({next.data(), next.size()}, 0) == chunks << 32) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("its header states ", extent.point_count, " points, but ", more,
                   " bytes follow them, and it has no chunk table; get another copy of the file, or correct the "
                   "point count"));
}

// Where the chunks of a file lie.
struct ChunkPlaces {
  std::optional<ChunkTable> table;
  std::uint64_t begin = 0;     // Of the first chunk, where there is no table.
  std::uint64_t tail_end = 0;  // LazPoints::tail_end().
};

absl::StatusOr<ChunkPlaces> PlacesOf(const ByteSource& file, const LazExtent& extent) {
  assert(extent.points_begin <= extent.points_end && extent.points_end <= file.size());
  ChunkPlaces places = {.table = {}, .begin = extent.points_begin, .tail_end = file.size()};
  const std::uint64_t room = extent.points_end - extent.points_begin;
  const bool has_chunks = extent.record.compressor != Compressor::kPointwise;
  if (has_chunks && room < kTableOffsetSize && extent.point_count > 0)
    return Damaged("its points have ", room, " bytes (expected ", kTableOffsetSize, " and their chunks)");
  if (!has_chunks || room < kTableOffsetSize) return places;
  places.begin += kTableOffsetSize;
  absl::StatusOr<ChunkTable> found = ReadChunkTable(file, extent.record, extent.points_begin, extent.point_count);
  if (!found.ok() && !absl::IsNotFound(found.status())) return found.status();
  if (!found.ok() && extent.record.chunk_size == kVariableChunks && extent.point_count > 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("it has no chunk table (needed where chunks have no constant number of points)", kGetAnotherCopy));
  }
  if (!found.ok()) return places;
  if (found->offset_at_end) places.tail_end -= kTableOffsetSize;
  if (found->end > extent.points_end) {
    return absl::InvalidArgumentError(absl::StrCat("its chunk table ends at byte ", found->end,
                                                   ", behind the begin of what follows the points, ", extent.points_end,
                                                   kGetAnotherCopy));
  }
  places.table = *std::move(found);
  return places;
}

}  // namespace

class LazPoints::Impl {
 public:
  Impl(const ByteSource& file, const LazExtent& extent, ChunkPlaces places, std::size_t threads, WantedFields wanted)
      : file_(file),
        extent_(extent),
        wanted_(wanted),
        record_length_(extent.record.record_length()),
        batch_points_(std::clamp<std::size_t>(kBatchBytes / record_length_, 1, kPointsOfBatch)),
        table_(std::move(places.table)),
        tail_end_(places.tail_end),
        next_begin_(places.begin),
        ring_(2 * threads) {
    for (std::size_t i = 0; i < threads; ++i) {
      try {
        threads_.emplace_back([this] { Work(); });
      } catch (const std::exception&) {  // The system has no more threads; those that exist do the work.
        break;
      }
    }
  }
  ~Impl() { ring_.Close(); }

  bool has_threads() const { return !threads_.empty(); }

  absl::Status Read(std::span<char> records) {
    while (!records.empty() && status_.ok()) {
      BatchRing::Batch& batch = ring_.Next();
      status_ = batch.status;
      if (!status_.ok()) break;
      const std::size_t size = std::min(records.size(), batch.records.size() - read_);
      std::memcpy(records.data(), batch.records.data() + read_, size);
      records = records.subspan(size);
      read_ += size;
      if (read_ < batch.records.size()) break;
      read_ = 0;
      ring_.Release();
    }
    if (!status_.ok()) ring_.Close();
    return status_;
  }

  absl::StatusOr<std::string> ReadChunk(std::uint64_t first, std::uint64_t count) const {
    const std::uint64_t size = extent_.record.chunk_size, number = first / std::max<std::uint64_t>(size, 1);
    if (!table_.has_value() || size == kVariableChunks || number >= table_->chunks.size()) return "";
    const Chunk& chunk = table_->chunks[number];
    if (number * size != first || chunk.points != count) return "";
    std::string bytes(chunk.bytes, '\0');
    RETURN_IF_ERROR(file_.ReadAt(chunk.offset, std::span(bytes)));
    return bytes;
  }

  std::uint64_t end() const {
    if (table_.has_value()) return table_->end;
    const std::lock_guard lock(mutex_);
    return next_begin_;
  }
  std::uint64_t tail_end() const { return std::max(end(), tail_end_); }

 private:
  void Work() {
    std::unique_ptr<ChunkDecoder> decoder;
    while (const std::optional<ChunkTask> task = NextChunk())
      if (!Decode(*task, decoder)) return;
  }

  std::optional<ChunkTask> NextChunk() {
    const std::lock_guard lock(mutex_);
    if (failed_ || begun_points_ == extent_.point_count) return std::nullopt;
    ChunkTask task;
    task.chunk = table_.has_value() ? table_->chunks[begun_chunks_] : NextWithoutTable();
    task.number = ++begun_chunks_;
    task.first_batch = begun_batches_;
    begun_points_ += task.chunk.points;
    begun_batches_ += (task.chunk.points + batch_points_ - 1) / batch_points_;
    return task;
  }

  Chunk NextWithoutTable() const {
    const std::uint64_t left = extent_.point_count - begun_points_;
    const bool in_one = extent_.record.compressor == Compressor::kPointwise;
    return {.offset = next_begin_,
            .bytes = extent_.points_end - next_begin_,
            .points = in_one ? left : std::min<std::uint64_t>(left, extent_.record.chunk_size)};
  }

  // False: the end of this thread.
  bool Decode(const ChunkTask& task, std::unique_ptr<ChunkDecoder>& decoder) {
    const Chunk& chunk = task.chunk;
    absl::Status status = WithMemory([&] {
      if (decoder == nullptr) decoder = ChunkDecoder::For(extent_.record, wanted_);
      return decoder->Begin(file_, chunk.offset, chunk.offset + chunk.bytes, chunk.points);
    });
    std::uint64_t left = chunk.points;
    for (std::uint64_t number = task.first_batch; left > 0; ++number) {
      BatchRing::Batch* const batch = ring_.Wait(number);
      if (batch == nullptr) return false;
      const std::size_t points = std::min<std::uint64_t>(batch_points_, left);
      left -= points;
      if (status.ok()) {
        status = WithMemory([&] {
          batch->records.resize(points * record_length_);
          return decoder->Decode(batch->records);
        });
      }
      if (status.ok() && left == 0) status = decoder->End(table_.has_value());
      batch->status = InChunk(task.number, status);
      // Before the batch is filled, because after the last point End() may be called at once.
      if (!status.ok()) Fail();
      if (status.ok() && left == 0 && !table_.has_value()) batch->status = EndWithoutTable(decoder->position());
      ring_.Fill(number);
      if (!status.ok()) return false;
    }
    return true;
  }

  // Points that do not fit into the memory end the reading, as damage does.
  template <typename Step>
  static absl::Status WithMemory(const Step& step) {
    try {
      return step();
    } catch (const std::bad_alloc&) {
      return absl::ResourceExhaustedError("the memory is too small for its points; end other programs");
    }
  }

  absl::Status InChunk(std::uint64_t number, const absl::Status& status) const {
    if (status.ok()) return status;
    const std::string of = table_.has_value() ? absl::StrCat(" of ", table_->chunks.size()) : "";
    return absl::Status(status.code(), absl::StrCat("chunk ", number, of, ": ", status.message()));
  }

  void Fail() {
    const std::lock_guard lock(mutex_);
    failed_ = true;
  }

  absl::Status EndWithoutTable(std::uint64_t end) {
    const std::lock_guard lock(mutex_);
    next_begin_ = end;
    return begun_points_ == extent_.point_count ? CheckAllCounted(file_, extent_, end) : absl::OkStatus();
  }

  const ByteSource& file_;
  const LazExtent extent_;
  const WantedFields wanted_;
  const std::size_t record_length_, batch_points_;
  const std::optional<ChunkTable> table_;
  const std::uint64_t tail_end_;

  absl::Status status_;   // Of the reader.
  std::size_t read_ = 0;  // Bytes of the next batch that were read.

  mutable std::mutex mutex_;
  std::uint64_t begun_chunks_ = 0, begun_points_ = 0, begun_batches_ = 0;
  std::uint64_t next_begin_;  // Of the next chunk, where there is no table.
  bool failed_ = false;

  BatchRing ring_;
  std::vector<std::jthread> threads_;  // Ends first.
};

namespace {

std::size_t ThreadCount(int wanted, const std::optional<ChunkTable>& table, const LazExtent& extent) {
  if (extent.point_count == 0) return 0;
  if (!table.has_value()) return 1;
  const std::size_t most = wanted > 0 ? static_cast<std::size_t>(wanted)
                                      : std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMaxThreads);
  const std::size_t max_in_memory = std::max<std::size_t>(kMaxRecordBytes / extent.record.record_length(), 1);
  return std::min({most, max_in_memory, table->chunks.size()});
}

}  // namespace

LazPoints::LazPoints(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LazPoints::~LazPoints() = default;

absl::StatusOr<std::unique_ptr<LazPoints>> LazPoints::Open(const ByteSource& file, const LazExtent& extent, int threads,
                                                           WantedFields wanted) {
  ASSIGN_OR_RETURN(ChunkPlaces places, PlacesOf(file, extent));
  if (!places.table.has_value() && extent.point_count == 0)
    RETURN_IF_ERROR(CheckAllCounted(file, extent, places.begin));
  const std::size_t count = ThreadCount(threads, places.table, extent);
  auto impl = std::make_unique<Impl>(file, extent, std::move(places), count, wanted);
  if (count > 0 && !impl->has_threads())
    return absl::ResourceExhaustedError("the system has no more threads; end other programs");
  return std::unique_ptr<LazPoints>(new LazPoints(std::move(impl)));
}

absl::StatusOr<std::string> LazPoints::First(const ByteSource& file, const LazExtent& extent) {
  ASSIGN_OR_RETURN(const ChunkPlaces places, PlacesOf(file, extent));
  const std::uint64_t begin = places.table.has_value() ? places.table->chunks.front().offset : places.begin;
  std::string record(extent.record.record_length(), '\0');
  if (extent.points_end - begin < record.size())
    return Damaged("its points have ", extent.points_end - begin, " bytes (expected at least ", record.size(), ")");
  RETURN_IF_ERROR(file.ReadAt(begin, std::span(record)));
  return record;
}

absl::Status LazPoints::Read(std::span<char> records) { return impl_->Read(records); }
absl::StatusOr<std::string> LazPoints::ReadChunk(std::uint64_t first, std::uint64_t count) const {
  return impl_->ReadChunk(first, count);
}
std::uint64_t LazPoints::end() const { return impl_->end(); }
std::uint64_t LazPoints::tail_end() const { return impl_->tail_end(); }

}  // namespace albtpu::laz
