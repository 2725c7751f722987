#include "laz/items/extra_bytes_encoder.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace albtpu::laz {

void ExtraBytesEncoder::Begin(const char* first_point) {
  first_point_.assign(first_point, place_.offset + bytes_);
  group_count_ = 0;
  for (ArithmeticEncoder& encoder : idle_) encoder.Begin();
}

void ExtraBytesEncoder::MakeGroups(Streams streams) {
  Group* group = nullptr;
  for (std::size_t b = 0; b < bytes_; ++b) {
    if (!streams[b].present) continue;
    const std::size_t offset = place_.offset + b;
    if (group == nullptr || group->count == kByteLanes || offset >= group->window.offset + LaneWindow::kSize) {
      if (group_count_ == groups_.size()) groups_.push_back(std::make_unique<Group>());
      group = groups_[group_count_++].get();
      group->window = {.offset = std::min(offset, first_point_.size() - LaneWindow::kSize)};
      group->count = 0;
      for (auto& last : group->last) std::memcpy(last.data(), &first_point_[group->window.offset], last.size());
      group->models.ForgetAll([](ByteLaneModels& models) { models.Forget(); });
    }
    group->window.places[group->count] = static_cast<std::uint8_t>(offset - group->window.offset);
    group->streams[group->count++] = b;
  }
}

void ExtraBytesEncoder::Code(Streams streams, const RecordRun<ArithmeticEncoder>& points,
                             const PointContexts& contexts) {
  if (group_count_ == 0) MakeGroups(streams);
  for (std::size_t g = 0; g < group_count_; ++g) CodeGroup(*groups_[g], streams, points, place_.Runs(contexts));
}

void ExtraBytesEncoder::CodeGroup(Group& group, Streams streams, const RecordRun<ArithmeticEncoder>& points,
                                  const ChannelRuns& runs) {
  std::array<ArithmeticEncoder*, kByteLanes> encoders;
  for (std::size_t l = 0; l < kByteLanes; ++l)
    encoders[l] = l < group.count ? &streams[group.streams[l]].coder : &idle_[l];
  for (const ChannelRun& run : runs) {
    ByteLaneModels& models = group.models[run.models];
    std::array<char, LaneWindow::kSize> before = group.last[run.from];
    for (std::size_t i = run.begin; i < run.end;) {
      models.Prepare();
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(run.end - i, models.until_update()));
      EncodeByteLanes(group.window, {points[i], points.record_length(), count, before.data()}, models, encoders);
      i += count;
      std::memcpy(before.data(), points[i - 1] + group.window.offset, before.size());
    }
    group.last[run.to] = before;
  }
}

void ExtraBytesEncoder::FindChanges(Streams streams, const RecordRun<ArithmeticEncoder>& points) const {
  // Eight bytes at a time, the last of which may overlap those before.
  struct Word {
    std::size_t offset;
    std::uint64_t first = 0, changes = 0;
  };
  const std::size_t end = place_.offset + bytes_;
  std::vector<Word> words;
  for (std::size_t offset = place_.offset; offset < end; offset += sizeof(std::uint64_t)) {
    words.push_back({.offset = std::min(offset, end - sizeof(std::uint64_t))});
    std::memcpy(&words.back().first, &first_point_[words.back().offset], sizeof(std::uint64_t));
  }
  for (std::size_t begin = 0; begin < points.count(); begin += kBatchPoints) {
    for (Word& word : words)
      for (std::size_t i = begin; i < std::min(begin + kBatchPoints, points.count()); ++i)
        word.changes |= points.Known<std::uint64_t>(i, word.offset) ^ word.first;
  }
  for (const Word& word : words) {
    const auto changes = std::bit_cast<std::array<std::uint8_t, sizeof word.changes>>(word.changes);
    for (std::size_t b = 0; b < changes.size(); ++b)
      if (word.offset + b >= place_.offset) streams[word.offset + b - place_.offset].present |= changes[b] != 0;
  }
}

}  // namespace albtpu::laz
