// The layers of extra bytes that are encoded together are those that a plain encoder gives, one after the other.
#include "laz/items/extra_bytes_encoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "laz/items/extra_bytes_layers.h"
#include "tests/instruction_sets.h"

namespace albtpu::laz {
namespace {

using albtpu::testing::OnInstructionSet;

constexpr std::size_t kOffset = 30;

// What a byte is at a point. Some never change; those that always fall are coded by the last symbol, whose codes are
// long runs of 0xFF, and now and then a carry goes through them.
class ByteSeries {
 public:
  ByteSeries(std::size_t kind, std::uint64_t seed) : kind_(kind % 7), random_(seed) {}

  char Next(std::size_t point) {
    switch (kind_) {
      case 0:
        return 'c';
      case 1:
        return static_cast<char>(random_());
      case 2:
        return static_cast<char>(value_ -= 1);
      case 3:
        return static_cast<char>(value_ -= random_() % 300 == 0 ? 2 : 1);
      case 4:
        return static_cast<char>(random_() % 50 == 0);
      case 5:
        return static_cast<char>(value_ += static_cast<std::uint8_t>(random_() % 3));
      default:
        return static_cast<char>(point < 900 ? 7 : random_() % 20);
    }
  }

 private:
  std::size_t kind_;
  std::mt19937_64 random_;
  std::uint8_t value_ = 0;
};

struct Records {
  std::size_t length, count;
  std::string bytes;
};

Records MakeRecords(std::size_t extra_bytes, std::size_t count, std::uint64_t seed) {
  Records records{kOffset + extra_bytes, count, std::string((kOffset + extra_bytes) * count, '\0')};
  for (std::size_t b = 0; b < extra_bytes; ++b) {
    ByteSeries series(b * 5 + seed, seed + b);
    for (std::size_t i = 0; i < count; ++i) records.bytes[i * records.length + kOffset + b] = series.Next(i);
  }
  return records;
}

// Of channels that change every `stay` points. With `falls_back`, as items of version 3 do.
void MakeRuns(std::size_t first, std::size_t count, std::size_t stay, bool falls_back, ChannelRuns& runs) {
  runs.Clear();
  for (std::size_t i = 0; i < count; ++i) {
    const auto channel = [&](std::size_t point) { return point / stay % kChannels; };
    const std::size_t point = first + i, from = point == 0 ? 0 : channel(point - 1);
    runs.Add(i, channel(point), from, falls_back ? from : channel(point));
  }
}

// The layers of a chunk; empty where there is none.
std::vector<std::string> Encode(Layers<ArithmeticEncoder>& layers, const Records& records, std::size_t stay,
                                bool falls_back) {
  std::vector<LayerStream<ArithmeticEncoder>> streams(layers.streams());
  const RecordRun<ArithmeticEncoder> further(records.bytes.data() + records.length, records.length, records.count - 1);
  layers.Begin(records.bytes.data());
  layers.FindChanges(streams, further);
  for (auto& stream : streams) stream.coder.Begin();
  const auto contexts = std::make_unique<PointContexts>();
  for (std::size_t i = 0; i < further.count(); i += kBatchPoints) {
    const std::size_t count = std::min(kBatchPoints, further.count() - i);
    MakeRuns(i, count, stay, falls_back, contexts->version3_runs);
    layers.Code(streams, {further[i], records.length, count}, *contexts);
  }
  std::vector<std::string> encoded;
  for (auto& stream : streams) encoded.push_back(stream.present ? stream.coder.Finish() : "");
  return encoded;
}

using ExtraBytesLanes = OnInstructionSet;
ALBTPU_ON_EACH_INSTRUCTION_SET(ExtraBytesLanes);

TEST_P(ExtraBytesLanes, GiveTheBytesOfAPlainEncoder) {
  for (const std::size_t extra_bytes : {1, 2, 7, 8, 9, 16, 23, 61, 115}) {
    const ItemPlace place = {.offset = kOffset, .version3 = true};
    ExtraBytesEncoder encoder(place, extra_bytes);  // Of chunk after chunk, in which other bytes change.
    for (const std::size_t count : {2, 100, 513, 5000, 50000}) {
      const std::size_t stay = count == 5000 ? 1 : count == 513 ? 100 : 1u << 20;
      const Records records = MakeRecords(extra_bytes, count, count % 11);
      ExtraBytesLayers<ArithmeticEncoder> plain(place, extra_bytes);
      const bool falls_back = extra_bytes % 2 == 1;
      EXPECT_EQ(Encode(encoder, records, stay, falls_back), Encode(plain, records, stay, falls_back))
          << extra_bytes << " extra bytes of " << count << " points";
    }
  }
}

TEST(ExtraBytesEncoder, LeavesOutLayersThatNeverChange) {
  Records records = MakeRecords(20, 3000, 0);
  for (std::size_t i = 0; i < records.count; ++i) records.bytes.replace(i * records.length + kOffset, 20, 20, 'x');
  ExtraBytesEncoder encoder({.offset = kOffset}, 20);
  for (const std::string& layer : Encode(encoder, records, 1000000, false)) EXPECT_EQ(layer, "");
  records.bytes.back() = 'y';
  const std::vector<std::string> encoded = Encode(encoder, records, 1000000, false);
  for (std::size_t b = 0; b < 20; ++b) EXPECT_EQ(encoded[b].empty(), b < 19) << b;
}

}  // namespace
}  // namespace albtpu::laz
