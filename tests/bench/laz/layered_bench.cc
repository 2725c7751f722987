// Chunks of formats 6 to 10 on one core: points of a simulated flight, with random numbers where it has none, encoded
// and decoded. `items_per_second` are points.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "survey/laz/coding/byte_source.h"
#include "survey/laz/coding/little_endian.h"
#include "survey/laz/items/chunk_decoder.h"
#include "survey/laz/items/chunk_encoder.h"
#include "survey/laz/items/laszip_record.h"
#include "survey/laz/items/layers/point14_fields.h"
#include "tests/survey/flights/survey.h"
#include "tests/survey/flights/survey_files.h"
#include "tests/survey/las/las_builder.h"

namespace albtpu::laz {
namespace {

constexpr std::size_t kChunks = 8;

const albtpu::testing::SimulatedSurvey& Flight() {
  static const albtpu::testing::SimulatedSurvey flight = [] {
    albtpu::testing::SurveyOptions options;
    options.pulse_rate = 30000;
    options.seconds = 10;
    options.wave_height = 0.3;
    options.range_noise = 0.02;
    return albtpu::testing::Simulate(options);
  }();
  return flight;
}

// Records of a flight, cut into chunks. The simulator leaves intensities and colours 0: here they are random walks.
// Extra bytes are floats, as of uncertainties.
std::vector<std::string> FlightChunks(int format, std::size_t extra_bytes) {
  std::vector<std::size_t> all(Flight().returns.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  albtpu::testing::PointOptions points;
  points.version_minor = 4;
  points.point_format = format;
  const std::string las = albtpu::testing::BuildLas(albtpu::testing::PointsOf(Flight(), all, points));
  const auto begin = Load<std::uint32_t>(las, 96);
  const std::size_t plain = Load<std::uint16_t>(las, 105);
  const std::size_t count = std::min<std::size_t>(all.size(), kChunks * kCommonChunkSize);

  std::mt19937 bits(1);
  std::normal_distribution<double> normal;
  std::array<double, 5> walk{500, 20000, 24000, 18000, 30000};
  std::vector<std::string> chunks;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kCommonChunkSize == 0) chunks.emplace_back();
    std::string record = las.substr(begin + i * plain, plain) + std::string(extra_bytes, '\0');
    for (double& value : walk) value = std::clamp(value + 150 * normal(bits), 0.0, 65535.0);
    Store(static_cast<std::uint16_t>(walk[0] + 30 * std::abs(normal(bits))), &record[kIntensityOffset]);
    for (std::size_t c = 0; kPoint14Size + 2 * c < plain; ++c) {
      Store(static_cast<std::uint16_t>(walk[1 + c]), &record[kPoint14Size + 2 * c]);
    }
    for (std::size_t e = 0; e + sizeof(float) <= extra_bytes; e += sizeof(float)) {
      Store(static_cast<float>(0.1 + 0.002 * normal(bits) + 1e-6 * walk[1]), &record[plain + e]);
    }
    chunks.back() += record;
  }
  return chunks;
}

LaszipRecord RecordOf(int format, std::size_t extra_bytes) {
  return RecordFor(format, albtpu::testing::PointSize(format) + extra_bytes, kCommonChunkSize);
}

void Encode(benchmark::State& state) {
  const int format = static_cast<int>(state.range(0));
  const auto extra_bytes = static_cast<std::size_t>(state.range(1));
  const std::vector<std::string> chunks = FlightChunks(format, extra_bytes);
  const LaszipRecord record = RecordOf(format, extra_bytes);
  const auto encoder = ChunkEncoder::For(record);
  std::string encoded;
  std::size_t next = 0, points = 0, bytes = 0;
  for (auto _ : state) {
    encoder->Encode(chunks[next], encoded);
    benchmark::DoNotOptimize(encoded.data());
    points += chunks[next].size() / record.record_length();
    bytes += encoded.size();
    next = (next + 1) % chunks.size();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(points));
  state.counters["bytes/point"] = static_cast<double>(bytes) / static_cast<double>(points);
}

void Decode(benchmark::State& state) {
  const int format = static_cast<int>(state.range(0));
  const auto extra_bytes = static_cast<std::size_t>(state.range(1));
  const std::vector<std::string> chunks = FlightChunks(format, extra_bytes);
  const LaszipRecord record = RecordOf(format, extra_bytes);
  std::vector<std::string> encoded(chunks.size());
  for (std::size_t i = 0; i < chunks.size(); ++i) ChunkEncoder::For(record)->Encode(chunks[i], encoded[i]);
  const auto decoder = ChunkDecoder::For(record);
  std::vector<char> records(chunks[0].size());
  std::size_t next = 0, points = 0;
  for (auto _ : state) {
    const MemorySource source(encoded[next]);
    const std::size_t count = chunks[next].size() / record.record_length();
    absl::Status status = decoder->Begin(source, 0, encoded[next].size(), count);
    if (status.ok()) status = decoder->Decode({records.data(), chunks[next].size()});
    if (status.ok()) status = decoder->End(true);
    if (!status.ok()) state.SkipWithError(std::string(status.message()).c_str());
    points += count;
    next = (next + 1) % chunks.size();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(points));
}

// Point format, extra bytes.
BENCHMARK(Decode)->Args({6, 0})->Args({6, 8})->Args({7, 0})->Args({8, 0})->Unit(benchmark::kMillisecond);
BENCHMARK(Encode)->Args({6, 0})->Args({6, 8})->Args({7, 0})->Args({8, 0})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace albtpu::laz

BENCHMARK_MAIN();
