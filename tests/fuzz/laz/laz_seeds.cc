#include "tests/fuzz/laz/laz_seeds.h"

#include <cstdint>
#include <utility>

#include "formats/laz/coding/little_endian.h"
#include "tests/formats/las/las_builder.h"
#include "tests/formats/laz/laz_bytes.h"
#include "tests/fuzz/laz/chunk_input.h"

namespace albtpu::fuzz {
namespace {

// Points on a line, with a second return here and there.
testing::LasSpec Line(int point_format, std::size_t extra_bytes, int count) {
  testing::LasSpec spec;
  spec.point_format = point_format;
  spec.extra_bytes = extra_bytes;
  for (int i = 0; i < count; ++i) {
    spec.points.push_back({.x = 1000 + 37 * i,
                           .y = -500 + i * i,
                           .z = 20 * (i % 3),
                           .classification = i % 4 == 0 ? 9 : 26,
                           .scan_angle = i - 3.0,
                           .gps_time = 1e5 + 0.001 * (i / 2),
                           .return_number = 1 + i % 2,
                           .return_count = 2,
                           .point_source_id = 7});
  }
  return spec;
}

struct Seed {
  int point_format;
  std::size_t extra_bytes;
  std::size_t count;
  std::string records;
};

std::vector<Seed> Seeds() {
  std::vector<Seed> seeds;
  for (int point_format = 0; point_format <= 10; ++point_format) {
    for (const auto& [extra_bytes, count] : {std::pair<std::size_t, int>(0, 9), {2, 4}, {0, 1}}) {
      const testing::LasSpec spec = Line(point_format, extra_bytes, count);
      const std::string file = testing::BuildLas(spec);
      const std::size_t size = spec.points.size() * (testing::PointSize(point_format) + extra_bytes);
      seeds.push_back({point_format, extra_bytes, spec.points.size(), file.substr(file.size() - size)});
    }
  }
  return seeds;
}

}  // namespace

std::vector<std::string> LazChunkSeeds() {
  std::vector<std::string> chunks;
  for (const Seed& seed : Seeds()) {
    const std::string head = ChunkHead(seed.point_format, seed.extra_bytes, seed.count, 3);
    std::string bytes;
    ParseChunkInput(head).coding->encoder->Encode(seed.records, bytes);
    chunks.push_back(head + bytes);
  }
  return chunks;
}

std::vector<std::string> LazRecordsSeeds() {
  std::vector<std::string> inputs;
  for (const Seed& seed : Seeds())
    inputs.push_back(ChunkHead(seed.point_format, seed.extra_bytes, seed.count, 3) + seed.records);
  return inputs;
}

std::vector<std::string> LazFileSeeds() {
  std::vector<std::string> files;
  for (int point_format = 0; point_format <= 10; ++point_format) {
    testing::LasSpec spec = Line(point_format, point_format % 2 == 0 ? 0 : 2, 7);
    spec.version_minor = point_format >= 6 ? 4 : point_format >= 4 ? 3 : 2;
    if (spec.version_minor == 4) spec.evlrs = {{"someone", 7, "behind"}};
    files.push_back(testing::BuildLaz(spec, 3));
  }
  // As a program writes files to a pipe: the offset of the table last, or no table.
  const std::string file = testing::BuildLaz(Line(6, 0, 7), 3);
  const auto begin = laz::Load<std::uint32_t>(file, 96);
  const std::string offset = file.substr(begin, sizeof(std::uint64_t)), none(sizeof(std::uint64_t), '\xFF');
  std::string piped = file;
  piped.replace(begin, none.size(), none);
  files.push_back(piped + offset);
  files.push_back(piped.substr(0, laz::Load<std::uint64_t>(offset, 0)));
  return files;
}

}  // namespace albtpu::fuzz
