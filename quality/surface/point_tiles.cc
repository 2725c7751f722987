#include "quality/surface/point_tiles.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "absl/strings/str_cat.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic = {'a', 'l', 'b', 't', 'p', 'u', 'P', '1'};
constexpr double kGreatestCell = 1e9;  // Of a column or row.

struct Head {
  std::array<char, 8> magic = kMagic;
  double cell = 0;
};
struct BlockHead {
  std::int64_t row = 0, column = 0;
  std::uint32_t points = 0, own = 0;  // All, and those of the tile itself.
};

absl::Status CutShort(const fs::path& path) {
  return absl::DataLossError(absl::StrCat(path.string(), ": was cut short or changed; make it again"));
}

// Floor of cell / kTileCells.
std::int64_t TileIndex(std::int64_t cell) {
  return cell >= 0 ? cell / kTileCells : -((-cell + kTileCells - 1) / kTileCells);
}

bool IsOwn(const SurfacePoint& point, const TilePlace& tile, double cell) {
  return TileIndex(static_cast<std::int64_t>(std::floor(point.x / cell))) == tile.column &&
         TileIndex(static_cast<std::int64_t>(std::floor(point.y / cell))) == tile.row;
}

// By SurfacePoint::Order, of which lines and times tell nearly all points apart: points are large to be moved about.
std::vector<SurfacePoint> Sorted(const std::vector<SurfacePoint>& points) {
  struct Key {
    double time;
    std::uint32_t flight_line, at;
  };
  std::vector<Key> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keys[i] = {points[i].time, points[i].flight_line, static_cast<std::uint32_t>(i)};
  std::ranges::sort(keys, [&](const Key& a, const Key& b) {
    if (a.flight_line != b.flight_line) return a.flight_line < b.flight_line;
    if (a.time != b.time) return a.time < b.time;
    return points[a.at].Order() < points[b.at].Order();
  });
  std::vector<SurfacePoint> sorted;
  sorted.reserve(points.size());
  for (const Key& key : keys) sorted.push_back(points[key.at]);
  return sorted;
}

std::uint64_t KeyOf(const TilePlace& tile) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(tile.row)) << 32 |
         static_cast<std::uint32_t>(tile.column);
}

}  // namespace

absl::Status CannotWritePoints(const fs::path& path) {
  const int error = errno;
  const std::string message = absl::StrCat(path.string(), ": cannot be written (", std::strerror(error),
                                           "); points of a survey take 100 bytes each there while its surface is made");
  return error == ENOSPC || error == EDQUOT ? absl::ResourceExhaustedError(message) : absl::DataLossError(message);
}

bool IsPointsFile(std::FILE* file) {
  Head head;
  return std::fread(&head, sizeof(head), 1, file) == 1 && head.magic == kMagic;
}

absl::StatusOr<PointTilesWriter> PointTilesWriter::Create(const fs::path& path, double cell) {
  PointTilesWriter writer(path, cell);
  writer.file_.reset(std::fopen(path.c_str(), "wbx"));
  const Head head = {.cell = cell};
  if (writer.file_ == nullptr || std::fwrite(&head, sizeof(head), 1, writer.file_.get()) != 1)
    return CannotWritePoints(path);
  return writer;
}

void PointTilesWriter::Add(const SurfacePoint& point) {
  if (!status_.ok()) return;
  const double x = std::floor(point.x / cell_), y = std::floor(point.y / cell_);
  if (!(std::abs(x) < kGreatestCell && std::abs(y) < kGreatestCell)) {
    status_ = absl::InvalidArgumentError(
        absl::StrCat("a point lies at ", point.x, ", ", point.y, ", too far for cells of ", cell_));
    return;
  }
  const auto column = static_cast<std::int64_t>(x), row = static_cast<std::int64_t>(y);
  for (std::int64_t r = TileIndex(row - kTileBorder); r <= TileIndex(row + kTileBorder); ++r)
    for (std::int64_t c = TileIndex(column - kTileBorder); c <= TileIndex(column + kTileBorder); ++c)
      AddTo({.row = r, .column = c}, point);
}

void PointTilesWriter::AddTo(const TilePlace& tile, const SurfacePoint& point) {
  std::vector<SurfacePoint>& points = buffers_[tile];
  if (points.capacity() == 0) {
    points.reserve(kBlock);
    buffered_ += kBlock * sizeof(SurfacePoint);
  }
  points.push_back(point);
  if (points.size() == kBlock) Write(tile, points);
  if (buffered_ > kMostBuffered) WriteAll();
}

void PointTilesWriter::Write(const TilePlace& tile, std::vector<SurfacePoint>& points) {
  if (!status_.ok() || points.empty()) return;
  const auto own = std::ranges::count_if(points, [&](const SurfacePoint& point) { return IsOwn(point, tile, cell_); });
  const BlockHead head = {.row = tile.row,
                          .column = tile.column,
                          .points = static_cast<std::uint32_t>(points.size()),
                          .own = static_cast<std::uint32_t>(own)};
  if (std::fwrite(&head, sizeof(head), 1, file_.get()) != 1 ||
      std::fwrite(points.data(), sizeof(SurfacePoint), points.size(), file_.get()) != points.size())
    status_ = CannotWritePoints(path_);
  points.clear();
}

void PointTilesWriter::WriteAll() {
  for (auto& [tile, points] : buffers_) Write(tile, points);
  buffers_.clear();
  buffered_ = 0;
}

absl::Status PointTilesWriter::Finish() {
  WriteAll();
  if (status_.ok() && std::fclose(file_.release()) != 0) status_ = CannotWritePoints(path_);
  return status_;
}

absl::StatusOr<PointTiles> PointTiles::Open(std::vector<PointsFile> files, double cell) {
  PointTiles tiles;
  tiles.files_ = std::move(files);
  std::map<TilePlace, bool> has_own;
  for (std::size_t i = 0; i < tiles.files_.size(); ++i) {
    const fs::path& path = tiles.files_[i].path;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (file == nullptr)
      return absl::NotFoundError(absl::StrCat(path.string(), ": cannot be read (", std::strerror(errno), ")"));
    Head head;
    if (std::fread(&head, sizeof(head), 1, file.get()) != 1 || head.magic != kMagic)
      return absl::DataLossError(absl::StrCat(path.string(), ": is no part of a surface"));
    if (head.cell != cell)
      return absl::InvalidArgumentError(absl::StrCat(path.string(), ": has cells of ", head.cell, ", not of ", cell,
                                                     "; all parts need the same --cell"));
    const auto end = static_cast<long>(tiles.files_[i].end != 0 ? tiles.files_[i].end : fs::file_size(path));
    long at = sizeof(head);
    while (at < end) {
      BlockHead block;
      if (std::fseek(file.get(), at, SEEK_SET) != 0 || std::fread(&block, sizeof(block), 1, file.get()) != 1)
        return CutShort(path);
      at += static_cast<long>(sizeof(block));
      const TilePlace tile = {.row = block.row, .column = block.column};
      tiles.blocks_[KeyOf(tile)].push_back({.file = i, .offset = at, .points = block.points});
      has_own[tile] |= block.own > 0;
      at += static_cast<long>(block.points * sizeof(SurfacePoint));
    }
    if (at != end) return CutShort(path);
  }
  for (const auto& [tile, own] : has_own)
    if (own) tiles.tiles_.push_back(tile);
  return tiles;
}

absl::StatusOr<std::vector<SurfacePoint>> PointTiles::Read(const TilePlace& tile) const {
  std::vector<SurfacePoint> points;
  const auto found = blocks_.find(KeyOf(tile));
  if (found == blocks_.end()) return points;
  std::size_t count = 0;
  for (const Block& block : found->second) count += block.points;
  points.reserve(count);
  std::size_t open = files_.size();
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(nullptr, &std::fclose);
  for (const Block& block : found->second) {
    const auto& [path, end, sources] = files_[block.file];
    if (block.file != open) {
      file.reset(std::fopen(path.c_str(), "rb"));
      if (file != nullptr) std::setvbuf(file.get(), nullptr, _IONBF, 0);  // Blocks are read whole.
    }
    open = block.file;
    const std::size_t before = points.size();
    points.resize(before + block.points);
    if (file == nullptr || std::fseek(file.get(), block.offset, SEEK_SET) != 0 ||
        std::fread(&points[before], sizeof(SurfacePoint), block.points, file.get()) != block.points)
      return CutShort(path);
    if (sources.empty()) continue;
    for (std::size_t i = before; i < points.size(); ++i) {
      if (points[i].source >= sources.size()) return CutShort(path);
      points[i].source = sources[points[i].source];
    }
  }
  return Sorted(points);
}

}  // namespace albtpu::quality
