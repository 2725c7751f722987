// Chunks that other programs wrote, decoded and encoded on one core. `items_per_second` are points. The sample files
// may lie beside the checkout.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "survey/laz/chunk_table.h"
#include "survey/laz/items/chunk_decoder.h"
#include "survey/laz/items/chunk_encoder.h"
#include "tests/survey/laz/laz_bytes.h"
#include "tests/survey/laz/laz_sample.h"

namespace albtpu::laz {
namespace {

struct SampleChunks {
  std::string file;
  LazExtent extent;
  std::vector<Chunk> chunks;

  std::size_t record_length() const { return extent.record.record_length(); }
};

SampleChunks Chunks(const std::string& name) {
  SampleChunks sample{.file = albtpu::testing::SampleBytes(name), .extent = {}, .chunks = {}};
  sample.extent = albtpu::testing::ExtentOf(sample.file).value();
  const LazExtent& extent = sample.extent;
  sample.chunks =
      ReadChunkTable(MemorySource(sample.file), extent.record, extent.points_begin, extent.point_count)
          .value()
          .chunks;
  return sample;
}

absl::Status Decode(ChunkDecoder& decoder, const ByteSource& source, const Chunk& chunk,
                    std::string& records) {
  absl::Status status = decoder.Begin(source, chunk.offset, chunk.offset + chunk.bytes, chunk.points);
  if (status.ok()) status = decoder.Decode(records);
  return status.ok() ? decoder.End(true) : status;
}

void DecodeSample(benchmark::State& state, const std::string& name) {
  const SampleChunks file = Chunks(name);
  const MemorySource source(file.file);
  const auto decoder = ChunkDecoder::For(file.extent.record);
  std::string records;
  for (auto _ : state) {
    for (const Chunk& chunk : file.chunks) {
      records.resize(chunk.points * file.record_length());
      if (!Decode(*decoder, source, chunk, records).ok()) state.SkipWithError("a chunk cannot be decoded");
      benchmark::DoNotOptimize(records.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(file.extent.point_count));
}

void EncodeSample(benchmark::State& state, const std::string& name) {
  const SampleChunks file = Chunks(name);
  const MemorySource source(file.file);
  const auto decoder = ChunkDecoder::For(file.extent.record);
  const auto encoder = ChunkEncoder::For(file.extent.record);
  std::vector<std::string> all;
  for (const Chunk& chunk : file.chunks) {
    all.emplace_back(chunk.points * file.record_length(), '\0');
    if (!Decode(*decoder, source, chunk, all.back()).ok()) state.SkipWithError("a chunk cannot be decoded");
  }
  std::string encoded;
  for (auto _ : state) {
    for (const std::string& records : all) {
      encoder->Encode(records, encoded);
      benchmark::DoNotOptimize(encoded.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(file.extent.point_count));
}

}  // namespace
}  // namespace albtpu::laz

int main(int argc, char** argv) {
  for (const char* name : {"autzen_trim.laz", "plane.laz", "extrabytes.laz", "1815.laz", "point10.las.laz"}) {
    if (albtpu::testing::SampleBytes(name).empty()) continue;
    benchmark::RegisterBenchmark((std::string("decode/") + name).c_str(), albtpu::laz::DecodeSample, name);
    benchmark::RegisterBenchmark((std::string("encode/") + name).c_str(), albtpu::laz::EncodeSample, name);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
