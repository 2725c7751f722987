// Points gathered by place, in a file: however many points a survey has, one square of the map is read at a time.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "quality/surface/surface_point.h"

namespace albtpu::quality {

// A square of the map of kTileCells by kTileCells cells: its first column and row of cells are multiples of that, east
// and north. In the order of rows, then of columns.
struct TilePlace {
  std::int64_t row = 0, column = 0;
  auto operator<=>(const TilePlace&) const = default;
};
inline constexpr int kTileCells = 32;
// A tile also has the points of the cells around it: the plane of a cell takes its neighbours, and what is left out of
// these depends on theirs.
inline constexpr int kTileBorder = 2;

// Writes the points of a survey, or of a part of it, in blocks of one tile each. Their order in the file does not
// matter.
class PointTilesWriter {
 public:
  // `cell` in the units of the map. The file must be new.
  static absl::StatusOr<PointTilesWriter> Create(const std::filesystem::path& path, double cell);

  // Once a block could not be written, points are ignored, and Finish() says why.
  void Add(const SurfacePoint& point);
  absl::Status Finish();

 private:
  static constexpr std::size_t kBlock = 512;               // Points.
  static constexpr std::size_t kMostBuffered = 192 << 20;  // Bytes.

  PointTilesWriter(std::filesystem::path path, double cell) : path_(std::move(path)), cell_(cell) {}
  void AddTo(const TilePlace& tile, const SurfacePoint& point);
  void Write(const TilePlace& tile, std::vector<SurfacePoint>& points);
  void WriteAll();

  struct Hash {
    std::size_t operator()(const TilePlace& tile) const {
      return static_cast<std::size_t>(tile.row) * 0x9E3779B97F4A7C15U ^ static_cast<std::size_t>(tile.column);
    }
  };
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  double cell_;
  std::unique_ptr<std::FILE, Close> file_;
  std::unordered_map<TilePlace, std::vector<SurfacePoint>, Hash> buffers_;
  std::size_t buffered_ = 0;
  absl::Status status_;
};

// ResourceExhausted or DataLoss, by errno.
absl::Status CannotWritePoints(const std::filesystem::path& path);

// Whether it begins as one of a writer.
bool IsPointsFile(std::FILE* file);

// What a writer wrote, and what may follow it.
struct PointsFile {
  std::filesystem::path path;
  std::uint64_t end = 0;                    // Bytes: where the points end; 0: at the end of the file.
  std::vector<std::uint16_t> sources = {};  // In place of source i of its points; empty: as it is.
};

// Reads what one or several writers wrote.
class PointTiles {
 public:
  // DataLoss where a file was cut short or is none of ours.
  static absl::StatusOr<PointTiles> Open(std::vector<PointsFile> files, double cell);

  // With points of their own: in order.
  const std::vector<TilePlace>& tiles() const { return tiles_; }

  // The points of a tile and of its border, in an order that depends on nothing but the points. Thread-safe.
  absl::StatusOr<std::vector<SurfacePoint>> Read(const TilePlace& tile) const;

 private:
  struct Block {
    std::size_t file;
    long offset;
    std::uint32_t points;
  };

  std::vector<PointsFile> files_;
  std::vector<TilePlace> tiles_;
  std::unordered_map<std::uint64_t, std::vector<Block>> blocks_;
};

}  // namespace albtpu::quality
