#include "tests/laz/laz_bytes.h"

#include <algorithm>

#include "laz/coding/arithmetic_decoder.h"
#include "laz/coding/little_endian.h"
#include "tests/laz/laz_builder.h"

namespace albtpu::testing {
namespace {

using laz::Load;

template <typename Number>
void Put(std::string& bytes, std::size_t offset, Number number) {
  laz::Store(number, bytes.data() + offset);
}

// Where the specification has the fields of the header.
constexpr std::size_t kVersionMinor = 25, kHeaderSize = 94, kOffsetToPoints = 96, kVlrCount = 100, kPointFormat = 104,
                      kRecordLength = 105, kLegacyCount = 107, kWaveforms = 227, kEvlrs = 235, kEvlrCount = 243,
                      kPointCount = 247;
constexpr std::size_t kVlrHeader = 54;

int VersionMinor(std::string_view header) { return Load<std::uint8_t>(header, kVersionMinor); }

bool IsCompressed(std::string_view header) { return Load<std::uint8_t>(header, kPointFormat) & laz::kCompressedFlag; }

// Takes the VLRs over, all but the LASzip record, whose data it gives: empty if there is none.
std::string TakeVlrs(std::string_view file, LasParts& parts) {
  std::string laszip;
  std::size_t at = parts.header.size();
  for (auto left = Load<std::uint32_t>(file, kVlrCount); left > 0; --left) {
    const std::size_t size = kVlrHeader + Load<std::uint16_t>(file, at + 20);
    const std::string_view user = file.substr(at + 2, laz::kLaszipUser.size());
    if (user == laz::kLaszipUser && Load<std::uint16_t>(file, at + 18) == laz::kLaszipRecordId) {
      laszip = file.substr(at + kVlrHeader, size - kVlrHeader);
    } else {
      parts.vlrs += file.substr(at, size);
      ++parts.vlr_count;
    }
    at += size;
  }
  parts.gap = file.substr(at, Load<std::uint32_t>(file, kOffsetToPoints) - at);
  return laszip;
}

absl::StatusOr<laz::LazExtent> Extent(std::string_view file, std::string_view laszip, const LasParts& parts) {
  auto record = laz::ParseLaszipRecord(laszip, parts.point_format(), parts.record_length());
  if (!record.ok()) return record.status();
  const bool has_evlrs = VersionMinor(file) >= 4 && Load<std::uint32_t>(file, kEvlrCount) > 0;
  return laz::LazExtent{.record = *std::move(record),
                        .points_begin = Load<std::uint32_t>(file, kOffsetToPoints),
                        .point_count = parts.point_count(),
                        .points_end = has_evlrs ? Load<std::uint64_t>(file, kEvlrs) : file.size()};
}

// The points of a LAZ file; gives where they end.
absl::StatusOr<std::uint64_t> Decompress(std::string_view file, const laz::LazExtent& extent, int threads,
                                         LasParts& parts) {
  const laz::MemorySource source(file);
  auto points = laz::LazPoints::Open(source, extent, threads);
  if (!points.ok()) return points.status();
  // No test has points that take so little.
  if (extent.point_count / 4096 > file.size()) return absl::DataLossError("too many points for its size");
  parts.points.resize(extent.point_count * parts.record_length());
  const std::size_t step = 12345 * parts.record_length();  // Not the size of a chunk.
  for (std::size_t at = 0; at < parts.points.size(); at += step) {
    const std::size_t size = std::min(step, parts.points.size() - at);
    if (auto status = (*points)->Read({parts.points.data() + at, size}); !status.ok()) return status;
  }
  return (*points)->end();
}

// Offsets into the tail, which begins at `tail_begin`.
void FindInTail(std::uint64_t tail_begin, LasParts& parts) {
  const auto find = [&](std::size_t field) -> std::optional<std::uint64_t> {
    const auto offset = Load<std::uint64_t>(parts.header, field);
    if (offset < tail_begin) return std::nullopt;
    return offset - tail_begin;
  };
  if (VersionMinor(parts.header) >= 3) parts.waveforms = find(kWaveforms);
  if (VersionMinor(parts.header) >= 4 && Load<std::uint32_t>(parts.header, kEvlrCount) > 0) parts.evlrs = find(kEvlrs);
}

// The header and all else before points that begin there.
std::string Head(const LasParts& parts, bool compressed, const std::string& laszip_vlr) {
  std::string header = parts.header;
  const std::size_t begin = header.size() + parts.vlrs.size() + laszip_vlr.size() + parts.gap.size();
  Put(header, kOffsetToPoints, static_cast<std::uint32_t>(begin));
  Put(header, kVlrCount, parts.vlr_count + (compressed ? 1 : 0));
  Put(header, kPointFormat, static_cast<std::uint8_t>(parts.point_format() | (compressed ? laz::kCompressedFlag : 0)));
  return header + parts.vlrs + laszip_vlr + parts.gap;
}

void PlaceTail(const LasParts& parts, std::string& file) {
  if (parts.waveforms) Put(file, kWaveforms, file.size() + *parts.waveforms);
  if (parts.evlrs) Put(file, kEvlrs, file.size() + *parts.evlrs);
  file += parts.tail;
}

std::string LaszipVlr(const laz::LaszipRecord& record) {
  const std::string data = laz::LaszipRecordData(record);
  std::string vlr(kVlrHeader, '\0');
  vlr.replace(2, laz::kLaszipUser.size(), laz::kLaszipUser);
  Put(vlr, 18, laz::kLaszipRecordId);
  Put(vlr, 20, static_cast<std::uint16_t>(data.size()));
  return vlr + data;
}

}  // namespace

int LasParts::point_format() const { return Load<std::uint8_t>(header, kPointFormat) & 0x3F; }

std::size_t LasParts::record_length() const { return Load<std::uint16_t>(header, kRecordLength); }

std::uint64_t LasParts::point_count() const {
  return VersionMinor(header) >= 4 ? Load<std::uint64_t>(header, kPointCount)
                                   : Load<std::uint32_t>(header, kLegacyCount);
}

absl::StatusOr<LasParts> TakeApart(std::string_view file, int threads) {
  LasParts parts;
  parts.header = file.substr(0, Load<std::uint16_t>(file, kHeaderSize));
  const std::string laszip = TakeVlrs(file, parts);
  const auto begin = Load<std::uint32_t>(file, kOffsetToPoints);
  std::uint64_t end = begin + parts.point_count() * parts.record_length();
  if (!IsCompressed(file)) {
    parts.points = file.substr(begin, end - begin);
  } else {
    const auto extent = Extent(file, laszip, parts);
    if (!extent.ok()) return extent.status();
    const auto end_of_points = Decompress(file, *extent, threads, parts);
    if (!end_of_points.ok()) return end_of_points.status();
    end = *end_of_points;
  }
  parts.tail = file.substr(end);
  // The offset of the table at the end of a file that was written to a pipe.
  if (IsCompressed(file) && Load<std::int64_t>(file, begin) == -1 && parts.tail.size() >= 8) {
    const auto table = Load<std::uint64_t>(parts.tail, parts.tail.size() - 8);
    if (begin < table && table < end) parts.tail.resize(parts.tail.size() - 8);
  }
  FindInTail(end, parts);
  return parts;
}

absl::StatusOr<laz::LazExtent> ExtentOf(std::string_view file) {
  LasParts parts;
  parts.header = file.substr(0, Load<std::uint16_t>(file, kHeaderSize));
  const std::string laszip = TakeVlrs(file, parts);
  return Extent(file, laszip, parts);
}

std::vector<std::size_t> ChunkPoints(std::uint64_t count, std::uint32_t chunk_size) {
  constexpr std::size_t kVariable[] = {1000, 1, 7, 60000, 2};
  std::vector<std::size_t> chunks;
  for (std::uint64_t at = 0; at < count; at += chunks.back()) {
    const std::size_t size = chunk_size == laz::kVariableChunks ? kVariable[chunks.size() % 5] : chunk_size;
    chunks.push_back(std::min<std::size_t>(size, count - at));
  }
  return chunks;
}

std::string AsLas(const LasParts& parts) {
  std::string file = Head(parts, false, "") + parts.points;
  PlaceTail(parts, file);
  return file;
}

std::string AsLaz(const LasParts& parts, const LazForm& form) {
  LazParts points = CompressPoints(parts.point_format(), parts.record_length(), parts.points,
                                   ChunkPoints(parts.point_count(), form.chunk_size));
  points.record.chunk_size = form.chunk_size;
  std::string file = Head(parts, true, LaszipVlr(points.record));
  const std::size_t begin = file.size();
  file += PointsSection(points, begin);
  const auto table = Load<std::uint64_t>(file, begin);
  if (form.table == TableForm::kNone) file.resize(table);
  if (form.table != TableForm::kInFront) Put(file, begin, std::int64_t{-1});
  PlaceTail(parts, file);
  if (form.table == TableForm::kAtEnd) {
    file.append(sizeof table, '\0');
    Put(file, file.size() - sizeof table, table);
  }
  return file;
}

LasParts FileOf(const RecordLayout& layout, const std::string& records) {
  LasSpec spec;
  spec.point_format = layout.point_format;
  spec.version_minor = layout.point_format < 4 ? 2 : layout.point_format < 6 ? 3 : 4;
  spec.extra_bytes = layout.extra_bytes;
  spec.points.resize(records.size() / RecordLength(layout));
  spec.vlrs = {{"a test", 7, "something"}, {"laszip encoded", 7, "of the same user"}};
  spec.gap = "gap";
  if (spec.version_minor >= 3) spec.waveform_packet = "waveforms";
  if (spec.version_minor >= 4) spec.evlrs = {{"a test", 8, "something else"}};
  LasParts parts = *TakeApart(BuildLas(spec));
  parts.points = records;
  return parts;
}

std::string BuildLaz(const LasSpec& spec, std::uint32_t chunk_size) {
  return AsLaz(*TakeApart(BuildLas(spec)), {.chunk_size = chunk_size});
}

}  // namespace albtpu::testing
