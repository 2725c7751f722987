// Decodes the points of a LAZ file and encodes them again, RUNS times, through one thread and through two.
//
// Usage: albtpu_laz_rate IN.laz RUNS
// Prints JSON: points, and seconds of each run. "decode" and "encode" are processor time of one thread, "decode_two"
// and "encode_two" elapsed time of two.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "laz/items/point_encoders.h"
#include "laz/laz_points.h"
#include "tests/laz/laz_bytes.h"

namespace albtpu::bench {
namespace {

double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double ElapsedSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool Decode(const laz::ByteSource& file, const laz::LazExtent& extent, int threads, std::span<char> records) {
  const auto points = laz::LazPoints::Open(file, extent, threads);
  if (!points.ok()) return false;
  const std::size_t step = 50000 * extent.record.record_length();
  for (std::size_t at = 0; at < records.size(); at += step)
    if (!(*points)->Read(records.subspan(at, std::min(step, records.size() - at))).ok()) return false;
  return true;
}

// The bytes of all chunks.
std::size_t Encode(const laz::LaszipRecord& record, int threads, std::string_view records) {
  const std::size_t step = laz::kCommonChunkSize * record.record_length();
  std::atomic<std::size_t> next = 0, bytes = 0;
  const auto work = [&] {
    const auto encoder = laz::ChunkEncoder::For(record);
    std::string chunk;
    for (std::size_t at; (at = next.fetch_add(step)) < records.size(); bytes += chunk.size())
      encoder->Encode(records.substr(at, step), chunk, {});
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  others.clear();
  return bytes;
}

int Run(const char* path, int runs) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const laz::MemorySource file(bytes);
  const auto extent = testing::ExtentOf(bytes);
  if (!extent.ok()) {
    std::fprintf(stderr, "%s: %s\n", path, extent.status().ToString().c_str());
    return 1;
  }
  std::vector<char> records(extent->point_count * extent->record.record_length());
  const std::string_view view(records.data(), records.size());
  nlohmann::ordered_json json;
  json["points"] = extent->point_count;
  for (int i = 0; i < runs; ++i) {
    double begin = ProcessorSeconds();
    if (!Decode(file, *extent, 1, records)) return 1;
    json["decode"].push_back(ProcessorSeconds() - begin);
    begin = ProcessorSeconds();
    json["bytes"] = Encode(extent->record, 1, view);
    json["encode"].push_back(ProcessorSeconds() - begin);
    begin = ElapsedSeconds();
    Decode(file, *extent, 2, records);
    json["decode_two"].push_back(ElapsedSeconds() - begin);
    begin = ElapsedSeconds();
    Encode(extent->record, 2, view);
    json["encode_two"].push_back(ElapsedSeconds() - begin);
  }
  std::puts(json.dump().c_str());
  return 0;
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: albtpu_laz_rate IN.laz RUNS\n", stderr);
    return 2;
  }
  return albtpu::bench::Run(argv[1], std::atoi(argv[2]));
}
