#include "quality/surface/point_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <set>
#include <vector>

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;

class PointTilesTest : public ::testing::Test {
 protected:
  PointTilesTest() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-70, 90);
    for (int i = 0; i < 20'000; ++i)
      points_.push_back({.x = place(random), .y = place(random), .z = -5, .time = 0.001 * i, .pulse = 1e-4F});
  }
  ~PointTilesTest() override { fs::remove_all(folder_); }

  fs::path Write(const std::string& name, std::size_t begin, std::size_t end, double cell) {
    fs::path path = folder_ / name;
    absl::StatusOr<PointTilesWriter> writer = PointTilesWriter::Create(path, cell);
    EXPECT_TRUE(writer.ok()) << writer.status();
    for (std::size_t i = begin; i < end; ++i) writer->Add(points_[i]);
    EXPECT_TRUE(writer->Finish().ok());
    return path;
  }

  fs::path folder_ = fs::temp_directory_path() / "albtpu_point_tiles_test";
  std::vector<SurfacePoint> points_;

  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directory(folder_);
  }
};

TEST_F(PointTilesTest, HaveThePointsOfTheirPlaceAndOfTheBorder) {
  constexpr double kCell = 1;
  const absl::StatusOr<PointTiles> tiles = PointTiles::Open({{Write("all", 0, points_.size(), kCell)}}, kCell);
  ASSERT_TRUE(tiles.ok()) << tiles.status();
  EXPECT_EQ(tiles->tiles().size(), 36U);  // From -96 to 96.
  std::size_t own = 0;
  for (const TilePlace& tile : tiles->tiles()) {
    const double west = static_cast<double>(tile.column * kTileCells),
                 south = static_cast<double>(tile.row * kTileCells);
    const auto within = [&](const SurfacePoint& p, double border) {
      return p.x >= west - border && p.x < west + kTileCells + border && p.y >= south - border &&
             p.y < south + kTileCells + border;
    };
    const absl::StatusOr<std::vector<SurfacePoint>> read = tiles->Read(tile);
    ASSERT_TRUE(read.ok()) << read.status();
    const auto expected = std::ranges::count_if(points_, [&](const auto& p) { return within(p, kTileBorder); });
    EXPECT_EQ(read->size(), static_cast<std::size_t>(expected));
    own += static_cast<std::size_t>(std::ranges::count_if(*read, [&](const auto& p) { return within(p, 0); }));
  }
  EXPECT_EQ(own, points_.size());
}

TEST_F(PointTilesTest, AreTheSameFromPartsInAnyOrder) {
  constexpr double kCell = 0.5;
  const fs::path whole = Write("whole", 0, points_.size(), kCell);
  const fs::path first = Write("first", 0, 7000, kCell), second = Write("second", 7000, points_.size(), kCell);
  const absl::StatusOr<PointTiles> one = PointTiles::Open({{whole}}, kCell);
  const absl::StatusOr<PointTiles> two = PointTiles::Open({{second}, {first}}, kCell);
  ASSERT_TRUE(one.ok() && two.ok());
  ASSERT_EQ(one->tiles(), two->tiles());
  for (const TilePlace& tile : one->tiles()) {
    const auto a = one->Read(tile), b = two->Read(tile);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_TRUE(std::ranges::equal(*a, *b, {}, &SurfacePoint::Order, &SurfacePoint::Order));
  }
}

TEST_F(PointTilesTest, CutShortAreNotRead) {
  const fs::path path = Write("cut", 0, 5000, 1);
  fs::resize_file(path, fs::file_size(path) - 10);
  EXPECT_EQ(PointTiles::Open({{path}}, 1).status().code(), absl::StatusCode::kDataLoss);
}

TEST_F(PointTilesTest, NeedOneSizeOfCells) {
  const fs::path path = Write("one", 0, 5000, 1);
  const absl::Status status = PointTiles::Open({{path}}, 2).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(status.message().find("cells of 1, not of 2"), std::string_view::npos) << status;
}

}  // namespace
}  // namespace albtpu::quality
